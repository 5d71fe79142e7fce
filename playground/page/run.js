// The run that the page shows: what the engine has last told of it, and the loop that asks for more.
"use strict";

let disks = 0;                        // their number, for hexatic.js
let box = { lower: [0, 0], upper: [1, 1], periodic: [false, false], isCircle: false, lengths: [1, 1] };  // that of the start

const run = {
  engine: null,
  scene: null,        // an entry of `scenes`, or {id: "own", title, toml}
  start: {},          // the numbers that its text was made from
  toml: "",
  overrides: [],
  description: null,
  radius: new Float64Array(), mass: new Float64Array(), species: new Float64Array(), largest: 0,
  x: new Float64Array(), y: new Float64Array(), vx: new Float64Array(), vy: new Float64Array(),
  numbers: new Float64Array(26),
  measured: null, histogram: null,
  twin: null, twinNumbers: null, twinMarks: null,
  extent: null,       // left, right, bottom, top of what the view shows
  isPlaying: false,
  isStale: true,
  rate: 1,            // simulated time per second
  speedScale: 1,      // root mean square speed at the start
  pairsPerSecond: 0, isLate: false,
  checks: 0, fault: "",
  lastEvent: null,
};

/// Takes what the engine has told.
function take(told) {
  if (told.description) {
    const d = told.description;
    run.description = d;
    Object.assign(run, { radius: told.radius, mass: told.mass, species: told.species });
    run.largest = told.radius.reduce((largest, r) => Math.max(largest, r), 0);
    disks = d.disks;
    box = { lower: d.lower, upper: d.upper, periodic: d.periodic, isCircle: d.isCircle, lengths: [d.upper[0] - d.lower[0], d.upper[1] - d.lower[1]] };
    onDescription.forEach((listener) => listener(d));
  }
  if (told.disks) {
    const count = told.numbers[at.disks];
    for (const [k, name] of ["x", "y", "vx", "vy"].entries()) run[name] = told.disks.subarray(k * count, (k + 1) * count);
    run.numbers = told.numbers;
    run.twin = told.twin ?? null;
  }
  for (const name of ["measured", "histogram", "twinNumbers", "twinMarks"]) if (told[name]) run[name] = told[name];
  if (!run.twin) run.twinNumbers = run.twinMarks = null;
  if (told.fault) notify(told.fault);
  run.isStale = true;
  if (told.description && !run.isPlaying) {
    put("hash", "…");
    showHash();
  }
}
const onDescription = [];

/// Asks the engine, and takes the answer; a refusal becomes a sentence on the page. Returns whether it was done.
async function act(name, values) {
  try {
    take(await run.engine.ask(name, values));
    run.lastEvent = null;
    return true;
  } catch (error) {
    notify(error.message);
    return false;
  }
}

/// Makes a change now: the body of a [[changes]] table. Returns whether it was done.
async function changeRun(body) {
  const isDone = await act("apply", { body });
  if (isDone) followOn(body);
  return isDone;
}

/// Follows the same disk after a change that takes one out: those after it have moved up by one.
function followOn(body) {
  const removed = /^\s*remove_disk\s*=\s*(\d+)/.exec(body);
  if (!removed) return;
  const disk = Number(removed[1]);
  if (settings.followed >= disk) follow(settings.followed === disk ? -1 : settings.followed - 1);
}

/// Loads a scene from its text. Keeps the run that is there where it is refused.
async function loadText(scene, toml, { overrides = [], changes = "", start = {} } = {}) {
  const told = await run.engine.ask("load", { toml, source: scene.id, overrides, changes });
  Object.assign(run, {
    scene, toml, overrides, start, measured: null, histogram: null, twin: null, twinNumbers: null, twinMarks: null, extent: null, lastEvent: null, checks: 0, fault: "",
    isLate: false, pairsPerSecond: 0,
  });
  take(told);
  let sum = 0;
  for (let i = 0; i < disks; ++i) sum += run.vx[i] ** 2 + run.vy[i] ** 2;
  const fall = Math.hypot(...run.description.gravity) * Math.min(...box.lengths);
  const hottest = Math.max(0, ...run.description.walls.map((wall) => wall.temperature ?? 0));
  run.speedScale = Math.max(Math.sqrt(sum / Math.max(disks, 1)), Math.sqrt(fall) / 2, hottest > 0 ? Math.sqrt((2 * hottest) / Math.max(...run.mass)) / 2 : 0) || Math.min(...box.lengths) / run.description.crossing || 1;
  run.rate = usualRate();
  // Room above a piston, which will rise.
  const { lower, upper, walls } = run.description;
  run.extent = scene.extent ?? (walls[3].mass !== null ? [lower[0], upper[0], lower[1], upper[1] + 0.35 * box.lengths[1]] : null);
  view.isFitted = true;
  settings.followed = scene.follow ?? -1;
  forgetHistory();
  forgetTrails();
  onLoad.forEach((listener) => listener());
  showLater();
}
const onLoad = [];

/// A disk of usual speed crosses the box in some six seconds.
const usualRate = () => (run.description.crossing / 6) * (run.scene.rate ?? 1);

/// Plays or pauses.
function play(isPlaying = !run.isPlaying) {
  run.isPlaying = isPlaying;
  run.lastEvent = null;
  showPlaying();
  if (!isPlaying) showHash();
}

/// The collisions so far: those of pairs, and with walls where the scene counts all.
const collisions = () => run.numbers[at.pairs] + (run.scene.counts === "all" ? run.numbers[at.walls] : 0);

