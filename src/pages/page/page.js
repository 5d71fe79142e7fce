// Draws every plot of the page, and draws again when the colours of the screen change or the page is printed.
//
// For tests: data-plots of the document is the number of plots drawn, data-points of each figure the number of points in it,
// data-errors all errors.
"use strict";

const paperSize = { width: 670, height: 360 };  // in pixels; fits on A4 and on letter paper within the margins of page.css
const drawn = [];                               // {canvas, plot} of every plot

/// Returns the number of points that plotly has drawn, without error bars and bands.
function pointsIn(canvas) {
  const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
  let count = 0;
  canvas.calcdata.forEach((points) => {
    const trace = points[0].trace;
    const isSeries = trace.visible === true && trace.hoverinfo !== "skip";
    if (isSeries) count += points.filter((point) => isNumber(point.x) && isNumber(point.y)).length;
  });
  return count;
}

async function draw(figure) {
  const canvas = figure.querySelector(".canvas");
  try {
    const plot = JSON.parse(figure.querySelector("script[type='application/json']").textContent);
    const { data, layout } = plotFigure(plot, currentTheme());
    const buttons = { displaylogo: false, displayModeBar: true, modeBarButtons: plotButtons(plot) };
    await Plotly.newPlot(canvas, data, layout, { responsive: true, ...buttons });
    const visible = plot.series.filter((series) => series.visible);
    const expected = visible.flatMap((series) => drawnPoints(series, plot)).filter((isDrawn) => isDrawn).length;
    figure.dataset.points = pointsIn(canvas);
    if (pointsIn(canvas) !== expected) pageError(`${plot.id} shows ${pointsIn(canvas)} of ${expected} points`);
    offerNumbers(figure.querySelector("details.numbers"), plot);
    drawn.push({ canvas, plot });
  } catch (error) {
    pageError(`${figure.id}: ${error}`, canvas);
  }
}

/// Keeps the reader's zoom and the series that are switched off.
function drawAgain(theme, size) {
  for (const { canvas, plot } of drawn) {
    const { data, layout } = plotFigure(plot, theme);
    Plotly.react(canvas, data, { ...layout, ...size });
  }
}

async function drawAll() {
  for (const figure of document.querySelectorAll("figure.plot")) await draw(figure);
  document.documentElement.dataset.plots = drawn.length;
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAgain(currentTheme(), {}));
  window.addEventListener("beforeprint", () => drawAgain(lightTheme(), paperSize));
  window.addEventListener("afterprint", () => drawAgain(currentTheme(), {}));
}

drawAll();
