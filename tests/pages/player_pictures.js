// Holds what a page draws on a canvas (`shown`: {canvas, moment}, or the player's own) against `expected`, states of the engine:
// [{time, positions: [[x, y], ...], walls: [4], scale}]. Every pixel of the box whose whole square lies inside a disk has the disks'
// colour, and every one whose square touches none has the box's; a pixel's square reaches 0.71 from its middle, and the rim of a disk
// is drawn half a pixel to either side. Browsers smooth rims by a few of 255 levels differently; disk and box differ by 75 and more.
const reach = 0.71 + 0.5;
const smoothing = 8;
const wrong = [];
carom.change({ colourBy: "species", theme: "light" });
const { canvas: drawnOn, moment: drawn } = window.shown ?? { canvas: document.getElementById("stage"), moment: carom.moment };
const copy = new OffscreenCanvas(drawnOn.width, drawnOn.height).getContext("2d", { willReadFrequently: true });
let apart = 0;
let compared = 0;
for (const { time, positions, walls, scale, areMany } of [...expected, { ...expected[0], areMany: true }]) {
  carom.change({ areMany: Boolean(areMany) });  // both ways of drawing
  carom.seek(time);
  copy.drawImage(drawnOn, 0, 0);
  const { width, data } = copy.getImageData(0, 0, drawnOn.width, drawnOn.height);
  const [lower, upper] = [[walls[0], walls[2]], [walls[1], walls[3]]];
  walls.forEach((wall, side) => (apart = Math.max(apart, Math.abs(drawn.walls[side] - wall) * carom.view.scale)));
  const lengths = [upper[0] - lower[0], upper[1] - lower[1]];
  const centres = [];
  positions.forEach(([x, y], i) => {
    const away = [drawn.x[i] - x, drawn.y[i] - y].map((d, axis) =>
      carom.description.box.periodic[axis] ? d - Math.round(d / lengths[axis]) * lengths[axis] : d,
    );
    apart = Math.max(apart, Math.hypot(...away) * carom.view.scale);
    for (const a of carom.description.box.periodic[0] ? [-1, 0, 1] : [0])
      for (const b of carom.description.box.periodic[1] ? [-1, 0, 1] : [0])
        centres.push([...carom.pixel(x + a * lengths[0], y + b * lengths[1]), carom.columns.radius[i] * scale * carom.view.scale]);
  });
  const kinds = new Uint8Array(width * drawnOn.height);  // of pixels: outside all disks, on a rim, inside a disk
  const [outside, rim, inside] = [0, 1, 2];
  for (const [x, y, r] of centres) {
    for (let row = Math.max(Math.floor(y - r - 2), 0); row < Math.min(y + r + 2, drawnOn.height); ++row) {
      for (let column = Math.max(Math.floor(x - r - 2), 0); column < Math.min(x + r + 2, width); ++column) {
        const beyond = Math.hypot(column + 0.5 - x, row + 0.5 - y) - r;
        if (beyond > reach) continue;
        const at = row * width + column;
        kinds[at] = Math.max(kinds[at], beyond < -reach ? inside : rim);
      }
    }
  }
  const [left, bottom] = carom.pixel(...lower);
  const [right, top] = carom.pixel(...upper);
  for (let row = Math.ceil(top) + 2; row < Math.floor(bottom) - 2; ++row) {
    for (let column = Math.ceil(left) + 2; column < Math.floor(right) - 2; ++column) {
      const kind = kinds[row * width + column];
      if (kind === rim) continue;
      const at = 4 * (row * width + column);
      const wanted = kind === inside ? [0, 114, 178] : [251, 252, 253];
      ++compared;
      if (wanted.some((level, k) => Math.abs(data[at + k] - level) > smoothing))
        wrong.push(`${time}: ${column},${row} is ${data.slice(at, at + 3).join()}`);
    }
  }
}
const root = document.documentElement.dataset;
root.compared = compared;
root.apart = apart < 0.01 ? "less than a hundredth of a pixel" : String(apart);
root.wrong = wrong.length > 0 ? `${wrong.length}, the first ${wrong[0]}` : "none";
