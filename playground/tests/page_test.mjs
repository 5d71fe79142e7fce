// Drives the built page in a headless Chromium: node page_test.mjs PAGE [CAROM] [--long]. With the program CAROM, states are compared with
// those that it computes. Prints a line for what fails, and ends with 1 then; ends with 77 where there is no Chromium.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { Browser, chromium, pause } from "./browser.mjs";

const isLong = process.argv.includes("--long");
const [page, carom] = process.argv.slice(2).filter((word) => !word.startsWith("--")).map((path) => resolve(path));
if (!chromium()) {
  console.log("chromium is not installed");
  process.exit(77);
}

let checks = 0;
let failures = 0;
function check(what, isRight, found = "") {
  ++checks;
  if (isRight) return;
  ++failures;
  console.log(`FAILED: ${what}${found === "" ? "" : `; found ${typeof found === "string" ? found : JSON.stringify(found)}`}`);
}

const address = `file://${page}`;
const browser = await Browser.start();
const ask = (expression) => browser.evaluate(expression);
const notice = () => ask("document.getElementById('notice').hidden ? '' : document.getElementById('notice').textContent");
const errors = async () => [...browser.errors, await ask("document.documentElement.dataset.errors")].filter(Boolean).join(" | ");
const clear = () => ask("document.getElementById('notice').hidden = true");
const time = () => ask("carom.run.numbers[0]");
/// The pixel of a place of the scene.
const pixelOf = (x, y) =>
  ask(`(() => { const r = document.getElementById("overlay").getBoundingClientRect(), [l, b] = carom.run.description.lower, [u, t] = carom.run.description.upper;
    const s = 0.9 * Math.min(r.width / (u - l), r.height / (t - b));
    return [r.left + r.width / 2 + (${x} - (l + u) / 2) * s, r.top + r.height / 2 - (${y} - (b + t) / 2) * s]; })()`);

async function test(name, work) {
  try {
    await work();
  } catch (error) {
    ++failures;
    console.log(`FAILED: ${name}: ${error.message}`);
  }
  const found = await errors().catch((error) => error.message);
  check(`${name}: no error in the console`, found === "", found);
}

/// Moves every slider to its ends and back, and returns those that the engine refuses to follow.
const stuckSliders = () =>
  ask(`(async () => {
    const note = document.getElementById("notice");
    const stuck = [];
    for (const input of document.querySelectorAll("#liveSettings input[type=range]")) {
      let moves = 0;
      for (const value of [input.max, input.min, input.value]) {
        note.hidden = true;
        input.value = value;
        input.dispatchEvent(new Event("input"));
        await carom.stateHash();  // the engine answers in turn
        if (note.hidden) ++moves;
      }
      if (moves === 0) stuck.push(input.dataset.setting);
    }
    return stuck;
  })()`);

const twoDisks = `box = { x = [0, 10], y = [0, 10], boundary = "walls" }
collision = { rule = "specular" }
run = { time = 100 }
[[disks]]
radius = 0.5
mass = 1
positions = [[2, 5], [8, 5]]
velocities = [[1, 0], [-1, 0]]
`;

await test("size", async () => check("the page has at most 1.2 MB", statSync(page).size <= 1.2e6, statSync(page).size));

await test("start", async () => {
  await browser.open(address);
  check("it plays by itself", await ask("carom.run.isPlaying"));
  const before = await time();
  await pause(500);
  check("time passes", (await time()) > before);
  check("nothing is loaded from elsewhere", (await ask("performance.getEntriesByType('resource').filter((one) => !/^(blob|data|file):/.test(one.name)).length")) === 0);
});

await test("scenes", async () => {
  const ids = await ask("carom.scenes()");
  check("there are at least 20 scenes", ids.length >= 20, ids.length);
  for (const id of ids) {
    await ask(`carom.scene("${id}").then(() => carom.play(true))`);
    await clear();  // what the scene before was told last
    await pause(isLong ? 10000 : 250);
    check(`${id}: time passes`, (await time()) > 0);
    check(`${id}: no notice`, (await notice()) === "" || isLong, await notice());
    const stuck = await stuckSliders();
    check(`${id}: every slider moves something`, stuck.length === 0, stuck);
    await clear();
    check(`${id}: no error`, (await errors()) === "", await errors());
    check(`${id}: the engine still answers`, /^[0-9a-f]{16}$/.test(await ask("carom.stateHash()")));
  }
});

await test("collisions", async () => {
  const alone = twoDisks.replace("[[2, 5], [8, 5]]", "[[2, 5]]").replace("[[1, 0], [-1, 0]]", "[[1, 0]]").replace("[0, 10]", "[0, 4]");
  await ask(`carom.load(${JSON.stringify(alone)}).then(() => carom.play(true))`);
  await pause(2500);
  const text = (name) => ask(`document.querySelector("[data-number=${name}]").textContent`);
  check("a disk that meets walls alone has no collisions", (await ask("carom.run.numbers[3]")) > 0 && (await text("collisions")) === "0" && (await text("rate")) === "0 per second", [await text("collisions"), await text("rate")]);
});

