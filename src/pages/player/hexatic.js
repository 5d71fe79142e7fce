// Voronoi cells of the disks, and what they say of the order round each: as `carom movie` and the observable voronoi have them
// (docs/observables.md). Psi = mean of exp(6 i theta) over the neighbours, weighted by the lengths of the sides; 1 in a perfect
// crystal. Where centres form exact rectangles, both diagonals have length 0 and count as no sides.
"use strict";

/// The axes of psi from -30 to 30 degrees as a number from 0 to 1, and the kind of a disk in neighbourColours().
const axisOf = (order, i) => Math.atan2(order.im[i], order.re[i]) / (2 * Math.PI) + 0.5;
const neighbourKind = (order, i) => Math.min(Math.max(order.neighbours[i], 4), 8) - 4;

const cellsOffered = disks >= 3 && disks <= 5000;

/// Writes the real and imaginary part of psi, its size, and the number of neighbours of every disk into `order`; 0 neighbours where a
/// wall, or the rim of a circular box, cuts the cell off. A cell is the box round its disk, cut by the bisector to one neighbour after
/// the other; these are searched in square cells of about two disks, ring after ring, until the rest is too far away to cut. Under
/// shear the rows of square cells above the box are displaced by whole cells, and disks by their part of one besides.
function findOrder(moment, order) {
  const left = box.periodic[0] ? box.lower[0] : moment.walls[0];
  const bottom = box.periodic[1] ? box.lower[1] : moment.walls[2];
  const width = box.periodic[0] ? box.lengths[0] : moment.walls[1] - left;
  const height = box.periodic[1] ? box.lengths[1] : moment.walls[3] - bottom;
  const side = Math.sqrt((2 * width * height) / disks);
  const across = Math.max(1, Math.floor(width / side));
  const up = Math.max(1, Math.floor(height / side));
  const head = new Int32Array(across * up).fill(-1);
  const next = new Int32Array(disks);
  const cell = (value, from, length, count) => Math.min(Math.max(Math.floor(((value - from) / length) * count), 0), count - 1);
  for (let i = 0; i < disks; ++i) {
    const at = cell(moment.x[i], left, width, across) + across * cell(moment.y[i], bottom, height, up);
    next[i] = head[at];
    head[at] = i;
  }
  const step = Math.min(width / across, height / up);
  const slid = Math.round((moment.displacement / width) * across);  // cells by which a row above is displaced, to the nearest
  const most = 64;  // corners of a cell
  const wall = -1;  // the label of a side that is one
  let x = new Float64Array(most), y = new Float64Array(most), label = new Int32Array(most), count = 0;
  let newX = new Float64Array(most), newY = new Float64Array(most), newLabel = new Int32Array(most);
  const toX = [];
  const toY = [];
  /// Cuts away what is nearer to (dx, dy) than to 0. Side k runs from corner k to the next.
  const cut = (dx, dy) => {
    const half = 0.5 * (dx * dx + dy * dy);
    const slack = 1e-12 * half;
    const beyond = (k) => x[k] * dx + y[k] * dy - half;
    let outside = 0;
    for (let k = 0; k < count; ++k) if (beyond(k) > slack) ++outside;
    if (outside === 0) return;
    const mark = toX.push(dx) - 1;
    toY.push(dy);
    let kept = 0;
    const put = (px, py, name) => {
      newX[kept] = px;
      newY[kept] = py;
      newLabel[kept++] = name;
    };
    for (let k = 0; k < count && kept < most - 2; ++k) {
      const to = (k + 1) % count;
      const a = beyond(k);
      const b = beyond(to);
      if (a <= slack) put(x[k], y[k], label[k]);
      if (a <= slack !== b <= slack) {
        const share = a / (a - b);
        put(x[k] + share * (x[to] - x[k]), y[k] + share * (y[to] - y[k]), a <= slack ? mark : label[k]);
      }
    }
    [x, newX] = [newX, x];
    [y, newY] = [newY, y];
    [label, newLabel] = [newLabel, label];
    count = kept;
  };
  for (let i = 0; i < disks; ++i) {
    const mx = moment.x[i];
    const my = moment.y[i];
    const west = box.periodic[0] ? -2 * width : left - mx;
    const east = box.periodic[0] ? 2 * width : left + width - mx;
    const south = box.periodic[1] ? -2 * height : bottom - my;
    const north = box.periodic[1] ? 2 * height : bottom + height - my;
    x.set([west, east, east, west]);
    y.set([south, south, north, north]);
    label.set([wall, wall, wall, wall]);
    count = 4;
    toX.length = toY.length = 0;
    const cx = cell(mx, left, width, across);
    const cy = cell(my, bottom, height, up);
    const farthest = () => {
      let square = 0;
      for (let k = 0; k < count; ++k) square = Math.max(square, x[k] * x[k] + y[k] * y[k]);
      return Math.sqrt(square);
    };
    const rings = 2 * Math.max(across, up) + 2;
    for (let ring = 0; ring <= rings && (ring - (moment.displacement === 0 ? 1 : 1.5)) * step <= 2 * farthest(); ++ring) {
      for (let b = -ring; b <= ring; ++b) {
        for (let a = -ring; a <= ring; a += Math.abs(b) === ring ? 1 : Math.max(2 * ring, 1)) {
          const boxY = Math.floor((cy + b) / up);
          const column = cx + a - boxY * slid;
          const boxX = Math.floor(column / across);
          if ((!box.periodic[0] && boxX !== 0) || (!box.periodic[1] && boxY !== 0)) continue;
          for (let j = head[column - boxX * across + across * (cy + b - boxY * up)]; j >= 0; j = next[j]) {
            if (j === i && boxX === 0 && boxY === 0) continue;
            cut(moment.x[j] + boxX * width + boxY * moment.displacement - mx, moment.y[j] + boxY * height - my);
          }
        }
      }
    }
    let re = 0;
    let im = 0;
    let perimeter = 0;
    let neighbours = 0;
    let isAtWall = false;
    for (let k = 0; k < count; ++k) {
      if (box.isCircle && Math.hypot(mx + x[k] - left - width / 2, my + y[k] - bottom - height / 2) > width / 2) isAtWall = true;
      const to = (k + 1) % count;
      const length = Math.hypot(x[to] - x[k], y[to] - y[k]);
      if (length < 1e-9 * side) continue;
      if (label[k] === wall) {
        isAtWall = true;
        continue;
      }
      const angle = 6 * Math.atan2(toY[label[k]], toX[label[k]]);
      re += length * Math.cos(angle);
      im += length * Math.sin(angle);
      perimeter += length;
      ++neighbours;
    }
    order.re[i] = perimeter > 0 ? re / perimeter : 0;
    order.im[i] = perimeter > 0 ? im / perimeter : 0;
    order.size[i] = Math.hypot(order.re[i], order.im[i]);
    order.neighbours[i] = isAtWall ? 0 : neighbours;
  }
}
