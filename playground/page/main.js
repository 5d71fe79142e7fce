// Starts the page: the engine, the scene that the address asks for, and one picture after the other.
//
// For scripts: window.carom answers with promises; data-errors of the document lists errors.
"use strict";

/// The reader's clock of the panel: numbers change a few times a second, so that they can be read.
let toldAt = 0;
let checkedAt = 0;

function showLater() {
  toldAt = 0;
  run.isStale = true;
}

let framesShown = 0;
function animate(now) {
  requestAnimationFrame(animate);
  goOn(now);
  if (!run.description) return;
  if (run.isStale) {
    run.isStale = false;
    draw();
    ++framesShown;
  }
  if (now - toldAt > (run.isPlaying ? 180 : 60)) {
    const isNew = toldOf !== run.numbers || toldMeasured !== run.measured || toldAt === 0;
    toldAt = now;
    if (!isNew) return;
    toldOf = run.numbers;
    toldMeasured = run.measured;
    showNumbers();
    drawSpeeds();
    drawHistory();
    drawWayBack();
    if (colourings[settings.colour].ends) document.querySelectorAll("#legend b").forEach((place, end) => (place.textContent = colourings[settings.colour].ends()[end]));
    if (run.isPlaying) put("hash", "…");
  }
  if (now - checkedAt > 3000) {
    checkedAt = now;
    checkNow();
  }
}
let toldOf = null;
let toldMeasured = null;

function fillQuestions() {
  const place = byId("questionList");
  place.replaceChildren();
  for (let k = 1; k <= 6; ++k) {
    const item = document.createElement("article");
    const [title, words, answer] = ["h3", "p", "p"].map((tag) => document.createElement(tag));
    title.textContent = `${k}. ${t(`question.${k}`)}`;
    words.textContent = t(`question.${k}.do`);
    answer.textContent = t(`question.${k}.answer`);
    const more = document.createElement("details");
    more.append(Object.assign(document.createElement("summary"), { textContent: t("answer") }), answer);
    const go = Object.assign(document.createElement("button"), { textContent: t("tryIt") });
    go.addEventListener("click", async () => {
      byId("questions").close();
      const { scene, start, history } = questionScenes[k - 1];
      await choose(scene, start);
      if (history) byId("historyKind").value = settings.history = history;
      play(true);
    });
    item.append(title, words, go, more);
    place.append(item);
  }
}
const questionScenes = [
  { scene: "box", start: { n: 300, eta: 0.2 }, history: "pressure" },
  { scene: "hotcold", start: {}, history: "sides" },
  { scene: "piston", start: {}, history: "piston" },
  { scene: "brownian", start: {} },
  { scene: "gas", start: { n: 200, eta: 0.3 } },
  { scene: "demon", start: {}, history: "sides" },
];

async function choose(id, start = {}) {
  const scene = scenes.find((one) => one.id === id);
  if (!scene) return notify(t("noScene", { scene: id }));
  try {
    await rest();
    await loadScene(scene, start);
  } catch (error) {
    notify(error.message);
  }
}

function translateAll() {
  translatePage();
  fillLists();
  fillQuestions();
  for (const key of Object.keys(saying)) delete saying[key];
  if (run.description) {
    fillStartSettings();
    fillLiveSettings();
    showLegend();
    showRate();
    showLiveSettings();
    byId("sceneWords").textContent = texts.en[`scene.${run.scene.id}.words`] ? t(`scene.${run.scene.id}.words`) : run.description.title;
    showLater();
    toldMeasured = null;
    if (!run.isPlaying) showHash();
  }
  showPlaying();
  document.title = t("title");
}

async function reverse() {
  if (run.description) await changeRun("scale_velocities = -1");
}
const heat = (factor) => changeRun(`scale_velocities = ${factor}`);

function toggleFull() {
  if (document.fullscreenElement) document.exitFullscreen();
  else document.documentElement.requestFullscreen?.().catch(() => notify(t("noFullScreen")));
}