await test("start settings", async () => {
  await ask('carom.scene("gas", { n: 50 })');
  check("a scene begins with the number asked for", (await ask("carom.run.description.disks")) === 50);
  await ask(`(() => { const input = document.querySelector('[data-start="eta"]'); input.value = 0.1; input.dispatchEvent(new Event("change")); })()`);
  await pause(300);
  check("the packing fraction is that of the slider", Math.abs((await ask("carom.run.description.packing")) - 0.1) < 1e-9);
  await ask(`(() => { const input = document.querySelector('[data-start="eta"]'); input.max = 7; input.value = 7; input.dispatchEvent(new Event("change")); })()`);
  await pause(300);
  check("a slider of the start that is refused goes back", (await notice()) !== "" && (await ask(`document.querySelector('[data-start="eta"]').value`)) === "0.1", await notice());
  await clear();
});

await test("law of speeds", async () => {
  // measures.js itself, with a run of 300 disks whose masses all differ: none of them is left out of the law.
  const source = readFileSync(new URL("../page/measures.js", import.meta.url), "utf8");
  const mass = Float64Array.from({ length: 300 }, (_, i) => 0.2 + 0.01 * i);
  const description = { thermal: [false, false], thermostatRate: 0, walls: [] };
  const { massClasses, equilibriumSpeeds } = new Function("run", "disks", `${source}\nreturn { massClasses, equilibriumSpeeds };`)({ mass, description }, mass.length);
  check("disks of many masses are in some classes", massClasses().length <= 64, massClasses().length);
  let sum = 0;
  for (let k = 0; k < 10000; ++k) sum += equilibriumSpeeds((k + 0.5) * 1e-3, 1) * 1e-3;
  check("the law of speeds has all disks", Math.abs(sum - 300) < 0.01, sum);
});

await test("a round box", async () => {
  // By the equation of state, and by Enskog's theory, in a circle without gravity.
  await ask('carom.scene("drum", { n: 100 })');
  await ask('carom.set("gravity.acceleration", [0, 0])');
  await ask("carom.runUntil(1)");
  await pause(400);
  const numberIn = async (name) => Number((await ask(`document.querySelector('[data-number=${name}]').textContent`)).match(/[\d.]+(?=\D*$)/)?.[0]);
  const { theoryZ, upper, lower, packing } = await ask("carom.run.description");
  const area = (Math.PI * (upper[0] - lower[0]) ** 2) / 4;
  const pressure = (theoryZ * 100 * (await ask("carom.run.numbers[15]"))) / area;
  check("the theory is said to be of an infinite fluid", (await ask('document.getElementById("theoryRow").textContent')) === "infinite fluid");
  const [shown] = (await ask("document.querySelector('[data-number=theory]').textContent")).split(" ");
  check("the pressure of the theory is that of a circle", Math.abs(Number(shown) / pressure - 1) < 1e-3, [shown, pressure]);
  const path = area / (2 * Math.SQRT2 * 100 * ((theoryZ - 1) / (2 * packing)));
  check("and so is the mean free path", Math.abs((await numberIn("path")) / path - 1) < 0.01, [await ask("document.querySelector('[data-number=path]').textContent"), path]);
});

await test("pi", async () => {
  await ask('carom.scene("galperin", { digits: 2 })');
  await ask("carom.runUntil(200)");
  await pause(400);
  check("all collisions are the digits of pi", (await ask("document.querySelector('[data-number=collisions]').textContent")) === "314", await ask("document.querySelector('[data-number=collisions]').textContent"));
});

await test("walls", async () => {
  await ask('carom.scene("box", { n: 50 })');
  const slide = (value) => ask(`(() => { const input = document.querySelector('[data-setting="wallsT"]'); input.value = ${value}; input.dispatchEvent(new Event("input")); })()`);
  await slide(3);
  await pause(200);
  check("a slider heats the walls", (await ask("carom.run.description.walls.every((wall) => wall.temperature === 3)")));
  await ask(`(() => { const input = document.querySelector('[data-setting="radius"]'); input.max = 50; input.value = 50; input.dispatchEvent(new Event("input")); })()`);
  await pause(200);
  check("a slider that is refused goes back", (await notice()) !== "" && Math.abs((await ask(`document.querySelector('[data-setting="radius"]').value`)) - (await ask("carom.run.description.species[0].radius"))) < 0.01, await notice());
  await clear();
  await slide(0);
  await pause(200);
  check("and insulates them again", (await ask("carom.run.description.walls.every((wall) => wall.temperature === null)")) && (await notice()) === "", await notice());
});

