// Canvases that show curves beside the disks.
"use strict";

const plots = [];

/// Returns a canvas with its size in pixels of the page. The size is read only when it changes: a read in every frame would force
/// a layout of the page in every frame.
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

/// Clears the plot and sets its font.
function clearPlot({ context, width, height, density }) {
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = `11px ${theme.font}`;
}
