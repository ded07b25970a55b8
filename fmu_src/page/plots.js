/** What the plots show of results, in units that suit. */
const scaled = (values, factor) => values.map((value) => (value === null ? null : factor * value));
const DEGREES = 180 / Math.PI;
const MODES = new Map([
  [1, { label: "slips forwards", colour: "forwards" }],
  [-1, { label: "slips backwards", colour: "backwards" }],
  [0, { label: "sticks", colour: "sticks" }],
  [2, { label: "lifted", colour: "lifted" }],
]);
const NOT_VALID = "no steady motion is predicted";

/** Return the unit and the factor of a time, in ms where it is short. */
function timeUnit(time) {
  return time < 0.5 ? ["ms", 1e3] : ["s", 1];
}

function overTime({ run, end }, y, values, label, more = () => []) {
  const [unit, factor] = timeUnit(end);
  const times = scaled(run.time, factor);
  return { x: { label: "time", unit }, y, curves: [{ label, x: times, y: values, colour: "run" }, ...more(times)] };
}

const AFTER = { label: "time after the end of the run", unit: "ms" };
const afterEnd = ({ closeUp }) => closeUp.time.map((now) => 1e3 * (now - closeUp.time[0]));

/** Return the bands of equal contact mode. */
function contactBands(times, modes) {
  const changes = modes.map((_, i) => i).filter((i) => i === 0 || modes[i] !== modes[i - 1]);
  return changes.map((from, k) => ({
    ...MODES.get(modes[from]), from: times[from], to: times[changes[k + 1] ?? modes.length - 1],
  }));
}

/** Return a curve of predictions over an input, the present point marked on it. */
function overInput({ isPredicted, outputs }, curve, [x, xFactor, present], name, y, marks = []) {
  const values = scaled(curve[name], 1e3);
  const point = {
    label: `at this ${x.label}`, x: [xFactor * present], y: [1e3 * outputs.get(name)], colour: "theory",
  };
  return {
    x, y,
    curves: [{ label: "predicted", x: scaled(curve.at, xFactor), y: values, colour: "theory" }],
    marks: [...marks, ...(isPredicted ? [point] : [])],
    note: values.some((value) => value !== null) ? "" : NOT_VALID,
  };
}

/** Add the ends of runs to a plot over phase, if there are any. */
function withRuns(plot, velocities) {
  if (velocities.some((value) => value !== null)) {
    const [{ x }] = plot.curves;
    plot.curves.push({ label: "ends of runs", x, y: scaled(velocities, 1e3), colour: "run", dash: [2, 3] });
    plot.note = "";
    plot.title = "Velocity over phase";
  }
  return plot;
}

const phaseAxis = ({ phase }) => [{ label: "phase", unit: "deg" }, DEGREES, phase];
const loadAxis = ({ load }) => [{ label: "load", unit: "mN" }, 1e3, load];

function endOfRun({ outputs }, at) {
  return { label: "end of the run", x: [at], y: [1e3 * outputs.get("mean_velocity")], colour: "run" };
}

const PLOTS = [
  (results) => ({
    title: "Mean velocity of the run",
    ...overTime(results, { label: "velocity", unit: "mm/s" }, scaled(results.run.mean_velocity, 1e3),
      "mean velocity", (times) => (results.isPredicted ? [{
        label: "predicted", x: times, colour: "theory", dash: [6, 4],
        y: times.map(() => 1e3 * results.outputs.get("steady_velocity")),
      }] : [])),
  }),
  (results) => ({
    title: "Steady velocity over phase",
    ...withRuns(overInput(results, results.overPhase, phaseAxis(results), "steady_velocity",
      { label: "velocity", unit: "mm/s" }, [endOfRun(results, DEGREES * results.phase)]), results.runsOverPhase),
  }),
  (results) => ({
    title: "Steady velocity over load",
    ...overInput(results, results.overLoad, loadAxis(results), "steady_velocity",
      { label: "velocity", unit: "mm/s" }, [endOfRun(results, 1e3 * results.load)]),
  }),
  (results) => ({
    title: "Blocking force over phase",
    ...overInput(results, results.overPhase, phaseAxis(results), "blocking_force",
      { label: "force", unit: "mN" }),
  }),
  (results) => {
    const x = afterEnd(results);
    return {
      title: "Velocity in the next periods", x: AFTER, y: { label: "velocity", unit: "mm/s" },
      curves: [{ label: "velocity", x, y: scaled(results.closeUp.velocity, 1e3), colour: "ink" }],
      bands: contactBands(x, results.closeUp.contact_mode),
    };
  },
  (results) => {
    const x = afterEnd(results);
    return {
      title: "Forces in the next periods", scale: results.fullFriction, x: AFTER, y: { label: "force", unit: "N" },
      curves: [
        { label: "normal force of a face", x, y: results.closeUp.normal_force, colour: "normal" },
        { label: "friction of all faces", x, y: results.closeUp.friction_force, colour: "friction" },
      ],
    };
  },
  ({ closeUp, fullFriction: scale }) => ({
    title: "Friction over normal force", isLoop: true, scale,
    x: { label: "normal force", unit: "N" }, y: { label: "friction force", unit: "N" },
    curves: [{ label: "friction force", x: closeUp.normal_force, y: closeUp.friction_force, colour: "friction" }],
  }),
  (results) => ({
    title: "Position in the run",
    ...overTime(results, { label: "position", unit: "mm" }, scaled(results.run.position, 1e3), "position"),
  }),
];

const charts = [];

function showPlots(results) {
  // All boxes come before the first curve, which has the width of its box.
  while (charts.length < PLOTS.length) {
    charts.push(new Chart(document.getElementById("plots")));
  }
  PLOTS.forEach((make, i) => charts[i].show(make(results)));
}

window.addEventListener("resize", () => charts.forEach((chart) => chart.fit()));
window.matchMedia("(prefers-color-scheme: dark)")
  .addEventListener("change", () => charts.forEach((chart) => chart.redraw()));
