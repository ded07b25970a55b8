/** How plots are drawn. A plot has `title`, `x` and `y` as `{label, unit}`, curves as
 * `{label, x, y, colour, dash}`, marks as `{label, x, y, colour}`, bands as `{label, from, to,
 * colour}`; a colour is a name in the style sheet. `scale` is a size of y beside which less than a
 * millionth is rounding. */
const PLOT_HEIGHT = 190;

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Return [low, high] with a margin; a width even for values that are equal to rounding, or none. */
function rangeOf(values, scale = 0) {
  const found = values.filter((value) => value !== null);
  const [low, high] = found.length ? [Math.min(...found), Math.max(...found)] : [-1, 1];
  const size = Math.max(Math.abs(low), Math.abs(high), scale);
  const margin = high - low > 1e-6 * size ? 0.06 * (high - low) : 0.1 * size || 1;
  return [low - margin, high + margin];
}

const titled = ({ label, unit }) => `${label} [${unit}]`;

function axis(description, extra) {
  return {
    label: titled(description), labelSize: 18, labelFont: "12px system-ui", labelGap: 2,
    ...(description.unit === "deg" ? { incrs: [15, 30, 45, 90, 180] } : {}),
    stroke: () => colour("quiet"), grid: { stroke: () => colour("line"), width: 1 }, ticks: { show: false },
    ...extra,
  };
}

const X_AXIS = { size: 26, gap: 4, space: 60 };
const Y_AXIS = {
  gap: 4, space: 34,
  size: (_, texts) => 12 + 7 * Math.max(2, ...(texts ?? []).map((text) => text.length)),
};

function drawBands(plot, bands) {
  const { left, top, width, height } = plot.bbox;
  const place = (x) => Math.min(left + width, Math.max(left, plot.valToPos(x, "x", true)));
  plot.ctx.save();
  plot.ctx.globalAlpha = 0.16;
  for (const { from, to, colour: name } of bands) {
    plot.ctx.fillStyle = colour(name);
    plot.ctx.fillRect(place(from), top, place(to) - place(from), height);
  }
  plot.ctx.restore();
}

/** Join the points of a curve in their order: uPlot's own paths need ascending x. */
function drawLoop(plot, { x, y, colour: name }) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.beginPath();
  x.forEach((at, i) => ctx.lineTo(plot.valToPos(at, "x", true), plot.valToPos(y[i], "y", true)));
  ctx.strokeStyle = colour(name);
  ctx.lineWidth = 1.75 * uPlot.pxRatio;
  ctx.stroke();
  ctx.restore();
}

/** Return the indices of values without a neighbour, which a line does not show. */
function isolated({ data }, series) {
  const values = data[series];
  return values.map((_, i) => i).filter((i) =>
    Number.isFinite(values[i]) && !Number.isFinite(values[i - 1]) && !Number.isFinite(values[i + 1]));
}

function lineOf({ label, colour: name, dash }) {
  const stroke = () => colour(name);
  const points = { show: true, size: 4, width: 0, fill: stroke, filter: isolated };
  return { label, stroke, width: 1.75, dash, pxAlign: 0, points };
}

function dotOf({ label, colour: name }) {
  const fill = () => colour(name);
  const points = { show: true, size: 10, width: 2, fill, stroke: () => colour("paper") };
  return { label, stroke: fill, width: 0, points };
}

/** Return the options of uPlot for a plot but its size. */
function optionsOf({ x, y, curves, marks = [], bands = [], isLoop = false, scale }) {
  const drawn = [...curves, ...marks];
  const [xs, ys] = [drawn.flatMap((one) => one.x), drawn.flatMap((one) => one.y)];
  const ends = isLoop || marks.length ? rangeOf(xs) : [xs[0], xs.at(-1)];
  return {
    pxAlign: 0,
    legend: { show: false },
    padding: [8, 26, 0, 0],
    cursor: { points: { show: !isLoop }, y: false, drag: { x: false, y: false } },
    scales: { x: { time: false, range: () => ends }, y: { range: () => rangeOf(ys, scale) } },
    axes: [axis(x, X_AXIS), axis(y, Y_AXIS)],
    series: isLoop ? [{}, {}] : [{}, ...curves.map(lineOf), ...marks.map(dotOf)],
    hooks: {
      drawClear: [(plot) => drawBands(plot, bands)],
      draw: [(plot) => isLoop && drawLoop(plot, curves[0])],
    },
  };
}

