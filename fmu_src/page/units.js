/** Factors of units to SI, and their exponents of kg, m, s and rad. */
const SYMBOLS = new Map([
  ["1", [1, [0, 0, 0, 0]]], ["%", [0.01, [0, 0, 0, 0]]],
  ["g", [1e-3, [1, 0, 0, 0]]], ["m", [1, [0, 1, 0, 0]]], ["s", [1, [0, 0, 1, 0]]],
  ["N", [1, [1, 1, -2, 0]]], ["rad", [1, [0, 0, 0, 1]]],
  ["deg", [Math.PI / 180, [0, 0, 0, 1]]], ["°", [Math.PI / 180, [0, 0, 0, 1]]],
  ["gf", [9.80665e-3, [1, 1, -2, 0]]], ["lbf", [4.4482216152605, [1, 1, -2, 0]]],
  ["lb", [0.45359237, [1, 0, 0, 0]]], ["in", [0.0254, [0, 1, 0, 0]]], ["min", [60, [0, 0, 1, 0]]],
  ["Hz", [2 * Math.PI, [0, 0, -1, 1]]], ["rpm", [Math.PI / 30, [0, 0, -1, 1]]],
]);
const PREFIXES = new Map([
  ["n", 1e-9], ["u", 1e-6], ["µ", 1e-6], ["μ", 1e-6], ["m", 1e-3], ["c", 1e-2], ["k", 1e3], ["M", 1e6],
]);

/** Return [factor, exponents] of one unit, with or without a prefix, or undefined. */
function symbolOf(word) {
  if (SYMBOLS.has(word)) {
    return SYMBOLS.get(word);
  }
  const [prefix, symbol] = [PREFIXES.get(word[0]), SYMBOLS.get(word.slice(1))];
  return prefix && symbol && [prefix * symbol[0], symbol[1]];
}

/** Return `{factor, dimension}` of a product like "kHz", "mm/s" or "1/um", or null. */
function unitOf(text) {
  let factor = 1;
  const dimension = [0, 0, 0, 0];
  for (const part of text.split(/(?=[*/])/)) {
    const [, operator, word, power = "1"] = /^([*/]?)\s*([^\s^]+)(?:\^(-?\d))?\s*$/.exec(part) ?? [];
    const symbol = word && symbolOf(word);
    if (!symbol) {
      return null;
    }
    const exponent = operator === "/" ? -Number(power) : Number(power);
    factor *= symbol[0] ** exponent;
    symbol[1].forEach((of, i) => { dimension[i] += of * exponent; });
  }
  return { factor, dimension: String(dimension) };
}

const NUMBER_WITH_UNIT = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$/;

/** Return a value in SI units from a text like "20 kHz"; a bare number is in `bareUnit`.
 * Throw Refused unless the whole text is a number with a unit of the variable. */
function valueOf(variable, text, bareUnit = variable.unit) {
  const { name, unit } = variable;
  const [, number, given] = NUMBER_WITH_UNIT.exec(text) ?? [];
  if (!Number.isFinite(Number(number)) || !(given || bareUnit)) {
    throw new Refused(`${name} = ${text} refused: ${mustBe(variable, bareUnit)}`);
  }
  const scale = unitOf(given || bareUnit);
  if (scale?.dimension !== unitOf(unit).dimension) {
    const of = unit === "1" ? "a ratio" : unit;
    throw new Refused(
      `${name} = ${text} refused: ${given} is no unit of ${of} that is known here; ${mustBe(variable, bareUnit)}`);
  }
  // So that "10 um" is 1e-5 and "30.1 mN" is 0.0301, to the last bit.
  const power = Math.round(Math.log10(scale.factor));
  const [digits, exponent = "0"] = number.toLowerCase().split("e");
  const isDecimal = Math.abs(scale.factor / 10 ** power - 1) < 1e-12;
  return isDecimal ? Number(`${digits}e${Number(exponent) + power}`) : Number(number) * scale.factor;
}

function mustBe({ unit, display_unit: display }, bareUnit) {
  const number = bareUnit === "1" ? "a finite number, or " : `a finite number in ${bareUnit}, or `;
  const example = display ?? (unit === "1" ? "%" : unit);
  return `must be ${bareUnit ? number : ""}a text with a unit such as "2 ${example}"`;
}

const displayUnit = ({ display_unit: display, unit }) => display ?? unit;

/** Return a value as a number in the unit that is shown, such as mm/s or Hz. */
function shownNumber({ factor }, value, digits = 6) {
  return String(Number((factor * value).toPrecision(digits)));
}

function shownValue(variable, value, digits) {
  const unit = displayUnit(variable);
  return `${shownNumber(variable, value, digits)} ${unit === "1" ? "" : unit}`.trim();
}
