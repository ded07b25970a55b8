"use strict";
const INK = "#546e7a";
const MAX_DISTANCE = 30;  // px from pointer or finger within which a point is shown

function shortNumber(value) {
  const size = Math.abs(value);
  return size === 0 || (size >= 1e-3 && size < 1e5) ? String(+value.toPrecision(6)) : value.toExponential(3).replace(/\.?0+e/, "e");
}

const isDecade = (value) => value > 0 && Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;

/** Keep the lines at powers of ten where there are more than a few of them. */
function decadesOf(plot, splits) {
  const decades = splits.map((value) => (isDecade(value) ? value : null));
  return decades.filter((value) => value !== null).length > 4 ? decades : splits;
}

function axisOf({ label, log }, extra) {
  const values = (plot, splits) => splits.map((value) => (value === null ? "" : shortNumber(value)));
  const lines = log ? { filter: decadesOf } : {};
  return { label, values, stroke: INK, grid: { stroke: "#eceff1", ...lines }, ticks: lines, labelSize: 20, ...extra };
}

/** Return the columns of uPlot: all x in ascending order, and for each series its y or null. */
function columnsOf(series) {
  const rows = series.flatMap(({ x, y }, column) => x.map((value, i) => [value, column, y[i]]));
  rows.sort((one, other) => one[0] - other[0]);
  return [rows.map(([x]) => x), ...series.map((_, own) => rows.map(([, column, y]) => (column === own ? y : null)))];
}

/** Return the place of a point in pixels; one without y lies on the x axis. */
function placeOf(plot, { x, y }, i) {
  const { top, height } = plot.bbox;
  return [plot.valToPos(x[i], "x", true), y[i] === null ? top + height : plot.valToPos(y[i], "y", true)];
}

/** Return for each place the edges half way to its neighbours. */
function edgesOf(places) {
  const sorted = [...new Set(places)].sort((one, other) => one - other);
  const alone = 10 * uPlot.pxRatio;
  return new Map(sorted.map((place, i) => {
    const before = i > 0 ? (place - sorted[i - 1]) / 2 : null;
    const after = i < sorted.length - 1 ? (sorted[i + 1] - place) / 2 : null;
    return [place, [place - (before ?? after ?? alone), place + (after ?? before ?? alone)]];
  }));
}

function drawCells(ctx, places, colours) {
  const [columns, rows] = [edgesOf(places.map(([x]) => x)), edgesOf(places.map(([, y]) => y))];
  places.forEach(([x, y], i) => {
    const [[left, right], [top, bottom]] = [columns.get(x), rows.get(y)];
    ctx.fillStyle = colours[i];
    const [x0, y0] = [Math.floor(left), Math.floor(top)];
    ctx.fillRect(x0, y0, Math.ceil(right) - x0, Math.ceil(bottom) - y0);
  });
}

function drawSeries(plot, one) {
  const { ctx } = plot;
  const places = one.x.map((_, i) => placeOf(plot, one, i));
  if (one.cells) {
    drawCells(ctx, places, one.colours);
    return;
  }
  if (one.width > 0) {
    ctx.strokeStyle = one.colour;
    ctx.lineWidth = one.width * uPlot.pxRatio;
    ctx.setLineDash(one.dash.map((length) => length * uPlot.pxRatio));
    ctx.beginPath();
    places.forEach(([x, y], i) => (one.y[i] === null || i === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
    ctx.stroke();
  }
  ctx.font = `${13 * uPlot.pxRatio}px sans-serif`;
  [ctx.textAlign, ctx.textBaseline] = ["center", "middle"];
  if (one.marker) {
    places.forEach(([x, y], i) => {
      ctx.fillStyle = one.colours[i] ?? one.colour;
      ctx.fillText(one.marker, x, y);
    });
  }
}

function drawAll(plot, series) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left - 8, bbox.top - 8, bbox.width + 16, bbox.height + 16);
  ctx.clip();
  series.forEach((one, i) => plot.series[i + 1].show && drawSeries(plot, one));
  ctx.restore();
}

/** Return the place of a point in CSS pixels from the corner of the plot. */
function placeInPlot(plot, one, i) {
  const [x, y] = placeOf(plot, one, i);
  return [(x - plot.bbox.left) / uPlot.pxRatio, (y - plot.bbox.top) / uPlot.pxRatio];
}

/** Return series and index of the point nearest to a place, null where none is near. */
function nearest(plot, series, left, top) {
  let [found, best] = [null, series.some(({ cells }) => cells) ? Infinity : MAX_DISTANCE];
  series.forEach((one, column) => {
    if (!plot.series[column + 1].show) return;
    one.x.forEach((_, i) => {
      const [x, y] = placeInPlot(plot, one, i);
      const distance = Math.hypot(x - left, y - top);
      if (distance < best) [found, best] = [[one, i], distance];
    });
  });
  return found;
}

function describe({ x, y }, [one, i]) {
  const value = (axis, number) => `${axis.label}: ${number === null ? "none" : shortNumber(number)}`;
  return [one.label, value(x, one.x[i]), value(y, one.y[i]), one.notes[i]].filter(Boolean).join("\n");
}

