#!/usr/bin/env node
// Films the page on which exact events and fixed steps fly side by side: docs/images/side_by_side.gif, and side_by_side_dark.gif for
// readers with a dark screen.
//
//   node docs/images/side_by_side.mjs path/to/carom
//
// `carom compare --play` makes the page from docs/images/accuracy_moderate.toml with 49 disks; a headless Chromium shows it moment by
// moment; ffmpeg puts the pictures together.

import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { Browser, pause } from "../../playground/tests/browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const films = { light: join(here, "side_by_side.gif"), dark: join(here, "side_by_side_dark.gif") };
const frames = 48;
const framesPerSecond = 8;

const directory = mkdtempSync(join(tmpdir(), "carom-film-"));
const made = spawnSync(resolve(process.argv[2]), ["compare", join(here, "accuracy_moderate.toml"), "--set", "disks.0.count=49", "--dt", "0.04",
  "--no-costs", "--play", "guarded:0.04", "--out", directory, "--force", "-q"], { stdio: ["ignore", "ignore", "inherit"] });
if (made.status !== 0) process.exit(1);

const browser = await Browser.start({ width: 900, height: 640 });
await browser.size(900, 640, { scale: 1 });
for (const [scheme, film] of Object.entries(films)) {
  await browser.media({ scheme });
  await browser.send("Page.navigate", { url: `file://${join(directory, "side_by_side.html")}` });
  await pause(2000);
  const clip = await browser.evaluate(`(() => {
    for (const button of document.querySelectorAll("button")) if (/zoom|box|screen/i.test(button.title + button.id) && button.closest("section, .stage")) button.style.visibility = "hidden";
    const sides = [...document.querySelectorAll("canvas#stage, canvas#steps")].map((canvas) => canvas.closest("section").getBoundingClientRect());
    const left = Math.min(...sides.map((side) => side.left)), top = Math.min(...sides.map((side) => side.top));
    return { x: left, y: top, width: Math.max(...sides.map((side) => side.right)) - left, height: Math.max(...sides.map((side) => side.bottom)) - top, scale: 1 };
  })()`);
  const duration = await browser.evaluate("carom.duration");
  const encoder = spawn("ffmpeg", ["-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", `${framesPerSecond}`, "-i", "-",
    "-vf", "scale=600:-2:flags=area,split[a][b];[a]palettegen=max_colors=40:stats_mode=diff[p];[b][p]paletteuse=dither=none:diff_mode=rectangle", "-loop", "0", film],
  { stdio: ["pipe", "inherit", "inherit"] });
  for (let k = 0; k < frames; ++k) {
    await browser.evaluate(`carom.seek(${(duration * k) / (frames - 1)})`);
    const { data } = await browser.send("Page.captureScreenshot", { format: "png", clip });
    encoder.stdin.write(Buffer.from(data, "base64"));
  }
  encoder.stdin.end();
  await new Promise((done) => encoder.on("exit", done));
  console.log(`${film}: ${(statSync(film).size / 1e3).toFixed(0)} kB, ${frames} pictures of ${duration} time units`);
}
await browser.close();
rmSync(directory, { recursive: true });
