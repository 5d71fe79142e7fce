// Saves a plot as a picture: what the screen shows, on white, with the title of the plot.
"use strict";

const picture = { width: 960, height: 600, titleHeight: 48 };  // pixels; a PNG has twice as many

function savePicture(canvas, plot, format) {
  const theme = lightTheme();
  const figure = plotFigure(plot, theme);
  figure.data.forEach((trace, i) => (trace.visible = canvas.data[i].visible));
  for (const axis of ["xaxis", "yaxis"]) {
    Object.assign(figure.layout[axis], { range: [...canvas.layout[axis].range], autorange: false });
  }
  Object.assign(figure.layout, {
    paper_bgcolor: theme.paper,
    title: { text: plotText(plot.title), x: 0.02, xanchor: "left", y: 0.97, yanchor: "top", font: { size: 17 } },
    legend: { ...figure.layout.legend, yref: "container", y: 1 - picture.titleHeight / picture.height, yanchor: "top" },
    margin: { ...figure.layout.margin, t: picture.titleHeight },
  });
  const { width, height } = picture;
  return Plotly.downloadImage(figure, { format, filename: plot.id, width, height, scale: format === "png" ? 2 : 1 });
}

function exportButton(plot, format, path) {
  return {
    name: `Save as ${format.toUpperCase()}`,
    title: `Save as ${format.toUpperCase()}`,
    icon: { width: 24, height: 24, path },
    click: (canvas) => savePicture(canvas, plot, format).catch((error) => pageError(String(error))),
  };
}

// Two icons, as paths in a square of 24 units.
const camera =
  "M9 4 7.2 6H4a2 2 0 0 0-2 2v10a2 2 0 0 0 2 2h16a2 2 0 0 0 2-2V8a2 2 0 0 0-2-2h-3.2L15 4H9zm3 4.5a4.5 4.5 0 1 1 0 9 4.5 4.5 0 0 1 " +
  "0-9zm0 2a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z";
const arrow = "M11 3h2v9l3.5-3.5 1.4 1.4L12 16l-5.9-6.1 1.4-1.4L11 12V3zM4 18h16v2H4z";

/// Returns the buttons of a plot.
function plotButtons(plot) {
  return [
    ["zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"],
    [exportButton(plot, "png", camera), exportButton(plot, "svg", arrow)],
  ];
}