/** Show what a point, series and index, says beside it; null hides the text. */
function showTip(plot, spec, tip, found) {
  tip.hidden = found === null;
  if (found === null) return;
  tip.textContent = describe(spec, found);
  const [left, top] = placeInPlot(plot, ...found);
  const { clientWidth, clientHeight } = plot.over;
  const beside = left + 14 + tip.offsetWidth > clientWidth ? left - tip.offsetWidth - 14 : left + 14;
  tip.style.left = `${Math.max(0, Math.min(beside, clientWidth - tip.offsetWidth))}px`;
  tip.style.top = `${Math.max(0, Math.min(top, clientHeight - tip.offsetHeight))}px`;
}

const KEYS = { ArrowLeft: ["x", -1], ArrowRight: ["x", 1], ArrowUp: ["y", 1], ArrowDown: ["y", -1] };

/** Return the indices of a series as an arrow passes them: in the row or column of a cell. */
function passed({ x, y, cells }, axis, i) {
  const [along, across] = axis === "x" ? [x, y] : [y, x];
  const all = x.map((_, index) => index).filter((index) => !cells || across[index] === across[i]);
  return all.sort((one, other) => along[one] - along[other]);
}

/** Return the point that a key leads to: along the series, or to the next series. */
function next(plot, series, found, key) {
  const shown = series.filter((one, i) => plot.series[i + 1].show && one.x.length > 0);
  if (shown.length === 0) return null;
  if (found === null || !shown.includes(found[0])) return [shown[0], passed(shown[0], "x", 0)[0]];
  const [one, i] = found;
  const [axis, step] = KEYS[key];
  if (axis === "x" || one.cells) {
    const order = passed(one, axis, i);
    return [one, order[Math.max(0, Math.min(order.indexOf(i) + step, order.length - 1))]];
  }
  const other = shown[(shown.indexOf(one) - step + shown.length) % shown.length];
  const distances = other.x.map((x) => Math.abs(plot.valToPos(x, "x") - plot.valToPos(one.x[i], "x")));
  return [other, distances.indexOf(Math.min(...distances))];
}

/** Let a mouse, a finger and the arrow keys lead from point to point. */
function tellPoints(plot, spec, tip) {
  const { over } = plot;
  let found = null;
  const show = (point) => showTip(plot, spec, tip, found = point);
  const follow = ({ clientX, clientY }) => {
    const { left, top } = over.getBoundingClientRect();
    show(nearest(plot, spec.series, clientX - left, clientY - top));
  };
  over.addEventListener("pointerdown", follow);
  over.addEventListener("pointermove", follow);
  over.addEventListener("pointerleave", ({ pointerType }) => pointerType === "mouse" && show(null));
  over.addEventListener("blur", () => show(null));
  over.addEventListener("keydown", (event) => {
    if (event.key in KEYS) show(next(plot, spec.series, found, event.key));
    else if (event.key === "Escape") show(null);
    else return;
    event.preventDefault();
  });
  over.tabIndex = 0;
  over.setAttribute("role", "application");
  over.setAttribute("aria-label", `${spec.title}: ${spec.y.label} over ${spec.x.label}; arrow keys read its points`);
  tip.setAttribute("role", "status");
  over.append(tip);
}

function scaleOf({ log }) {
  return { time: false, ...(log ? { distr: 3 } : {}) };
}

/** Return how a series looks, for the legend: its marker, on its line. */
function sampleOf({ marker, colour, width, dash }) {
  const sample = document.createElement("span");
  sample.className = "sample";
  sample.style.color = colour;
  sample.textContent = marker || "\u00a0";
  if (width > 0) {
    const line = document.createElement("i");
    line.style.borderTop = `${Math.max(1.5, width)}px ${dash.length ? "dashed" : "solid"}`;
    sample.append(line);
  }
  return sample;
}

function draw(box) {
  const spec = JSON.parse(box.querySelector("script").textContent);
  const tip = document.createElement("div");
  [tip.className, tip.hidden] = ["tip", true];
  const width = () => Math.max(280, box.clientWidth);
  const plot = new uPlot({
    width: width(), height: spec.height,
    scales: { x: scaleOf(spec.x), y: scaleOf(spec.y) },
    axes: [axisOf(spec.x, { size: 34 }), axisOf(spec.y, { size: 64 })],
    cursor: { points: { show: false }, drag: { x: true, y: true, uni: 20 } },
    legend: { show: spec.series.length > 1 && !spec.series.every(({ cells }) => cells), live: false, markers: { show: false } },
    series: [{}, ...spec.series.map((one) => {
      const shown = document.createElement("span");
      shown.append(sampleOf(one), one.label);
      return { label: shown, stroke: INK, paths: () => null, points: { show: false } };
    })],
    hooks: { draw: [(self) => drawAll(self, spec.series)] },
  }, columnsOf(spec.series), box);
  tellPoints(plot, spec, tip);
  box.dataset.drawn = "true";
  window.addEventListener("resize", () => plot.setSize({ width: width(), height: spec.height }));
}

/** Return the plots that are still to be drawn: a folded one has no width. */
function waiting() {
  return [...document.querySelectorAll(".plot:not([data-drawn])")].filter((box) => !box.closest("details:not([open])"));
}

/** Draw one plot after the other, so that a page with many answers meanwhile. */
function drawInTurn() {
  const [box] = waiting();
  if (box === undefined) return;
  draw(box);
  setTimeout(drawInTurn);
}
drawInTurn();
document.addEventListener("toggle", drawInTurn, true);
window.addEventListener("beforeprint", () => waiting().forEach(draw));

function unfoldTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target instanceof HTMLDetailsElement) target.open = true;
}
window.addEventListener("hashchange", unfoldTarget);
unfoldTarget();
