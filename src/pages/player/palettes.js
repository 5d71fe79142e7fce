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

/// The quantities that colours can show. `value` is a number from 0 to 1 for each disk, or the number of its kind; `prepare` must
/// be called first where there is one. `ends` are the texts at the ends of the legend.
const colourings = {
  speed: {
    label: "speed",
    isOffered: true,
    ends: () => ["0", shortNumber(2.5 * speedScale)],
    value: (moment, i) => speedOf(moment, i) / (2.5 * speedScale),
  },
  species: { label: "species", isOffered: true, isKind: true, value: (moment, i) => species[i] % kinds.length },
  collisions: {
    label: "collisions so far",
    isOffered: description.exact,
    prepare: () => {
      fewest = Infinity;
      most = 0;
      for (let i = 0; i < disks; ++i) {
        fewest = Math.min(fewest, replay.collisionsOf(i));
        most = Math.max(most, replay.collisionsOf(i));
      }
    },
    ends: () => [String(fewest), String(most)],
    value: (moment, i) => (replay.collisionsOf(i) - fewest) / Math.max(most - fewest, 1),
  },
  id: { label: "id", isOffered: true, ends: () => ["0", String(Math.max(disks - 1, 0))], value: (moment, i) => i / Math.max(disks - 1, 1) },
  psi6: { label: "sixfold order |ψ6|", isOffered: hexaticOffered, prepare: (moment) => hexaticOrder(moment, psi), ends: () => ["0", "1"], value: (moment, i) => psi[i] },
};
const psi = new Float64Array(hexaticOffered ? disks : 0);
let fewest = 0;  // smallest number of collisions of a disk up to the moment
let most = 0;

/// Returns a number with at most four digits: 1.5, 0.001234, 1.20·10^5.
function shortNumber(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace("e", "·10^").replace("^+", "^");
  return String(Number(value.toPrecision(4)));
}