await test("settings of scenes from elsewhere", async () => {
  const disks = (x, y) => `[[disks]]\nradius = 0.5\nmass = 1\npositions = [[${x}, ${y}]]\nvelocities = [[1, 0]]\n`;
  const scene = (boundary, effects) =>
    `box = { x = [0, 10], y = [0, 10], boundary = "${boundary}" }\ncollision = { rule = "specular" }\nrun = { time = 100 }\n${disks(2, 5)}${disks(8, 5)}${effects}`;
  const sliders = () => ask('[...document.querySelectorAll("#liveSettings [data-setting]")].map((one) => one.dataset.setting)');
  const has = async (what, yes, no) => {
    const found = await sliders();
    check(`${what} has the settings of its effects`, yes.every((name) => found.includes(name)) && !no.some((name) => found.includes(name)), found);
    const stuck = await stuckSliders();
    check(`${what}: every slider moves something`, stuck.length === 0, stuck);
    await clear();
  };
  const slide = async (name, value) => {
    await ask(`(() => { const input = document.querySelector('[data-setting="${name}"]'); input.value = ${value}; input.dispatchEvent(new Event("input")); })()`);
    await ask("carom.stateHash()");
  };
  await ask(`carom.load(${JSON.stringify(scene("periodic", `
    [brownian]\ntemperature = 1\nrate = 2\n[non_additivity]\ndelta = -0.1
    [stepped_potential]\nsteps = [{ width = 1.2, energy = 0.5 }, { width = 1.5, energy = -0.5 }]`))})`);
  await has("a liquid", ["brownianT", "brownianRate", "nonAdditivity", "step0", "step1"], ["step2", "thermostat", "vibration", "amplitude", "topSlides"]);
  await slide("step1", -1);
  check("the other step stays", JSON.stringify(await ask("carom.run.description.steps.map((step) => step.energy)")) === "[0.5,-1]", await ask("carom.run.description.steps"));
  await ask(`carom.load(${JSON.stringify(scene("walls", `
    [walls]\nleft = { vibration = 1 }\ntop = { temperature = 2, tangential_velocity = 1 }
    bottom = { vibration = { form = "sawtooth", amplitude = 0.5, frequency = 2 }, restitution = 0.9 }`))})`);
  await has("a box", ["vibration", "amplitude", "frequency", "topSlides"], ["bottomSlides", "wallsT", "brownianT", "step0", "nonAdditivity"]);
  await slide("amplitude", 0.25);
  await slide("topSlides", -2);
  const [left, , bottom, top] = await ask("carom.run.description.walls");
  check("a slider changes what it names alone", bottom.amplitude === 0.25 && bottom.frequency === 2 && bottom.restitution === 0.9 && top.slides === -2 && top.temperature === 2 && left.vibration === 1, [left, bottom, top]);
});

await test("restitution and drag", async () => {
  const slide = async (name, value) => {
    await ask(`(() => { const input = document.querySelector('[data-setting="${name}"]'); input.value = ${value}; input.dispatchEvent(new Event("input")); })()`);
    await ask("carom.stateHash()");
  };
  const found = async () => [await ask("carom.run.description.restitution"), await ask("carom.run.description.drag"), await notice()];
  for (const load of ['carom.scene("break")', `carom.load(${JSON.stringify(twoDisks)})`]) {
    await clear();
    await ask(load);
    await slide("restitution", 0.5);
    await slide("drag", 0.2);
    await slide("restitution", 0.6);
    check(`${load}: both move one after the other`, (await found()).join() === "0.6,0.2,", await found());
    await slide("drag", 0);
    await slide("restitution", 0.7);
    check(`${load}: and without drag`, (await found()).join() === "0.7,0,", await found());
  }
  await ask('carom.scene("hourglass")');
  await slide("restitution", 0.7);
  check("a scene keeps its own time below which collisions are elastic", /elastic_below=\{ time = 1e-2 \}/.test(await ask("carom.changes()")), await ask("carom.changes()"));
  await ask(`carom.load(${JSON.stringify(twoDisks + "[gravity]\nacceleration = [0, -1]\n")})`);
  await ask(`carom.load(${JSON.stringify(twoDisks + "[gravity]\nacceleration = [0.3, -0.5]\n")})`);
  await slide("gravity", 0.6);
  check("gravity to the side stays", (await ask("carom.run.description.gravity")).join() === "0.3,-0.6", await ask("carom.run.description.gravity"));
  check("drag is not offered where it cannot be combined", await ask(`document.querySelector('[data-setting="drag"]') === null`));
});

await test("the way back", async () => {
  for (const [id, isReversible] of [["gas", true], ["piston", true], ["granular", false], ["swimmers", false], ["heat", false]]) {
    await ask(`carom.scene("${id}", { n: 100 })`);
    await ask("carom.runUntil(1)");
    await ask('carom.change("scale_velocities = -1")');
    await ask("carom.runUntil(1.5)");
    await pause(300);
    const words = await ask("document.getElementById('wayBackWords').textContent");
    check(`${id}: chaos is blamed only where the same way leads back`, /same way does not/.test(words) !== isReversible, words);
  }
});

await test("mean free path", async () => {
  const isShown = () => ask("getComputedStyle(document.querySelector('[data-number=path]')).display !== 'none'");
  for (const [id, isThere] of [["gas", true], ["lorentz", false], ["mixing", true]]) {
    await ask(`carom.scene("${id}")`);
    await pause(300);
    check(`${id}: it is shown where no posts end paths`, (await isShown()) === isThere);
  }
});

await test("balls that start nearly alike", async () => {
  for (const id of ["sinai", "stadium"]) {
    const spread = [];
    for (const apart of [-1, -8]) {
      await ask(`carom.scene("${id}", { n: 20, apart: ${apart} })`);
      await ask("carom.runUntil(30)");
      spread.push(await ask("Math.max(...carom.run.x) - Math.min(...carom.run.x)"));
    }
    check(`${id}: they part the later, the nearer they start`, spread[0] > 0.5 && spread[1] < 1e-4, spread);
  }
});

