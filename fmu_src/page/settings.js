/** Settings of a run: the end time `t` in s, and values by variable name where they are not starts. */
const MAX_TIME = 3600;
const START_TIME = 4;
const SLIDER_STEPS = 400;

/** Controls shown first, with the range of their sliders; text fields take any value. */
const RANGES = new Map([
  ["phase", [-Math.PI, Math.PI]],
  ["load", [-0.2, 0.2]],
  ["frequency_ratio", [0, 4]],
  ["friction_coefficient", [0, 1]],
  ["normal_preload", [0, 3]],
  ["normal_amplitude", [0, 3]],
  ["base_amplitude", [0, 3e-4]],
  ["drive_frequency", [1750, 7000]],
]);
const CHOICES = new Map([
  ["fidelity", [[0, "0: slow motion"], [1, "1: slider"], [2, "2: full device"]]],
  ["friction_law", [[0, "0: Coulomb"], [1, "1: LuGre"]]],
]);

/** Return a number, throw Refused unless the whole text is one. */
function numberOf(name, text) {
  const value = Number(text);
  if (text.trim() === "" || !Number.isFinite(value)) {
    throw new Refused(`${name} = ${text} refused: must be a finite number`);
  }
  return value;
}

/** Return the value of one of the `SLIDER_STEPS` equal steps of a slider; its ends are exact. */
function valueAt([min, max], step) {
  const value = min + ((max - min) * step) / SLIDER_STEPS;
  return value === min || value === max ? value : Number(value.toPrecision(12));
}

/** Return the step of a slider that is nearest to a value. */
function stepAt([min, max], value) {
  return Math.round(((value - min) / (max - min)) * SLIDER_STEPS);
}

/** Set one of `{time, values}`, throw Refused for another name or what is no number. */
function setOne(settings, name, text) {
  if (name === "t") {
    settings.time = numberOf(name, text);
  } else if (BY_NAME.has(name) && BY_NAME.get(name).causality !== "output") {
    settings.values.set(name, numberOf(name, text));
  } else {
    throw new Refused(`${name} refused: must be t, an input or a parameter`);
  }
}

/** Return `{time, values, refused}` of an address like "#phase=0.4&t=20"; the first
 * refusal counts, and what is refused, or given again, sets nothing. */
function settingsOf(hash) {
  const settings = { time: START_TIME, values: new Map(), refused: null };
  const seen = new Set();
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    try {
      if (seen.has(name)) {
        throw new Refused(`${name} = ${text} refused: must be given once`);
      }
      seen.add(name);
      setOne(settings, name, text);
    } catch (error) {
      if (!(error instanceof Refused)) {
        throw error;
      }
      settings.refused ??= error;
    }
  }
  return settings;
}

/** Return the address of settings, without values that are at their start. */
function hashOf({ time, values }) {
  const parts = [...values].filter(([name, value]) => value !== BY_NAME.get(name).start);
  if (time !== START_TIME) {
    parts.push(["t", time]);
  }
  return "#" + parts.map(([name, value]) => `${name}=${value}`).join("&");
}
