const STEPS = 1000;
const PERIODS_SHOWN = 4;
const SAMPLES_PER_PERIOD = 100;
const LOADS = 61;
/** Milliseconds of work after which the page may respond. */
const SLICE = 40;

/** Record variables: an object of arrays by name, `time` among them. */
function emptyRecord(names) {
  return Object.fromEntries(["time", ...names].map((name) => [name, []]));
}

function sample(component, record, time) {
  const names = Object.keys(record).filter((name) => name !== "time");
  record.time.push(time);
  for (const [name, value] of component.get(names)) {
    record[name].push(value);
  }
}

/** Run from rest to `time` in STEPS equal steps; yield the share done, return the record. */
function* runTo(component, { time, values }) {
  if (!(time > 0 && time <= MAX_TIME)) {
    throw new Refused(`t = ${time} refused: must be above 0 and at most ${MAX_TIME} s`);
  }
  component.start(values);
  const record = emptyRecord(["position", "mean_velocity"]);
  sample(component, record, 0);
  let now = 0;
  for (let i = 1; i <= STEPS; i++) {
    const next = i === STEPS ? time : (time * i) / STEPS;
    component.step(now, next - now);
    // As the component adds: the next step has to begin where this one ended.
    now += next - now;
    sample(component, record, now);
    yield i / STEPS;
  }
  return record;
}

/** Go on for some drive periods; return their record. */
function closeUp(component, time, period) {
  const record = emptyRecord([
    "velocity", "position", "resonator_displacement", "normal_force", "friction_force",
    "contact_mode",
  ]);
  const size = period / SAMPLES_PER_PERIOD;
  let now = time;
  sample(component, record, now);
  for (let i = 0; i < PERIODS_SHOWN * SAMPLES_PER_PERIOD; i++) {
    component.step(now, size);
    now += size;
    sample(component, record, now);
  }
  return record;
}

/** Predict the steady velocity over loads up to full friction, one way and the other. */
function loadSpeedCurve(component) {
  const names = ["friction_faces", "friction_coefficient", "normal_preload", "load"];
  const [faces, coefficient, preload, load] = component.get(names).values();
  const full = faces * coefficient * preload;
  const curve = { load: [], steady_velocity: [] };
  for (let i = 0; i < LOADS && full > 0; i++) {
    const at = full * ((2 * i) / (LOADS - 1) - 1);
    component.set(new Map([["load", at]]));
    curve.load.push(at);
    curve.steady_velocity.push(component.get(["steady_velocity"]).get("steady_velocity"));
  }
  component.set(new Map([["load", load]]));
  return curve;
}

/** Return everything that the page shows of settings, or null once `isCurrent` is false. */
async function computeResults(component, settings, isCurrent, onProgress) {
  const begin = performance.now();
  let sliceBegin = begin;
  let waited = 0;
  const run = runTo(component, settings);
  let turn = run.next();
  for (; !turn.done; turn = run.next()) {
    const now = performance.now();
    if (now - sliceBegin > SLICE) {
      onProgress(turn.value);
      await new Promise((resolve) => setTimeout(resolve));
      sliceBegin = performance.now();
      waited += sliceBegin - now;
      if (!isCurrent()) {
        return null;
      }
    }
  }
  const computingTime = performance.now() - begin - waited;
  const outputs = component.get(OUTPUTS.map((variable) => variable.name));
  const present = component.get(["drive_frequency", "load"]);
  const period = (2 * Math.PI) / present.get("drive_frequency");
  const curve = loadSpeedCurve(component);
  return {
    run: turn.value, outputs, curve, computingTime, period,
    load: present.get("load"),
    periods: settings.time / period,
    closeUp: closeUp(component, settings.time, period),
  };
}
