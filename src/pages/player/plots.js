// Canvases that show curves beside the disks.
"use strict";

const plots = [];

/// A canvas and its size in pixels of the page, which is looked up only when it changes: asked for in every frame, it would have the
/// page laid out in every frame.
function plotOn(id) {
  const element = document.getElementById(id);
  const plot = { element, context: element.getContext("2d"), width: 1, height: 1, density: 1 };
  plots.push(plot);
  return plot;
}

function resizePlots() {
  for (const plot of plots) {
    const { clientWidth: width, clientHeight: height } = plot.element;
    Object.assign(plot, { width, height, density: window.devicePixelRatio || 1 });
    plot.element.width = Math.round(width * plot.density);
    plot.element.height = Math.round(height * plot.density);
  }
}

/// Empties the plot and sets its letters.
function clearPlot({ context, width, height, density }) {
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = `11px ${theme.font}`;
}
