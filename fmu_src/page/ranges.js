/** Ranges of sliders in SI units, which follow the device: the value itself is a step of its range. */
const SLIDER_STEPS = 360;

const ascending = (...ends) => ends.sort((one, other) => one - other);
const fromZero = (value, settings, { start }) =>
  ascending(0, 4 * (value || start || settingOf(settings, "normal_preload") || 1));
const around = (value) => [value / 2, 1.5 * value];
const RANGES = new Map([
  ["phase", () => [-Math.PI, Math.PI]],
  ["load", (_, settings) => {
    const full = fullFriction(settings) || 1;
    return [-full, full];
  }],
  ["frequency_ratio", (value) => [Math.min(0, 2 * value), Math.max(4, 2 * value)]],
  ["friction_coefficient", fromZero],
  ["normal_preload", fromZero],
  ["normal_amplitude", fromZero],
  ["base_amplitude", fromZero],
  ["tangential_force", fromZero],
  ["drive_frequency", around],
  ["slider_mass", around],
  ["resonator_mass", fromZero],
  ["resonator_frequency", around],
  ["damping_ratio", fromZero],
]);

/** Return the friction of all faces while the slider slides under the mean normal load, in N. */
function fullFriction(settings) {
  const [faces, coefficient, preload] = ["friction_faces", "friction_coefficient", "normal_preload"]
    .map((name) => settingOf(settings, name));
  return faces * coefficient * preload;
}

/** Return the value of a step of a slider; its ends are exact. */
function valueAt([low, high], step) {
  const value = low + ((high - low) * step) / SLIDER_STEPS;
  return value === low || value === high ? value : Number(value.toPrecision(12));
}

/** Return the step of a slider that is nearest to a value. */
function stepAt([low, high], value) {
  return Math.round(((value - low) / (high - low)) * SLIDER_STEPS);
}
