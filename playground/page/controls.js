// Sliders, buttons and lists: those of the scene before it starts, those that change the run, and those of the page.
"use strict";

/// A slider with its number; `logarithmic` ones move by ratios. Calls `onInput` while it moves and `onChange` when it has come to rest.
function slider(place, { label, unit = "", least, most, step, logarithmic = false, value, zero = null, onInput = null, onChange = null }) {
  const row = document.createElement("label");
  row.className = "setting";
  const name = document.createElement("span");
  name.textContent = label;
  const shown = document.createElement("output");
  const input = document.createElement("input");
  input.type = "range";
  const steps = 200;
  const toPosition = (v) => (logarithmic ? (steps * Math.log(Math.max(v, least) / least)) / Math.log(most / least) : v);
  const toValue = (position) => {
    if (!logarithmic) return Number(Number(position).toPrecision(10));
    const v = least * (most / least) ** (position / steps);
    return step >= 1 ? Math.round(v) : Number(v.toPrecision(2));
  };
  Object.assign(input, logarithmic ? { min: 0, max: steps, step: 1 } : { min: least, max: most, step });
  const show = (v) => {
    shown.textContent = v === 0 && zero ? zero : `${short(v, 4)}`;
    const text = document.createElement("small");
    text.textContent = v === 0 && zero ? "" : ` ${unitText(unit)}`;
    shown.append(text);
    input.setAttribute("aria-valuetext", shown.textContent);
  };
  input.value = toPosition(value);
  show(value);
  input.addEventListener("input", () => {
    show(toValue(input.value));
    onInput?.(toValue(input.value));
  });
  input.addEventListener("change", () => onChange?.(toValue(input.value)));
  row.append(name, shown, input);
  place.append(row);
  return { input, set: (v) => {
    if (document.activeElement === input && document.activeElement.matches(":active")) return;
    input.value = toPosition(v);
    show(v);
  } };
}

const unitText = (unit) => (unit ? t(`unit.${unit}`) : "");

let shownSettings = [];

/// Runs the latest change of a slider at once, and leaves out those that came while the one before was on its way.
function lazily(work) {
  let isBusy = false;
  let waiting;
  return async (value) => {
    waiting = value;
    if (isBusy) return;
    isBusy = true;
    while (waiting !== undefined) {
      const next = waiting;
      waiting = undefined;
      await work(next);
    }
    isBusy = false;
  };
}

function fillLiveSettings() {
  const place = byId("liveSettings");
  place.replaceChildren();
  shownSettings = [];
  const names = run.scene.live ?? settingsOf(run.description);
  for (const name of names) {
    if (name === "demon") {
      addChoice(place, t("setting.demon"), ["sort", "valve", "open", "closed"].map((rule) => [rule, t(`demon.${rule}`)]), demon.rule, (rule) => (demon.rule = rule));
      continue;
    }
    const setting = liveSettings[name];
    if (setting.choices) {
      const list = addChoice(place, t(`setting.${name}`), setting.choices.map((choice) => [choice, t(`${name}.${choice}`)]), setting.value(run.description), async (choice) => (await changeRun(setting.change(choice, run.description))) || showLiveSettings());
      shownSettings.push({ setting, set: (v) => (list.value = v) });
      continue;
    }
    // Where the engine refuses, the slider goes back to what is so; at once, or when it is let go.
    let isRefused = false;
    const change = lazily(async (v) => {
      isRefused = false;
      isRefused = !(await changeRun(setting.change(v, run.description)));
      if (isRefused) showLiveSettings();
    });
    const letGo = () => setTimeout(() => isRefused && showLiveSettings());
    const made = slider(place, { ...setting, label: t(`setting.${name}`), zero: setting.zero ? t(setting.zero) : null, value: setting.value(run.description), onInput: change, onChange: letGo });
    made.input.dataset.setting = name;
    shownSettings.push({ setting, set: made.set });
  }
  byId("heatRow").hidden = disks === 0;
  byId("liveSection").hidden = false;
  const door = byId("door");
  door.hidden = !run.scene.door;
  byId("doorRow").hidden = !run.scene.door;
}

function addChoice(place, label, choices, value, onChange) {
  const row = document.createElement("label");
  row.className = "setting choice";
  const name = document.createElement("span");
  name.textContent = label;
  const list = document.createElement("select");
  for (const [key, text] of choices) list.add(new Option(text, key));
  list.value = value;
  list.addEventListener("change", () => onChange(list.value));
  row.append(name, list);
  place.append(row);
  return list;
}

