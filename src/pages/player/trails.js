// Trails: the paths of disks during the last part of the run, traced back flight by flight. A path is drawn in one piece from the
// present position, without a jump at periodic edges.
"use strict";

const longestTrail = 64;  // corners of one path at most
const trailTime = (0.16 * Math.min(extent[1] - extent[0], extent[3] - extent[2])) / speedScale;

/// Adds the path of disk i to `context`; its position in pixels is given.
function traceFlights(context, i, moment, px, py) {
  const { flights, cursor } = moment;
  const [gx, gy] = description.acceleration;
  let left = Math.min(trailTime, moment.time);
  let until = moment.time;
  let x = px;
  let y = py;
  context.moveTo(x, y);
  for (let slot = cursor[i], corners = 0; left > 0 && corners < longestTrail; --slot, ++corners) {
    const dt = Math.min(until - flights.time[slot], left);
    const end = until - flights.time[slot];  // since the flight began
    const vx = flights.vx[slot] + gx * end;
    const vy = flights.vy[slot] + gy * end;
    // Backwards along a parabola: its middle control point is where the two tangents meet.
    const middleX = x - view.scale * vx * (dt / 2);
    const middleY = y + view.scale * vy * (dt / 2);
    x -= view.scale * (vx - 0.5 * gx * dt) * dt;
    y += view.scale * (vy - 0.5 * gy * dt) * dt;
    if (gx || gy) context.quadraticCurveTo(middleX, middleY, x, y);
    else context.lineTo(x, y);
    left -= dt;
    until = flights.time[slot];
    if (slot === flights.first[i]) break;
  }
}

/// Adds the path of disk i from samples.
function traceSamples(context, i, moment, px, py) {
  const times = replay.stepTimes;
  let k = Math.min(Math.max(moment.done - 1, 0), times.length - 2);
  if (k < 0) return;
  const begin = Math.max(moment.time - trailTime, 0);
  let until = moment.time;
  let x = px;
  let y = py;
  context.moveTo(x, y);
  for (let corners = 0; k >= 0 && until > begin && corners < longestTrail; --k, ++corners) {
    const [dx, dy] = replay.displacement(k, i);
    const share = (until - Math.max(times[k], begin)) / (times[k + 1] - times[k]);
    x -= view.scale * dx * share;
    y += view.scale * dy * share;
    context.lineTo(x, y);
    until = times[k];
  }
}

const tracePath = description.exact ? traceFlights : traceSamples;