let isAsked = false;  // a frame is on its way
let isDue = false;    // the screen has asked for another since
let resting = 0;      // those who wait until none is on its way
let askedAt = 0;
let measuredAt = 0;

/// Asks for the next frame where the run goes on and none is on its way.
async function goOn(now) {
  if (!run.isPlaying) askedAt = now;
  isDue = isAsked;
  if (!run.isPlaying || isAsked || resting > 0) return;
  isAsked = true;
  const seconds = Math.min(Math.max(now - askedAt, 0) / 1000, 0.1);
  askedAt = now;
  const isMeasured = now - measuredAt > 200;
  if (isMeasured) measuredAt = now;
  const before = collisions();
  try {
    const told = await run.engine.ask("frame", { time: run.rate * seconds, budget: 14, about: { measured: isMeasured, histogram: isMeasured } });
    take(told);
    run.isLate = told.status === 1;
    const share = 0.1;
    if (seconds > 0) run.pairsPerSecond += share * ((collisions() - before) / seconds - run.pairsPerSecond);
    if (told.status === 2) {
      play(false);
      notify(t("stopped", { why: t(`stopped.${told.why}`) }));
    }
    keepHistory();
    keepTrails();
    await runDemon();
  } catch (error) {
    play(false);
    notify(error.message);
  }
  isAsked = false;
  if (isDue) goOn(performance.now());  // it came late: the engine does not wait for the screen too
}

/// Waits until the frame that is on its way has come; no other is asked for meanwhile.
async function rest() {
  ++resting;
  while (isAsked) await new Promise((resolve) => setTimeout(resolve, 2));
  --resting;
}

async function stepOn() {
  play(false);
  await rest();
  const before = run.numbers[at.time];
  try {
    const told = await run.engine.ask("step");
    take(told);
    run.lastEvent = told.event;
    if (!told.event) notify(t("noEvent"));
    else keepHistory();
  } catch (error) {
    notify(error.message);
  }
  if (run.numbers[at.time] === before) run.isStale = true;
  showHash();
}

async function stepBack() {
  play(false);
  await rest();
  try {
    const told = await run.engine.ask("back", { events: 1 });
    if (!told.done) notify(t("noWayBack"));
    take(told);
    run.lastEvent = null;
    if (run.twin) await startTwin();
    cutHistory(run.numbers[at.time]);
  } catch (error) {
    notify(error.message);
  }
  showHash();
}

/// Begins the same scene anew, as it was at time 0, without the changes.
async function again() {
  await rest();
  try {
    await loadText(run.scene, run.toml, { overrides: run.overrides, start: run.start });
  } catch (error) {
    notify(error.message);
  }
}

// Maxwell's demon: opens and closes the third obstacle of its scene, as what comes near deserves. All that he does is a change like any.
const demon = { rule: "sort", door: null, isOpen: false, isBusy: false };
onLoad.push(() => {
  demon.door = run.scene.demon ? run.description.obstacles[2] : null;
  demon.isOpen = false;
});

async function runDemon() {
  if (!demon.door || !run.isPlaying) return;
  const wanted = demonOpens();
  if (wanted === demon.isOpen) return;
  const index = run.description.obstacles.findIndex((one) => one.from && one.from[1] === demon.door.from[1] && one.from[0] === demon.door.from[0] && one.to[1] === demon.door.to[1]);
  try {
    if (wanted && index >= 0) take(await run.engine.ask("apply", { body: `remove_obstacle = ${index}` }));
    else if (!wanted && index < 0) take(await run.engine.ask("apply", { body: `add_obstacle = ${segmentText(demon.door.from, demon.door.to)}` }));
    demon.isOpen = wanted;
  } catch {
    // A disk is in the door: he closes it when that is through.
  }
}

/// Whether the demon wants the door open: something comes near that may pass, and nothing that may not.
function demonOpens() {
  if (demon.rule === "open") return true;
  if (demon.rule === "closed") return false;
  const x = demon.door.from[0];
  const [bottom, top] = [demon.door.from[1], demon.door.to[1]].sort((a, b) => a - b);
  const usual = run.speedScale;
  const ahead = (run.rate / 60) * 4;
  let comes = false;
  for (let i = 0; i < disks; ++i) {
    const way = run.vx[i] * ahead;
    const isFromLeft = run.x[i] < x && run.vx[i] > 0;
    const isFromRight = run.x[i] > x && run.vx[i] < 0;
    if (!isFromLeft && !isFromRight) continue;
    if (Math.abs(run.x[i] - x) > Math.abs(way) + run.radius[i] || run.y[i] < bottom - 0.5 || run.y[i] > top + 0.5) continue;
    const speed = Math.hypot(run.vx[i], run.vy[i]);
    const mayPass = demon.rule === "valve" ? isFromLeft : isFromLeft ? speed > usual : speed < usual;
    if (!mayPass) return false;
    comes = true;
  }
  return comes || (demon.isOpen && isInDoor(x, bottom, top));
}
function isInDoor(x, bottom, top) {
  for (let i = 0; i < disks; ++i) if (Math.abs(run.x[i] - x) < run.radius[i] && run.y[i] > bottom - 0.5 && run.y[i] < top + 0.5) return true;
  return false;
}

const number = (value) => String(Number(value));
const segmentText = (from, to) => `{ segment = { from = [${from.map(number).join(", ")}], to = [${to.map(number).join(", ")}] } }`;
