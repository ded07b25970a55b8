/** Device files, of which the part of TOML is read that they need: comments, the table [device],
 * and in a line a name with a number or a text. */
const DEVICE_LINE = /^\s*(?:\[\s*([^\]]*?)\s*\]|([\w-]+)\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'|[^\s#"']+))?\s*(?:#.*)?$/;
const TEXTS = ["name", "title", "description"];
/** What else a file may be, by the tables that it has. */
const OTHER_FILES = [
  [/^\s*\[+\s*(inputs|run|tuning|need|expect|sweep|beside)\b/m, "a scene: slider-resonator run FILE"],
  [/^\s*\[\s*grid\b/m, "a grid: slider-resonator sweep FILE"],
];

/** Return the text within the quotes of a TOML string. */
function unquoted(token) {
  return token.startsWith("'") ? token.slice(1, -1) : JSON.parse(token);
}

/** Return the value in SI units of a parameter: a number, or a text with a unit. */
function parameterOf(name, token) {
  const parameter = PARAMETERS.find((variable) => variable.name === name);
  if (!parameter) {
    throw new Refused(`${name} refused: must be a parameter, such as slider_mass`);
  }
  if (/^["']/.test(token)) {
    return valueOf(parameter, unquoted(token), "");
  }
  return valueOf(parameter, token.replace(/(\d)_(?=\d)/g, "$1"));
}

/** Return a sentence for each frequency given as a `plain` number in rad/s that may be meant in Hz:
 * round numbers, and a frequency that is 2 pi times or a 2 pi-th of the other. */
function possibleSlips(values, plain) {
  const both = ["drive_frequency", "resonator_frequency"].map(
    (name) => PARAMETERS.find((variable) => variable.name === name));
  const [drive, resonator] = both.map(({ name, start }) => values.get(name) ?? start);
  const isApart = [drive / resonator, resonator / drive].some(
    (ratio) => Math.abs(ratio / (2 * Math.PI) - 1) < 0.03);
  const isSlip = (value, start) => value > 0
    && (isApart || (value !== start && Number(value.toPrecision(2)) === value));
  return both.filter(({ name, start }) => plain.has(name) && isSlip(values.get(name), start))
    .map((variable) => {
      const [name, value] = [variable.name, values.get(variable.name)];
      return `${name} = ${value} is in rad/s, which is ${shownValue(variable, value)}; `
        + `if ${value} Hz is meant, write ${name} = "${value} Hz"`;
    });
}

/** Return `{title, values, slips}` of a device file; what it leaves out keeps its start.
 * Throw Refused with the line, key, value and what it must be. */
function deviceOf(text) {
  const device = { title: "", values: new Map() };
  const seen = new Set();
  const plain = new Set();
  let isBelow = false;
  const other = OTHER_FILES.find(([table]) => table.test(text));
  if (other) {
    throw new Refused(`the file refused: must be a device file; it is ${other[1]}`);
  }
  text.replace(/^\uFEFF/, "").split(/\r?\n/).forEach((line, i) => {
    try {
      const [whole, table, name, token] = DEVICE_LINE.exec(line) ?? [];
      if (whole === undefined) {
        throw new Refused(`${line.trim()} refused: must be [device], or a name = a number or "text"`);
      }
      const key = table ?? name;
      if (key !== undefined && seen.size === seen.add(`${isBelow} ${key}`).size) {
        throw new Refused(`${key} refused: must be given once`);
      }
      if (table !== undefined) {
        if (table !== "device") {
          throw new Refused(`[${table}] refused: must be [device]`);
        }
        isBelow = true;
      } else if (name && isBelow) {
        device.values.set(name, parameterOf(name, token));
        if (!/^["']/.test(token)) {
          plain.add(name);
        }
      } else if (name === "title") {
        device.title = unquoted(token);
      } else if (name && !TEXTS.includes(name)) {
        throw new Refused(`${name} refused: must be below [device], or one of ${TEXTS.join(", ")}`);
      }
    } catch (error) {
      if (error instanceof Refused || error instanceof SyntaxError) {
        throw new Refused(`line ${i + 1}: ${error.message}`);
      }
      throw error;
    }
  });
  if (!isBelow) {
    throw new Refused("the file must have a table headed [device]");
  }
  return { ...device, slips: possibleSlips(device.values, plain) };
}

/** Return the text of a device file: a title, what differs from the start, and the number of faces. */
function deviceText(values, title) {
  const lines = [...(title ? [`title = ${JSON.stringify(title)}`, ""] : []), "[device]"];
  for (const parameter of PARAMETERS) {
    const { name, start, unit } = parameter;
    const value = values.get(name) ?? start;
    if (value !== start || name === "friction_faces") {
      const comment = unit && unit !== "1" ? `  # ${unit}, ${shownValue(parameter, value)}` : "";
      lines.push(`${name} = ${value}${comment}`);
    }
  }
  return lines.join("\n") + "\n";
}
