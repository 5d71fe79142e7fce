// The scenes of the playground. Each makes its TOML text from the numbers that one chooses before it starts; `live` names the settings
// that change while it runs. Lengths are in diameters of a usual disk, masses in its mass, and Boltzmann's constant is 1.
"use strict";

const round = (value) => Number(value.toPrecision(12));
const pairs = (list) => `[${list.map(([x, y]) => `[${round(x)}, ${round(y)}]`).join(", ")}]`;

/// Returns `count` places on a lattice that fills a rectangle, row after row, each at least `radius` away from its edges.
function lattice(count, [left, right], [bottom, top], radius) {
  const width = right - left - 2 * radius;
  const height = top - bottom - 2 * radius;
  let across = Math.max(1, Math.round(Math.sqrt((count * width) / height)));
  while (across > 1 && width / (across - 1) < 2.02 * radius) --across;
  const up = Math.ceil(count / across);
  const places = [];
  for (let k = 0; k < count; ++k) {
    const column = k % across;
    const row = Math.floor(k / across);
    places.push([
      left + radius + (across > 1 ? (width * column) / (across - 1) : width / 2),
      bottom + radius + (up > 1 ? (height * row) / (up - 1) : height / 2),
    ]);
  }
  return places;
}

const boxOf = (x, y, boundary) => `[box]\nx = [${x.map(round).join(", ")}]\ny = [${y.map(round).join(", ")}]\nboundary = ${boundary}\n\n`;
const disksOf = ({ name, count, radius = 0.5, mass = 1, positions = '"random"', velocities = "{ temperature = 1.0 }", more = "" }) =>
  `[[disks]]\nname = "${name}"\n${count === undefined ? "" : `count = ${count}\n`}radius = ${round(radius)}\nmass = ${round(mass)}\n${more}` +
  `positions = ${positions}\nvelocities = ${velocities}\n\n`;
const segment = (from, to) => `[[obstacles]]\nsegment = { from = [${from.map(round).join(", ")}], to = [${to.map(round).join(", ")}] }\n\n`;
const arc = (centre, radius, from, to) => `[[obstacles]]\narc = { centre = [${centre.map(round).join(", ")}], radius = ${round(radius)}, from = ${from}, to = ${to} }\n\n`;
const post = (centre, radius) => `[[obstacles]]\ndisk = { centre = [${centre.map(round).join(", ")}], radius = ${round(radius)} }\n\n`;
const collision = (more = "") => `[collision]\nrule = "specular"\n${more}\n`;
const runOf = (p, time = 1000, more = "") => `[run]\ntime = ${time}\nseed = ${p.seed ?? 1}\n${more}`;
const titled = (name) => `title = "${name}"\n\n`;
const kT = (value) => `{ temperature = ${round(value)} }`;
/// The side of a square in which `count` disks of radius 0.5 have this packing fraction.
const sideOf = (count, eta, radius = 0.5) => Math.sqrt((count * Math.PI * radius * radius) / eta);
const walls = '"walls"';
const periodic = '"periodic"';

/// The settings before the start that many scenes have: [least, usual, most, step].
const count = (usual, most = 4000, least = 2) => ({ key: "n", least, usual, most, step: 1, logarithmic: true });
const packing = (usual, most = 0.7) => ({ key: "eta", least: 0.01, usual, most, step: 0.01 });
const temperature = (usual = 1, most = 5) => ({ key: "kT", least: 0.1, usual, most, step: 0.1 });

/// A gas of one kind, from random places or, where it is dense, from a lattice.
const gasOf = (p, name, boundary, velocities = kT(p.kT)) => {
  const side = sideOf(p.n, p.eta);
  return disksOf({ name: "gas", count: p.n, positions: p.eta > 0.45 ? '"hexagonal"' : '"random"', velocities }) +
    boxOf([0, side], [0, side], boundary);
};

/// Balls that fly alike, 10^apart above each other. Their radius is a hundredth of that, so that they hardly ever meet.
const beam = (p, [x, y]) =>
  disksOf({ name: "balls", radius: 10 ** p.apart / 100, positions: pairs(Array.from({ length: p.n }, (_, k) => [x, y + 10 ** p.apart * k])),
    velocities: pairs(Array.from({ length: p.n }, () => [0.8, 0.6])) });

