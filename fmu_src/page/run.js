const STEPS = 1000;
const PERIODS_SHOWN = 4;
const SAMPLES_PER_PERIOD = 100;

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

/** Go on from time 0 to `end` in STEPS equal steps; yield at each, return the record. */
function* runTo(component, end) {
  const record = emptyRecord(["position", "mean_velocity"]);
  sample(component, record, 0);
  let now = 0;
  for (let i = 1; i <= STEPS; i++) {
    const next = i === STEPS ? end : (end * i) / STEPS;
    component.step(now, next - now);
    // As the component adds: the next step has to begin where this one ended.
    now += next - now;
    sample(component, record, now);
    yield;
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
