// The exact replay. Between two events a disk is in free flight. Each flight is stored with the time, position and velocity of
// its beginning. The state at a time follows from the flight of each disk at that time, which is found from the flight shown
// before, or by bisection. Time runs in both directions.
"use strict";

/// The flights of all disks, those of disk i from first[i] to first[i + 1] - 1 in order of time.
function buildFlights({ start, time, disk, partner, velocity }) {
  const rescale = disks + 4;  // code of the event that multiplies all velocities by a factor
  const first = new Uint32Array(disks + 1);
  const rescaled = new Uint32Array(time.length + 1);  // number of such events up to each event
  let rescalings = 0;
  for (let e = 0; e < time.length; ++e) {
    rescaled[e + 1] = rescaled[e] + (partner[e] === rescale ? 1 : 0);
    if (partner[e] === rescale) {
      ++rescalings;
    } else {
      ++first[disk[e] + 1];
      if (partner[e] < disks) ++first[partner[e] + 1];
    }
  }
  for (let i = 0; i < disks; ++i) first[i + 1] += first[i] + 1 + rescalings;
  const count = first[disks];
  const numbers = () => new Float64Array(count);
  const flights = { first, rescaled, event: new Int32Array(count), time: numbers(), x: numbers(), y: numbers(), vx: numbers(), vy: numbers() };
  const last = new Uint32Array(disks);
  const [gx, gy] = description.acceleration;
  const put = (slot, event, when, x, y, vx, vy) => {
    flights.event[slot] = event;
    flights.time[slot] = when;
    flights.x[slot] = box.periodic[0] ? folded(x, 0) : x;
    flights.y[slot] = box.periodic[1] ? folded(y, 1) : y;
    flights.vx[slot] = vx;
    flights.vy[slot] = vy;
  };
  /// Begins a new flight of disk i; `velocityAfter` returns the new velocity from the old one.
  const begin = (i, event, when, velocityAfter) => {
    const old = last[i];
    const dt = when - flights.time[old];
    const x = flights.x[old] + (flights.vx[old] + 0.5 * gx * dt) * dt;
    const y = flights.y[old] + (flights.vy[old] + 0.5 * gy * dt) * dt;
    const [vx, vy] = velocityAfter(flights.vx[old] + gx * dt, flights.vy[old] + gy * dt);
    put(++last[i], event, when, x, y, vx, vy);
  };
  for (let i = 0; i < disks; ++i) {
    last[i] = first[i];
    put(first[i], -1, 0, start[4 * i], start[4 * i + 1], start[4 * i + 2], start[4 * i + 3]);
  }
  for (let e = 0; e < time.length; ++e) {
    const v = velocity.subarray(4 * e, 4 * e + 4);
    if (partner[e] === rescale) {
      for (let i = 0; i < disks; ++i) begin(i, e, time[e], (vx, vy) => [vx * v[0], vy * v[0]]);
    } else {
      begin(disk[e], e, time[e], () => [v[0], v[1]]);
      if (partner[e] < disks) begin(partner[e], e, time[e], () => [v[2], v[3]]);
    }
  }
  return flights;
}

/// Returns the positions of moving sides of the box: each moves on from its last change of velocity before `time`.
function wallsAt(time, walls) {
  for (let side = 0; side < 4; ++side) {
    const track = columns[`wall${side}`];
    let low = 0;
    let high = track.length / 3;
    while (high - low > 1) {
      const middle = (low + high) >>> 1;
      if (track[3 * middle] <= time) low = middle;
      else high = middle;
    }
    const dt = time - track[3 * low];
    walls[side] = track[3 * low + 1] + (track[3 * low + 2] + 0.5 * description.accelerations[side] * dt) * dt;
  }
}

/// Returns the replay of the events of a log: {start, time, disk, partner, velocity}.
function exactReplay(log = columns) {
  const flights = buildFlights(log);
  const { first, event } = flights;
  const cursor = first.slice(0, disks);  // flight of each disk at the time read last
  const [gx, gy] = description.acceleration;
  let readBefore = 0;

  /// Returns the flight of disk i after `done` events.
  const flightOf = (i, done) => {
    let low = first[i];
    let high = first[i + 1];
    while (high - low > 1) {
      const middle = (low + high) >>> 1;
      if (event[middle] < done) low = middle;
      else high = middle;
    }
    return low;
  };
  const moveCursors = (done) => {
    const far = Math.abs(done - readBefore) > 4 * disks;
    for (let i = 0; i < disks; ++i) {
      let slot = cursor[i];
      if (far) slot = flightOf(i, done);
      while (slot + 1 < first[i + 1] && event[slot + 1] < done) ++slot;
      while (slot > first[i] && event[slot] >= done) --slot;
      cursor[i] = slot;
    }
    readBefore = done;
  };
  return {
    flights,
    cursor,
    stepName: "collision",
    stepTimes: log.time,
    duration: description.duration,
    doneAt: (time) => countUpTo(log.time, time),
    /// Returns the number of collisions of disk i up to the time read last.
    collisionsOf: (i) => cursor[i] - first[i] - flights.rescaled[readBefore],
    /// Fills `moment` with the state at `time` after `done` events, all of which are at or before that time.
    read(time, done, moment) {
      moveCursors(done);
      moment.time = time;
      moment.done = done;
      moment.flights = flights;
      moment.cursor = cursor;
      for (let i = 0; i < disks; ++i) {
        const slot = cursor[i];
        const dt = time - flights.time[slot];
        const x = flights.x[slot] + (flights.vx[slot] + 0.5 * gx * dt) * dt;
        const y = flights.y[slot] + (flights.vy[slot] + 0.5 * gy * dt) * dt;
        moment.x[i] = box.periodic[0] ? folded(x, 0) : x;
        moment.y[i] = box.periodic[1] ? folded(y, 1) : y;
        moment.vx[i] = flights.vx[slot] + gx * dt;
        moment.vy[i] = flights.vy[slot] + gy * dt;
      }
      moment.scale = description.scale + description.growth * time;
      wallsAt(time, moment.walls);
    },
  };
}
