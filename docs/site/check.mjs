#!/usr/bin/env node
// Opens the pages of a built site in a headless Chromium, from the disk and without a network, and fails with a line for each thing that
// is wrong: errors on the console, pages wider than a phone, a search that finds nothing, a gallery that does not play.
//
//   node docs/site/check.mjs build/site

import { readdirSync } from "node:fs";
import { join, relative, resolve } from "node:path";

import { Browser, chromium, pause } from "../../playground/tests/browser.mjs";

if (chromium() === null) {
  console.log("skipped: there is no Chromium");
  process.exit(0);
}
const site = resolve(process.argv[2]);
const files = readdirSync(site, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile() && entry.name.endsWith(".html"))
  .map((entry) => relative(site, join(entry.parentPath ?? entry.path, entry.name)))
  .sort();
const pages = files.filter((name) => !/^(players|play|_)/.test(name));
const faults = [];
const check = (what, isTrue) => {
  if (!isTrue) faults.push(what);
};

const browser = await Browser.start({ options: ["--host-resolver-rules=MAP * ~NOTFOUND", "--allow-file-access-from-files=false"] });
const open = async (name) => {
  browser.errors = [];
  await browser.send("Page.navigate", { url: `file://${join(site, name)}` });
  for (let k = 0; k < 400; ++k) {
    await pause(25);
    if (await browser.evaluate("document.readyState === 'complete' && location.href !== 'about:blank'").catch(() => false)) return;
  }
  faults.push(`${name} is not there after ten seconds`);
};
const errors = (name) => browser.errors.forEach((error) => faults.push(`${name}: ${error}`));

check("the site has pages", pages.length > 40);
for (const [scheme, width, height, isPhone] of [["light", 1280, 800, false], ["dark", 390, 844, true]]) {
  await browser.size(width, height, { touch: isPhone });
  await browser.media({ scheme });
  for (const name of pages) {
    await open(name);
    errors(`${name}, ${scheme}`);
    const broken = await browser.evaluate("[...document.images].filter((image) => image.complete && image.naturalWidth === 0 && image.loading !== 'lazy').map((image) => image.src)");
    check(`${name}: pictures that cannot be shown: ${broken}`, broken.length === 0);
    const wide = await browser.evaluate("document.documentElement.scrollWidth - innerWidth");
    check(`${name}, ${width} pixels: it is ${wide} pixels too wide`, wide <= 0);
  }
}

await browser.size(1280, 800);
await open("search.html?q=thermostat");
await pause(1500);
errors("search");
check("search finds the page of the thermostat", await browser.evaluate("[...document.querySelectorAll('#search-results a')].some((link) => /effects\\/thermostat/.test(link.href))"));

await open("index.html");
const film = await browser.evaluate("[...document.querySelectorAll('.film img')].map((film) => film.getBoundingClientRect()).filter((film) => film.width > 200 && film.bottom < innerHeight).length === 1");
check("one film is on the first screen, light or dark", film);

const players = files.filter((name) => name.startsWith("players/") && name !== "players/side_by_side.html");
if (players.length > 0) {
  await open("gallery.html");
  const count = await browser.evaluate("document.querySelectorAll('a.press-to-play').length");
  check(`the gallery has ${count} pictures to press, and the site ${players.length} players`, count === players.length);
  await browser.evaluate("document.querySelector('a.press-to-play').scrollIntoView(); document.querySelector('a.press-to-play').click()");
  await pause(2500);
  check("a press puts a player in the place of its picture", await browser.evaluate("/players\\/\\w+\\.html#play$/.test(document.querySelector('iframe.live')?.src)"));
  errors("gallery");
  await open(`${players[0]}#play`);
  await pause(1000);
  check("#play begins to play", await browser.evaluate("carom.settings.isPlaying && carom.moment.time > 0"));
  for (const name of files.filter((name) => name.startsWith("players/"))) {
    await open(name);
    await pause(300);
    errors(name);
    check(`${name} says that it has no errors`, await browser.evaluate("document.documentElement.dataset.errors === '' && Boolean(window.carom)"));
  }
}
if (files.includes("play/playground.html")) {
  await open("play/playground.html");
  await pause(3000);
  errors("playground");
  check("the playground is ready", await browser.evaluate("document.documentElement.dataset.ready !== undefined"));
}
await browser.close();
for (const fault of faults) console.log(fault);
console.log(`${files.length} pages of ${site}: ${faults.length === 0 ? "all are fine" : `${faults.length} faults`}`);
process.exit(faults.length === 0 ? 0 : 1);
