const UNIT_OF_TIME = "s";

/** Fields by name of a setting: its text field or choice, and its slider where it has one. */
const fields = new Map();

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  made.append(...children);
  return made;
}

function addControl(parent, { name, unit, description, start }, range, choices) {
  const id = `field-${name}`;
  const box = element("div", { class: "control", title: description });
  box.append(element("label", { for: id }, name));
  if (choices) {
    const options = choices.map(([value, text]) => element("option", { value }, text));
    const select = element("select", { id, name }, ...options);
    select.addEventListener("change", () => changeSetting(name, select.value));
    fields.set(name, { text: select, start });
    box.append(select);
  } else {
    const text = element("input", { id, name, type: "text", inputmode: "decimal", autocomplete: "off" });
    text.addEventListener("change", () => changeSetting(name, text.value));
    box.append(text, element("span", { class: "unit" }, unit && unit !== "1" ? unit : ""));
    const field = { text, start };
    if (range) {
      field.range = range;
      field.slider = element("input", { type: "range", min: 0, max: SLIDER_STEPS, "aria-label": name });
      field.slider.addEventListener("input", () => {
        changeSetting(name, String(valueAt(range, field.slider.valueAsNumber)));
      });
      box.append(field.slider);
    }
    fields.set(name, field);
  }
  parent.append(box);
}

function addControls() {
  const main = document.getElementById("main-controls");
  const more = document.getElementById("more-controls");
  const time = { name: "t", unit: UNIT_OF_TIME, description: "End of the run", start: START_TIME };
  const first = [...RANGES.keys(), ...CHOICES.keys()];
  first.forEach((name) => addControl(main, BY_NAME.get(name), RANGES.get(name), CHOICES.get(name)));
  addControl(main, time, [0.02, 20]);
  SETTABLE.filter(({ name }) => !first.includes(name)).forEach((variable) => addControl(more, variable));
}

function addOutputs() {
  const body = document.querySelector("#outputs tbody");
  for (const { name, description } of OUTPUTS) {
    const value = element("td", { class: "value" }, element("output", { name }));
    body.append(element("tr", {}, element("th", { scope: "row" }, name), value, element("td", {}, description)));
  }
}

/** Show a value in its display unit, and in SI units as `data-value`. */
function showValue(name, value, { factor = 1, unit = "" } = {}) {
  const output = document.querySelector(`output[name="${name}"]`);
  output.dataset.value = String(value);
  output.textContent = `${Number((factor * value).toPrecision(7))} ${unit}`.trim();
}

function displayUnit({ display_unit: display, unit, factor }) {
  return { factor, unit: display ?? (unit === "1" || !unit ? "" : unit) };
}

function showMessage(text, isBusy = false) {
  const box = document.getElementById("message");
  box.hidden = text === "";
  box.classList.toggle("busy", isBusy);
  document.querySelector('output[name="message"]').textContent = text;
}

function showSettings(settings) {
  for (const [name, { text, slider, range, start }] of fields) {
    const value = name === "t" ? settings.time : settings.values.get(name) ?? start;
    if (document.activeElement !== text || Number(text.value) !== value) {
      text.value = String(value);
    }
    if (slider) {
      slider.value = String(stepAt(range, value));
      slider.setAttribute("aria-valuetext", String(value));
    }
  }
}

function markStale(isStale) {
  document.getElementById("results").classList.toggle("stale", isStale);
  if (isStale) {
    document.querySelectorAll("output[data-value]").forEach((output) => {
      delete output.dataset.value;
      output.textContent = "";
    });
  }
}

let sketch;
let component;
let runs = 0;

/** Run the settings of the address and show the results; a later call cancels an earlier one. */
async function showAddress() {
  const mine = ++runs;
  document.body.dataset.state = "running";
  try {
    const settings = settingsOf(location.hash);
    showSettings(settings);
    if (settings.refused) {
      throw settings.refused;
    }
    const results = await computeResults(component, settings, () => mine === runs,
      (share) => showMessage(`computing, ${Math.round(100 * share)} %`, true));
    if (results === null) {
      return;
    }
    showMessage("");
    markStale(false);
    OUTPUTS.forEach((variable) => showValue(variable.name, results.outputs.get(variable.name), displayUnit(variable)));
    showValue("periods", results.periods, { unit: "" });
    showValue("computing_time", results.computingTime / 1e3, { factor: 1e3, unit: "ms" });
    showPlots(results);
    sketch.show(results);
    document.body.dataset.state = "done";
  } catch (error) {
    if (!(error instanceof Refused)) {
      throw error;
    }
    markStale(true);
    showMessage(error.message);
    document.body.dataset.state = "refused";
  }
}

/** Change one setting: the address holds them all, less what it had that is refused. */
function changeSetting(name, text) {
  try {
    const settings = settingsOf(location.hash);
    setOne(settings, name, text);
    history.replaceState(null, "", hashOf(settings));
    requestShow();
  } catch (error) {
    if (!(error instanceof Refused)) {
      throw error;
    }
    showMessage(error.message);
  }
}

let isRequested = false;

/** Show the address in the next frame, once for all changes until then. */
function requestShow() {
  if (!isRequested) {
    isRequested = true;
    document.body.dataset.state = "running";
    requestAnimationFrame(() => {
      isRequested = false;
      showAddress();
    });
  }
}

addControls();
addOutputs();
document.getElementById("controls").addEventListener("submit", (event) => event.preventDefault());
document.getElementById("controls").addEventListener("reset", (event) => {
  event.preventDefault();
  history.replaceState(null, "", "#");
  requestShow();
});
window.addEventListener("hashchange", requestShow);
sketch = new Sketch();
component = await Component.load();
await showAddress();