function showLiveSettings() {
  for (const { setting, set } of shownSettings) set(setting.value(run.description));
  const door = byId("door");
  const isThere = run.scene?.door && run.description.obstacles.some((one) => one.from && one.from[0] === doorOf()?.from[0] && one.to[1] === doorOf()?.to[1]);
  door.textContent = t(isThere ? "door.open" : "door.close");
}

/// The partition of the scene's start.
let doorAtStart = null;
const doorOf = () => doorAtStart;

async function turnDoor() {
  const index = run.description.obstacles.findIndex((one) => one.from && one.from[0] === doorAtStart.from[0] && one.to[1] === doorAtStart.to[1]);
  if (index >= 0) await changeRun(`remove_obstacle = ${index}`);
  else await changeRun(`add_obstacle = ${segmentText(doorAtStart.from, doorAtStart.to)}`);
}

/// The sliders of the start: a change begins the scene anew.
function fillStartSettings() {
  const place = byId("startSettings");
  place.replaceChildren();
  const own = run.scene.start ?? ownStart();
  byId("startSection").hidden = own.length === 0;
  for (const { key, least, most, step, logarithmic = false, override } of own) {
    const value = override ? override.value() : run.start[key];
    const begin = async (v) => {
      const start = { ...run.start, [key]: v };
      try {
        await rest();
        if (override) await loadText(run.scene, run.toml, { overrides: [...run.overrides.filter((one) => !one.startsWith(`${override.key}=`)), `${override.key}=${v}`], start });
        else await loadScene(run.scene, start);
      } catch (error) {
        notify(error.message);
        fillStartSettings();
      }
    };
    slider(place, { label: t(`start.${key}`), unit: startUnits[key] ?? "", least, most, step, logarithmic, value, onChange: begin }).input.dataset.start = key;
  }
}
const startUnits = { kT: "energy", hole: "length", grain: "length", speed: "length / time", aim: "length", growth: "1 / time", post: "length" };

