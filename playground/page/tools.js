// What the pointer does on the stage: look, throw a disk in, take one out, move one, draw a wall, take one away.
"use strict";

const pointer = { isDown: false, x: 0, y: 0, startX: 0, startY: 0, disk: -1, others: new Map() };

/// The distance of a place from the middle of a disk, the short way round where the box is periodic.
function distanceFrom(i, x, y) {
  const [dx, dy] = [x - run.x[i], y - run.y[i]].map((d, axis) => (box.periodic[axis] ? d - Math.round(d / box.lengths[axis]) * box.lengths[axis] : d));
  return Math.hypot(dx, dy);
}

/// The disk under a place, or -1.
function diskAt(x, y) {
  const reach = 6 / view.scale;
  let best = -1;
  let nearest = Infinity;
  for (let i = 0; i < disks; ++i) {
    const distance = distanceFrom(i, x, y) - run.radius[i] * run.numbers[at.scale];
    if (distance < Math.min(reach, nearest)) {
      nearest = distance;
      best = i;
    }
  }
  return best;
}

/// Whether a disk of a radius has room at a place; disk `but` does not count.
function hasRoom(x, y, radius, but = -1) {
  const [left, right, bottom, top] = [at.left, at.right, at.bottom, at.top].map((k) => run.numbers[k]);
  if (!box.periodic[0] && (x - radius < left || x + radius > right)) return false;
  if (!box.periodic[1] && (y - radius < bottom || y + radius > top)) return false;
  if (run.description.isCircle && Math.hypot(x - (left + right) / 2, y - (bottom + top) / 2) + radius > (right - left) / 2) return false;
  for (let i = 0; i < disks; ++i) {
    if (i !== but && distanceFrom(i, x, y) < radius + run.radius[i] * run.numbers[at.scale]) return false;
  }
  return run.description.obstacles.every((one) => distanceTo(one, x, y) >= radius);
}

