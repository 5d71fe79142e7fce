// Puts the page together: node assemble.mjs CHECKOUT ENGINE_DIRECTORY PAGE. Everything is in the one file; nothing is loaded.

import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { basename, dirname, join } from "node:path";

const [root, engine, page] = process.argv.slice(2);
const read = (...path) => readFileSync(join(...path), "utf8");
const own = join(root, "playground");

const scripts = [
  "src/pages/player/scales.js", "playground/scenes/scenes.js", "playground/page/texts.js", "playground/page/engine.js", "playground/page/run.js",
  "src/pages/player/hexatic.js", "src/pages/player/raster.js",
  ...["look", "measures", "live_settings", "stage", "drawing", "plots", "tools", "links", "controls", "numbers", "main"].map((name) => `playground/page/${name}.js`),
];
const texts = {};
for (const file of readdirSync(join(own, "texts")).sort((a, b) => (a === "en.json" ? -1 : b === "en.json" ? 1 : a < b ? -1 : 1)))
  texts[basename(file, ".json")] = JSON.parse(read(own, "texts", file));

const policy =
  "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";
const inScript = (text) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const json = (value) => JSON.stringify(value).replaceAll("<", "\\u003c");
const wasm = gzipSync(readFileSync(join(engine, "engine.wasm")), { level: 9 }).toString("base64");

const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="generator" content="carom playground">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>Carom playground</title>
<style>
${read(root, "src/pages/player/player.css")}${read(own, "page/playground.css")}</style>
<script>
${read(root, "src/pages/page/errors.js")}</script>
</head>
<body>
${read(own, "page/page.html")}<script type="application/json" id="ownScenes">[]</script>
<script type="application/json" id="texts">${json(texts)}</script>
<script type="text/plain" id="worker">${inScript(read(engine, "engine.js"))}
${inScript(read(own, "page/worker.js"))}</script>
<script type="text/plain" id="wasm">${wasm}</script>
<script>
/* This is delaunator.

${read(root, "src/pages/delaunator/LICENSE")}*/
${inScript(read(root, "src/pages/delaunator/delaunator.min.js"))}
</script>
<script>
(() => {
${scripts.map((name) => inScript(read(root, name)).replace(/^"use strict";\n/m, "")).join("\n")}
})();
</script>
</body>
</html>
`;
writeFileSync(page, html);
// The page as a package for other pages: npm/ beside it.
const npm = join(dirname(page), "npm");
mkdirSync(npm, { recursive: true });
for (const name of readdirSync(join(own, "npm"))) copyFileSync(join(own, "npm", name), join(npm, name));
writeFileSync(join(npm, "playground.html"), html);
console.log(`${page}: ${(html.length / 1e6).toFixed(2)} MB`);
