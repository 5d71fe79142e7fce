// Small plots: lines and bars with axes, in the colours of the page.
"use strict";

const lineColours = () => [theme.accent, theme.second, theme.muted];

const powerOfTen = (power) => `10${[...String(power)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;

/// Returns a number as the reader's language writes it, with marks between thousands from 10,000 on.
const written = (value, options) => value.toLocaleString(language, { useGrouping: Math.abs(value) >= 1e4, ...options });

/// Returns a number with at most `digits` digits: 1.5, 0.00123, 1.2·10⁵; in German 1,5.
function short(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [head, power] = value.toExponential(digits - 1).split("e");
    return `${written(Number(head), { minimumFractionDigits: digits - 1 })}·${powerOfTen(Number(power))}`;
  }
  return written(value, { maximumSignificantDigits: digits });
}

/// Returns a mean with its standard error, both to two digits of the error: 1.234 ± 0.056.
function withError(mean, error) {
  if (mean === null || mean === undefined) return "–";
  if (!(error > 0)) return short(mean, 4);
  const places = Math.max(0, Math.min(8, 1 - Math.floor(Math.log10(error))));
  const [shownMean, shownError] = [mean, error].map((value) => written(value, { minimumFractionDigits: places, maximumFractionDigits: places }));
  return `${shownMean} ± ${shownError}`;
}

function clearPlot(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const density = window.devicePixelRatio || 1;
  const size = [Math.round(width * density), Math.round(height * density)];
  if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
  const context = canvas.getContext("2d");
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = `11px ${theme.font}`;
  return { context, width, height };
}

/// Round numbers between two limits.
function ticks(low, high, most = 4) {
  const span = high - low;
  if (!(span > 1e-12 * Math.max(Math.abs(low), Math.abs(high)))) return [low];
  const raw = span / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= raw);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; ++k) list.push(k * step);
  return list;
}

/// Draws axes; returns the maps from numbers to pixels.
function axes({ context, width, height }, [x0, x1], [y0, y1], { isLog = false, xLabel = "" } = {}) {
  const left = 44;
  const bottom = height - 18;
  const top = 6;
  const toX = (x) => left + ((x - x0) / (x1 - x0 || 1)) * (width - left - 6);
  const toY = (y) => bottom - ((y - y0) / (y1 - y0 || 1)) * (bottom - top);
  context.strokeStyle = theme.rule;
  context.fillStyle = theme.muted;
  context.lineWidth = 1;
  context.textAlign = "right";
  for (const y of ticks(y0, y1, isLog ? 3 : 4)) {
    if (isLog && !Number.isInteger(y)) continue;
    context.beginPath();
    context.moveTo(left, Math.round(toY(y)) + 0.5);
    context.lineTo(width - 6, Math.round(toY(y)) + 0.5);
    context.stroke();
    context.fillText(isLog ? powerOfTen(y) : short(y), left - 5, toY(y) + 4);
  }
  context.textAlign = "center";
  const marks = ticks(x0, x1, 4);
  const end = width - 10 - context.measureText(xLabel).width;
  for (const x of marks) if (toX(x) < end - 12) context.fillText(short(x), Math.max(toX(x), left + 4), height - 4);
  context.textAlign = "right";
  context.fillText(xLabel, width - 4, height - 4);
  context.textAlign = "left";
  return { toX, toY, left, bottom, top };
}

function drawSpeeds() {
  const canvas = document.getElementById("speeds");
  const plot = clearPlot(canvas);
  if (!(plot.width > 0)) return;
  const { context } = plot;
  const kT = run.numbers[at.kT];
  const range = Math.max(3 * run.speedScale, ...[kT > 0 && run.mass.length > 0 ? 2.2 * Math.sqrt((2 * kT) / run.mass.reduce((least, m) => Math.min(least, m))) : 0]);
  const bins = 30;
  const counts = new Float64Array(bins);
  for (let i = 0; i < disks; ++i) {
    const bin = Math.floor((Math.sqrt(run.vx[i] ** 2 + run.vy[i] ** 2) / range) * bins);
    if (bin < bins) ++counts[bin];
  }
  const perBin = range / bins;
  const curve = [];
  if (kT > 0 && disks > 2) for (let k = 0; k <= 120; ++k) curve.push(equilibriumSpeeds((k / 120) * range, kT) * perBin);
  // The mean over time, in the same measure.
  const mean = [];
  if (run.histogram) {
    const sum = run.histogram.reduce((a, b) => a + b, 0);
    if (sum > 0) run.histogram.forEach((value, k) => mean.push([((k + 0.5) * run.numbers[at.range]) / 60, (value / sum) * disks * (perBin / (run.numbers[at.range] / 60))]));
  }
  const most = Math.max(1, ...curve, ...mean.map(([, y]) => y), ...counts) * 1.08;
  const { toX, toY, bottom } = axes(plot, [0, range], [0, most], { xLabel: t("speedAxis") });
  context.fillStyle = theme.accent;
  context.globalAlpha = 0.35;
  for (let b = 0; b < bins; ++b) context.fillRect(toX(b * perBin) + 0.5, toY(counts[b]), toX(perBin) - toX(0) - 1, bottom - toY(counts[b]));
  context.globalAlpha = 1;
  context.fillStyle = theme.second;
  for (const [x, y] of mean) {
    if (x > range) break;
    context.beginPath();
    context.arc(toX(x), toY(y), 2, 0, 2 * Math.PI);
    context.fill();
  }
  if (curve.length > 0) {
    context.beginPath();
    curve.forEach((y, k) => context.lineTo(toX((k / 120) * range), toY(y)));
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5;
    context.stroke();
  }
}

function drawHistory() {
  const canvas = document.getElementById("history");
  const plot = clearPlot(canvas);
  if (!(plot.width > 0)) return;
  const { context } = plot;
  const kind = histories[settings.history];
  const { points } = past;
  let low = Infinity;
  let high = -Infinity;
  for (const point of points)
    for (const line of kind.lines) {
      const y = point[line];
      if (!Number.isFinite(y)) continue;
      if (y < low) low = y;
      if (y > high) high = y;
    }
  if (settings.history === "pressure" && idealPressures()) {
    for (const value of idealPressures()) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (kind.range) [low, high] = kind.range;
  else if (low > 0 && low < 0.7 * high) low = 0;
  if (!(high - low > 1e-9 * Math.abs(high))) [low, high] = Number.isFinite(low) && Number.isFinite(high) ? [low - Math.abs(low || 1) * 0.1, high + Math.abs(high || 1) * 0.1] : [0, 1];
  const pad = kind.range ? 0 : 0.06 * (high - low);
  const first = points[0]?.time ?? 0;
  const last = Math.max(points.at(-1)?.time ?? 1, first + 1e-9);
  const { toX, toY } = axes(plot, [first, last], [low < 0 || low - pad >= 0 ? low - pad : low, high + pad], { xLabel: t("timeAxis") });
  if (settings.history === "pressure" && idealPressures()) {
    context.setLineDash([4, 4]);
    idealPressures().forEach((value, k) => {
      context.strokeStyle = k === 0 ? theme.ink : theme.muted;
      context.beginPath();
      context.moveTo(toX(first), toY(value));
      context.lineTo(toX(last), toY(value));
      context.stroke();
    });
    context.setLineDash([]);
  }
  kind.lines.forEach((line, k) => {
    context.beginPath();
    for (const point of points) if (Number.isFinite(point[line])) context.lineTo(toX(point.time), toY(point[line]));
    context.strokeStyle = lineColours()[k];
    context.lineWidth = 1.6;
    context.stroke();
  });
}

/// P of the equation of state and of an ideal gas, where the scene has them.
function idealPressures() {
  const { theoryZ } = run.description;
  if (theoryZ === null) return null;
  const ideal = (disks * run.numbers[at.kT]) / area();
  return [theoryZ * ideal, ideal];
}

function drawWayBack() {
  const canvas = document.getElementById("wayBack");
  const way = run.measured?.way_back ?? [];
  const plot = clearPlot(canvas);
  if (!(plot.width > 0) || way.length === 0) return;
  const { context } = plot;
  const end = run.measured.return_at - run.measured.reversed_at;
  const low = -17;
  const high = Math.ceil(Math.log10(Math.max(...box.lengths)));
  const { toX, toY } = axes(plot, [0, end], [low, high], { isLog: true, xLabel: t("wayBackAxis") });
  context.beginPath();
  for (const [time, distance] of way) context.lineTo(toX(time), toY(Math.max(Math.log10(Math.max(distance, 1e-300)), low)));
  context.strokeStyle = theme.fault;
  context.lineWidth = 1.8;
  context.stroke();
  const contact = Math.log10(2 * (run.radius[0] ?? 0.5));
  context.strokeStyle = theme.muted;
  context.setLineDash([3, 3]);
  context.beginPath();
  context.moveTo(toX(0), toY(contact));
  context.lineTo(toX(end), toY(contact));
  context.stroke();
  context.setLineDash([]);
}
