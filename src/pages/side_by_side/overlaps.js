// The overlaps of the fixed-step method at a moment, or during the interval of a frame, so that none is missed between two frames;
// and the rings and lenses that show them.
"use strict";

const { overlapFirst, overlapSecond, overlapBegin, overlapEnd, overlapDepth } = columns;

/// Returns the largest of the first k values, for all k, which bisection can search.
function largestSoFar(values) {
  const largest = Float64Array.from(values);
  for (let k = 1; k < largest.length; ++k) largest[k] = Math.max(largest[k], largest[k - 1]);
  return largest;
}
const lastEnd = largestSoFar(overlapEnd);
const deepest = largestSoFar(overlapDepth);

/// Returns the numbers of the overlaps that exist at any time in [from, to].
function overlapsBetween(from, to) {
  const found = [];
  const begun = countUpTo(overlapBegin, to);
  for (let k = countUpTo(lastEnd, from); k < begun; ++k) if (overlapEnd[k] > from) found.push(k);
  return found;
}

const overlapsBegunBy = (time) => countUpTo(overlapBegin, time);
const deepestBy = (time) => (overlapsBegunBy(time) > 0 ? deepest[overlapsBegunBy(time) - 1] : 0);

/// Shows the middle of the next overlap.
function showNextOverlap() {
  for (let k = overlapsBegunBy(moment.time); k < overlapBegin.length; ++k) {
    const middle = (overlapBegin[k] + overlapEnd[k]) / 2;
    if (middle <= moment.time) continue;
    change({ isPlaying: false });
    showTime(middle);
    return;
  }
}

/// Fills the area that disks i and j share at the moment.
function fillLens(i, j, moment, shift) {
  const apart = [moment.x[j] - moment.x[i], moment.y[j] - moment.y[i]].map((d, axis) =>
    box.periodic[axis] ? d - Math.round(d / box.lengths[axis]) * box.lengths[axis] : d,
  );
  const distance = Math.hypot(...apart);
  if (distance >= radius[i] + radius[j] || distance <= Math.abs(radius[i] - radius[j])) return;
  const toOther = Math.atan2(-apart[1], apart[0]);  // the y axis of pixels points down
  const halfAngle = (own, other) => Math.acos((distance * distance + own * own - other * other) / (2 * distance * own));
  const a = halfAngle(radius[i], radius[j]);
  const b = halfAngle(radius[j], radius[i]);
  const x = moment.x[i] + shift[0] * box.lengths[0];
  const y = moment.y[i] + shift[1] * box.lengths[1];
  context.beginPath();
  context.arc(pixelX(x), pixelY(y), radius[i] * view.scale, toOther - a, toOther + a);
  context.arc(pixelX(x + apart[0]), pixelY(y + apart[1]), radius[j] * view.scale, toOther + Math.PI - b, toOther + Math.PI + b);
  context.fill();
}

/// Draws overlaps on the canvas drawn last. A ring is a line of the warning colour between two dark ones, which is visible without
/// colours too; its outer edge is that of the disk.
function drawOverlaps(moment, numbers) {
  if (numbers.length === 0) return;
  const shifts = visibleShifts(settings.ghosts, moment);
  const concerned = new Set();
  for (const k of numbers) concerned.add(overlapFirst[k]).add(overlapSecond[k]);
  context.save();
  if (!settings.ghosts) {
    boxPath(moment);
    context.clip();
  }
  for (const [colour, more] of [["#12161c", 2], [theme.overlap, 0]]) {
    context.strokeStyle = colour;
    for (const i of concerned) {
      const r = radius[i] * view.scale;
      const width = Math.min(Math.max(r / 5, 1.5), 4);
      context.lineWidth = width + more;
      for (const [a, b] of shifts) {
        context.beginPath();
        context.arc(pixelX(moment.x[i] + a * box.lengths[0]), pixelY(moment.y[i] + b * box.lengths[1]), Math.max(r - width / 2, 0), 0, 2 * Math.PI);
        context.stroke();
      }
    }
  }
  context.fillStyle = theme.overlap;
  for (const k of numbers) for (const shift of shifts) fillLens(overlapFirst[k], overlapSecond[k], moment, shift);
  context.restore();
}
