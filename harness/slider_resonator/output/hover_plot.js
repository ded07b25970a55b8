"use strict";
const INK = "#546e7a";
const MAX_DISTANCE = 30;  // px from the pointer within which a point is shown

function shortNumber(value) {
  const size = Math.abs(value);
  return size === 0 || (size >= 1e-3 && size < 1e5) ? String(+value.toPrecision(6)) : value.toExponential(3).replace(/\.?0+e/, "e");
}

function axisOf({ label }, extra) {
  const values = (plot, splits) => splits.map((value) => (value === null ? "" : shortNumber(value)));
  return { label, values, stroke: INK, grid: { stroke: "#eceff1" }, labelSize: 20, ...extra };
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
    ctx.fillRect(left, top, Math.ceil(right - left), Math.ceil(bottom - top));
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

/** Return series and index of the point nearest to the pointer, null where none is near. */
function nearest(plot, series) {
  const { left, top } = plot.cursor;
  let [found, best] = [null, series.some(({ cells }) => cells) ? Infinity : MAX_DISTANCE];
  series.forEach((one, column) => {
    if (!plot.series[column + 1].show || left < 0) return;
    one.x.forEach((_, i) => {
      const [x, y] = placeOf(plot, one, i);
      const distance = Math.hypot((x - plot.bbox.left) / uPlot.pxRatio - left, (y - plot.bbox.top) / uPlot.pxRatio - top);
      if (distance < best) [found, best] = [[one, i], distance];
    });
  });
  return found;
}

function describe({ x, y }, [one, i]) {
  const value = (axis, number) => `${axis.label}: ${number === null ? "none" : shortNumber(number)}`;
  return [one.label, value(x, one.x[i]), value(y, one.y[i]), one.notes[i]].filter(Boolean).join("\n");
}

function showTip(plot, spec, tip) {
  const found = nearest(plot, spec.series);
  tip.hidden = found === null;
  if (found === null) return;
  tip.textContent = describe(spec, found);
  const { left, top } = plot.cursor;
  const { clientWidth, clientHeight } = plot.over;
  tip.style.left = `${Math.max(0, left + 14 + tip.offsetWidth > clientWidth ? left - tip.offsetWidth - 14 : left + 14)}px`;
  tip.style.top = `${Math.max(0, Math.min(top, clientHeight - tip.offsetHeight))}px`;
}

function scaleOf({ log, range }) {
  return { time: false, ...(log ? { distr: 3 } : {}), ...(range ? { range: () => range } : {}) };
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
    legend: { live: false, markers: { show: false } },
    series: [{}, ...spec.series.map(({ label, marker, colour }) => {
      const shown = document.createElement("span");
      const sample = document.createElement("span");
      [shown.textContent, sample.textContent] = [` ${label}`, marker || "\u2501"];
      sample.style.color = colour;
      shown.prepend(sample);
      return { label: shown, stroke: colour, paths: () => null, points: { show: false } };
    })],
    hooks: { draw: [(self) => drawAll(self, spec.series)], setCursor: [(self) => showTip(self, spec, tip)] },
  }, columnsOf(spec.series), box);
  plot.over.append(tip);
  box.dataset.drawn = "true";
  window.addEventListener("resize", () => plot.setSize({ width: width(), height: spec.height }));
}

const seen = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
  if (!isIntersecting) return;
  seen.unobserve(target);
  draw(target);
}), { rootMargin: "300px" });
document.querySelectorAll(".plot").forEach((box) => seen.observe(box));
