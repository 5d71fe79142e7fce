// The view: the map from lengths of the run to pixels and back, zoom, and the disk that the view follows.
"use strict";

const stages = [...document.querySelectorAll(".stage canvas")];  // one box, or two with one view
const canvas = stages[0];
const view = { width: 1, height: 1, density: 1, scale: 1, x: 0, y: 0 };  // scale: pixels per length; x, y: the position in the middle

/// The largest extent of the box during the run: at a few moments, and where walls that vibrate turn.
const extent = (() => {
  const moment = emptyMoment();
  const found = [Infinity, -Infinity, Infinity, -Infinity];
  for (let k = 0; k <= 64; ++k) {
    const time = (replay.duration * k) / 64;
    replay.read(time, replay.doneAt(time), moment);
    for (let side = 0; side < 4; ++side)
      found[side] = side % 2 ? Math.max(found[side], moment.walls[side]) : Math.min(found[side], moment.walls[side]);
  }
  for (const { side, low, high } of description.vibrations ?? [])
    found[side] = side % 2 ? Math.max(found[side], high) : Math.min(found[side], low);
  return found;
})();

let isFitted = true;  // until the reader zooms or moves it
function fitView() {
  isFitted = true;
  const margin = 0.92;
  view.scale = margin * Math.min(view.width / (extent[1] - extent[0]), view.height / (extent[3] - extent[2]));
  view.x = (extent[0] + extent[1]) / 2;
  view.y = (extent[2] + extent[3]) / 2;
  change({ followed: -1 });
}

const pixelX = (x) => (x - view.x) * view.scale + view.width / 2;
const pixelY = (y) => view.height / 2 - (y - view.y) * view.scale;
const placeX = (px) => (px - view.width / 2) / view.scale + view.x;
const placeY = (py) => (view.height / 2 - py) / view.scale + view.y;

/// Zooms by a factor; the position under the pixel stays there.
function zoom(factor, px = view.width / 2, py = view.height / 2) {
  isFitted = false;
  const x = placeX(px);
  const y = placeY(py);
  const whole = Math.min(view.width / (extent[1] - extent[0]), view.height / (extent[3] - extent[2]));
  view.scale = Math.min(Math.max(view.scale * factor, 0.1 * whole), 1e5 * whole);
  view.x += x - placeX(px);
  view.y += y - placeY(py);
}

function pan(dx, dy) {
  isFitted = false;
  view.x -= dx / view.scale;
  view.y += dy / view.scale;
}

/// Moves the followed disk to the middle.
function followView(moment) {
  if (settings.followed < 0) return;
  view.x = moment.x[settings.followed];
  view.y = moment.y[settings.followed];
}

/// Gives every canvas the size that the page gives the first.
function resizeView() {
  const { width, height } = canvas.getBoundingClientRect();
  Object.assign(view, { width, height, density: window.devicePixelRatio || 1 });
  for (const stage of stages) {
    stage.width = Math.round(width * view.density);
    stage.height = Math.round(height * view.density);
  }
  if (isFitted && settings.followed < 0) fitView();
}

/// Returns the shifts, in box lengths, of the images to draw; those above a sheared box are displaced besides. With `all` these are
/// all that the view reaches, else only those that an edge of the box cuts off.
function visibleShifts(all, moment) {
  const most = 4;  // boxes to each side
  const range = (axis, low, high) => {
    if (!box.periodic[axis]) return [0, 1];
    if (!all) return [-0.5, 1.5];
    const count = (value) => Math.min(Math.max((value - box.lower[axis]) / box.lengths[axis], -most), most + 1);
    return [count(low), count(high)];
  };
  const [left, right] = range(0, placeX(0), placeX(view.width));
  const [bottom, top] = range(1, placeY(view.height), placeY(0));
  const shifts = [];
  for (let b = Math.floor(bottom); b < top; ++b) {
    const aside = (b * moment.displacement) / box.lengths[0];
    for (let a = Math.floor(left - aside); a < right - aside; ++a) shifts.push([a, b]);
  }
  return shifts;
}

/// Returns the disk at a pixel, or -1.
function diskAt(px, py, moment) {
  const x = placeX(px);
  const y = placeY(py);
  const reach = 4 / view.scale;  // pixels of tolerance round a small disk
  let best = -1;
  let nearest = Infinity;
  for (let i = 0; i < disks; ++i) {
    let dx = x - moment.x[i];
    let dy = y - moment.y[i];
    if (box.periodic[0]) dx -= Math.round(dx / box.lengths[0]) * box.lengths[0];
    if (box.periodic[1]) dy -= Math.round(dy / box.lengths[1]) * box.lengths[1];
    const distance = Math.hypot(dx, dy) - radius[i] * moment.scale;
    if (distance < Math.min(reach, nearest)) {
      nearest = distance;
      best = i;
    }
  }
  return best;
}