await test("bits", async () => {
  await ask(`carom.scene("box", { n: 100 })`);
  const toml = await ask("carom.run.toml");
  await ask("carom.load(carom.run.toml)");
  await ask("carom.runUntil(1)");
  await ask('carom.set("gravity.acceleration", [0, -1])');
  await ask("carom.runUntil(2.5)");
  await ask('carom.change("scale_velocities = 1.1")');
  await ask('carom.change("remove_disk = 3")');
  await ask("carom.runUntil(3)");
  await ask('carom.set("walls.left", 0).catch(() => 0)');
  await ask('carom.change("set = [\\"walls.left={ temperature = 2 }\\"]")');
  await ask("carom.runUntil(6)");
  const hash = await ask("carom.stateHash()");
  const changes = await ask("carom.changes()");
  check("all changes are listed", (changes.match(/^\[\[changes\]\]/gm) ?? []).length === 4, changes);
  const link = await ask("carom.link()");
  if (carom) {
    const directory = mkdtempSync(join(tmpdir(), "carom-page-test-"));
    writeFileSync(join(directory, "scene.toml"), toml);
    writeFileSync(join(directory, "changes.toml"), changes);
    const run = spawnSync(carom, ["run", "scene.toml", "--set", "run.time=6", "--changes", "changes.toml", "--json"], { cwd: directory, encoding: "utf8" });
    check("carom run --changes ends", run.status === 0, run.stderr);
    if (run.status === 0) check("the hash is that of carom run", JSON.parse(run.stdout).state_hash === hash, `${JSON.parse(run.stdout).state_hash} and ${hash}`);
    rmSync(directory, { recursive: true });
  }
  await browser.open(`${address}?play=0${link.slice(link.indexOf("#"))}`);
  await ask('carom.change("remove_disk = 1000").catch(() => 0)');  // refused: the list goes on
  await ask("carom.runUntil(6)");
  check("a link gives the same run to the last bit", (await ask("carom.stateHash()")) === hash);
  check("and all of its changes", (await ask("carom.changes()")) === changes);
  // In the page that plays: a link whose first change is at time 0.
  await ask(`carom.scene("gas", { n: 20000 }).then(() => carom.change("scale_velocities = 1.5"))`);
  const early = await ask("carom.link()");
  await clear();
  await ask(`carom.scene("gas", { n: 20000 }).then(() => { carom.play(true); location.hash = ${JSON.stringify(early.slice(early.indexOf("#")))}; })`);
  await pause(1500);
  check("a link that is pasted while the page plays keeps its changes", (await ask("carom.run.numbers[22]")) === 1 && !/too late/.test(await notice()), await notice());
  await browser.open(`${address}?play=0${link.slice(link.indexOf("#"))}`);
  await ask("carom.runUntil(6)");
  // Steps back lead to the same bits.
  const there = await ask("carom.state().then((state) => state.pairs)");
  for (let k = 0; k < 3; ++k) await browser.key(",");
  await pause(300);
  check("a step back takes an event back", (await ask("carom.run.numbers[2]")) <= there);
  await ask("carom.runUntil(6)");
  check("and forward again are the same bits", (await ask("carom.stateHash()")) === hash);
});

await test("the command that repeats a run", async () => {
  const own = `${twoDisks}${[1.5, 2.5].map((time) => `[[changes]]\ntime = ${time}\nscale_velocities = 1.5\n`).join("")}`;
  await ask(`carom.load(${JSON.stringify(own)})`);
  check("the page knows both changes of the scene", ((await ask("carom.runUntil(3).then(() => carom.command())")).match(/^\[\[changes\]\]/gm) ?? []).length === 2, await ask("carom.command()"));
  await ask(`carom.load(${JSON.stringify(own)})`);
  const command = await ask("carom.runUntil(2).then(() => carom.command())");
  check("it leaves out those that are to come", /^time = 1.5$/m.test(command) && !/^time = 2.5$/m.test(command), command);
  if (!carom) return;
  const directory = mkdtempSync(join(tmpdir(), "carom-page-test-"));
  const run = spawnSync("sh", ["-c", command.replace("carom run", `'${carom}' run`)], { cwd: directory, encoding: "utf8" });
  check("it runs", run.status === 0 && run.stdout.includes(await ask("carom.stateHash()")), `${run.stdout}${run.stderr}`);
  rmSync(directory, { recursive: true });
});

await test("the program in Python", async () => {
  if (spawnSync("python3", ["--version"]).status !== 0) return;
  const title = String.raw`'''a\"b\\n''''`;  // quotes and backslashes, as TOML writes them
  await ask(`carom.load(${JSON.stringify(`title = "${title}"\n${twoDisks}`)})`);
  await ask('Object.defineProperty(navigator, "clipboard", { configurable: true, value: { writeText: async (text) => { window.copied = text; } } })');
  const copied = async (name) => {
    await ask(`window.copied = ""; document.getElementById("${name}").click()`);
    await pause(300);
    return ask("window.copied");
  };
  const [toml, program] = [await copied("copyToml"), await copied("copyPython")];
  const firstText = "import ast, sys\nprint(next(node.value for node in ast.walk(ast.parse(sys.stdin.read())) if isinstance(node, ast.Constant)), end='')";
  const read = spawnSync("python3", ["-c", firstText], { input: program, encoding: "utf8" });
  check("it holds the scene, whatever its quotes", toml.includes("'''a") && read.stdout === `\n${toml}`, `${read.stderr}${read.stdout}`);
  await ask("delete navigator.clipboard");
});

