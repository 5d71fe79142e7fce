// How far each disk is from itself on the other side: as a number, and as a colour, which shows errors spread from collision to
// collision.
"use strict";

const apart = new Float64Array(disks);  // of each disk at the moment shown, to the nearest image, in mean diameters

/// Fills `apart`; the result is its root mean square.
function measureTwins() {
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

/// The decade of the first distance that is more than rounding, 2e-16 of the box a flight: axis and colours begin there.
const lowestDecade = (() => {
  const rounding = 1e-10;
  const seen = columns.distance.filter((d) => d > rounding && Number.isFinite(d));
  return seen.length > 0 ? Math.min(Math.floor(Math.log10(Math.min(...seen))), -1) : -3;
})();

/// 10 to a whole power: "0.001", "10⁻⁵"
function powerOfTen(decade) {
  if (decade >= -2 && decade <= 3) return String(Number((10 ** decade).toPrecision(1)));
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  return `10${decade < 0 ? "⁻" : ""}${[...String(Math.abs(decade))].map((digit) => digits[digit]).join("")}`;
}

delete colourings.collisions;  // of which the two sides have different ones
colourings.apart = {
  label: "distance from its twin",
  isOffered: true,
  ends: () => [`${powerOfTen(lowestDecade)}`, "1 diameter"],
  value: (_, i) => (apart[i] > 0 ? 1 - Math.log10(apart[i]) / lowestDecade : 0),
};
settings.colourBy = "apart";
