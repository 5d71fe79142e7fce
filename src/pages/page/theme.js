// The colours of plots. They stand in page.css, so that text and plots agree; this reads those that hold at the moment.
"use strict";

const colourCount = 8;

function currentTheme() {
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue(name).trim();
  return {
    ink: value("--ink"),
    muted: value("--muted"),
    grid: value("--grid"),
    frame: value("--frame"),
    paper: value("--paper"),
    font: value("--plot-font"),
    series: Array.from({ length: colourCount }, (_, k) => value(`--series-${k}`)),
  };
}

/// What holds on white paper, whatever the screen shows: for print and for exported pictures.
function lightTheme() {
  const classes = document.documentElement.classList;
  const wasLight = classes.contains("light");
  classes.add("light");
  const theme = currentTheme();
  classes.toggle("light", wasLight);
  return theme;
}