await test("links", async () => {
  await browser.open(`${address}#run=AAAA.zzz`);
  check("a damaged link is told", /damaged/.test(await notice()), await notice());
  check("and the page runs", (await ask("carom.run.description.disks")) > 0);
  const link = await ask("carom.link()");
  await browser.open(link.slice(0, -20));
  check("a link that was cut is told", /damaged/.test(await notice()), await notice());
});

await test("refusals", async () => {
  await browser.open(`${address}?play=0`);
  await ask(`carom.load(${JSON.stringify(twoDisks)})`);
  check("disks that are listed cannot become more at the start", await ask(`document.querySelector('[data-start="n"]') === null && document.querySelector('[data-start="seed"]') !== null`));
  const refused = (expression) => ask(`${expression}.then(() => "", (error) => error.message)`);
  check("a wrong scene is refused with a sentence", /own:1:1/.test(await refused('carom.load("box = 3")')) || /box/.test(await refused('carom.load("box = 3")')), await refused('carom.load("box = 3")'));
  check("the scene before goes on", (await ask("carom.run.description.disks")) === 2);
  check("too many disks are refused", /more than this page holds/.test(await refused(`carom.load(${JSON.stringify(twoDisks.replace(/positions.*\nvelocities.*/, "count = 200000\npositions = \"square\"\nvelocities = \"rest\"").replace("radius = 0.5", "radius = 0.001"))})`)));
  check("before their places are computed", /more than this page holds/.test(await refused('Promise.race([carom.scene("mixing", { n: 1e7 }), new Promise((resolve) => setTimeout(resolve, 5000))])')));
  check("a wall through a disk is refused", /obstacle/.test(await refused('carom.change("add_obstacle = { segment = { from = [2, 0], to = [2, 10] } }")')));
  check("a disk upon a disk is refused", /overlap/.test(await refused('carom.change("add_disk = { position = [2, 5] }")')));
  check("nonsense is refused", (await refused('carom.change("hello")')) !== "");
  for (const [key, value] of [["eta", 0], ["eta", -1], ["kT", -2], ["n", 0]]) {
    const sentence = await refused(`carom.scene("gas", { ${key}: ${value} })`);
    check(`a start with ${key} = ${value} is refused by its name`, sentence.includes(`(${key}) must be greater than 0, and is ${value}.`), sentence);
  }
  check("an unknown scene is refused", /no scene/.test(await refused('carom.scene("nothing")')));
  await ask("carom.runUntil(2)");
  check("and the run goes on", (await time()) === 2);
});

