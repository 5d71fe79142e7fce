#!/usr/bin/env node
// Takes the pictures of pages that docs/ shows, NAME.png on a light screen and NAME_dark.png on a dark one: player, side_by_side, fields,
// and playground where its page is named.
//
//   node docs/images/screens.mjs path/to/carom [--dark] [--playground playground.html] [NAME...]
//
// Needs a Chromium, and python3-pil for palettes of 256 colours. With --dark it takes the dark ones alone.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { Browser, pause } from "../../playground/tests/browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const docs = dirname(here);
const [program, ...words] = process.argv.slice(2);
const playground = words.includes("--playground") ? resolve(words.splice(words.indexOf("--playground"), 2)[1]) : null;
const schemes = words.includes("--dark") ? ["dark"] : ["light", "dark"];
const names = words.filter((word) => word !== "--dark");

const directory = mkdtempSync(join(tmpdir(), "carom-screens-"));
const carom = (...more) => {
  const ran = spawnSync(resolve(program), [...more, "-q"], { cwd: directory, stdio: ["ignore", "ignore", "inherit"] });
  if (ran.status !== 0) throw new Error(`carom ${more.join(" ")} ended with ${ran.status}`);
};

const screens = {
  player: {
    size: [1100, 690],
    make: () => {
      carom("run", join(docs, "scenes/mixture.toml"), "--events");
      carom("play", "mixture");
      return join(directory, "mixture/player.html");
    },
    ready: "carom.change({ trails: true }); carom.seek(20.0207738)",
  },
  side_by_side: {
    size: [1280, 720],
    make: () => {
      carom("compare", join(here, "accuracy_moderate.toml"), "--time", "3", "--dt", "0.02", "--no-costs", "--longest", "0.02", "--play", "guarded:0.02",
        "--out", "beside");
      return join(directory, "beside/side_by_side.html");
    },
    ready: "carom.seek(0.4636)",
  },
  fields: {
    size: [912, 900],
    make: () => {
      carom("run", join(docs, "scenes/cavity.toml"), "--time", "400");
      carom("report", "cavity");
      return join(directory, "cavity/report.html");
    },
    part: "iframe[srcdoc*='Maps of the fields'], iframe[title*='aps']",
  },
  playground: {
    size: [1200, 720],
    make: () => playground,
    ready: "carom.ready.then(() => carom.scene('gas')).then(() => carom.runUntil(18.8))",
  },
};

const browser = await Browser.start({ width: 1200, height: 800 });
for (const [name, screen] of Object.entries(screens)) {
  if ((names.length > 0 && !names.includes(name)) || (name === "playground" && playground === null)) continue;
  const page = screen.make();
  for (const scheme of schemes) {
    await browser.media({ scheme });
    await browser.size(...screen.size);
    await browser.send("Page.navigate", { url: `file://${page}` });
    await pause(5000);
    if (screen.ready) await browser.evaluate(screen.ready);
    await pause(2000);
    const clip = screen.part ? await browser.evaluate(`(() => {
      const part = document.querySelector(${JSON.stringify(screen.part)});
      part.scrollIntoView({ block: "start" });
      const { left, top, width, height } = part.getBoundingClientRect();
      return { x: left + scrollX, y: top + scrollY, width, height, scale: 1 };
    })()`) : undefined;
    await pause(1000);
    const { data } = await browser.send("Page.captureScreenshot", { format: "png", ...(clip ? { clip, captureBeyondViewport: true } : {}) });
    const file = join(here, `${name}${scheme === "dark" ? "_dark" : ""}.png`);
    writeFileSync(file, Buffer.from(data, "base64"));
    spawnSync("python3", ["-c", "import sys; from PIL import Image; p = Image.open(sys.argv[1]).convert('RGB');"
      + "p.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(sys.argv[1], optimize=True)", file]);
    console.log(`${file}: ${(statSync(file).size / 1e3).toFixed(0)} kB`);
  }
}
await browser.close();
rmSync(directory, { recursive: true });
