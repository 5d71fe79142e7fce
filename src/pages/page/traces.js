// Converts the series of a plot to the traces that plotly draws.
"use strict";

// Symbols distinguish series without colours too. Sizes, in pixels, make them appear equally large.
const symbols = [
  { symbol: "circle", size: 8 },
  { symbol: "square", size: 8 },
  { symbol: "diamond", size: 10 },
  { symbol: "triangle-up", size: 10 },
  { symbol: "triangle-down", size: 10 },
  { symbol: "cross", size: 9 },
  { symbol: "x", size: 8 },
  { symbol: "star", size: 11 },
];

/// Plotly interprets HTML-like marks in names and titles as formatting; this escapes them.
/// (It fills in %{...} too, but only in figures that have `meta`.)
function plotText(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

const raisedDigits = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";

/// Returns a number with five digits, with a power of ten where plain digits would be hard to read.
function plotNumber(value) {
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e6)) return String(Number(value.toPrecision(5)));
  const [mantissa, exponent] = value.toExponential(4).split("e");
  const raised = [...String(Number(exponent))].map((c) => (c === "-" ? "\u207b" : raisedDigits[c])).join("");
  return `${mantissa} \u00d7 10${raised}`;
}

function isDrawable(value, axis) {
  return value !== null && (!axis.log || value > 0);
}

/// Returns for each point of a series whether it is drawn.
function drawnPoints(series, plot) {
  return series.x.map((x, i) => isDrawable(x, plot.x) && isDrawable(series.y[i], plot.y));
}

function hoverText(series, plot, i) {
  const lines = [`<b>${plotText(series.name)}</b>`];
  if (series.labels && series.labels[i]) lines.push(plotText(series.labels[i]));
  lines.push(`${plotText(plot.x.title || "x")}: ${plotNumber(series.x[i])}`);
  lines.push(`${plotText(plot.y.title || "y")}: ${plotNumber(series.y[i])}`);
  const hasRange = series.y_low && series.y_low[i] !== null && series.y_high[i] !== null;
  if (hasRange) lines.push(`from ${plotNumber(series.y_low[i])} to ${plotNumber(series.y_high[i])}`);
  return lines.join("<br>");
}

/// Returns the outline of the region between y_low and y_high: one polygon for each part without a gap.
function bandOutline(series, plot) {
  const outline = { x: [], y: [] };
  let begin = 0;
  const isWhole = (i) =>
    isDrawable(series.x[i], plot.x) && isDrawable(series.y_low[i], plot.y) && isDrawable(series.y_high[i], plot.y);
  for (let i = 0; i <= series.x.length; ++i) {
    if (i < series.x.length && isWhole(i)) continue;
    if (i - begin > 1) {
      const x = series.x.slice(begin, i);
      outline.x.push(...x, ...[...x].reverse(), null);
      outline.y.push(...series.y_high.slice(begin, i), ...series.y_low.slice(begin, i).reverse(), null);
    }
    begin = i + 1;
  }
  return outline;
}

function errorBars(series, colour) {
  const difference = (high, low) => high.map((value, i) => (value === null || low[i] === null ? 0 : value - low[i]));
  return {
    type: "data",
    symmetric: false,
    array: difference(series.y_high, series.y),
    arrayminus: difference(series.y, series.y_low),
    color: colour,
    thickness: 1.2,
    width: 3,
  };
}

const modes = { line: "lines", dashed: "lines", points: "markers", levels: "markers", line_and_points: "lines+markers", band: "lines" };

function seriesMarker(series, colour, theme) {
  if (series.style === "levels") return { symbol: "line-ew", size: 18, line: { color: colour, width: 2.5 } };
  return { ...symbols[series.group % symbols.length], color: colour, line: { color: theme.paper, width: 0.8 } };
}

function seriesTraces(series, k, plot, theme) {
  const colour = theme.series[series.group % theme.series.length];
  const isDrawn = drawnPoints(series, plot);
  const isEmpty = !isDrawn.includes(true);
  const keep = (values) => (isEmpty ? [null] : values.map((value, i) => (isDrawn[i] ? value : null)));
  const shared = { type: "scatter", legendgroup: `series-${k}`, visible: series.visible ? true : "legendonly" };
  const traces = [];
  if (series.style === "band") {
    const region = { mode: "none", fill: "toself", fillcolor: colour + "2e", hoverinfo: "skip", showlegend: false };
    traces.push({ ...shared, ...bandOutline(series, plot), ...region });
  }
  traces.push({
    ...shared,
    name: plotText(series.name) + (isEmpty ? " (no data)" : ""),
    x: keep(series.x),
    y: keep(series.y),
    mode: modes[series.style],
    line: { color: colour, width: 2, dash: series.style === "dashed" ? "6px,4px" : "solid" },
    marker: seriesMarker(series, colour, theme),
    error_y: series.y_low && series.style !== "band" && !isEmpty ? errorBars(series, colour) : undefined,
    hoverinfo: "text",
    hoverlabel: { bordercolor: colour },
    hovertext: isEmpty ? [] : isDrawn.map((drawn, i) => (drawn ? hoverText(series, plot, i) : "")),
  });
  return traces;
}