/** Return the columns of uPlot: all x, and for each curve and mark its y. */
function dataOf({ curves, marks = [], isLoop = false }) {
  return isLoop ? [rangeOf(curves[0].x), [null, null]]
    : uPlot.join([...curves, ...marks].map((one) => [one.x, one.y]));
}

/** Return an entry of the key for each curve that is drawn, mark and kind of band, if several. */
function keyOf({ curves, marks = [], bands = [] }) {
  const entries = [
    ...curves.filter(({ y }) => y.some(Number.isFinite))
      .map((curve) => [curve.label, curve.dash ? "dash" : "line", curve.colour]),
    ...marks.map((mark) => [mark.label, "dot", mark.colour]),
    ...new Map(bands.map((band) => [band.label, [band.label, "band", band.colour]])).values(),
  ];
  return (entries.length > 1 ? entries : []).map(([label, kind, name]) =>
    element("span", { class: kind, style: `--mark: var(--${name})` }, label));
}

const csvCell = (value) => (typeof value === "number" ? Number(value.toPrecision(12)) : value ?? "");

/** Return the curves as text of a CSV file, each under its own x where these differ. */
function csvOf({ x, y, curves }) {
  const columns = curves.flatMap((curve, i) => [
    ...(curve.x === curves[i - 1]?.x ? [] : [[titled(x), ...curve.x]]),
    [titled({ ...y, label: curve.label }), ...curve.y],
  ]);
  const rows = Array.from({ length: Math.max(...columns.map((column) => column.length)) },
    (_, i) => columns.map((column) => csvCell(column[i])).join(","));
  return rows.join("\n") + "\n";
}

/** A plot in a box with its title, what is under the pointer, and a key of curves if several. */
class Chart {
  constructor(parent) {
    this.title = element("h3");
    this.reading = element("span", { class: "reading" });
    const save = element("button", { type: "button", class: "quiet" }, "CSV");
    save.addEventListener("click", () => {
      download(`${this.content.title.toLowerCase().replaceAll(" ", "_")}.csv`, csvOf(this.content));
    });
    this.area = element("div", { class: "area", role: "img" });
    this.key = element("p", { class: "key" });
    parent.append(element("div", { class: "chart" },
      element("header", {}, this.title, this.reading, save), this.area, this.key));
  }

  show(content) {
    const { title, note } = content;
    this.content = content;
    this.title.textContent = title;
    this.area.setAttribute("aria-label", title);
    this.reading.textContent = "";
    this.key.replaceChildren(...keyOf(content));
    this.plot?.destroy();
    this.plot = new uPlot({ ...optionsOf(content), ...this.#size() }, dataOf(content), this.area);
    this.plot.hooks.setCursor = [() => this.#read()];
    if (note) {
      this.plot.over.append(element("p", { class: "note" }, note));
    }
  }

  #size() {
    return { width: Math.max(200, this.area.clientWidth), height: PLOT_HEIGHT };
  }

  fit() {
    this.plot?.setSize(this.#size());
  }

  redraw() {
    this.plot?.redraw();
  }

  #read() {
    const { cursor: { idx: i }, data } = this.plot;
    const { x, y, curves, isLoop } = this.content;
    const values = curves.map((_, k) => data[k + 1][i]).filter(Number.isFinite);
    const round = (value) => Number(value.toPrecision(4));
    this.reading.textContent = i === null || isLoop || values.length === 0 ? ""
      : `${round(data[0][i])} ${x.unit}: ${values.map(round).join(", ")} ${y.unit}`;
  }
}
