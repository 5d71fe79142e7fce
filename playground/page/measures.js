// What is computed here from a moment of the run, and kept over time.
"use strict";

const share = (sum, count) => (count > 0 ? sum / count : NaN);

/// Temperatures and numbers of the left and the right half of the box.
function halves() {
  const middle = (run.numbers[at.left] + run.numbers[at.right]) / 2;
  const left = { count: 0, heat: 0, ofFirst: 0, ofSecond: 0 };
  const right = { count: 0, heat: 0 };
  let first = 0;
  let second = 0;
  let height = 0;
  for (let i = 0; i < disks; ++i) {
    const side = run.x[i] < middle ? left : right;
    ++side.count;
    side.heat += (run.mass[i] * (run.vx[i] ** 2 + run.vy[i] ** 2)) / 2;
    height += run.y[i];
    if (run.species[i] === 0) ++first;
    if (run.species[i] === 1) ++second;
    if (side === left && run.species[i] === 0) ++left.ofFirst;
    if (side === left && run.species[i] === 1) ++left.ofSecond;
  }
  return {
    leftT: share(left.heat, left.count), rightT: share(right.heat, right.count), leftCount: left.count, rightCount: right.count, left: share(left.count, disks),
    first: share(left.ofFirst, first), second: share(left.ofSecond, second), height: share(height, disks) - run.numbers[at.bottom],
  };
}

/// What can be followed over time: the lines of each history, each a number of the moment.
const histories = {
  temperature: { unit: "energy", lines: ["kT"] },
  sides: { unit: "energy", lines: ["leftT", "rightT"] },
  pressure: { unit: "energy / length²", lines: ["pressure"] },
  left: { unit: "", lines: ["left"], range: [0, 1] },
  left0: { unit: "", lines: ["first", "second"], range: [0, 1] },
  energy: { unit: "energy", lines: ["kinetic", "potential", "total"] },
  collisions: { unit: "1 / time", lines: ["collisions"] },
  height: { unit: "length", lines: ["height"] },
  piston: { unit: "length", lines: ["piston"] },
};

const mostPoints = 800;
const past = { points: [], every: 0, pressure: { integral: 0, covered: 0 }, pairs: 0, time: 0 };

function forgetHistory() {
  Object.assign(past, { points: [], every: 0, pressure: { integral: 0, covered: 0 }, pairs: 0, time: run.numbers[at.time] });
}
function cutHistory(time) {
  past.points = past.points.filter((point) => point.time <= time);
  Object.assign(past, { pressure: { integral: 0, covered: 0 }, pairs: run.numbers[at.pairs], time });
}

function keepHistory() {
  const n = run.numbers;
  const last = past.points.at(-1);
  if (last && n[at.time] - last.time < past.every) return;
  if (last && n[at.time] <= last.time) return;
  const point = { time: n[at.time], kT: n[at.kT], ...halves(), kinetic: n[at.kinetic] + n[at.spin], potential: n[at.potential] + n[at.pistons], piston: n[at.top] - n[at.bottom] };
  point.total = point.kinetic + point.potential;
  // Pressure since the point before; measuring has begun anew where its time is shorter.
  if (n[at.covered] < past.pressure.covered) past.pressure = { integral: 0, covered: 0 };
  const covered = n[at.covered] - past.pressure.covered;
  point.pressure = covered > 0 ? (n[at.integral] - past.pressure.integral) / covered : (last?.pressure ?? NaN);
  if (covered > 0) past.pressure = { integral: n[at.integral], covered: n[at.covered] };
  const passed = n[at.time] - past.time;
  point.collisions = passed > 0 ? (2 * (n[at.pairs] - past.pairs)) / (passed * Math.max(disks, 1)) : NaN;
  Object.assign(past, { pairs: n[at.pairs], time: n[at.time] });
  past.points.push(point);
  if (past.points.length <= mostPoints) return;
  past.points = past.points.filter((_, k) => k % 2 === 0);
  past.every = (n[at.time] - past.points[0].time) / (mostPoints / 2);
}

/// Degrees of freedom of all disks together.
function freedom() {
  const { thermal } = run.description;
  return 2 * disks - (thermal[0] ? 0 : 1) - (thermal[1] ? 0 : 1);
}

/// Returns the number of disks per unit of speed at speed v in equilibrium. With a finite number of disks that share their energy the
/// law is v (1 - m v^2 / f kT)^(f / 2 - 2), which has an end; of infinitely many, or in a bath, it is Maxwell-Boltzmann's.
function equilibriumSpeeds(v, kT) {
  const f = freedom();
  const d = run.description;
  const isBath = d.thermostatRate > 0 || d.walls.some((wall) => wall.temperature !== null);
  let sum = 0;
  for (const [m, count] of massClasses()) {
    if (isBath || f > 2000) {
      sum += count * ((m * v) / kT) * Math.exp((-m * v * v) / (2 * kT));
    } else if (f > 4) {
      const rest = 1 - (m * v * v) / (f * kT);
      if (rest > 0) sum += count * ((m * v * (f - 2)) / (f * kT)) * rest ** (f / 2 - 2);
    }
  }
  return sum;
}

let classes = [];
let classesOf = null;
/// Pairs of a mass and the number of its disks. Where there are many masses, disks are put into classes of equal numbers, each with its
/// middle mass.
function massClasses() {
  if (classesOf === run.mass) return classes;
  const most = 64;
  let counts = new Map();
  for (const m of run.mass) counts.set(m, (counts.get(m) ?? 0) + 1);
  if (counts.size > most) {
    const sorted = run.mass.slice().sort();
    counts = new Map();
    for (let k = 0; k < most; ++k) {
      const [from, to] = [k, k + 1].map((end) => Math.floor((end * disks) / most));
      const middle = sorted[Math.floor((from + to) / 2)];
      counts.set(middle, (counts.get(middle) ?? 0) + to - from);
    }
  }
  classes = [...counts];
  classesOf = run.mass;
  return classes;
}

/// The mean free path by Enskog's theory, 1 / (2 sqrt(2) n sigma g), with g from the equation of state; null for other than equal disks,
/// and under reversal, which leaves their speeds as they are.
function enskogPath() {
  const { theoryZ, packing, species, rule } = run.description;
  if (theoryZ === null || rule !== "specular" || species.length !== 1 || !species[0].uniform || !(packing > 0)) return null;
  const contact = (theoryZ - 1) / (2 * packing);
  const density = disks / areaAtStart();
  return 1 / (2 * Math.SQRT2 * density * 2 * species[0].radius * contact);
}

// Paths of the disk that is followed, or of all in scenes of a few.
const trails = { points: [] };
const longestTrail = 240;
function forgetTrails() {
  trails.points = [];
}
function keepTrails() {
  const which = run.scene.trails && disks <= 100 ? Array.from({ length: disks }, (_, i) => i) : settings.followed >= 0 && settings.followed < disks ? [settings.followed] : [];
  if (which.length === 0) {
    trails.points = [];
    return;
  }
  if (trails.points.length > 0 && trails.points[0].which.length !== which.length) trails.points = [];
  trails.points.push({ which, x: which.map((i) => run.x[i]), y: which.map((i) => run.y[i]) });
  if (trails.points.length > longestTrail) trails.points.shift();
}
