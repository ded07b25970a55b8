/** Milliseconds of work after which the page may respond. */
const SLICE = 40;
/** Bounds of a run that follows the device, in drive periods. */
const MIN_PERIODS = 20;
const MAX_PERIODS = 20000;

/** Return a time from the start to steady motion, rounded up to 1, 2 or 5 times a power of ten: four
 * times that in which friction changes the velocity by the largest of those at the start and steady. */
function settlingTime(settings, period, velocities) {
  const mass = settingOf(settings, "slider_mass") + settingOf(settings, "resonator_mass");
  const fastest = Math.max(...[...velocities, settingOf(settings, "initial_velocity")].map(Math.abs));
  const time = Math.min(MAX_PERIODS * period,
    Math.max(MIN_PERIODS * period, (4 * mass * fastest) / fullFriction(settings) || 0));
  const power = 10 ** Math.floor(Math.log10(time));
  return Number((power * [1, 2, 5, 10].find((digit) => time <= digit * power)).toPrecision(1));
}

/** Compute what the page shows of settings; yield where it may wait. */
function* work(component, settings) {
  component.start(valuesOf(settings));
  const frequency = settingOf(settings, "drive_frequency") * (1 + settingOf(settings, "frequency_deviation"));
  const period = (2 * Math.PI) / frequency;
  const overPhase = yield* predictOver(component, "phase", evenly(Math.PI, PHASE_STEPS));
  const full = fullFriction(settings);
  const overLoad = yield* predictOver(component, "load", full > 0 ? evenly(full, LOAD_STEPS) : []);
  const end = settings.time ?? settlingTime(settings, period, overPhase.steady_velocity);
  const runsOverPhase = end <= MAX_SHORT_RUN * period
    ? yield* runOverPhase(component, settings, overPhase, end) : overPhase.at.map(() => null);
  component.start(valuesOf(settings));
  const run = yield* runTo(component, end);
  const outputs = component.get(OUTPUTS.map((variable) => variable.name));
  return {
    run, end, outputs, overPhase, overLoad, runsOverPhase, period,
    isPredicted: outputs.get("prediction_valid") === 1,
    phase: settingOf(settings, "phase"),
    load: settingOf(settings, "load"),
    faces: settingOf(settings, "friction_faces"),
    fullFriction: full,
    closeUp: closeUp(component, end, period),
  };
}

/** Return the results of settings with `computingTime` in ms, or null once `isCurrent` is false;
 * `onWait` is called often. */
async function computeResults(component, settings, isCurrent, onWait) {
  const steps = work(component, settings);
  for (let computingTime = 0; isCurrent(); ) {
    const begin = performance.now();
    let turn = steps.next();
    while (!turn.done && performance.now() - begin < SLICE) {
      turn = steps.next();
    }
    computingTime += performance.now() - begin;
    if (turn.done) {
      return { ...turn.value, computingTime };
    }
    onWait();
    await new Promise((resolve) => setTimeout(resolve));
  }
  return null;
}