function connect() {
  const click = (name, work) => byId(name).addEventListener("click", work);
  click("play", () => play());
  click("next", stepOn);
  click("previous", stepBack);
  click("again", again);
  click("reverse", reverse);
  click("hotter", () => heat(1.1));
  click("colder", () => heat(0.9));
  click("door", turnDoor);
  click("zoomIn", () => zoom(1.25));
  click("zoomOut", () => zoom(0.8));
  click("fit", () => (fitView(), (run.isStale = true)));
  click("full", toggleFull);
  click("measureAnew", () => act("measureAnew"));
  click("askQuestions", () => byId("questions").showModal());
  click("help", () => byId("keysDialog").showModal());
  click("share", () => byId("shareDialog").showModal());
  click("copyLink", async () => {
    const link = await linkOfRun();
    if (link.length > 30000) notify(t("longLink", { count: grouped(link.length) }));
    await copy(link);
  });
  click("copyToml", async () => copy(await sceneText()));
  click("copyChanges", async () => copy((await run.engine.ask("changes")).toml || t("noChanges")));
  click("copyCommand", async () => copy(await commandText()));
  click("copyPython", async () => copy(await pythonText()));
  for (const dialog of document.querySelectorAll("dialog")) dialog.querySelector(".close").addEventListener("click", () => dialog.close());
  for (const button of document.querySelectorAll("[data-tool]")) button.addEventListener("click", () => chooseTool(button.dataset.tool));
  byId("scene").addEventListener("change", async (event) => {
    const wasPlaying = run.isPlaying;
    await choose(event.target.value);
    play(wasPlaying);
  });
  byId("rate").addEventListener("input", (event) => setRate(rateOf(Number(event.target.value))));
  const onChoice = (name, work) => byId(name).addEventListener("change", (event) => work(event.target.value));
  onChoice("colour", (value) => ((settings.colour = value), showLegend(), (run.isStale = true)));
  onChoice("palette", (value) => ((settings.palette = value), showLegend(), (run.isStale = true)));
  onChoice("theme", (value) => ((settings.theme = value), applyTheme(), showLegend(), showLater(), (toldMeasured = null)));
  onChoice("language", (value) => ((language = value), translateAll()));
  onChoice("historyKind", (value) => ((settings.history = value), showLater(), (toldMeasured = null)));
  byId("arrows").addEventListener("click", () => {
    settings.arrows = !settings.arrows;
    byId("arrows").setAttribute("aria-pressed", settings.arrows);
    run.isStale = true;
  });
  byId("twin").addEventListener("change", startTwin);
  byId("twinMethod").addEventListener("change", startTwin);
  byId("twinStep").addEventListener("input", lazily(startTwin));
  darkScreen.addEventListener("change", () => (applyTheme(), run.description && showLegend()));
  new ResizeObserver(() => {
    layOut(run.twin !== null);
    run.isStale = true;
    draw();
  }).observe(stage);
}

const keys = {
  " ": () => play(), ".": stepOn, ",": stepBack, r: reverse, Home: again, h: () => heat(1.1), c: () => heat(0.9), ArrowUp: () => changeRate(true), ArrowDown: () => changeRate(false),
  "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: () => (fitView(), (run.isStale = true)), f: toggleFull, v: () => byId("arrows").click(), s: () => byId("share").click(),
  "?": () => byId("help").click(), o: () => !byId("door").hidden && turnDoor(), 1: () => chooseTool("hand"), 2: () => chooseTool("throw"), 3: () => chooseTool("take"), 4: () => chooseTool("drag"),
  5: () => chooseTool("wall"), 6: () => chooseTool("erase"), d: () => ((byId("theme").value = theme.isDark ? "light" : "dark"), byId("theme").dispatchEvent(new Event("change"))),
  Escape: () => follow(-1), "[": () => disks > 0 && follow((Math.max(settings.followed, 0) + disks - 1) % disks), "]": () => disks > 0 && follow((settings.followed + 1) % disks),
};

function connectKeyboard() {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const { target } = event;
    if (target.matches("textarea, select, input[type=number]")) return;
    if (target.matches("input[type=range]") && event.key.startsWith("Arrow")) return;
    if (target.matches("input[type=range]") && event.key === "Home") return;
    const work = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!work || !run.description) return;
    if (event.repeat && [reverse, keys.h, keys.c].includes(work)) return;  // a key that is held would make one change after the other
    event.preventDefault();  // Space plays whatever button has the focus
    work();
  });
  document.addEventListener("keyup", (event) => event.key === " " && event.target.matches("button, input[type=checkbox]") && event.preventDefault());
}

