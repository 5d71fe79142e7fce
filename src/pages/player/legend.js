// What the colours of the disks mean, below them.
"use strict";

/// Fills in the legend of the present colouring.
function showLegend() {
  const colouring = colourings[settings.colourBy];
  const legend = document.getElementById("legend");
  legend.replaceChildren();
  const add = (tag, text, style = "") => {
    const element = document.createElement(tag);
    element.textContent = text;
    element.style.cssText = style;
    legend.append(element);
  };
  if (colouring.isKind) {
    const most = 12;
    const names = colouring.names();
    const colours = colouring.colours();
    names.slice(0, most).forEach((name, k) => add("span", name, `--swatch: ${colours[k % colours.length]}`));
    if (names.length > most) add("em", `and ${names.length - most} more`);
  } else {
    add("b", "");
    add("i", "", `background: linear-gradient(to right, ${(colouring.colours?.() ?? scaleColours(settings.palette, theme.isDark)).join(",")})`);
    add("b", "");
    showLegendEnds();
  }
}

/// Shows the values at the ends of the scale, which may change from moment to moment.
function showLegendEnds() {
  const colouring = colourings[settings.colourBy];
  if (colouring.isKind) return;
  document.querySelectorAll("#legend b").forEach((element, end) => {
    const text = colouring.ends()[end];
    if (element.textContent !== text) element.textContent = text;
  });
}
