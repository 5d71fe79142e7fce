// Colours: scales of evenly rising lightness, which colour-blind readers can follow too (viridis of van der Walt and Smith;
// cividis of Nunez, Anderton and Renslow), and the colours of Okabe and Ito for kinds of disks.
"use strict";

const colourSteps = 64;
const scales = {
  viridis: ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"],
  cividis: ["#00224e", "#1a386f", "#434e6c", "#61656f", "#7d7c78", "#9b9476", "#bcae6c", "#dec958", "#fee838"],
  plasma: ["#0d0887", "#4c02a1", "#7e03a8", "#aa2395", "#cc4778", "#e66c5c", "#f89540", "#fdc527", "#f0f921"],
  blues: ["#d6e6f4", "#abcfe5", "#82badb", "#5aa3cf", "#3787c0", "#1b69af", "#0b4d94", "#08306b", "#041f4a"],
};
const kinds = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8c8c8c"];

/// A circle of colours of about equal lightness, from -30 to 30 degrees: its ends are the same.
const circleColours = Array.from({ length: colourSteps }, (_, k) => {
  const part = (begin) => 0.55 + 0.4 * Math.cos(2 * Math.PI * ((k + 0.5) / colourSteps - 0.5 - begin));
  return "#" + [0, 1 / 3, 2 / 3].map((begin) => Math.round(255 * part(begin)).toString(16).padStart(2, "0")).join("");
});

/// The colours of disks with at most 4, 5, 6, 7, and at least 8 neighbours: none stands out but those that are not six.
const neighbourColours = (isDark) => [kinds[1], kinds[5], isDark ? "#39424e" : "#d5dae0", kinds[0], kinds[2]];

function mixed(from, to, share) {
  const part = (colour, k) => parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16);
  return "#" + [0, 1, 2].map((k) => Math.round(part(from, k) + share * (part(to, k) - part(from, k))).toString(16).padStart(2, "0")).join("");
}

/// Returns the colours of a scale from its low end to its high end; on a dark page the order of the blues is reversed.
function scaleColours(name, isDark) {
  const anchors = name === "blues" && isDark ? [...scales[name]].reverse() : scales[name];
  return Array.from({ length: colourSteps }, (_, k) => {
    const at = (k / (colourSteps - 1)) * (anchors.length - 1);
    const low = Math.min(Math.floor(at), anchors.length - 2);
    return mixed(anchors[low], anchors[low + 1], at - low);
  });
}