/// What a script can do. Times, lengths and energies are in the units of the scene.
window.carom = {
  /// Loads a scene from TOML text; resolves with its description.
  async load(toml, { overrides = [], changes = "" } = {}) {
    play(false);
    await rest();
    await loadText({ id: "own", title: "", live: null }, toml, { overrides, changes });
    return run.description;
  },
  /// Loads one of the page's scenes: carom.scene("gas", { n: 100 }).
  async scene(id, start = {}) {
    const scene = scenes.find((one) => one.id === id);
    if (!scene) throw new Error(t("noScene", { scene: id }));
    play(false);
    await rest();
    await loadScene(scene, start);
    return run.description;
  },
  /// Runs to a time, and resolves there. Rejects where the run cannot go on.
  async runUntil(time) {
    play(false);
    await rest();
    take(await run.engine.ask("until", { time }));
    keepHistory();
    return run.numbers[at.time];
  },
  /// Sets a key of the scene now: carom.set("gravity.acceleration", [0, -1]).
  async set(key, value) {
    return window.carom.change(`set = [${JSON.stringify(`${key}=${typeof value === "string" ? JSON.stringify(value) : JSON.stringify(value)}`)}]`);
  },
  /// Makes a change now, written as in a file of changes: carom.change("remove_disk = 3").
  async change(body) {
    take(await run.engine.ask("apply", { body }));
    followOn(body);
    return run.description;
  },
  /// Resolves with the hash of the state of now, which carom run prints at the same time.
  async stateHash() {
    return (await run.engine.ask("hash")).hash;
  },
  /// Resolves with the time, positions, velocities, radii and masses of now.
  async state() {
    take(await run.engine.ask("look"));
    const { x, y, vx, vy, radius, mass } = run;
    return { time: run.numbers[at.time], pairs: run.numbers[at.pairs], x: x.slice(), y: y.slice(), vx: vx.slice(), vy: vy.slice(), radius: radius.slice(), mass: mass.slice() };
  },
  /// Resolves with the list of changes so far, as TOML.
  changes: async () => (await run.engine.ask("changes")).toml,
  link: () => linkOfRun(),
  command: () => commandText(),
  play: (isPlaying = true) => play(isPlaying),
  memory: async () => (await run.engine.ask("memory")).bytes,
  run,
  settings,
  get frames() {
    return framesShown;
  },
  drawing: () => drawer.name,
  scenes: () => scenes.map((scene) => scene.id),
  ready: null,
};

async function begin() {
  chooseLanguage(parameters.get("lang"));
  settings.theme = ["light", "dark"].includes(parameters.get("theme")) ? parameters.get("theme") : "auto";
  applyTheme();
  drawer = disksDrawer();
  const own = JSON.parse(byId("ownScenes").textContent);
  for (const [k, { title, toml }] of own.entries()) scenes.push({ id: `own${k}`, group: "own", title, toml, live: null });
  translateAll();
  connect();
  connectKeyboard();
  connectPointer();
  chooseTool("hand");
  layOut(false);
  requestAnimationFrame(animate);
  const wasm = await inflated(byId("wasm").textContent);
  run.engine = await Engine.start(byId("worker").textContent, wasm);
  byId("wasm").remove();
  let isOpened = false;
  try {
    isOpened = await openLink();
  } catch (error) {
    notify(error.message);
  }
  if (!isOpened) {
    const start = Object.fromEntries([...parameters].filter(([, value]) => value !== "" && Number.isFinite(Number(value))).map(([key, value]) => [key, Number(value)]));
    const asked = parameters.get("scene") ?? (own.length > 0 ? "own0" : "gas");
    await choose(asked, start);
    if (!run.description) await choose("gas");
  }
  if (parameters.has("rate") && Number(parameters.get("rate")) > 0) setRate(Number(parameters.get("rate")));
  for (const name of ["colour", "palette", "history"]) {
    const value = parameters.get(name);
    if (value && [...byId(name === "history" ? "historyKind" : name).options].some((option) => option.value === value)) {
      byId(name === "history" ? "historyKind" : name).value = settings[name] = value;
      showLegend();
    }
  }
  // Somebody who asked for less motion starts it himself.
  const asked = parameters.get("play");
  play(asked === "1" || (asked !== "0" && !stillScreen.matches));
  if (!run.isPlaying) showHash();
  window.addEventListener("hashchange", async () => {
    try {
      await rest();
      await openLink();
    } catch (error) {
      notify(error.message);
    }
  });
  document.documentElement.dataset.ready = "";
}

if (parameters.has("embed")) document.documentElement.dataset.embedded = "";
window.carom.ready = begin();
