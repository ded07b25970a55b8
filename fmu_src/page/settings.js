/** Settings of a run: a device by name, the changes of its values and of inputs, in SI units, and
 * the end of the run in s, or null for one that follows the device. */
const MAX_TIME = 3600;
const TIME = { name: "t", unit: "s", display_unit: null, factor: 1, description: "End of the run" };

/** Devices to start from, as `{title, values}` by name. */
const DEVICES = new Map(
  Object.entries(JSON.parse(document.getElementById("devices").textContent))
    .map(([name, text]) => [name, deviceOf(text)]));
const [FIRST_DEVICE] = DEVICES.keys();

/** Return the value that a setting has without a change. */
function unchanged({ device }, name) {
  return DEVICES.get(device).values.get(name) ?? BY_NAME.get(name).start;
}

function settingOf(settings, name) {
  return settings.changes.get(name) ?? unchanged(settings, name);
}

/** Return all values that are not at their start. */
function valuesOf({ device, changes }) {
  return new Map([...DEVICES.get(device).values, ...changes]);
}

function freshSettings(device = FIRST_DEVICE) {
  return { device, time: null, changes: new Map() };
}

/** Set a value in SI units. */
function change(settings, name, value) {
  if (value === unchanged(settings, name)) {
    settings.changes.delete(name);
  } else {
    settings.changes.set(name, value);
  }
}

/** Set one setting; throw Refused for another name, or what is no number in `unit`. */
function setOne(settings, name, text, unit) {
  if (name === "t") {
    const time = text.trim() === "" ? null : valueOf(TIME, text);
    if (time !== null && !(time > 0 && time <= MAX_TIME)) {
      throw new Refused(`t = ${text} refused: must be above 0 and at most ${MAX_TIME} s`);
    }
    settings.time = time;
  } else if (SETTABLE.includes(BY_NAME.get(name))) {
    change(settings, name, valueOf(BY_NAME.get(name), text, unit));
  } else {
    throw new Refused(`${name} refused: must be device, t, an input or a parameter`);
  }
}

/** Return settings of the device that differs least from values, with these values. */
function settingsFor(values) {
  const candidates = [...DEVICES.keys()].map((device) => {
    const settings = freshSettings(device);
    PARAMETERS.forEach(({ name, start }) => change(settings, name, values.get(name) ?? start));
    return settings;
  });
  return candidates.reduce((best, other) => (other.changes.size < best.changes.size ? other : best));
}

/** Return the settings of an address like "#device=stick_slip&phase=0.4&t=20", and as `refused`
 * its first refusal; what is refused, or given again, sets nothing. */
function settingsOf(hash) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const device = given.get("device") ?? FIRST_DEVICE;
  const isKnown = DEVICES.has(device);
  const settings = freshSettings(isKnown ? device : FIRST_DEVICE);
  settings.refused = isKnown ? null : new Refused(
    `device = ${device} refused: must be one of ${[...DEVICES.keys()].join(", ")}`);
  const seen = new Set();
  for (const [name, text] of given) {
    try {
      if (seen.has(name)) {
        throw new Refused(`${name} = ${text} refused: must be given once`);
      }
      seen.add(name);
      if (name !== "device") {
        setOne(settings, name, text);
      }
    } catch (error) {
      if (!(error instanceof Refused)) {
        throw error;
      }
      settings.refused ??= error;
    }
  }
  return settings;
}

/** Return the address of settings, which has all that differs from the first device. */
function hashOf({ device, time, changes }) {
  const parts = device === FIRST_DEVICE ? [] : [["device", device]];
  parts.push(...changes);
  if (time !== null) {
    parts.push(["t", time]);
  }
  return "#" + parts.map(([name, value]) => `${name}=${value}`).join("&");
}
