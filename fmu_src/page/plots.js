const PLOT_HEIGHT = 210;
const INK = "#546e7a";
const COLOURS = { 1: "#1976d2", [-1]: "#00897b", 0: "#c62828", 2: "#b0bec5" };

function axis(label, extra = {}) {
  return { label, stroke: INK, grid: { stroke: "#eceff1" }, labelSize: 18, size: 52, ...extra };
}

function line(label, stroke, extra = {}) {
  return { label, stroke, width: 1.5, points: { show: false }, ...extra };
}

function xAxis(label) {
  return axis(label, { size: 34 });
}

/** Paint the contact mode behind a curve over time. */
function drawContactBands(plot, times, modes) {
  const { left, top, width, height } = plot.bbox;
  plot.ctx.save();
  plot.ctx.globalAlpha = 0.14;
  let begin = 0;
  for (let i = 1; i <= modes.length; i++) {
    if (i === modes.length || modes[i] !== modes[begin]) {
      const from = Math.max(left, plot.valToPos(times[begin], "x", true));
      const to = Math.min(left + width, plot.valToPos(times[Math.min(i, modes.length - 1)], "x", true));
      plot.ctx.fillStyle = COLOURS[modes[begin]];
      plot.ctx.fillRect(from, top, to - from, height);
      begin = i;
    }
  }
  plot.ctx.restore();
}

/** Join points in their order: uPlot's own paths need ascending x. */
function drawLoop(plot, xs, ys) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.beginPath();
  xs.forEach((x, i) => ctx.lineTo(plot.valToPos(x, "x", true), plot.valToPos(ys[i], "y", true)));
  ctx.strokeStyle = "#6a1b9a";
  ctx.lineWidth = 1.5 * uPlot.pxRatio;
  ctx.stroke();
  ctx.restore();
}

/** Return how single points look, which are named in the legend. */
function points(label, stroke) {
  return { label, stroke, width: 0, points: { show: true, size: 10, fill: stroke } };
}

/** Return [low, high] with a margin; a width even for equal values. */
function rangeOf(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const margin = 0.06 * (high - low) || 0.1 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}

const scaled = (values, factor) => values.map((value) => factor * value);

const millisecondsOf = ({ time }) => time.map((now) => 1e3 * (now - time[0]));

/** The plots: for each its title, and from results the data and options of uPlot. */
const PLOTS = [
  {
    title: "Slow velocity",
    make: ({ run, outputs }) => {
      const predicted = 1e3 * outputs.get("steady_velocity");
      return {
        data: [run.time, scaled(run.mean_velocity, 1e3), run.time.map(() => predicted)],
        series: [line("mean velocity", "#1976d2"), line("predicted", "#ef6c00", { dash: [6, 4] })],
        axes: [xAxis("time [s]"), axis("mean velocity [mm/s]")],
      };
    },
  },
  {
    title: "Position",
    make: ({ run }) => ({
      data: [run.time, scaled(run.position, 1e3)],
      series: [line("position", "#1976d2")],
      axes: [xAxis("time [s]"), axis("position [mm]")],
    }),
  },
  {
    title: "Velocity over the next periods",
    make: ({ closeUp }) => {
      const times = millisecondsOf(closeUp);
      return {
        data: [times, scaled(closeUp.velocity, 1e3)],
        series: [line("velocity", "#263238")],
        axes: [xAxis("time after the end of the run [ms]"), axis("velocity [mm/s]")],
        hooks: { drawClear: [(plot) => drawContactBands(plot, times, closeUp.contact_mode)] },
      };
    },
  },
  {
    title: "Forces over the next periods",
    make: ({ closeUp }) => ({
      data: [millisecondsOf(closeUp), closeUp.normal_force, scaled(closeUp.friction_force, 10)],
      series: [line("normal force", "#5e35b1"), line("10 times friction", "#c62828")],
      axes: [xAxis("time after the end of the run [ms]"), axis("force [N]")],
    }),
  },
  {
    title: "Friction on normal force",
    make: ({ closeUp }) => {
      const friction = scaled(closeUp.friction_force, 1e3);
      return {
        data: [rangeOf(closeUp.normal_force), rangeOf(friction)],
        series: [line("friction", "transparent")],
        scales: {
          x: { time: false, range: () => rangeOf(closeUp.normal_force) },
          y: { range: () => rangeOf(friction) },
        },
        axes: [xAxis("normal force [N]"), axis("friction force [mN]")],
        hooks: { draw: [(plot) => drawLoop(plot, closeUp.normal_force, friction)] },
        legend: { show: false },
      };
    },
  },
  {
    title: "Steady velocity on load",
    make: ({ curve, outputs, load }) => {
      const loads = scaled(curve.load, 1e3);
      const present = 1e3 * load;
      const data = uPlot.join([
        [loads, scaled(curve.steady_velocity, 1e3)],
        [[1e3 * outputs.get("blocking_force")], [0]],
        [[present], [1e3 * outputs.get("steady_velocity")]],
        [[present], [1e3 * outputs.get("mean_velocity")]],
      ]);
      return {
        data,
        series: [
          line("predicted", "#ef6c00"), points("blocking force", "#ffb74d"),
          points("predicted at this load", "#ef6c00"), points("mean velocity of the run", "#1976d2"),
        ],
        scales: { x: { time: false, range: () => rangeOf([...loads, present]) } },
        axes: [xAxis("load [mN]"), axis("velocity [mm/s]")],
      };
    },
  },
];

const shown = [];

function showPlots(results) {
  const parent = document.getElementById("plots");
  while (parent.children.length < PLOTS.length) {
    parent.append(document.createElement("div"));
  }
  PLOTS.forEach(({ title, make }, i) => {
    shown[i]?.destroy();
    const box = parent.children[i];
    const { data, series, axes, hooks = {}, legend = {}, scales = { x: { time: false } } } = make(results);
    shown[i] = new uPlot(
      {
        title, axes, hooks, legend, scales,
        width: Math.max(200, box.clientWidth - 12), height: PLOT_HEIGHT,
        series: [{ label: axes[0].label.replace(/ after.*(?= \[)/, "") }, ...series],
      },
      data, box);
  });
}

window.addEventListener("resize", () => {
  shown.forEach((plot) => {
    const box = plot.root.parentElement;
    plot.setSize({ width: Math.max(200, box.clientWidth - 12), height: PLOT_HEIGHT });
  });
});
