// Draws a moment: disks in their colours, and above them the box, the obstacles, paths and arrows.
"use strict";

/// The quantities that colours can show: `value` is a number from 0 to 1 for each disk, `kind` the number of its kind, whose names and
/// colours are those of `kinds`. `colours` are those of the scale where they are not the reader's choice; `isCut` says which disks have no
/// value.
const colourings = {
  speed: { value: (i) => Math.sqrt(run.vx[i] ** 2 + run.vy[i] ** 2) / (2.5 * run.speedScale), ends: () => ["0", `≥ ${short(2.5 * run.speedScale)}`], unit: "length / time" },
  energy: { value: (i) => (run.mass[i] * (run.vx[i] ** 2 + run.vy[i] ** 2)) / (6 * Math.max(run.numbers[at.kT], 1e-300)), ends: () => ["0", `≥ ${short(3 * run.numbers[at.kT])}`], unit: "energy" },
  species: {
    kind: (i) => run.species[i] % kinds.length,
    kinds: () => kinds.map((colour, k) => ({ colour, name: speciesWords(k) })),
  },
  direction: { colours: () => wheel, value: (i) => Math.atan2(run.vy[i], run.vx[i]) / (2 * Math.PI) + 0.5 },
  id: { value: (i) => i / Math.max(disks - 1, 1), ends: () => ["0", String(disks - 1)] },
  psi6: { value: (i) => order.size[i], ends: () => ["0", "1"] },
  psi6_angle: { colours: () => circleColours, value: (i) => axisOf(order, i), ends: () => ["−30°", "30°"] },
  neighbours: {
    kind: (i) => neighbourKind(order, i),
    kinds: () => ["≤ 4", "5", "6", "7", `≥ 8 ${t("colour.neighbours")}`].map((name, k) => ({ name, colour: neighbourColours(theme.isDark)[k] })),
  },
};
const order = { re: new Float64Array(), im: new Float64Array(), size: new Float64Array(), neighbours: new Float64Array() };
let orderAt = 0;  // when it was found
for (const name of ["psi6", "psi6_angle", "neighbours"])
  Object.assign(colourings[name], {
    isCut: (i) => order.neighbours[i] === 0,
    prepare: () => {
      if (order.size.length !== disks) for (const name of Object.keys(order)) order[name] = new Float64Array(disks);
      else if (disks >= 600 && performance.now() - orderAt < 150) return;
      const walls = ["left", "right", "bottom", "top"].map((side) => run.numbers[at[side]]);
      if (disks >= 3 && disks <= 5000) findOrder({ x: run.x, y: run.y, walls, displacement: run.numbers[at.shift] }, order);
      orderAt = performance.now();
    },
  });

/// The name of a species and its number of disks; empty where there is none.
function speciesWords(k) {
  const one = run.description.species[k];
  return one ? `${t(`species.${one.name}`).replace("species.", "")} (${one.count})` : "";
}

const wheel = Array.from({ length: colourSteps }, (_, k) => {
  const part = (shift) => Math.round(127 + 90 * Math.cos(2 * Math.PI * (k / colourSteps - shift))).toString(16).padStart(2, "0");
  return `#${part(0)}${part(1 / 3)}${part(2 / 3)}`;
});

let drawer = null;
let instances = new Float32Array(0);
let paletteShown = "";

function setPalette() {
  const colouring = colourings[settings.colour];
  const key = `${settings.colour} ${settings.palette} ${theme.isDark}`;
  if (key === paletteShown) return;
  paletteShown = key;
  drawer.setPalette([...coloursOf(colouring), theme.fault, theme.frame]);  // the last are those of overlapping disks, and of disks without a value
}
const coloursOf = (colouring) => colouring.kinds?.().map((kind) => kind.colour) ?? colouring.colours?.() ?? scaleColours(settings.palette, theme.isDark);

