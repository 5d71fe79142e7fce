// Links that hold a run: the scene's text, what was set before the start, and all changes, compressed into the part of the address behind
// the #. Whoever opens one gets the same run to the last bit.
"use strict";

async function piped(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

/// Returns the text of the address: Base64 for addresses of the compressed JSON.
async function packed(value) {
  const bytes = await piped(new TextEncoder().encode(JSON.stringify(value)), new CompressionStream("deflate-raw"));
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/// The inverse of packed(). Throws where the text is damaged.
async function unpacked(text) {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = await piped(Uint8Array.from(binary, (c) => c.charCodeAt(0)), new DecompressionStream("deflate-raw"));
  const value = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  const isText = (one) => typeof one === "string";
  if (!isText(value.toml) || !isText(value.changes) || !isText(value.id) || !Array.isArray(value.overrides) || !value.overrides.every(isText)) throw new Error("damaged");
  return value;
}

/// Returns the address of the run of now. The text ends with a sum of its letters, so that a letter that is lost is found.
async function linkOfRun() {
  const { toml: changes } = await run.engine.ask("changes");
  const text = await packed({ v: 1, id: run.scene.id, start: run.start, toml: run.toml, overrides: run.overrides, changes, time: run.numbers[at.time] });
  return `${location.href.split("#")[0]}#run=${text}.${sumOf(text)}`;
}

/// FNV-1a of 32 bits.
function sumOf(text) {
  let sum = 0x811c9dc5;
  for (let k = 0; k < text.length; ++k) sum = Math.imul(sum ^ text.charCodeAt(k), 0x01000193);
  return (sum >>> 0).toString(36);
}

/// Loads what the address holds; returns whether it holds a run. Throws a sentence where that is damaged.
async function openLink() {
  if (!location.hash.startsWith("#run=")) return false;
  const [text, sum] = location.hash.slice(5).split(".");
  let value;
  try {
    if (sum !== sumOf(text)) throw new Error("damaged");
    value = await unpacked(text);
  } catch {
    throw new Error(t("damagedLink"));
  }
  const known = scenes.find((scene) => scene.id === value.id) ?? { id: value.id, title: value.id, live: null };
  await loadText(known, value.toml, { overrides: value.overrides, changes: value.changes, start: value.start ?? {} });
  const count = (value.changes.match(/^\[\[changes\]\]/gm) ?? []).length;
  notify(t(count > 0 ? "linkWithChanges" : "linkOpened", { count }), true);
  return true;
}

/// The scene of the start with all that was set, as TOML.
const sceneText = async () => (await run.engine.ask("scene")).toml;

/// A scene's text without those of its own changes that come later than now: a run must not end before its last one.
const withChangesSoFar = (toml) =>
  toml.split(/^(?=\[)/m).filter((table) => !(table.startsWith("[[changes]]") && Number(table.match(/^time = (.*)$/m)[1]) > run.numbers[at.time])).join("");

/// The commands by which the program repeats the run up to now, and prints the same hash.
async function commandText() {
  const { toml: changes } = await run.engine.ask("changes");
  const lines = [`cat > playground.toml <<'END'\n${withChangesSoFar(await sceneText())}END`];
  if (changes) lines.push(`cat > changes.toml <<'END'\n${changes}END`);
  lines.push(`carom run playground.toml --set run.time=${number(run.numbers[at.time])}${changes ? " --changes changes.toml" : ""} --no-trajectory --force`);
  return `${lines.join("\n")}\n`;
}

/// A literal of Python that holds a text line by line.
const pythonLiteral = (text) => `'''\n${text.replace(/\\|'(?='')/g, "\\$&")}'''`;

/// A program in Python that does the same, from the start to now.
async function pythonText() {
  const { toml: changes } = await run.engine.ask("changes");
  return `import carom\n\nscene = carom.Scene.parse(${pythonLiteral(await sceneText())})\nsimulation = carom.Simulation(scene)\n` +
    (changes ? "# The changes that were made in the page are not part of this; carom run --changes repeats them.\n" : "") +
    `simulation.run_until(${number(run.numbers[at.time])})\nprint(simulation.state_hash)\n`;
}
