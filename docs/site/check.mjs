#!/usr/bin/env node
// Opens the pages of a built site in a headless Chromium, from the disk and without a network, and fails with a line for each thing that
// is wrong: errors on the console, pages wider than a phone, a search that finds nothing, a gallery that does not play.
//
//   node docs/site/check.mjs build/site [--whole]
//
// With --whole every picture of the gallery must have its player, and the start page its two live pages.

import { readdirSync } from "node:fs";
import { join, relative, resolve } from "node:path";

import { Browser, chromium, pause } from "../../playground/tests/browser.mjs";

const isWhole = process.argv.includes("--whole");
if (chromium() === null) {
  console.log(isWhole ? "there is no Chromium, and without it nothing can be pressed" : "skipped: there is no Chromium");
  process.exit(isWhole ? 1 : 0);
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

// Each live page that has a button is there, opens without an error and begins to move.
const buttons = await browser.evaluate("[...document.querySelectorAll('.buttons a.button')].map((button) => [button.innerText, button.href])");
if (isWhole) check(`the start page has the buttons of the playground and of the film, not only "${buttons.map(([words]) => words).join('", "')}"`, buttons.length === 2);
for (const [words, address] of buttons) {
  await open("index.html");
  await browser.evaluate(`[...document.querySelectorAll('.buttons a.button')].find((button) => button.href === ${JSON.stringify(address)}).click()`);
  await pause(4000);
  errors(words);
  const shown = await browser.evaluate("[location.href, document.documentElement.dataset.errors ?? '']");
  check(`"${words}" leads to ${shown[0]}`, shown[0] === address);
  check(`"${words}" says ${shown[1]}`, shown[1] === "");
}

const players = files.filter((name) => name.startsWith("players/") && name !== "players/side_by_side.html");
if (players.length > 0) {
  for (const scheme of ["light", "dark"]) {
    await browser.media({ scheme });
    await open("gallery.html");
    const shown = await browser.evaluate("[...document.querySelectorAll('article img')].filter((image) => image.getBoundingClientRect().width > 0).map((image) => image.src.replace(/.*\\//, ''))");
    const count = await browser.evaluate("[...document.querySelectorAll('a.press-to-play')].filter((link) => [...link.querySelectorAll('img')].filter((image) => image.getBoundingClientRect().width > 0).length === 1).length");
    check(`the gallery has ${count} pictures to press, and the site ${players.length} players, ${scheme}`, count === players.length);
    if (isWhole) check(`of ${shown.length} pictures of the gallery ${count} can be pressed, ${scheme}`, count === shown.length && count > 30);
    check(`pictures of the gallery on a ${scheme} page: ${shown}`, shown.every((name) => name.endsWith("_dark.png") === (scheme === "dark")));
  }
  await browser.media({ scheme: "light" });
  await open("gallery.html");
  await browser.evaluate("document.querySelector('a.press-to-play').scrollIntoView(); document.querySelector('a.press-to-play').click()");
  await pause(2500);
  check("a press puts a player in the place of its picture", await browser.evaluate("/players\\/\\w+\\.html#play$/.test(document.querySelector('iframe.live')?.src)"));
  errors("gallery");
  for (const name of files.filter((name) => name.startsWith("players/"))) {
    await open(`${name}#play`);
    const times = [];
    for (let k = 0; k < 40 && times.length < 2; ++k) {  // until the clock has been seen to move
      await pause(100);
      const time = await browser.evaluate("window.carom?.moment?.time ?? window.carom?.time ?? null").catch(() => null);
      if (time !== null && time !== times.at(-1)) times.push(time);
    }
    errors(name);
    check(`${name} says that it has no errors`, await browser.evaluate("document.documentElement.dataset.errors === '' && Boolean(window.carom)"));
    check(`${name}#play begins to play`, times.length === 2);
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
