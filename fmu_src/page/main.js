/** Milliseconds after which a message says that the page computes. */
const PATIENCE = 400;

const byId = (id) => document.getElementById(id);

function showMessage(text, isBusy = false) {
  byId("message").hidden = text === "";
  byId("message").classList.toggle("busy", isBusy);
  document.querySelector('output[name="message"]').textContent = text;
}

/** Do something; show what is refused. Returns whether it was done. */
async function guarded(action) {
  try {
    await action();
    return true;
  } catch (error) {
    if (!(error instanceof Refused)) {
      throw error;
    }
    showMessage(error.message);
    return false;
  }
}

/** Show what differs from the device, each with a button that takes it back. */
function showChanges(settings) {
  const chips = [...settings.changes].map(([name, value]) => {
    const chip = element("button", { type: "button", title: `Set ${name} back` },
      `${name} ${shownValue(BY_NAME.get(name), value)} ✕`);
    chip.addEventListener("click", () => edit((now) => change(now, name, unchanged(now, name))));
    return chip;
  });
  if (settings.time !== null) {
    const chip = element("button", { type: "button", title: "Let t follow the device" },
      `t ${shownValue(TIME, settings.time)} ✕`);
    chip.addEventListener("click", () => edit((now) => { now.time = null; }));
    chips.push(chip);
  }
  byId("changes").replaceChildren(...(chips.length ? ["changed:", ...chips] : ["unchanged"]));
}

let component;
let sketch;
let runs = 0;
let deviceShown = null;
let note = "";

function showSettings(settings, isNew) {
  byId("device").value = settings.device;
  showControls(controls, settings, isNew || settings.device !== deviceShown);
  deviceShown = settings.device;
  showChanges(settings);
}

/** Run the settings of the address and show the results; a later call cancels an earlier one. */
async function showAddress(isNew = false) {
  const mine = ++runs;
  document.body.dataset.state = "running";
  const settings = settingsOf(location.hash);
  showSettings(settings, isNew);
  const isDone = await guarded(async () => {
    if (settings.refused) {
      throw settings.refused;
    }
    const begin = performance.now();
    const results = await computeResults(component, settings, () => mine === runs,
      () => performance.now() - begin > PATIENCE && showMessage("computing", true));
    if (results) {
      showMessage(note);
      note = "";
      controls.get("t").field.placeholder = `auto ${results.end}`;
      showSummary(results);
      showPlots(results);
      sketch.show(results);
    }
  });
  if (mine === runs) {
    byId("results").classList.toggle("stale", !isDone);
    if (!isDone) {
      clearOutputs();
    }
    byId("save").disabled = !isDone;
    document.body.dataset.state = isDone ? "done" : "refused";
  }
}

/** Change the settings: the address holds them all, less what it had that is refused. */
function edit(action) {
  return guarded(() => {
    const settings = settingsOf(location.hash);
    action(settings);
    show(settings);
  });
}

let isRequested = false;

/** Put settings into the address and show them in the next frame, once for all until then. */
function show(settings, isNew = false) {
  history.replaceState(null, "", hashOf(settings));
  document.body.dataset.state = "running";
  if (!isRequested) {
    isRequested = true;
    requestAnimationFrame(() => {
      isRequested = false;
      showAddress(isNew);
    });
  }
}

const controls = makeControls(
  (name, text) => edit((settings) => setOne(settings, name, text, displayUnit(BY_NAME.get(name) ?? TIME))),
  (name, value) => edit((settings) => change(settings, name, value)));
DEVICES.forEach(({ title }, name) => byId("device").append(element("option", { value: name }, title)));
byId("device").addEventListener("change", () => show(freshSettings(byId("device").value), true));
byId("reset").addEventListener("click", () => show(freshSettings(byId("device").value), true));
byId("load").addEventListener("click", () => byId("file").click());
byId("file").addEventListener("change", () => guarded(async () => {
  const [file] = byId("file").files;
  byId("file").value = "";
  const { values, slips } = deviceOf(await file.text());
  note = slips.join("\n");
  show(settingsFor(values), true);
}));
byId("save").addEventListener("click", () => {
  const settings = settingsOf(location.hash);
  const { title } = DEVICES.get(settings.device);
  const isOther = PARAMETERS.some(({ name }) => settings.changes.has(name));
  download("device.toml", deviceText(valuesOf(settings), isOther ? "" : title));
});
byId("share").addEventListener("click", async () => {
  await navigator.clipboard.writeText(location.href);
  byId("share").textContent = "Copied";
  setTimeout(() => { byId("share").textContent = "Copy link"; }, 1500);
});
byId("controls").addEventListener("submit", (event) => event.preventDefault());
window.addEventListener("hashchange", () => showAddress(true));
addOutputs();
sketch = new Sketch();
component = await Component.load();
await showAddress(true);
