// What the colours of the disks can show, in the scales of scales.js.
"use strict";

/// The quantities that colours can show. `value` is a number from 0 to 1 for each disk, or the number of its kind; `prepare` must
/// be called first where there is one. `ends` are the texts at the ends of the legend. `colours` are those of the scale or of the
/// kinds where they are not the reader's choice, `names` those of the kinds. `isCut` says which disks have no value.
const colourings = {
  speed: {
    label: "speed",
    isOffered: true,
    ends: () => ["0", shortNumber(2.5 * speedScale)],
    value: (moment, i) => speedOf(moment, i) / (2.5 * speedScale),
  },
  species: { label: "species", isOffered: true, isKind: true, colours: () => kinds, names: () => description.species, value: (moment, i) => species[i] % kinds.length },
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
  psi6: { label: "sixfold order |ψ6|", ends: () => ["0", "1"], value: (moment, i) => order.size[i] },
  psi6_angle: {
    label: "axes of the sixfold order",
    colours: () => circleColours,
    ends: () => ["−30°", "30°"],
    value: (moment, i) => axisOf(order, i),
  },
  neighbours: {
    label: "neighbours",
    isKind: true,
    colours: () => neighbourColours(theme.isDark),
    names: () => ["≤ 4", "5", "6", "7", "≥ 8 neighbours"],
    value: (moment, i) => neighbourKind(order, i),
  },
};
for (const name of ["psi6", "psi6_angle", "neighbours"])
  Object.assign(colourings[name], { isOffered: cellsOffered, prepare: (moment) => findOrder(moment, order), isCut: (i) => order.neighbours[i] === 0 });
const order = Object.fromEntries(["re", "im", "size", "neighbours"].map((name) => [name, new Float64Array(cellsOffered ? disks : 0)]));
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

/// Returns a time with at most nine digits: 0.25, 100000000, 1.5e-7.
const clockText = (time) => String(Number(time.toPrecision(9)));