/// What the start of a scene from elsewhere lets one choose: the number of disks where they are not listed, and the seed.
function ownStart() {
  const text = run.toml;
  const list = [{ key: "seed", least: 1, most: 100, step: 1, override: { key: "run.seed", value: () => run.description.seed } }];
  if (run.description.species.length === 1 && /^\s*count\s*=/m.test(text) && /^\s*positions\s*=\s*"/m.test(text))
    list.unshift({ key: "n", least: 2, most: Math.max(4000, disks), step: 1, logarithmic: true, override: { key: "disks.0.count", value: () => disks } });
  return list;
}

const mostDisks = 100_000;  // as in engine/playground.cpp

/// Loads a scene of the list with the numbers of its start, those not given being the usual ones.
async function loadScene(scene, start = {}) {
  if (scene.toml) return loadText(scene, scene.toml);
  const all = { seed: 1 };
  for (const { key, usual } of scene.start) all[key] = usual;
  for (const [key, value] of Object.entries(start)) if (Number.isFinite(value)) all[key] = value;
  for (const { key, least } of scene.start)
    if (least > 0 && !(all[key] > 0)) throw new Error(t("startNotPositive", { name: t(`start.${key}`), key, value: all[key] }));
  if ("n" in all) all.n = Math.max(1, Math.round(all.n));
  if (all.n > mostDisks) throw new Error(t("tooManyDisks", { count: grouped(all.n), most: grouped(mostDisks) }));
  const toml = scene.make(all);
  await loadText(scene, toml, { start: all });
}

onLoad.push(() => {
  doorAtStart = run.scene.door ? run.description.obstacles[0] : null;
  settings.colour = run.scene.colour ?? (run.description.species.length > 1 ? "species" : "speed");
  settings.history = run.scene.history ?? "temperature";
  byId("scene").value = run.scene.id;
  byId("colour").value = settings.colour;
  byId("historyKind").value = settings.history;
  byId("sceneWords").textContent = texts.en[`scene.${run.scene.id}.words`] ? t(`scene.${run.scene.id}.words`) : run.description.title;
  fillStartSettings();
  fillLiveSettings();
  showLegend();
  layOut(false);
  byId("twin").checked = false;
  showTwinChoices();
  showRate();
  showLiveSettings();
});
onDescription.push(() => {
  if (!run.scene) return;
  showLiveSettings();
  showLegend();
});

function sceneTitle(scene) {
  return texts.en[`scene.${scene.id}`] ? t(`scene.${scene.id}`) : scene.title;
}

function fillScenes() {
  const list = byId("scene");
  list.replaceChildren();
  const groups = new Map();
  for (const scene of scenes) {
    if (!groups.has(scene.group)) {
      const group = document.createElement("optgroup");
      group.label = t(`group.${scene.group}`);
      groups.set(scene.group, group);
      list.append(group);
    }
    groups.get(scene.group).append(new Option(sceneTitle(scene), scene.id));
  }
  if (run.scene) list.value = run.scene.id;
}

function fillLists() {
  fillScenes();
  const fillList = (name, entries, value) => {
    const list = byId(name);
    list.replaceChildren(...entries.map(([key, text]) => new Option(text, key)));
    list.value = value;
  };
  fillList("colour", Object.keys(colourings).map((key) => [key, t(`colour.${key}`)]), settings.colour);
  fillList("palette", ["viridis", "cividis", "plasma", "blues"].map((key) => [key, t(`palette.${key}`)]), settings.palette);
  fillList("theme", ["auto", "light", "dark"].map((key) => [key, t(`theme.${key}`)]), settings.theme);
  fillList("language", languages.map((key) => [key, texts[key]["language"]]), language);
  fillList("historyKind", Object.keys(histories).map((key) => [key, t(`history.${key}`)]), settings.history);
  fillList("twinMethod", ["naive-edge", "guarded", "soft"].map((key) => [key, t(`twin.${key}`)]), byId("twinMethod").value || "guarded");
}

// The speed of time: twenty steps of the slider per decade round the usual rate; keys go by 1, 2, 5.
const rateOf = (position) => usualRate() * 10 ** (position / 20);
function showRate() {
  byId("rate").value = Math.round(20 * Math.log10(run.rate / usualRate()));
  byId("rateText").textContent = t("rate", { rate: short(run.rate, 2) });
  byId("rate").setAttribute("aria-valuetext", byId("rateText").textContent);
}
function setRate(rate) {
  const round = Number(rate.toPrecision(2));  // moves the slider by less than half a step
  run.rate = Math.min(Math.max(round, usualRate() * 1e-3), usualRate() * 1e3);
  showRate();
}
function changeRate(up) {
  const power = 10 ** Math.floor(Math.log10(run.rate) + 1e-9);
  const lead = Math.round(run.rate / power);
  setRate(up ? (lead < 2 ? 2 : lead < 5 ? 5 : 10) * power : (lead > 5 ? 5 : lead > 2 ? 2 : lead > 1 ? 1 : 0.5) * power);
}

function showPlaying() {
  const button = byId("play");
  button.querySelector("use").setAttribute("href", run.isPlaying ? "#icon-pause" : "#icon-play");
  button.title = t(run.isPlaying ? "pause" : "play");
  button.setAttribute("aria-label", button.title);
  button.setAttribute("aria-pressed", run.isPlaying);
}

function showLegend() {
  const legend = byId("legend");
  const colouring = colourings[settings.colour];
  legend.replaceChildren();
  if (colouring.kinds) {
    for (const { name, colour } of colouring.kinds().filter((kind) => kind.name !== "").slice(0, 6)) {
      const item = document.createElement("span");
      item.className = "kind";
      item.style.setProperty("--swatch", colour);
      item.textContent = name;
      legend.append(item);
    }
    return;
  }
  const ends = colouring.ends?.() ?? ["←", "→"];
  const bar = document.createElement("i");
  bar.style.background = `linear-gradient(to right, ${coloursOf(colouring).join(",")})`;
  const [low, high] = ends.map((end) => Object.assign(document.createElement("b"), { textContent: end }));
  const unit = Object.assign(document.createElement("small"), { textContent: unitText(colouring.unit ?? "") });
  legend.append(Object.assign(document.createElement("em"), { textContent: t(`colour.${settings.colour}`) }), low, bar, high, unit);
}

// The twin.
function showTwinChoices() {
  byId("twinChoices").hidden = !byId("twin").checked;
}
/// dt is given in the time in which a disk of usual speed moves by its radius.
const twinStep = () => (10 ** Number(byId("twinStep").value) * (run.radius[0] ?? 0.5)) / run.speedScale;
async function startTwin() {
  const isOn = byId("twin").checked;
  showTwinChoices();
  byId("twinStepText").textContent = `dt = ${short(twinStep(), 2)}`;
  try {
    take(await run.engine.ask("twin", { method: isOn ? byId("twinMethod").value : "", dt: twinStep() }));
  } catch (error) {
    byId("twin").checked = false;
    showTwinChoices();
    notify(error.message);
    await run.engine.ask("twin", { method: "", dt: 1 }).then(take);
  }
  layOut(run.twin !== null);
}
/// The twin begins anew from where the run is when disks or effects have changed; stepBack() does so too.
let twinOf = null;
onDescription.push((d) => {
  const key = `${d.changes}`;
  if (run.twin && twinOf !== null && twinOf !== key) queueMicrotask(startTwin);
  twinOf = key;
});