const scenes = [
  {
    id: "gas", group: "gases", start: [count(400, 20000), packing(0.3), temperature()],
    live: ["restitution", "radius", "thermostat", "rule"],
    make: (p) => titled("Hard-disk gas") + gasOf(p, "gas", periodic) + collision() + runOf(p),
  },
  {
    id: "box", group: "gases", start: [count(300, 10000), packing(0.2, 0.6), temperature()],
    live: ["gravity", "restitution", "wallsT", "radius"], shows: "walls",
    make: (p) => titled("Gas in a box") + gasOf(p, "gas", walls) + collision() + runOf(p),
  },
  {
    id: "mixing", group: "gases", start: [count(200, 1500), temperature()], colour: "species", door: true,
    live: ["mass0", "mass1", "restitution"], shows: "walls", history: "left0",
    make: (p) => {
      const side = sideOf(p.n, 0.15);
      const half = Math.floor(p.n / 2);
      return titled("Two gases mix") + boxOf([0, 2 * side], [0, side], walls) +
        disksOf({ name: "left", positions: pairs(lattice(half, [0, side - 0.05], [0, side], 0.5)), velocities: kT(p.kT) }) +
        disksOf({ name: "right", positions: pairs(lattice(p.n - half, [side + 0.05, 2 * side], [0, side], 0.5)), velocities: kT(p.kT) }) +
        segment([side, 0], [side, side]) + collision() + runOf(p);
    },
  },
  {
    id: "hotcold", group: "gases", start: [count(200, 1500), { key: "ratio", least: 1, usual: 5, most: 20, step: 0.5 }], door: true, colour: "speed",
    live: ["restitution"], shows: "walls", history: "sides",
    make: (p) => {
      const side = sideOf(p.n, 0.15);
      const half = Math.floor(p.n / 2);
      return titled("Hot meets cold") + boxOf([0, 2 * side], [0, side], walls) +
        disksOf({ name: "cold", positions: pairs(lattice(half, [0, side - 0.05], [0, side], 0.5)), velocities: kT(1) }) +
        disksOf({ name: "hot", positions: pairs(lattice(p.n - half, [side + 0.05, 2 * side], [0, side], 0.5)), velocities: kT(p.ratio) }) +
        segment([side, 0], [side, side]) + collision() + runOf(p);
    },
  },
  {
    id: "expansion", group: "gases", start: [count(200, 1500), temperature()], door: true,
    live: ["restitution"], shows: "walls", history: "left",
    make: (p) => {
      const side = sideOf(p.n, 0.2);
      return titled("Free expansion") + boxOf([0, 2 * side], [0, side], walls) +
        disksOf({ name: "gas", positions: pairs(lattice(p.n, [0, side - 0.05], [0, side], 0.5)), velocities: kT(p.kT) }) +
        segment([side, 0], [side, side]) + collision() + runOf(p);
    },
  },
  {
    id: "effusion", group: "gases", start: [count(200, 1200, 60), { key: "hole", least: 1.5, usual: 3, most: 10, step: 0.5 }],
    live: ["restitution"], shows: "walls", history: "left",
    make: (p) => {
      const side = sideOf(p.n, 0.2);
      return titled("Effusion") + boxOf([0, 2 * side], [0, side], walls) +
        disksOf({ name: "gas", positions: pairs(lattice(p.n, [0, side - 0.05], [0, side], 0.5)), velocities: kT(1) }) +
        segment([side, 0], [side, (side - p.hole) / 2]) + segment([side, (side + p.hole) / 2], [side, side]) + collision() + runOf(p);
    },
  },
  {
    id: "demon", group: "gases", start: [count(120, 400)], demon: true, history: "sides",
    live: ["demon"], shows: "walls",
    make: (p) => {
      const side = sideOf(p.n / 2, 0.1);
      const half = Math.floor(p.n / 2);
      const gap = side / 5;
      return titled("Maxwell's demon") + boxOf([0, 2 * side], [0, side], walls) +
        disksOf({ name: "left", positions: pairs(lattice(half, [0, side - 0.05], [0, side], 0.5)), velocities: kT(1) }) +
        disksOf({ name: "right", positions: pairs(lattice(p.n - half, [side + 0.05, 2 * side], [0, side], 0.5)), velocities: kT(1) }) +
        segment([side, 0], [side, (side - gap) / 2]) + segment([side, (side + gap) / 2], [side, side]) +
        segment([side, (side - gap) / 2], [side, (side + gap) / 2]) + collision() + runOf(p);
    },
  },
  {
    id: "brownian", group: "gases", start: [count(300, 3000), { key: "grain", least: 1, usual: 3, most: 6, step: 0.5 }, temperature()], colour: "species", follow: 0,
    live: ["mass0", "gravity", "restitution"], shows: "walls",
    make: (p) => {
      const side = Math.max(sideOf(p.n, 0.12), 5 * p.grain);
      return titled("A Brownian disk") + boxOf([0, side], [0, side], walls) +
        disksOf({ name: "grain", radius: p.grain, mass: 20, positions: pairs([[side / 2, side / 2]]), velocities: '"rest"' }) +
        disksOf({ name: "molecules", count: p.n, velocities: kT(p.kT) }) + collision() + runOf(p);
    },
  },
  {
    id: "swimmers", group: "gases", start: [count(200, 3000), packing(0.15, 0.5)], follow: 0,
    live: ["tumbling", "radius"],
    make: (p) => titled("Run and tumble") + gasOf(p, "swimmers", periodic, "{ speed = 1.0 }") +
      collision() + "[tumbling]\nrate = 0.5\n\n" + runOf(p),
  },
  {
    id: "piston", group: "walls", start: [count(150, 1500), temperature()], shows: "walls", history: "piston",
    live: ["load", "pistonMass", "gravity0"],
    make: (p) => {
      const side = sideOf(p.n, 0.12);
      return titled("Piston with weights") + boxOf([0, side], [0, side], walls) +
        disksOf({ name: "gas", count: p.n, velocities: kT(p.kT) }) + collision() +
        `[walls]\ntop = { mass = 50, load = ${round((p.n * p.kT) / (side * side))} }\n\n` + runOf(p);
    },
  },
  {
    id: "compression", group: "walls", start: [count(200, 1500), temperature()], shows: "walls", history: "temperature",
    live: ["wallSpeed"],
    make: (p) => {
      const side = sideOf(p.n, 0.1);
      return titled("Compression by a moving wall") + boxOf([0, 1.5 * side], [0, side], walls) +
        disksOf({ name: "gas", count: p.n, velocities: kT(p.kT) }) + collision() + runOf(p);
    },
  },
  {
    id: "heat", group: "walls", start: [count(300, 3000), packing(0.2, 0.5)], shows: "walls", history: "sides",
    live: ["leftT", "rightT", "restitution"],
    make: (p) => {
      const side = sideOf(p.n, p.eta);
      return titled("Heat between two walls") + boxOf([0, side], [0, side], '{ x = "walls", y = "periodic" }') +
        disksOf({ name: "gas", count: p.n, positions: p.eta > 0.45 ? '"hexagonal"' : '"random"', velocities: kT(1.4) }) +
        collision() + "[walls]\nleft = { temperature = 2 }\nright = { temperature = 1 }\n\n" + runOf(p);
    },
  },
  {
    id: "couette", group: "walls", start: [count(250, 3000), packing(0.2, 0.5)], shows: "walls", history: "temperature",
    live: ["slide", "restitution"],
    make: (p) => {
      const side = sideOf(p.n, p.eta);
      return titled("Flow between sliding walls") + boxOf([0, side], [0, side], '{ x = "periodic", y = "walls" }') +
        disksOf({ name: "gas", count: p.n, positions: p.eta > 0.45 ? '"hexagonal"' : '"random"' }) + collision() +
        "[walls]\nbottom = { temperature = 1, tangential_velocity = -1 }\ntop = { temperature = 1, tangential_velocity = 1 }\n\n" + runOf(p);
    },
  },
  {
    id: "sediment", group: "walls", start: [count(300, 3000), temperature()], shows: "walls", history: "height",
    live: ["gravity", "bottomT", "restitution"],
    make: (p) => {
      const side = sideOf(p.n, 0.12);
      return titled("Sedimentation") + boxOf([0, side], [0, 1.2 * side], '{ x = "periodic", y = "walls" }') +
        disksOf({ name: "gas", count: p.n, velocities: kT(p.kT) }) + collision() + `[gravity]\nacceleration = [0, ${round(-5 / side)}]\n\n` + runOf(p);
    },
  },
  {
    id: "granular", group: "grains", start: [count(1000, 10000), packing(0.25, 0.5), { key: "e", least: 0.5, usual: 0.85, most: 1, step: 0.01 }], history: "energy",
    live: ["restitution", "thermostat"],
    make: (p) => titled("Granular cooling and clusters") + gasOf({ ...p, kT: 1 }, "grains", periodic) +
      collision(`restitution = ${p.e}\nelastic_below = { time = 1e-3 }\n`) + runOf(p, 10000),
  },
  {
    id: "shaken", group: "grains", start: [count(200, 1500)], shows: "walls", history: "height",
    live: ["gravity", "bottomT", "restitution"],
    make: (p) => {
      const width = Math.sqrt(p.n) * 1.8;
      return titled("Grains on a hot plate") + boxOf([0, width], [0, 2.5 * width], walls) +
        disksOf({ name: "grains", positions: pairs(lattice(p.n, [0, width], [0.2, width], 0.5)), velocities: kT(1) }) +
        collision("restitution = 0.9\nelastic_below = { time = 1e-3 }\n") +
        "[gravity]\nacceleration = [0, -0.5]\n\n[walls]\nbottom = { temperature = 8 }\n\n" + runOf(p);
    },
  },
  {
    id: "vibrated", group: "grains", start: [count(288, 1500, 20)], shows: "walls", history: "height",
    live: ["amplitude", "frequency", "restitution", "gravity"],
    make: (p) => {
      const width = Math.max(Math.sqrt(p.n) * 1.4, 6);
      return titled("Grains on a vibrating floor") + boxOf([0, width], [0, 2.5 * width], '{ x = "periodic", y = "walls" }') +
        disksOf({ name: "grains", positions: pairs(lattice(p.n, [0.05, width - 0.05], [0.2, width], 0.5)), velocities: kT(1) }) +
        collision("restitution = 0.8\nelastic_below = { time = 1e-3 }\n") +
        '[gravity]\nacceleration = [0, -1]\n\n[walls]\nbottom = { vibration = { form = "sine", amplitude = 0.5, frequency = 1 } }\n\n' + runOf(p);
    },
  },
  {
    id: "rough", group: "grains", start: [count(300, 3000), packing(0.25, 0.5)], history: "temperature",
    live: ["roughness", "restitution"],
    make: (p) => titled("Rough disks spin") + gasOf({ ...p, kT: 1 }, "disks", periodic) + collision("roughness = 0.5\nelastic_below = { time = 1e-3 }\n") + runOf(p),
  },
  {
    id: "hourglass", group: "grains", start: [count(150, 500, 40)], shows: "walls", history: "height",
    live: ["gravity", "restitution"],
    make: (p) => {
      const width = Math.sqrt(p.n) * 1.5;
      const gap = 4.5;
      return titled("Hourglass") + boxOf([0, width], [0, 3 * width], walls) +
        disksOf({ name: "sand", positions: pairs(lattice(p.n, [0.2, width - 0.2], [2.15 * width, 3 * width], 0.5)), velocities: kT(0.1) }) +
        collision("restitution = 0.8\nelastic_below = { time = 1e-2 }\n") +
        segment([0, 2.1 * width], [(width - gap) / 2, 1.5 * width]) + segment([width, 2.1 * width], [(width + gap) / 2, 1.5 * width]) +
        "[gravity]\nacceleration = [0, -1]\n\n" + runOf(p);
    },
  },
  {
    id: "freezing", group: "dense", start: [count(400, 4000), { key: "eta", least: 0.6, usual: 0.7, most: 0.85, step: 0.005 }], colour: "psi6",
    live: ["growth"],
    make: (p) => {
      const side = sideOf(p.n, p.eta);
      return titled("Freezing") + boxOf([0, side], [0, side], periodic) +
        disksOf({ name: "disks", count: p.n, positions: p.eta > 0.8 ? '"hexagonal"' : `{ packing_fraction = ${p.eta} }` }) + collision() + runOf(p);
    },
  },
  {
    id: "crystal", group: "dense", start: [count(256, 2000), { key: "growth", least: 0.002, usual: 0.02, most: 0.2, step: 0.002, logarithmic: true }], colour: "psi6",
    live: ["growth"],
    make: (p) => titled("Disks that grow") + gasOf({ n: p.n, eta: 0.3, kT: 1 }, "disks", periodic) + collision() +
      `[growth]\nrate = ${p.growth}\nuntil = { packing_fraction = 0.85 }\n\n` + runOf(p),
  },
  {
    id: "sizes", group: "dense", start: [count(300, 3000), packing(0.72, 0.76), { key: "spread", least: 0.02, usual: 0.2, most: 0.4, step: 0.01 }],
    live: ["restitution"],
    make: (p) => titled("Disks of all sizes") + "[box]\naspect = 1\nboundary = \"periodic\"\n\n" +
      `[[disks]]\nname = "disks"\ncount = ${p.n}\nradius = { lognormal = { mean = 0.5, deviation = ${round(0.5 * p.spread)} } }\npacking_fraction = ${p.eta}\n` +
      `mass = { per_area = 1.0 }\npositions = { packing_fraction = ${p.eta} }\nvelocities = { temperature = 1.0 }\n\n` + collision() + runOf(p),
  },
  {
    id: "condensation", group: "dense", start: [count(500, 3000, 20), packing(0.2, 0.4), temperature(0.6, 2)], colour: "speed", history: "temperature",
    live: ["wellDepth", "thermostat"],
    make: (p) => titled("Drops from square wells") + gasOf(p, "gas", periodic) + collision() +
      `[square_well]\nwidth = 1.5\ndepth = 1\n\n[thermostat]\ntemperature = ${p.kT}\nrate = 0.1\n\n` + runOf(p),
  },
  {
    id: "shear", group: "dense", start: [count(300, 3000), packing(0.4, 0.6)], history: "temperature",
    live: ["shear", "thermostat", "restitution"],
    make: (p) => titled("Shear flow") + gasOf({ ...p, kT: 1 }, "gas", periodic) + collision() +
      "[shear]\nrate = 0.1\n\n[thermostat]\ntemperature = 1\nrate = 0.2\n\n" + runOf(p),
  },
  {
    id: "break", group: "few", start: [{ key: "speed", least: 1, usual: 10, most: 40, step: 1 }, { key: "aim", least: -0.4, usual: 0.02, most: 0.4, step: 0.01 }], colour: "species", shows: "walls",
    live: ["drag", "restitution"], rate: 0.5,
    make: (p) => {
      const rack = [];
      for (let row = 0; row < 5; ++row)
        for (let k = 0; k <= row; ++k) rack.push([26 + row * 0.8675, 10 + (k - row / 2) * 1.002]);
      return titled("Break shot") + boxOf([0, 40], [0, 20], walls) +
        disksOf({ name: "cue", positions: pairs([[10, 10 + p.aim]]), velocities: pairs([[p.speed, 0]]) }) +
        disksOf({ name: "rack", positions: pairs(rack), velocities: '"rest"' }) + collision("restitution = 0.95\n") + "[drag]\nrate = 0.1\n\n" + runOf(p);
    },
  },
  {
    id: "cradle", group: "few", start: [{ key: "n", least: 2, usual: 5, most: 10, step: 1 }, { key: "strikers", least: 1, usual: 1, most: 3, step: 1 }], colour: "speed",
    live: ["restitution"], shows: "walls",
    make: (p) => {
      const row = Array.from({ length: p.n }, (_, k) => [8 + k, 1]);
      const strikers = Array.from({ length: p.strikers }, (_, k) => [2 + k, 1]);
      return titled("Newton's cradle") + boxOf([0, 16 + p.n], [0, 2], walls) +
        disksOf({ name: "strikers", positions: pairs(strikers), velocities: pairs(strikers.map(() => [1, 0])) }) +
        disksOf({ name: "row", positions: pairs(row), velocities: '"rest"' }) + collision() + runOf(p);
    },
  },
  {
    id: "galperin", group: "few", start: [{ key: "digits", least: 0, usual: 2, most: 4, step: 1 }], colour: "species", counts: "all",
    live: [], shows: "walls", extent: [0, 24, -1, 1],
    // The far wall is out of sight, and so far away that it adds no collision.
    make: (p) => titled("Galperin counts pi") + boxOf([0, 1e6], [-1, 1], walls) +
      disksOf({ name: "light", radius: 0.25, positions: pairs([[3, 0]]), velocities: '"rest"' }) +
      disksOf({ name: "heavy", radius: 0.75, mass: 100 ** p.digits, positions: pairs([[8, 0]]), velocities: pairs([[-1, 0]]) }) + collision() + runOf(p, 100),
  },
  {
    id: "sinai", group: "few", start: [{ key: "n", least: 1, usual: 12, most: 60, step: 1 }, { key: "apart", least: -8, usual: -3, most: -1, step: 1 }], colour: "id", shows: "walls",
    live: [], trails: true,
    make: (p) => titled("Sinai's billiard") + boxOf([-10, 10], [-10, 10], walls) +
      beam(p, [-8, -3]) + post([0, 0], 4) + collision() + runOf(p),
  },
  {
    id: "stadium", group: "few", start: [{ key: "n", least: 1, usual: 8, most: 20, step: 1 }, { key: "straight", least: 0, usual: 8, most: 16, step: 1 }, { key: "apart", least: -8, usual: -3, most: -1, step: 1 }], colour: "id", trails: true,
    live: [],
    make: (p) => {
      const [half, radius] = [p.straight / 2, 8];
      const sides = half > 0 ? segment([-half, -radius], [half, -radius]) + segment([half, radius], [-half, radius]) : "";
      return titled("Bunimovich's stadium") + boxOf([-half - radius - 0.5, half + radius + 0.5], [-radius - 0.5, radius + 0.5], walls) +
        beam(p, [-2, 1]) +
        arc([-half, 0], radius, 90, 270) + arc([half, 0], radius, -90, 90) + sides + collision() + runOf(p);
    },
  },
  {
    id: "drum", group: "few", start: [count(60, 600, 1), temperature()], history: "energy",
    live: ["gravity", "restitution"],
    make: (p) => {
      const radius = Math.max(Math.sqrt(p.n) * 0.5 / Math.sqrt(0.15), 3);
      return titled("A round drum") + `[box]\ncircle = { centre = [0, 0], radius = ${round(radius)} }\n\n` +
        disksOf({ name: "balls", count: p.n, positions: '"hexagonal"', velocities: kT(p.kT) }) + collision() +
        "[gravity]\nacceleration = [0, -0.3]\n\n" + runOf(p);
    },
  },
  {
    id: "lorentz", group: "few", start: [{ key: "n", least: 1, usual: 40, most: 400, step: 1, logarithmic: true }, { key: "post", least: 0.3, usual: 0.9, most: 1.05, step: 0.05 }], colour: "id", trails: true,
    live: [],
    make: (p) => {
      const columns = 6;
      const rows = 6;
      const posts = [];
      for (let row = 0; row < rows; ++row)
        for (let k = 0; k < columns; ++k) posts.push(post([2.25 * (k + (row % 2) / 2) + 0.5625, 1.95 * (row + 0.5)], p.post));
      return titled("Lorentz gas") + boxOf([0, 2.25 * columns], [0, 1.95 * rows], periodic) +
        disksOf({ name: "balls", count: p.n, radius: 0.02, velocities: "{ speed = 1.0 }" }) + posts.join("") + collision() + runOf(p);
    },
  },
  {
    id: "galton", group: "few", start: [count(60, 150, 1)], extent: [0, 24, 0, 46], history: "height",
    live: ["gravity", "restitution"], shows: "walls",
    make: (p) => {
      const pins = [];
      for (let row = 0; row < 9; ++row)
        for (let k = 0; k <= 11 - (row % 2); ++k) pins.push(post([1 + 2 * k + (row % 2), 15 + 2 * row], 0.25));
      const slots = Array.from({ length: 11 }, (_, k) => segment([2 * (k + 1), 0], [2 * (k + 1), 12]));
      const balls = Array.from({ length: p.n }, (_, k) => [12 + [-0.31, 0.23, -0.07, 0.37, -0.19, 0.11][k % 6] + (k % 2 ? 0.5 : -0.5), 36 + 1.05 * k]);
      return titled("Galton's board") + boxOf([0, 24], [0, 38 + 1.1 * p.n], walls) +
        disksOf({ name: "balls", radius: 0.4, positions: pairs(balls), velocities: '"rest"' }) +
        collision("restitution = 0.5\nelastic_below = { time = 2e-2 }\n") + pins.join("") + slots.join("") +
        "[gravity]\nacceleration = [0, -1]\n\n[walls]\nbottom = { restitution = 0.3 }\n\n" + runOf(p);
    },
  },
];
