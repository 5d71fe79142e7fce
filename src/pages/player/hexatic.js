// Sixfold order: psi = mean over the six nearest neighbours of exp(6 i theta), as in docs/observables.md; 1 in a perfect crystal.
"use strict";

const hexaticOffered = disks >= 7 && disks <= 5000;

/// Writes |psi| of every disk into `order`. Neighbours are searched in square cells of about two disks.
function hexaticOrder(moment, order) {
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
  const square = new Float64Array(6);
  const toX = new Float64Array(6);
  const toY = new Float64Array(6);
  const cellWidth = width / across;
  const cellHeight = height / up;
  for (let i = 0; i < disks; ++i) {
    const cx = cell(moment.x[i], left, width, across);
    const cy = cell(moment.y[i], bottom, height, up);
    let found = 0;
    // Search ring after ring of cells, until the sixth neighbour is nearer than the next ring, or all cells are searched.
    for (let ring = 0; ring <= Math.max(across, up); ++ring) {
      if (found === 6 && square[5] <= ((ring - 1) * Math.min(cellWidth, cellHeight)) ** 2) break;
      for (let b = -ring; b <= ring; ++b) {
        for (let a = -ring; a <= ring; a += Math.abs(b) === ring ? 1 : Math.max(2 * ring, 1)) {
          let ax = cx + a;
          let by = cy + b;
          if (box.periodic[0] && (2 * Math.abs(a) > across || 2 * a === -across)) continue;  // the nearest image is on the other side
          if (box.periodic[1] && (2 * Math.abs(b) > up || 2 * b === -up)) continue;
          if (box.periodic[0]) ax = (ax + across) % across;
          if (box.periodic[1]) by = (by + up) % up;
          if (ax < 0 || by < 0 || ax >= across || by >= up) continue;
          for (let j = head[ax + across * by]; j >= 0; j = next[j]) {
            if (j === i) continue;
            let dx = moment.x[j] - moment.x[i];
            let dy = moment.y[j] - moment.y[i];
            if (box.periodic[0]) dx -= Math.round(dx / width) * width;
            if (box.periodic[1]) dy -= Math.round(dy / height) * height;
            const d = dx * dx + dy * dy;
            if (found === 6 && d >= square[5]) continue;
            let at = found < 6 ? found++ : 5;
            for (; at > 0 && square[at - 1] > d; --at) {
              square[at] = square[at - 1];
              toX[at] = toX[at - 1];
              toY[at] = toY[at - 1];
            }
            square[at] = d;
            toX[at] = dx;
            toY[at] = dy;
          }
        }
      }
    }
    let re = 0;
    let im = 0;
    for (let k = 0; k < found; ++k) {
      const angle = 6 * Math.atan2(toY[k], toX[k]);
      re += Math.cos(angle);
      im += Math.sin(angle);
    }
    order[i] = found > 0 ? Math.hypot(re, im) / found : 0;
  }
}