/// The distance of a place from the surface of an obstacle.
function distanceTo(one, x, y) {
  if (one.angles) {
    const [dx, dy] = [x - one.centre[0], y - one.centre[1]];
    const turned = (angle) => ((angle % 360) + 360) % 360;
    if (turned((Math.atan2(dy, dx) * 180) / Math.PI - one.angles[0]) <= one.angles[1] - one.angles[0]) return Math.abs(Math.hypot(dx, dy) - one.radius);
    return Math.min(...one.angles.map((angle) => (angle * Math.PI) / 180).map((angle) => Math.hypot(dx - one.radius * Math.cos(angle), dy - one.radius * Math.sin(angle))));
  }
  if (!one.from) return Math.hypot(x - one.centre[0], y - one.centre[1]) - one.radius;
  const [dx, dy] = [one.to[0] - one.from[0], one.to[1] - one.from[1]];
  const along = Math.min(1, Math.max(0, ((x - one.from[0]) * dx + (y - one.from[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - one.from[0] - along * dx, y - one.from[1] - along * dy);
}

/// A place folded into the box along periodic axes.
function folded(value, axis) {
  if (!box.periodic[axis]) return value;
  const inside = value - Math.floor((value - box.lower[axis]) / box.lengths[axis]) * box.lengths[axis];
  return inside < box.upper[axis] ? inside : box.lower[axis];
}

const place = () => [folded(placeX(pointer.x), 0), folded(placeY(pointer.y), 1)];
const thrownSpecies = () => run.description.species.length - 1;
const thrownRadius = () => (run.description.species[thrownSpecies()]?.radius ?? 0.5) * run.numbers[at.scale];
const digits = (value) => Number(value.toPrecision(9));

/// The place in the box that is nearest to one: rounded numbers may be beyond its edge.
function insideBox([x, y]) {
  const [left, right, bottom, top] = [at.left, at.right, at.bottom, at.top].map((wall) => run.numbers[wall]);
  if (!run.description.isCircle) return [Math.min(Math.max(x, left), right), Math.min(Math.max(y, bottom), top)];
  const [x0, y0] = [(left + right) / 2, (bottom + top) / 2];
  const scale = Math.min(1, ((1 - 1e-9) * (right - left)) / 2 / Math.hypot(x - x0, y - y0));
  return [x0 + scale * (x - x0), y0 + scale * (y - y0)];
}

const pairText = ([x, y]) => `[${digits(x)}, ${digits(y)}]`;

function drawGhost(x, y, radius, isFree) {
  pen.beginPath();
  pen.arc(x, y, radius * view.scale, 0, 2 * Math.PI);
  pen.globalAlpha = 0.5;
  pen.fillStyle = isFree ? theme.accent : theme.fault;
  pen.fill();
  pen.globalAlpha = 1;
  pen.lineWidth = 2;
  pen.strokeStyle = isFree ? theme.accent : theme.fault;
  pen.stroke();
}

const tools = {
  hand: {
    cursor: "grab",
    move(dx, dy) {
      view.isFitted = false;
      view.x -= dx / view.scale;
      view.y += dy / view.scale;
    },
    up() {
      if (Math.hypot(pointer.x - pointer.startX, pointer.y - pointer.startY) > 5) return;
      const disk = diskAt(...place());
      follow(disk === settings.followed ? -1 : disk);
    },
  },
  throw: {
    cursor: "crosshair",
    draw() {
      if (!pointer.isDown) return;
      drawGhost(pointer.startX, pointer.startY, thrownRadius(), hasRoom(folded(placeX(pointer.startX), 0), folded(placeY(pointer.startY), 1), thrownRadius()));
      arrow(pointer.startX, pointer.startY, pointer.x - pointer.startX, pointer.y - pointer.startY, theme.ink);
    },
    async up() {
      if (run.description.species.length === 0) return notify(t("noSpecies"));
      const time = arrowTime() * view.scale;
      const velocity = [(pointer.x - pointer.startX) / time, -(pointer.y - pointer.startY) / time];
      const position = [folded(placeX(pointer.startX), 0), folded(placeY(pointer.startY), 1)];
      if (!hasRoom(...position, thrownRadius())) return notify(t("noRoom"));
      await changeRun(`add_disk = { species = ${thrownSpecies()}, position = ${pairText(position)}, velocity = ${pairText(velocity)} }`);
    },
  },
  take: {
    cursor: "pointer",
    async up() {
      const disk = diskAt(...place());
      if (disk >= 0) await changeRun(`remove_disk = ${disk}`);
    },
  },
  drag: {
    cursor: "move",
    down() {
      pointer.disk = diskAt(...place());
      pointer.wasPlaying = run.isPlaying;
      if (pointer.disk >= 0) play(false);
    },
    draw() {
      if (!pointer.isDown || pointer.disk < 0) return;
      const radius = run.radius[pointer.disk] * run.numbers[at.scale];
      drawGhost(pointer.x, pointer.y, radius, hasRoom(...place(), radius, pointer.disk));
    },
    async up() {
      const { disk } = pointer;
      pointer.disk = -1;
      if (disk < 0) return;
      const radius = run.radius[disk] * run.numbers[at.scale];
      if (!hasRoom(...place(), radius, disk)) notify(t("noRoom"));
      else await changeRun(`move_disk = { disk = ${disk}, position = ${pairText(place())}, velocity = ${pairText([run.vx[disk], run.vy[disk]])} }`);
      if (pointer.wasPlaying) play(true);
    },
    cancel() {
      if (pointer.disk >= 0 && pointer.wasPlaying) play(true);
      pointer.disk = -1;
    },
  },
  wall: {
    cursor: "crosshair",
    draw() {
      if (!pointer.isDown) return;
      pen.beginPath();
      pen.lineWidth = 3;
      pen.strokeStyle = theme.accent;
      pen.moveTo(pointer.startX, pointer.startY);
      pen.lineTo(pointer.x, pointer.y);
      pen.stroke();
    },
    async up() {
      const from = [placeX(pointer.startX), placeY(pointer.startY)];
      const to = [placeX(pointer.x), placeY(pointer.y)];
      if (Math.hypot(to[0] - from[0], to[1] - from[1]) * view.scale < 5) return;
      await changeRun(`add_obstacle = ${segmentText(insideBox(from.map(digits)), insideBox(to.map(digits)))}`);
    },
  },
  erase: {
    cursor: "pointer",
    async up() {
      const [x, y] = place();
      let best = -1;
      let nearest = 12 / view.scale;
      run.description.obstacles.forEach((one, k) => {
        const distance = distanceTo(one, x, y);
        if (distance < nearest) [best, nearest] = [k, distance];
      });
      if (best >= 0) await changeRun(`remove_obstacle = ${best}`);
    },
  },
};

function chooseTool(name) {
  settings.tool = name;
  overlay.style.cursor = tools[name].cursor;
  for (const button of document.querySelectorAll("[data-tool]")) button.setAttribute("aria-pressed", button.dataset.tool === name);
}

function follow(disk) {
  settings.followed = disk;
  forgetTrails();
  run.isStale = true;
}

function connectPointer() {
  const placeOf = (event) => {
    const { left, top } = overlay.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  let pinch = null;
  overlay.addEventListener("pointerdown", (event) => {
    overlay.setPointerCapture(event.pointerId);
    pointer.others.set(event.pointerId, placeOf(event));
    if (pointer.others.size === 2) {
      pinch = [...pointer.others.values()];
      if (pointer.isDown) tools[settings.tool].cancel?.();
      pointer.isDown = false;
      return;
    }
    [pointer.x, pointer.y] = placeOf(event);
    Object.assign(pointer, { isDown: true, startX: pointer.x, startY: pointer.y });
    tools[settings.tool].down?.();
    run.isStale = true;
  });
  overlay.addEventListener("pointermove", (event) => {
    const [x, y] = placeOf(event);
    if (pointer.others.has(event.pointerId)) pointer.others.set(event.pointerId, [x, y]);
    if (pointer.others.size === 2 && pinch) {
      const now = [...pointer.others.values()];
      const apart = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
      zoom(apart(now) / Math.max(apart(pinch), 1), (now[0][0] + now[1][0]) / 2, (now[0][1] + now[1][1]) / 2);
      pinch = now;
      return;
    }
    const [dx, dy] = [x - pointer.x, y - pointer.y];
    [pointer.x, pointer.y] = [x, y];
    if (pointer.isDown) tools[settings.tool].move?.(dx, dy);
    if (pointer.isDown || tools[settings.tool].draw) run.isStale = true;
  });
  const end = (event) => {
    pointer.others.delete(event.pointerId);
    if (pointer.others.size < 2) pinch = null;
    if (!pointer.isDown) return;
    pointer.isDown = false;
    if (event.type === "pointerup") tools[settings.tool].up?.();
    else tools[settings.tool].cancel?.();
    run.isStale = true;
  };
  overlay.addEventListener("pointerup", end);
  overlay.addEventListener("pointercancel", end);
  overlay.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 0.0022), ...placeOf(event));
  }, { passive: false });
  overlay.addEventListener("dblclick", () => settings.tool === "hand" && (fitView(), (run.isStale = true)));
}
