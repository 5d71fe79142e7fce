// Measures the page in a headless Chromium, which has no graphics card: node speed.mjs PAGE [canvas]. Prints the rows of the table of
// docs/playground.md.

import { resolve } from "node:path";
import { Browser, pause } from "./browser.mjs";

const page = resolve(process.argv[2]);
const draw = process.argv[3] ? `&draw=${process.argv[3]}` : "";
const browser = await Browser.start({ width: 1280, height: 800 });
const ask = (expression) => browser.evaluate(expression);

const starts = [];
for (let k = 0; k < 5; ++k) {
  await browser.open(`file://${page}?play=1${draw}`);
  starts.push(await ask("new Promise((resolve) => { const look = () => (carom.frames > 0 ? resolve(performance.now()) : setTimeout(look, 5)); look(); }).then((now) => (window.firstPicture ?? now))"));
}
console.log(`drawn by ${await ask("carom.drawing()")}; ready after ${Math.min(...starts).toFixed(0)} ms at best of ${starts.length}`);

for (const n of [500, 2000, 10000, 20000]) {
  await ask(`carom.scene("gas", { n: ${n}, eta: 0.4 })`);
  const row = [n];
  for (const faster of [1, 100]) {
    await ask(`(carom.run.rate = carom.run.description.crossing / 6 * ${faster}, carom.play(true))`);
    await pause(1000);
    const [frames, pairs, began] = await ask("[carom.frames, carom.run.numbers[2], performance.now()]");
    const before = await browser.processorTime();
    await pause(3000);
    const after = await browser.processorTime();
    const [framesThen, pairsThen, ended] = await ask("[carom.frames, carom.run.numbers[2], performance.now()]");
    const passed = Math.max(1, framesThen - frames);
    const work = (kind) => ((1000 * (after[kind] - before[kind])) / passed).toFixed(1);
    row.push((passed / ((ended - began) / 1000)).toFixed(0), ((pairsThen - pairs) / passed).toFixed(0), `${work("renderer")} + ${work("GPU")}`);
  }
  await ask("carom.play(false)");
  await pause(300);
  const slider = await ask(`(async () => {
    const times = [];
    for (let k = 0; k < 7; ++k) {
      const before = performance.now();
      await carom.change('set = ["collision.restitution=0.9' + k + '"]');
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      times.push(performance.now() - before);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    return times.sort((a, b) => a - b)[3];
  })()`);
  row.push(slider.toFixed(0), ((await ask("carom.memory()")) / 1e6).toFixed(0));
  console.log(`| ${row.join(" | ")} |`);
}
await browser.close();
