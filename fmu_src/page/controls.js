/** The fields of settings in groups, with sliders beside those that have a range. */
const GROUPS = [
  ["Inputs", ["phase", "load", "frequency_ratio"]],
  ["Friction", ["friction_faces", "friction_coefficient", "normal_preload", "normal_amplitude",
    "friction_law", "bristle_stiffness", "bristle_damping"]],
  ["Drive", ["base_amplitude", "tangential_force", "drive_frequency"]],
  ["Slider and resonator",
    ["slider_mass", "resonator_mass", "resonator_frequency", "damping_ratio"]],
  ["Model", ["fidelity", "averaging_order", "t"]],
];
const CHOICES = new Map([
  ["friction_faces", [[1, "1 face"], [2, "2 faces"]]],
  ["friction_law", [[0, "0: Coulomb"], [1, "1: LuGre"]]],
  ["fidelity", [[0, "0: slow motion"], [1, "1: slider"], [2, "2: full device"]]],
  ["averaging_order", [[1, "1: averages"], [2, "2: leaps over periods"]]],
]);
const LUGRE_ONLY = ["bristle_stiffness", "bristle_damping"];

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  made.append(...children);
  return made;
}

/** Return a name of which a line may end behind each underscore. */
function breakable(name) {
  return name.split(/(?<=_)/).flatMap((part) => [document.createElement("wbr"), part]);
}

/** A row of a setting. `onText(name, text)` is called with what is typed or chosen, a bare number
 * being in the unit that is shown; `onValue(name, value)` with the SI value of a slider. */
class Control {
  constructor(variable, onText, onValue) {
    const { name, description } = variable;
    const unit = displayUnit(variable);
    const choices = CHOICES.get(name);
    const attributes = { id: `field-${name}`, name };
    this.variable = variable;
    this.field = choices
      ? element("select", attributes, ...choices.map(([value, text]) => element("option", { value }, text)))
      : element("input", { ...attributes, type: "text", autocomplete: "off" });
    this.field.addEventListener("change", () => onText(name, this.field.value));
    this.row = element("div", { class: "control", title: `${name}: ${description}` },
      element("label", { for: attributes.id }, ...breakable(name)), this.field);
    if (!choices) {
      this.row.append(element("span", { class: "unit" }, unit === "1" ? "" : unit));
    }
    if (RANGES.has(name)) {
      this.slider = element("input", { type: "range", min: 0, max: SLIDER_STEPS, "aria-label": name });
      this.slider.addEventListener("input", () => {
        onValue(name, valueAt(this.range, this.slider.valueAsNumber));
      });
      this.row.append(this.slider);
    }
  }

  /** Show a value, or null for none, marked where it is changed. While a slider moves, its range
   * stays: only `isNew`, for a new device, or a value beyond sets another. */
  show(value, isChanged, isNew, settings) {
    const { name } = this.variable;
    this.row.classList.toggle("changed", isChanged);
    this.row.hidden = LUGRE_ONLY.includes(name) && settingOf(settings, "friction_law") === 0;
    this.field.value = value === null ? ""
      : this.field.matches("select") ? String(value) : shownNumber(this.variable, value);
    if (this.slider) {
      const isWithin = value >= this.range?.[0] && value <= this.range?.[1];
      if (isNew || !isWithin || name === "load") {
        this.range = RANGES.get(name)(value, settings, this.variable);
      }
      this.slider.value = String(stepAt(this.range, value));
      this.slider.setAttribute("aria-valuetext", shownValue(this.variable, value));
    }
  }
}

/** Return the controls of all settings by name, shown on the page. */
function makeControls(onText, onValue) {
  const controls = new Map();
  const isNarrow = window.matchMedia("(max-width: 56rem)").matches;
  const grouped = GROUPS.flatMap(([, names]) => names);
  const rest = SETTABLE.map(({ name }) => name).filter((name) => !grouped.includes(name));
  [...GROUPS, ["More settings", rest]].forEach(([title, names], i) => {
    const group = element("details", {}, element("summary", {}, title));
    group.open = i === 0 || (!isNarrow && names !== rest);
    for (const name of names) {
      const control = new Control(name === "t" ? TIME : BY_NAME.get(name), onText, onValue);
      controls.set(name, control);
      group.append(control.row);
    }
    document.getElementById("controls").append(group);
  });
  return controls;
}

function showControls(controls, settings, isNew) {
  for (const [name, control] of controls) {
    if (name === "t") {
      control.show(settings.time, settings.time !== null, isNew, settings);
    } else {
      control.show(settingOf(settings, name), settings.changes.has(name), isNew, settings);
    }
  }
}
