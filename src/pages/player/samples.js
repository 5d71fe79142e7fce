// The replay of runs without an event log: straight lines from sample to sample, to the nearest image where the box is periodic.
// Velocities are those of the last sample, because those between two samples are unknown.
"use strict";

function sampleReplay() {
  const { sampleTime, sampleWalls, sampleScale, sampleDisplacement, samplePosition, sampleVelocity } = columns;
  const { lower, positionStep, velocityStep } = description.samples;
  const last = sampleTime.length - 1;
  const place = (k, i, axis) => lower[axis] + positionStep[axis] * samplePosition[2 * (k * disks + i) + axis];

  /// Returns the displacement of disk i from sample k to the next one.
  const displacement = (k, i) => {
    let dx = place(k + 1, i, 0) - place(k, i, 0);
    let dy = place(k + 1, i, 1) - place(k, i, 1);
    if (box.periodic[1]) {
      const round = Math.round(dy / box.lengths[1]);
      dy -= round * box.lengths[1];
      dx -= round * sampleDisplacement[k + 1];  // under shear the images above are displaced
    }
    if (box.periodic[0]) dx -= Math.round(dx / box.lengths[0]) * box.lengths[0];
    return [dx, dy];
  };
  /// Returns the offset of the images above; it starts again from 0 at every whole box length.
  const displacementAt = (k, next, share) => {
    let more = sampleDisplacement[next] - sampleDisplacement[k];
    more -= Math.round(more / box.lengths[0]) * box.lengths[0];
    return sampleDisplacement[k] + share * more;
  };
  return {
    displacement,
    stepName: "sample",
    stepTimes: sampleTime,
    duration: description.duration,
    doneAt: (time) => countUpTo(sampleTime, time),
    read(time, done, moment) {
      const k = Math.min(Math.max(done - 1, 0), last);
      const next = Math.min(k + 1, last);
      const share = next > k ? Math.min(Math.max((time - sampleTime[k]) / (sampleTime[next] - sampleTime[k]), 0), 1) : 0;
      const between = (list, size, at) => list[size * k + at] + share * (list[size * next + at] - list[size * k + at]);
      moment.time = time;
      moment.done = done;
      moment.displacement = displacementAt(k, next, share);
      for (let i = 0; i < disks; ++i) {
        let x = place(k, i, 0);
        let y = place(k, i, 1);
        if (share > 0) {
          const [dx, dy] = displacement(k, i);
          x += share * dx;
          y += share * dy;
        }
        if (box.periodic[1]) x -= Math.floor((y - box.lower[1]) / box.lengths[1]) * moment.displacement;
        moment.x[i] = box.periodic[0] ? folded(x, 0) : x;
        moment.y[i] = box.periodic[1] ? folded(y, 1) : y;
        moment.vx[i] = velocityStep * sampleVelocity[2 * (k * disks + i)];
        moment.vy[i] = velocityStep * sampleVelocity[2 * (k * disks + i) + 1];
      }
      moment.scale = between(sampleScale, 1, 0);
      for (let side = 0; side < 4; ++side) moment.walls[side] = between(sampleWalls, 4, side);
    },
  };
}

/// Replays events where the file holds them, else samples.
const replay = description.exact ? exactReplay() : sampleReplay();
