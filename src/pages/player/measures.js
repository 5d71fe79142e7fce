// What is measured at the moment shown: energy, temperature, speeds; and what collisions have added up to by then.
"use strict";

const { mass, radius, species } = columns;
const totalMass = mass.reduce((sum, m) => sum + m, 0);

/// Kinetic and potential energy, and kT = 2 K' / f: K' without the common motion where no collision changes that.
function energyOf(moment) {
  const [gx, gy] = description.gravity;
  const ground = [0, 1].map((axis) => (description.gravity[axis] < 0 ? box.lower[axis] : box.upper[axis]));
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

/// Running sums over events: entry k is what the first k have made.
function eventTotals() {
  const { time, disk, partner } = columns;
  const count = time.length;
  const totals = { pairs: new Uint32Array(count + 1), walls: new Uint32Array(count + 1), virial: new Float64Array(count + 1) };
  totals.heat = new Float64Array(count + 1);  // the integral over time of kT
  const { first, x, y, vx, vy, time: begun } = replay.flights;
  const slot = first.slice(0, disks);
  const [gx, gy] = description.gravity;
  const moment = emptyMoment();
  replay.read(0, 0, moment);
  const { heat: heatAtStart, freedom } = energyOf(moment);
  let heat = heatAtStart;
  let before = 0;
  const turned = (i, e) => {  // what its next flight adds to the energy
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
      for (let i = 0; i < disks; ++i) turned(i, e);
      continue;
    }
    const kick = turned(disk[e], e);
    if (!isPair) continue;
    turned(partner[e], e);
    const a = slot[disk[e]];
    const b = slot[partner[e]];
    totals.virial[e + 1] += mass[disk[e]] * (kick.dx * apart(x[a], x[b], 0) + kick.dy * apart(y[a], y[b], 1));
  }
  totals.heatAtStart = (2 * heatAtStart) / freedom;
  return totals;
}

const totals = description.exact ? eventTotals() : null;

/// Z = 1 + W / (2 N times the integral of kT over time), of everything up to the moment; null where it means nothing.
function compressibility(moment, temperature) {
  if (description.whyNoZ || disks === 0) return null;
  if (!totals) return description.Z;
  const last = moment.done > 0 ? columns.time[moment.done - 1] : 0;
  const heat = totals.heat[moment.done] + temperature * (moment.time - last);
  return heat > 0 && totals.pairs[moment.done] > 0 ? 1 + totals.virial[moment.done] / (2 * disks * heat) : null;
}

/// The fastest root mean square speed of some moments of the run: what colours and histograms are scaled by.
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

/// [mass, number of disks] of every mass there is; of many masses, of classes between the lightest and the heaviest.
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

/// Unlike Math.hypot without care for overflow, and several times as fast.
const speedOf = (moment, i) => Math.sqrt(moment.vx[i] * moment.vx[i] + moment.vy[i] * moment.vy[i]);

const speedBins = 36;
const speedRange = 3.2 * speedScale;

/// How many disks have which speed, in `counts`; the last bin holds all that are faster.
function countSpeeds(moment, counts) {
  counts.fill(0);
  for (let i = 0; i < disks; ++i) {
    const bin = Math.floor((speedOf(moment, i) / speedRange) * speedBins);
    ++counts[Math.min(bin, speedBins - 1)];
  }
}

/// Disks per bin about speed v in equilibrium: the two-dimensional Maxwell-Boltzmann distribution, each mass by itself.
function maxwellCount(v, temperature) {
  let sum = 0;
  for (const [m, count] of massClasses) sum += count * ((m * v) / temperature) * Math.exp((-m * v * v) / (2 * temperature));
  return (sum * speedRange) / speedBins;
}
