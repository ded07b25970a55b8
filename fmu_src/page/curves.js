/** What the component predicts over phase and load, and what runs end with where it predicts nothing. */
const PHASE_STEPS = 72;
const LOAD_STEPS = 60;
const PREDICTIONS = ["steady_velocity", "blocking_force"];
/** Runs of more drive periods than these are too many to wait for. */
const MAX_SHORT_RUN = 200;

/** Return values from -reach to reach in equal steps. */
function evenly(reach, steps) {
  return Array.from({ length: steps + 1 }, (_, i) => reach * ((2 * i) / steps - 1));
}

/** Predict at values of an input, null where the prediction does not hold; yield at each value.
 * Returns `{at, steady_velocity, blocking_force}`. */
function* predictOver(component, input, at) {
  const present = component.get([input]);
  const curve = { at, steady_velocity: [], blocking_force: [] };
  for (const value of at) {
    component.set(new Map([[input, value]]));
    const found = component.get([...PREDICTIONS, "prediction_valid"]);
    PREDICTIONS.forEach((name) => {
      curve[name].push(found.get("prediction_valid") === 1 ? found.get(name) : null);
    });
    yield;
  }
  component.set(present);
  return curve;
}

/** Return the mean velocity at the end of a run at each phase where none is predicted, else null;
 * yield at each. */
function* runOverPhase(component, settings, { at, steady_velocity: predicted }, end) {
  const velocities = [];
  for (const [i, phase] of at.entries()) {
    velocities.push(null);
    if (predicted[i] === null) {
      component.start(new Map([...valuesOf(settings), ["phase", phase]]));
      component.step(0, end);
      velocities[i] = component.get(["mean_velocity"]).get("mean_velocity");
    }
    yield;
  }
  return velocities;
}