/// Fills the instances with places in a pane's pixels.
function fill(x, y, pane, marks) {
  const count = x.length;
  if (instances.length < 4 * count) instances = new Float32Array(4 * count + 400);
  const colouring = colourings[settings.colour];
  const scale = run.numbers[at.scale] * view.scale;
  const colours = coloursOf(colouring).length;
  const own = [run.vx, run.vy];
  // The twin's colours are those of its own speeds.
  if (x !== run.x) [run.vx, run.vy] = [2, 3].map((k) => run.twin.subarray(k * count, (k + 1) * count));
  let at4 = 0;
  const put = (px, py, r, colour) => {
    if (at4 + 4 > instances.length) {
      const longer = new Float32Array(2 * instances.length);
      longer.set(instances);
      instances = longer;
    }
    instances[at4] = px;
    instances[at4 + 1] = py;
    instances[at4 + 2] = r;
    instances[at4 + 3] = colour;
    at4 += 4;
  };
  const width = box.lengths[0] * view.scale;
  const height = box.lengths[1] * view.scale;
  const shift = run.numbers[at.shift] * view.scale;
  const edge = clipOf(pane, true);
  for (let i = 0; i < count; ++i) {
    const px = pixelX(x[i], pane);
    const py = pixelY(y[i], pane);
    const r = Math.max(run.radius[i] * scale, 0.75);
    const share = colouring.kind?.(i) ?? (Math.max(0, Math.min(colours - 1, Math.floor(colouring.value(i) * colours))) || 0);
    const colour = marks?.[i] ? colours : colouring.isCut?.(i) ? colours + 1 : share;
    put(px, py, r, colour);
    // The images of a disk that an edge of a periodic box cuts.
    const across = !box.periodic[0] ? 0 : px - r < edge.left ? 1 : px + r > edge.right ? -1 : 0;
    const up = !box.periodic[1] ? 0 : py - r < edge.top ? 1 : py + r > edge.bottom ? -1 : 0;
    if (across !== 0) put(px + across * width, py, r, colour);
    if (up === 0) continue;
    // Images above and below are shifted under shear, and may then be cut by the sides.
    for (const more of across !== 0 || shift !== 0 ? [-1, 0, 1] : [0]) put(px - up * shift + more * width, py + up * height, r, colour);
  }
  [run.vx, run.vy] = own;
  return at4 / 4;
}

/// The box in a pane's pixels: its edges, or what of it is to be seen.
function clipOf(pane, isWhole = false) {
  const [left, right, bottom, top] = [at.left, at.right, at.bottom, at.top].map((k) => run.numbers[k]);
  const edge = { left: pixelX(left, pane), right: pixelX(right, pane), top: pixelY(top, pane), bottom: pixelY(bottom, pane) };
  if (isWhole) return edge;
  const x0 = Math.max(edge.left, pane.left);
  const y0 = Math.max(edge.top, pane.top);
  return { left: x0, top: y0, width: Math.min(edge.right, pane.left + pane.width) - x0, height: Math.min(edge.bottom, pane.top + pane.height) - y0 };
}

function draw() {
  if (!run.description) return;
  if (run.isPlaying && settings.followed >= 0 && settings.followed < disks && !view.isFitted) {
    view.x = run.x[settings.followed];
    view.y = run.y[settings.followed];
  }
  setPalette();
  colourings[settings.colour].prepare?.();
  const isOutlined = run.largest * run.numbers[at.scale] * view.scale > 3;
  drawer.begin();
  panes.forEach((pane, k) => {
    const count = run.x.length;
    const isTwin = k === 1 && run.twin;
    const filled = fill(isTwin ? run.twin.subarray(0, count) : run.x, isTwin ? run.twin.subarray(count, 2 * count) : run.y, pane, isTwin ? run.twinMarks : null);
    drawer.draw(instances, filled, clipOf(pane), isOutlined, theme.isDark);
  });
  drawOverlay();
}

const pen = overlay.getContext("2d");
let overlayShown = "";  // what it was drawn from; empty where it has to be drawn again
onDescription.push(() => (overlayShown = ""));

