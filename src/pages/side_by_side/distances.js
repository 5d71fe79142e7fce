// The distance of each disk from the same disk on the other side, as a number and as a colour. Colours show errors spread from
// collision to collision.
"use strict";

const apart = new Float64Array(disks);  // distance of each disk at the moment shown, to the nearest image, in mean diameters

/// Fills `apart`, and returns its root mean square.
function measureDistances() {
  let sum = 0;
  const between = (a, b, axis) => {
    const d = a - b;
    return box.periodic[axis] ? d - Math.round(d / box.lengths[axis]) * box.lengths[axis] : d;
  };
  for (let i = 0; i < disks; ++i) {
    const dx = between(moment.x[i], stepsMoment.x[i], 0);
    const dy = between(moment.y[i], stepsMoment.y[i], 1);
    const square = (dx * dx + dy * dy) / (description.sigma * description.sigma);
    apart[i] = Math.sqrt(square);
    sum += square;
  }
  return Math.sqrt(sum / disks);
}

/// The decade of the smallest distance above rounding (2e-16 of the box per flight). Axis and colours begin there.
const lowestDecade = (() => {
  const rounding = 1e-10;
  const seen = columns.distance.filter((d) => d > rounding && Number.isFinite(d));
  return seen.length > 0 ? Math.min(Math.floor(Math.log10(Math.min(...seen))), -1) : -3;
})();

/// Returns a power of ten as text: "0.001", "10⁻⁵".
function powerOfTen(decade) {
  if (decade >= -2 && decade <= 3) return String(Number((10 ** decade).toPrecision(1)));
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  return `10${decade < 0 ? "⁻" : ""}${[...String(Math.abs(decade))].map((digit) => digits[digit]).join("")}`;
}

delete colourings.collisions;  // the two sides have different collisions
colourings.apart = {
  label: "distance from the other side",
  isOffered: true,
  ends: () => [`${powerOfTen(lowestDecade)}`, "1 diameter"],
  value: (_, i) => (apart[i] > 0 ? 1 - Math.log10(apart[i]) / lowestDecade : 0),
};
settings.colourBy = "apart";
