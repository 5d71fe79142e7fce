// The layout of a plot: axes, reference lines, legend.
"use strict";

function markLine(mark, theme) {
  const { value } = mark;
  const upright = { xref: "x", x0: value, x1: value, yref: "paper", y0: 0, y1: 1 };
  const level = { xref: "paper", x0: 0, x1: 1, yref: "y", y0: value, y1: value };
  const line = { color: theme.muted, width: 1.2, dash: "2px,3px" };
  return { ...(mark.axis === "x" ? upright : level), type: "line", layer: "below", line };
}

/// Returns the label of a reference line, at its end inside the plot. On a logarithmic axis the position of an annotation is the
/// logarithm, unlike that of a shape.
function markLabel(mark, plot, theme) {
  const at = plot[mark.axis].log ? Math.log10(mark.value) : mark.value;
  const upright = { xref: "x", x: at, yref: "paper", y: 0.99, yanchor: "top", textangle: -90 };
  const level = { xref: "paper", x: 0.995, yref: "y", y: at, yanchor: "bottom" };
  const style = { xanchor: "right", showarrow: false, bgcolor: theme.paper + "cc", font: { color: theme.muted, size: 12 } };
  return { ...(mark.axis === "x" ? upright : level), ...style, text: plotText(mark.label) };
}

/// Breaks the long title of a vertical axis into lines, at the ends of words and at the dots of names but not in a unit, so that
/// nothing is cut off.
function axisTitle(axis, isUpright) {
  const longest = 36;  // characters that the shortest plot has room for
  if (!isUpright || axis.title.length <= longest) return plotText(axis.title);
  const lines = [""];
  for (const piece of axis.title.split(/(?<=[. ])(?![^()]*\))/)) {
    if (lines.at(-1) !== "" && (lines.at(-1) + piece).trimEnd().length > longest) lines.push("");
    lines[lines.length - 1] += piece;
  }
  return lines.map((line) => plotText(line.trimEnd())).join("<br>");
}

function axisLayout(axis, theme, isEmpty, isUpright = false) {
  return {
    type: axis.log ? "log" : "linear",
    title: { text: axisTitle(axis, isUpright), standoff: 10 },
    automargin: true,
    exponentformat: "power",
    tickfont: { size: axis.log ? 10.8 : 12 },  // plotly sets powers of ten a quarter larger
    showticklabels: !isEmpty,
    showgrid: !isEmpty,
    gridcolor: theme.grid,
    linecolor: theme.frame,
    showline: true,
    mirror: true,
    ticks: isEmpty ? "" : "outside",
    ticklen: 5,
    tickcolor: theme.frame,
    zeroline: false,
  };
}

function plotFigure(plot, theme) {
  const isEmpty = !plot.series.some((series) => drawnPoints(series, plot).includes(true));
  const marks = isEmpty ? [] : plot.marks.filter((mark) => isDrawable(mark.value, plot[mark.axis]));
  const middle = { xref: "paper", yref: "paper", x: 0.5, y: 0.5, showarrow: false };
  const noData = { ...middle, text: "no data", font: { color: theme.muted, size: 16 } };
  return {
    data: plot.series.flatMap((series, k) => seriesTraces(series, k, plot, theme)),
    layout: {
      uirevision: plot.id,
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font: { family: theme.font, size: 13, color: theme.ink },
      margin: { l: 64, r: 12, t: 12, b: 52 },
      xaxis: axisLayout(plot.x, theme, isEmpty),
      yaxis: axisLayout(plot.y, theme, isEmpty, true),
      showlegend: plot.series.length > 1,
      legend: { orientation: "h", x: 0, xanchor: "left", y: 1.02, yanchor: "bottom", bgcolor: "rgba(0,0,0,0)" },
      hovermode: "closest",
      hoverlabel: { bgcolor: theme.paper, font: { family: theme.font, size: 13, color: theme.ink }, align: "left" },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: theme.muted, activecolor: theme.ink },
      shapes: marks.map((mark) => markLine(mark, theme)),
      annotations: isEmpty ? [noData] : marks.filter((mark) => mark.label !== "").map((mark) => markLabel(mark, plot, theme)),
    },
  };
}