/// Draws what is above the disks, where anything of it is other than before.
function drawOverlay() {
  const moves = settings.arrows || settings.followed >= 0 || run.lastEvent || trails.points.length > 0 || pointer.isDown;
  const from = moves ? "" : [...Object.values(view), panes.length, ...run.numbers.subarray(at.left, at.top + 1), theme.isDark, language].join();
  if (from !== "" && from === overlayShown) return;
  overlayShown = from;
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.clearRect(0, 0, overlay.width, overlay.height);
  pen.setTransform(view.density, 0, 0, view.density, 0, 0);
  panes.forEach((pane, k) => {
    pen.save();
    pen.beginPath();
    pen.rect(pane.left, pane.top, pane.width, pane.height);
    pen.clip();
    drawBox(pane);
    drawObstacles(pane);
    if (k === 0) {
      drawTrails(pane);
      if (settings.arrows) drawArrows(pane);
      drawMarks(pane);
      tools[settings.tool].draw?.(pane);
    }
    pen.restore();
    if (panes.length > 1) {
      pen.font = `600 13px ${theme.font}`;
      const text = t(k === 0 ? "twin.exact" : "twin.steps");
      const width = pen.measureText(text).width;
      pen.fillStyle = theme.raised;
      pen.fillRect(pane.left + pane.width / 2 - width / 2 - 8, pane.top + 4, width + 16, 22);
      pen.fillStyle = k === 0 ? theme.accent : theme.fault;
      pen.textAlign = "center";
      pen.fillText(text, pane.left + pane.width / 2, pane.top + 19);
      pen.textAlign = "left";
    }
  });
}

