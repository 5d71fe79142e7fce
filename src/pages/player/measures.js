// Measurements at the moment shown: energy, temperature and speeds; and sums over the collisions up to it.
"use strict";

const { mass, radius, species } = columns;
const totalMass = mass.reduce((sum, m) => sum + m, 0);

/// Returns kinetic and potential energy, and kT = 2 K' / f. K' leaves out the motion of the centre of mass where that is no heat.
function energyOf(moment) {
  const [gx, gy] = description.acceleration;
  const ground = [0, 1].map((axis) => (description.acceleration[axis] < 0 ? box.lower[axis] : box.upper[axis]));
  let kinetic = 0;
  let potential = 0;
  let px = 0;
  let py = 0;
  for (let i = 0; i < disks; ++i) {
    const vx = moment.vx[i];
    const vy = moment.vy[i];
    kinetic += 0.5 * mass[i] * (vx * vx + vy * vy);
    px += mass[i] * vx;
    py += mass[i] * vy;
    potential -= mass[i] * (gx * (moment.x[i] - ground[0]) + gy * (moment.y[i] - ground[1]));
  }
  let heat = kinetic;
  let freedom = 2 * disks;
  [px, py].forEach((p, axis) => {
    if (description.centreOfMassIsThermal[axis]) return;
    heat -= (p * p) / (2 * totalMass);
    freedom -= 1;
  });
  return { kinetic, potential, heat, temperature: freedom > 0 ? Math.max(0, (2 * heat) / freedom) : 0, freedom };
}

/// Returns running sums over events: entry k is the sum over the first k.
function eventTotals() {
  const { time, disk, partner } = columns;
  const count = time.length;
  const totals = { pairs: new Uint32Array(count + 1), walls: new Uint32Array(count + 1), virial: new Float64Array(count + 1) };
  totals.heat = new Float64Array(count + 1);  // the integral over time of kT
  const { first, x, y, vx, vy, time: begun } = replay.flights;
  const slot = first.slice(0, disks);
  const [gx, gy] = description.acceleration;
  const moment = emptyMoment();
  replay.read(0, 0, moment);
  const { heat: heatAtStart, freedom } = energyOf(moment);
  let heat = heatAtStart;
  let before = 0;
  const startNextFlight = (i, e) => {  // adds the change of kinetic energy; returns the change of velocity
    const old = slot[i];
    const now = ++slot[i];
    const dt = time[e] - begun[old];
    const ux = vx[old] + gx * dt;
    const uy = vy[old] + gy * dt;
    heat += 0.5 * mass[i] * (vx[now] * vx[now] + vy[now] * vy[now] - ux * ux - uy * uy);
    return { dx: vx[now] - ux, dy: vy[now] - uy };
  };
  const apart = (a, b, axis) => {
    const length = box.lengths[axis];
    return box.periodic[axis] ? a - b - Math.round((a - b) / length) * length : a - b;
  };
  for (let e = 0; e < count; ++e) {
    totals.heat[e + 1] = totals.heat[e] + ((2 * heat) / freedom) * (time[e] - before);
    before = time[e];
    const isPair = partner[e] < disks;
    const isRescaling = partner[e] === disks + 4;
    totals.pairs[e + 1] = totals.pairs[e] + (isPair ? 1 : 0);
    totals.walls[e + 1] = totals.walls[e] + (isPair || isRescaling ? 0 : 1);
    totals.virial[e + 1] = totals.virial[e];
    if (isRescaling) {
      for (let i = 0; i < disks; ++i) startNextFlight(i, e);
      continue;
    }
    const change = startNextFlight(disk[e], e);
    if (!isPair) continue;
    startNextFlight(partner[e], e);
    const a = slot[disk[e]];
    const b = slot[partner[e]];
    totals.virial[e + 1] += mass[disk[e]] * (change.dx * apart(x[a], x[b], 0) + change.dy * apart(y[a], y[b], 1));
  }
  totals.heatAtStart = (2 * heatAtStart) / freedom;
  return totals;
}

const totals = description.exact ? eventTotals() : null;

/// Returns Z = 1 + W / (2 N times the integral of kT over time) over all up to the moment; null where Z has no meaning.
function compressibility(moment, temperature) {
  if (description.whyNoZ || disks === 0) return null;
  if (!totals) return description.Z;
  const last = moment.done > 0 ? columns.time[moment.done - 1] : 0;
  const heat = totals.heat[moment.done] + temperature * (moment.time - last);
  return heat > 0 && totals.pairs[moment.done] > 0 ? 1 + totals.virial[moment.done] / (2 * disks * heat) : null;
}

/// Returns the largest root mean square speed at some moments of the run. It scales colours and histograms.
function typicalSpeed() {
  const moment = emptyMoment();
  let largest = 0;
  for (let k = 0; k <= 16; ++k) {
    const time = (replay.duration * k) / 16;
    replay.read(time, replay.doneAt(time), moment);
    let sum = 0;
    for (let i = 0; i < disks; ++i) sum += moment.vx[i] * moment.vx[i] + moment.vy[i] * moment.vy[i];
    largest = Math.max(largest, Math.sqrt(sum / Math.max(disks, 1)));
  }
  return largest || 1;
}

const speedScale = typicalSpeed();

/// Pairs [mass, number of disks], one per mass; where there are many masses, one per class of masses.
const massClasses = (() => {
  const most = 48;
  let counts = new Map();
  for (const m of mass) counts.set(m, (counts.get(m) || 0) + 1);
  if (counts.size > most) {
    const sorted = Float64Array.from(mass).sort();
    counts = new Map();
    for (let k = 0; k < most; ++k) {
      const from = Math.floor((k * disks) / most);
      const to = Math.floor(((k + 1) * disks) / most);
      const middle = sorted[Math.floor((from + to) / 2)];
      counts.set(middle, (counts.get(middle) || 0) + to - from);
    }
  }
  return [...counts];
})();

/// Faster than Math.hypot by a factor of several, because it does not guard against overflow.
const speedOf = (moment, i) => Math.sqrt(moment.vx[i] * moment.vx[i] + moment.vy[i] * moment.vy[i]);

const speedBins = 36;
const speedRange = 3.2 * speedScale;

/// Fills `counts` with the histogram of speeds; the last bin holds all faster disks too.
function countSpeeds(moment, counts) {
  counts.fill(0);
  for (let i = 0; i < disks; ++i) {
    const bin = Math.floor((speedOf(moment, i) / speedRange) * speedBins);
    ++counts[Math.min(bin, speedBins - 1)];
  }
}

/// Returns the number of disks per bin at speed v in equilibrium: the two-dimensional Maxwell-Boltzmann distribution, summed over
/// masses.
function maxwellCount(v, temperature) {
  let sum = 0;
  for (const [m, count] of massClasses) sum += count * ((m * v) / temperature) * Math.exp((-m * v * v) / (2 * temperature));
  return (sum * speedRange) / speedBins;
}
