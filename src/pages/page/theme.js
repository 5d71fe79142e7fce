// The colours of plots. page.css defines them for text and plots alike; this file reads the present ones.
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

/// Returns the colours for white paper, whatever the screen shows: for print and for exported pictures.
function lightTheme() {
  const classes = document.documentElement.classList;
  const wasLight = classes.contains("light");
  classes.add("light");
  const theme = currentTheme();
  classes.toggle("light", wasLight);
  return theme;
}