function drawBox(pane) {
  const [left, right, bottom, top] = [at.left, at.right, at.bottom, at.top].map((k) => run.numbers[k]);
  const x = [pixelX(left, pane), pixelX(right, pane)];
  const y = [pixelY(bottom, pane), pixelY(top, pane)];
  if (run.description.isCircle) {
    pen.beginPath();
    pen.lineWidth = 4;
    pen.strokeStyle = theme.solid;
    pen.arc((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, (x[1] - x[0]) / 2 + 2, 0, 2 * Math.PI);
    pen.stroke();
    return;
  }
  const sides = [[x[0], y[0], x[0], y[1]], [x[1], y[0], x[1], y[1]], [x[0], y[0], x[1], y[0]], [x[0], y[1], x[1], y[1]]];
  sides.forEach(([x0, y0, x1, y1], side) => {
    const wall = run.description.walls[side];
    const isOpen = box.periodic[side < 2 ? 0 : 1];
    const out = 3 * (side % 2 === 0 ? -1 : 1);
    const [dx, dy] = side < 2 ? [out, 0] : [0, -out];
    pen.beginPath();
    pen.setLineDash(isOpen ? [5, 5] : []);
    pen.lineWidth = isOpen ? 1 : wall.mass !== null ? 10 : 4;
    pen.strokeStyle = isOpen ? theme.frame : wall.temperature !== null ? heatColour(wall.temperature) : wall.mass !== null ? theme.accent : theme.solid;
    const way = wall.mass !== null ? 2 : isOpen ? 0 : 2 / 3;
    pen.moveTo(x0 + way * dx, y0 + way * dy);
    pen.lineTo(x1 + way * dx, y1 + way * dy);
    pen.stroke();
    if (wall.load > 0) drawWeights(side, wall, x, y);
    if (wall.temperature !== null) {
      pen.font = `12px ${theme.font}`;
      pen.fillStyle = theme.muted;
      const text = `kT ${short(wall.temperature)}`;
      pen.save();
      pen.translate((x0 + x1) / 2, (y0 + y1) / 2);
      if (side < 2) pen.rotate(-Math.PI / 2);
      pen.textAlign = "center";
      pen.fillText(text, 0, side === 2 || side === 1 ? 15 : -8);
      pen.restore();
    }
  });
  pen.setLineDash([]);
}

/// Weights on the piston: as many as its load, and at least one.
function drawWeights(side, wall, x, y) {
  if (side !== 3) return;
  const weights = Math.max(1, Math.min(12, Math.round((12 * wall.load) / liveSettings.load.most)));
  pen.fillStyle = theme.solid;
  const middle = (x[0] + x[1]) / 2;
  for (let k = 0; k < weights; ++k) {
    const column = (k % 4) - Math.min(weights - 1 - 4 * Math.floor(k / 4), 3) / 2;
    pen.fillRect(middle + column * 24 - 10, y[1] - 26 - 16 * Math.floor(k / 4), 20, 14);
  }
}

function heatColour(temperature) {
  const warm = Math.min(1, Math.max(0, Math.log2(temperature + 0.25) / 4 + 0.4));
  return mixed("#2f7fd0", "#e0452c", warm);
}

function drawObstacles(pane) {
  pen.lineCap = "round";
  for (const one of run.description.obstacles) {
    pen.beginPath();
    if (one.angles) {
      pen.lineWidth = 3;
      pen.strokeStyle = theme.solid;
      const [first, last] = one.angles.map((angle) => (-angle * Math.PI) / 180);
      pen.arc(pixelX(one.centre[0], pane), pixelY(one.centre[1], pane), one.radius * view.scale, first, last, true);
      pen.stroke();
    } else if (one.from) {
      pen.lineWidth = 3;
      pen.strokeStyle = theme.solid;
      pen.moveTo(pixelX(one.from[0], pane), pixelY(one.from[1], pane));
      pen.lineTo(pixelX(one.to[0], pane), pixelY(one.to[1], pane));
      pen.stroke();
    } else {
      pen.fillStyle = theme.solid;
      for (const a of box.periodic[0] ? [-1, 0, 1] : [0])
        for (const b of box.periodic[1] ? [-1, 0, 1] : [0]) {
          pen.moveTo(pixelX(one.centre[0] + a * box.lengths[0], pane), pixelY(one.centre[1] + b * box.lengths[1], pane));
          pen.arc(pixelX(one.centre[0] + a * box.lengths[0], pane), pixelY(one.centre[1] + b * box.lengths[1], pane), one.radius * view.scale, 0, 2 * Math.PI);
        }
      const clip = clipOf(pane);
      pen.save();
      const region = new Path2D();
      region.rect(clip.left, clip.top, clip.width, clip.height);
      pen.clip(region);
      pen.fill();
      pen.restore();
    }
  }
}

function drawTrails(pane) {
  const { points } = trails;
  if (points.length < 2) return;
  const many = points[0].which.length;
  for (let k = 0; k < many; ++k) {
    pen.beginPath();
    let hasBegun = false;
    points.forEach((point, at) => {
      const x = pixelX(point.x[k], pane);
      const y = pixelY(point.y[k], pane);
      const before = points[at - 1];
      const jumps = before && (Math.abs(point.x[k] - before.x[k]) > box.lengths[0] / 2 || Math.abs(point.y[k] - before.y[k]) > box.lengths[1] / 2);
      if (!hasBegun || jumps) pen.moveTo(x, y);
      else pen.lineTo(x, y);
      hasBegun = true;
    });
    pen.strokeStyle = many === 1 ? theme.accent : scaleColours(settings.palette, theme.isDark)[Math.floor((k / many) * colourSteps)];
    pen.globalAlpha = many === 1 ? 0.9 : 0.6;
    pen.lineWidth = 1.5;
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

function arrow(x, y, dx, dy, colour) {
  const length = Math.hypot(dx, dy);
  if (length < 2) return;
  const head = Math.min(7, length / 2);
  const angle = Math.atan2(dy, dx);
  pen.beginPath();
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5;
  pen.moveTo(x, y);
  pen.lineTo(x + dx, y + dy);
  for (const turn of [2.6, -2.6]) {
    pen.moveTo(x + dx, y + dy);
    pen.lineTo(x + dx + head * Math.cos(angle + turn), y + dy + head * Math.sin(angle + turn));
  }
  pen.stroke();
}

const arrowTime = () => (0.08 * Math.min(...box.lengths)) / run.speedScale;
function drawArrows(pane) {
  const time = arrowTime() * view.scale;
  const most = Math.min(disks, 2000);
  for (let i = 0; i < most; ++i) arrow(pixelX(run.x[i], pane), pixelY(run.y[i], pane), run.vx[i] * time, -run.vy[i] * time, theme.ink);
}

/// Rings round the disk that is followed, and round those that have just met.
function drawMarks(pane) {
  const ring = (i, colour) => {
    if (!(i >= 0 && i < disks)) return;
    pen.beginPath();
    pen.lineWidth = 2.5;
    pen.strokeStyle = colour;
    pen.arc(pixelX(run.x[i], pane), pixelY(run.y[i], pane), Math.max(run.radius[i] * run.numbers[at.scale] * view.scale, 1.5) + 3, 0, 2 * Math.PI);
    pen.stroke();
  };
  ring(settings.followed, theme.accent);
  if (run.lastEvent) {
    ring(run.lastEvent.disk, theme.fault);
    ring(run.lastEvent.partner, theme.fault);
  }
}
