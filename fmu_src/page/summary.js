/** The results in numbers: cards of the most important ones, and the table of all outputs. */
function addOutputs() {
  const body = document.querySelector("#outputs tbody");
  for (const { name, description } of OUTPUTS) {
    const value = element("td", { class: "value" }, element("output", { name }));
    const head = element("th", { scope: "row" }, ...breakable(name));
    body.append(element("tr", {}, head, value, element("td", {}, description)));
  }
}

/** Show an output in its display unit, and in SI units as `data-value`. */
function showOutput(variable, value) {
  const output = document.querySelector(`#outputs output[name="${variable.name}"]`);
  output.dataset.value = String(value);
  output.textContent = shownValue(variable, value, 7);
}

function clearOutputs() {
  document.querySelectorAll("output[data-value]").forEach((output) => {
    delete output.dataset.value;
    output.textContent = "";
  });
}

const facesOf = (count) => (count === 1 ? "1 face" : `${count} faces`);

/** Return the cards as [class, title, value, remark]. */
function cardsOf({ outputs, isPredicted, end, phase, load, faces, fullFriction: friction }) {
  const shown = (name, value = outputs.get(name)) =>
    shownValue(BY_NAME.get(name), value, 4).replace(" ", "\u00a0");
  const [unit, factor] = timeUnit(end);
  const remark = "not predicted here";
  return [
    ["theory", "steady velocity", isPredicted ? shown("steady_velocity") : "none",
      isPredicted ? `at phase ${shown("phase", phase)}, load ${shown("load", load)}` : remark],
    ["theory", "blocking force", isPredicted ? shown("blocking_force") : "none",
      isPredicted ? "the load that stops the slider" : remark],
    ["run", "mean velocity", shown("mean_velocity"), `of the last period, after ${factor * end}\u00a0${unit}`],
    ["friction", `friction of ${facesOf(faces)}`, shown("normal_preload", friction),
      `while sliding; it heats by ${shown("friction_power")}`],
  ];
}

function showSummary(results) {
  document.getElementById("cards").replaceChildren(
    ...cardsOf(results).map(([kind, title, value, remark]) => element("div", { class: `card ${kind}` },
      element("h3", {}, title), element("strong", {}, value), element("small", {}, remark))));
  OUTPUTS.forEach((variable) => showOutput(variable, results.outputs.get(variable.name)));
  const periods = Number((results.end / results.period).toPrecision(4));
  document.getElementById("cost").textContent =
    `${periods} drive periods and ${PHASE_STEPS + LOAD_STEPS + 2} predictions in ${results.computingTime.toFixed(0)} ms`;
}