await test("tools", async () => {
  await ask(`carom.load(${JSON.stringify(twoDisks)})`);
  const tool = (name) => ask(`document.querySelector('[data-tool="${name}"]').click()`);
  const drag = async (from, to = from) => {
    await browser.drag(await pixelOf(...from), await pixelOf(...to));
    await pause(150);
  };
  await tool("throw");
  await drag([5, 8], [6, 8]);
  check("a disk is thrown in", (await ask("carom.run.description.disks")) === 3);
  check("with its velocity", (await ask("carom.run.vx[2]")) > 0 && Math.abs(await ask("carom.run.vy[2]")) < 1e-6);
  await drag([5, 8], [6, 8]);
  check("not upon another", (await ask("carom.run.description.disks")) === 3 && /no room/.test(await notice()), await notice());
  await tool("drag");
  await drag([5, 8], [5, 2]);
  check("a disk is moved", Math.abs((await ask("carom.run.y[2]")) - 2) < 0.2, await ask("carom.run.y[2]"));
  await tool("wall");
  await drag([4, 9], [6, 9]);
  check("a wall is drawn", (await ask("carom.run.description.obstacles.length")) === 1);
  await clear();
  await drag([2, 1], [2, 9]);
  check("a wall through a disk is not, and is told", (await ask("carom.run.description.obstacles.length")) === 1 && /through disk 0/.test(await notice()), await notice());
  await tool("erase");
  await drag([5, 9]);
  check("a wall is taken away", (await ask("carom.run.description.obstacles.length")) === 0);
  await tool("take");
  await drag([5, 2]);
  check("a disk is taken out", (await ask("carom.run.description.disks")) === 2);
  await ask(`carom.load(${JSON.stringify(twoDisks)}).then(() => carom.play(true))`);
  await tool("drag");
  const touch = async (type, ...places) => {
    await browser.send("Input.dispatchTouchEvent", { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
    await pause(100);
  };
  const finger = await pixelOf(...(await ask("[carom.run.x[0], carom.run.y[0]]")));
  await touch("touchStart", finger);
  check("a disk that is held pauses the run", !(await ask("carom.run.isPlaying")));
  await touch("touchStart", finger, [finger[0] + 100, finger[1]]);
  check("and a second finger lets it go on", await ask("carom.run.isPlaying"));
  await touch("touchEnd");
  await ask(`carom.load(${JSON.stringify(twoDisks)})`);
  await tool("hand");
  await drag([8, 5]);
  check("a disk is followed", (await ask("carom.settings.followed")) === 1);
  await tool("take");
  await drag([2, 5]);
  check("and is the same where one before it is taken out", (await ask("carom.settings.followed")) === 0 && (await ask("carom.run.x[0]")) > 5);
  await drag([8, 5]);
  check("and nobody where it is taken out itself", (await ask("carom.settings.followed")) === -1);
});

await test("keys", async () => {
  await ask(`carom.load(${JSON.stringify(twoDisks)})`);
  await browser.key(" ");
  check("Space plays", await ask("carom.run.isPlaying"));
  const rate = () => ask("Number(document.getElementById('rate').value)");
  const first = await rate();
  await ask("document.getElementById('rate').focus()");
  for (let k = 0; k < 3; ++k) await browser.key("ArrowRight");
  check("an arrow key moves the speed by a step", (await rate()) === first + 3, [first, await rate()]);
  await ask("document.getElementById('arrows').focus()");
  await browser.key(" ");
  check("Space pauses whatever has the focus", !(await ask("carom.run.isPlaying")) && !(await ask("carom.settings.arrows")));
  await browser.key(".");
  await pause(200);
  check("a step goes to the next collision", (await ask("carom.run.numbers[2]")) >= 1 || (await time()) > 0);
  await ask(`carom.load(${JSON.stringify(twoDisks)})`);
  await browser.key(".");
  await pause(200);
  check("the first is at 2.5", Math.abs((await time()) - 2.5) < 1e-9, await time());
  await browser.key("r");
  await pause(200);
  check("reversed, its velocities are turned", (await ask("carom.run.vx[0]")) > 0);
  await browser.key("h");
  await pause(200);
  check("hotter is faster", Math.abs(Math.abs(await ask("carom.run.vx[0]")) - 1.1) < 1e-9, await ask("carom.run.vx[0]"));
  await ask('document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "h", repeat: true, bubbles: true }))');
  await pause(200);
  check("a key that is held makes one change", (await ask("carom.run.numbers[22]")) === 2, await ask("carom.run.numbers[22]"));
  for (const [key, disk] of [["[", 1], ["[", 0], ["Escape", -1], ["]", 0]]) {
    await browser.key(key);
    check(`${key} follows disk ${disk}`, (await ask("carom.settings.followed")) === disk, await ask("carom.settings.followed"));
  }
  const shown = () => ask('document.querySelector("[data-number=hash]").textContent');
  check("the hash is that of the faster disks", (await shown()) === (await ask("carom.stateHash()")), await shown());
  await browser.key("Home");
  await pause(300);
  check("and after beginning anew that of the start", (await time()) === 0 && (await shown()) === (await ask("carom.stateHash()")), await shown());
});

await test("legend", async () => {
  await ask('carom.scene("brownian").then(() => carom.change("remove_disk = 5"))');
  const species = await ask("carom.run.description.species.map((one) => one.count)");
  const legend = await ask("[...document.querySelectorAll('#legend .kind')].map((one) => one.textContent)");
  check("the legend counts the disks of now", legend.length > 1 && species.every((count, k) => legend[k].includes(count)), [species, legend]);
});

await test("fast disks", async () => {
  await ask('carom.scene("gas", { n: 300 }).then(() => carom.runUntil(0.1)).then(() => carom.change("scale_velocities = 1e9"))');
  await browser.key(".");
  await pause(200);
  const change = 'carom.change("scale_velocities = 1e-9").then(() => "changed")';
  check("disks that have become fast can be changed", (await ask(`Promise.race([${change}, new Promise((resolve) => setTimeout(resolve, 5000, "waits"))])`)) === "changed");
});

await test("twin", async () => {
  await ask('carom.scene("gas", { n: 200, eta: 0.4 }).then(() => { document.getElementById("twin").click(); carom.play(true); })');
  await pause(isLong ? 5000 : 1500);
  check("the twin runs beside", await ask("carom.run.twin !== null && carom.run.twin.length === 800"));
  check("and its numbers are there", (await ask("carom.run.twinNumbers.collisions")) > 0);
  await ask('carom.play(false)');
  const method = "document.getElementById('twinMethod')";
  await ask(`(() => { ${method}.value = "naive-edge"; ${method}.dispatchEvent(new Event("change")); })()`);
  await pause(200);
  for (let k = 0; k < 5; ++k) {
    await browser.key(".");
    await pause(100);
  }
  check("it goes along by steps", Math.abs((await ask("carom.run.twinNumbers.time")) - (await time())) < 1e-9, [await ask("carom.run.twinNumbers.time"), await time()]);
  for (const language of ["de", "en"]) await ask(`(() => { const list = document.getElementById("language"); list.value = "${language}"; list.dispatchEvent(new Event("change")); })()`);
  check("another language keeps its method", (await ask(`${method}.value`)) === "naive-edge");
  await ask('document.getElementById("twin").click()');
  await pause(300);
  check("it can be switched off", await ask("carom.run.twin === null"));
  await ask('carom.scene("box", { n: 20, eta: 0.01 }).then(() => carom.set("gravity.acceleration", [0, -0.1]))');
  await ask('document.getElementById("twin").click()');
  await pause(200);
  await ask("carom.runUntil(3)");
  await pause(200);
  check("under gravity its energy is compared with the sum", Math.abs(parseFloat(await ask("document.querySelector('[data-number=twinEnergy]').textContent"))) < 5, await ask("[document.querySelector('[data-number=twinEnergy]').textContent, carom.run.twinNumbers]"));
  await ask('carom.scene("shear").then(() => document.getElementById("twin").click())');
  await pause(300);
  check("where fixed steps cannot, a sentence says so", /fixed-step methods know/.test(await notice()), await notice());
});

await test("reset", async () => {
  await ask('carom.scene("gas", { n: 500 })');
  const resets = isLong ? 1000 : 30;
  await ask("(async () => { for (let k = 0; k < 10; ++k) await carom.load(carom.run.toml); })()");
  const before = await ask("carom.memory()");
  await ask(`(async () => { for (let k = 0; k < ${resets}; ++k) await carom.load(carom.run.toml); })()`);
  check(`memory is steady over ${resets} resets`, (await ask("carom.memory()")) === before, `${before} bytes, then ${await ask("carom.memory()")}`);
});

await test("screens", async () => {
  await browser.size(360, 740, { touch: true });
  await browser.open(`${address}?scene=piston&lang=de&draw=canvas`);
  check("nothing is wider than a phone", await ask("document.documentElement.scrollWidth <= innerWidth"), await ask("[document.documentElement.scrollWidth, innerWidth]"));
  check("it draws without WebGL", (await ask("carom.drawing()")) === "canvas");
  check("it speaks German", (await ask("document.documentElement.lang")) === "de" && (await ask("document.getElementById('hotter').textContent")) === "Wärmer");
  await ask('carom.scene("gas")');
  await ask(`(() => { const input = document.querySelector('[data-start="eta"]'); input.max = 7; input.value = 7; input.dispatchEvent(new Event("change")); })()`);
  await pause(300);
  check("what is refused too", /gleiche Scheiben erreichen höchstens 0,9069/.test(await notice()), await notice());
  await ask('Object.defineProperty(navigator, "clipboard", { configurable: true, value: { writeText: async () => {} } })');
  await ask('document.getElementById("shareDialog").showModal(); document.getElementById("copyLink").click()');
  await pause(300);
  check("that a link is copied can be read above the dialog", await ask(`(() => {
    const note = document.getElementById("notice"), { left, top, width, height } = note.getBoundingClientRect();
    note.style.pointerEvents = "auto";
    return note.textContent === "Kopiert." && document.elementFromPoint(left + width / 2, top + height / 2) === note;
  })()`), await notice());
  await ask('document.getElementById("shareDialog").close(); document.getElementById("notice").style.pointerEvents = ""');
  await ask('carom.scene("box", { n: 50, kT: 1.5 }).then(() => carom.runUntil(200))');
  await pause(400);
  const numbers = await ask(`[...document.querySelectorAll("#liveSettings output, #startSettings output, [data-number=kT], [data-number=walls], #rateText")].map((one) => one.textContent).join(" ")`);
  check("numbers have a comma in German", /\d,\d/.test(numbers) && /\d,\d+ ± 0,\d/.test(numbers) && !/\d\.\d/.test(numbers), numbers);
  for (const id of ["heat", "couette", "compression", "vibrated", "granular", "piston"]) {
    await ask(`carom.scene("${id}")`);
    await pause(200);
    const why = await ask('document.getElementById("noZ").textContent');
    check(`${id}: why there is no equation of state is said in German`, !/\b(walls|the|and|energy)\b/.test(why), why);
  }
  check("every button has a name", await ask("[...document.querySelectorAll('button')].every((one) => one.textContent.trim() !== '' || one.getAttribute('aria-label'))"));
  check("every field has a name", await ask("[...document.querySelectorAll('input, select')].every((one) => one.closest('label') || one.getAttribute('aria-label') || document.querySelector(`label[for=\"${one.id}\"]`))"));
  await browser.size(1280, 800);
  await browser.media({ still: true, scheme: "dark" });
  await browser.open(`${address}?draw=webgl&embed&scene=heat&n=80`);
  check("it draws with WebGL", (await ask("carom.drawing()")) === "WebGL");
  check("with less motion it waits", !(await ask("carom.run.isPlaying")));
  check("it is dark", (await ask("document.documentElement.dataset.theme")) === "dark");
  check("embedded, it shows the disks alone", await ask("getComputedStyle(document.querySelector('aside')).display === 'none'"));
  check("the address gives the start", (await ask("carom.run.description.disks")) === 80);
  await browser.open(`${address}?scene=crystal&rate=2&growth=0.1`);
  check("the growth of the disks and the speed of time have addresses of their own", (await ask("[carom.run.rate, carom.run.description.growth]")).join() === "2,0.1", await ask("[carom.run.rate, carom.run.description.growth]"));
});

// In a triangular lattice every disk has six neighbours, and ψ6 is 1.
await test("colours", async () => {
  const lattice = `[box]\nx = [0, 6]\ny = [0, ${3 * Math.sqrt(3)}]\nboundary = "periodic"\n[[disks]]\ncount = 36\nradius = 0.4\nmass = 1
positions = "hexagonal"\nvelocities = "rest"\n[collision]\nrule = "specular"\n[run]\ntime = 1\n`;
  for (const scheme of ["light", "dark"]) {
    await browser.media({ still: true, scheme });
    await browser.open(`${address}?draw=canvas&play=0`);
    const choose = (colour) =>
      ask(`(() => { const list = document.getElementById("colour"); list.value = "${colour}"; list.dispatchEvent(new Event("change")); return [...document.querySelectorAll("#legend .kind, #legend b")].map((one) => one.textContent); })()`);
    /// The colours of pixels well inside of disks.
    const inside = async () => {
      await pause(200);
      return ask(`(() => {
        const stage = document.getElementById("stage"), [l, b] = carom.run.description.lower, [u, t] = carom.run.description.upper;
        const s = 0.9 * Math.min(stage.width / (u - l), stage.height / (t - b));
        const copy = new OffscreenCanvas(stage.width, stage.height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(stage, 0, 0);
        const pixel = (i) => [...copy.getImageData(stage.width / 2 + (carom.run.x[i] - (l + u) / 2) * s, stage.height / 2 - (carom.run.y[i] - (b + t) / 2) * s, 1, 1).data.slice(0, 3)];
        return [...new Set(Array.from(carom.run.x, (_, i) => pixel(i).map((part) => part.toString(16).padStart(2, "0")).join("")))];
      })()`);
    };
    await ask(`carom.load(${JSON.stringify(lattice)})`);
    const kinds = await choose("neighbours");
    check("the legend names the numbers of neighbours", kinds.join() === "≤ 4,5,6,7,≥ 8 neighbours", kinds);
    const six = await inside();
    check(`in a ${scheme} crystal all have six`, six.join() === (scheme === "dark" ? "39424e" : "d5dae0"), six);
    await choose("psi6");
    const most = await inside();
    check("and the colour of full order", most.join() === "fde725", most);
    const ends = await choose("psi6_angle");
    check("axes go from -30 to 30 degrees", ends.join() === "−30°,30°", ends);
    check("and are all the same, to rounding between two colours", (await inside()).length <= 2, await inside());
    await ask(`carom.load(${JSON.stringify(twoDisks)})`);
    await choose("neighbours");
    const cut = await inside();
    check("disks without a cell of their own have no number", cut.length === 1 && !["39424e", "d5dae0", "e69f00"].includes(cut[0]), cut);
  }
});

await test("component", async () => {
  // The package as a server gives it to a page: browsers take no modules from files.
  const own = `<!doctype html><title>boxes</title><script type="module" src="carom-box.js"></script>
<carom-box id="named" scene="heat" n="60" seed="3" height="12rem" play="0"></carom-box>
<carom-box id="text" play="0">${twoDisks}</carom-box>
<carom-box id="wrong" play="0">box = 3</carom-box>
<carom-box id="lost" page="nowhere.html"></carom-box>
<script type="module">
  window.carom = (id) => document.getElementById(id).ready;
  await Promise.allSettled([...document.querySelectorAll("carom-box")].map((box) => box.ready));
  document.documentElement.dataset.ready = "";
</script>`;
  const server = createServer((request, response) => {
    const name = basename(new URL(request.url, "http://here").pathname);
    response.setHeader("content-type", name.endsWith(".js") ? "text/javascript" : "text/html");
    if (name === "") response.end(own);
    else if (["carom-box.js", "playground.html"].includes(name)) response.end(readFileSync(join(dirname(page), "npm", name)));
    else response.end("");
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  await browser.open(`http://127.0.0.1:${server.address().port}/`);
  check("a box shows its scene, with the numbers of its attributes", await ask('carom("named").then((carom) => carom.run.scene.id === "heat" && carom.run.description.disks === 60 && carom.run.start.seed === 3)'));
  check("as high as it is told", (await ask('document.getElementById("named").getBoundingClientRect().height')) === 192);
  check("a box runs the text inside it", await ask('carom("text").then(async (carom) => (await carom.runUntil(2), carom.run.description.disks === 2 && carom.run.numbers[0] === 2))'));
  check("wrong text is refused with a sentence", /own:1/.test(await ask('carom("wrong").catch((error) => error.message)')), await ask('carom("wrong").catch((error) => error.message)'));
  check("a page that is not there is told", /nowhere.html.* is not/.test(await ask('carom("lost").then(() => "", (error) => error.message)')));
  await ask('document.getElementById("named").setAttribute("scene", "piston")');
  check("another attribute is another scene", (await ask('carom("named").then((carom) => carom.run.scene.id)')) === "piston");
  await ask('document.body.prepend(document.getElementById("text"))');
  check("a box that is moved in its page is ready again", (await ask('carom("text").then((carom) => carom.run.description.disks)')) === 2);
  const { name, types, files } = JSON.parse(readFileSync(join(dirname(page), "npm", "package.json")));
  check("the package has the files that it names", name !== "" && [types, ...files].every((file) => statSync(join(dirname(page), "npm", file)).size > 0));
  server.close();
});

await browser.close();
console.log(`${checks - failures} of ${checks} checks hold`);
process.exit(failures > 0 ? 1 : 0);
