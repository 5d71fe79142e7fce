// Voronoi cells of the disks, and what they say of the order round each: as `carom movie` and the observable voronoi have them
// (docs/observables.md). Psi = mean of exp(6 i theta) over the neighbours, weighted by the lengths of the sides; 1 in a perfect
// crystal. Where centres form exact rectangles, both diagonals have length 0 and count as no sides, as in films; the observable
// counts one of them.
"use strict";

/// The axes of psi from -30 to 30 degrees as a number from 0 to 1, and the kind of a disk in neighbourColours().
const axisOf = (order, i) => Math.atan2(order.im[i], order.re[i]) / (2 * Math.PI) + 0.5;
const neighbourKind = (order, i) => Math.min(Math.max(order.neighbours[i], 4), 8) - 4;

const cellsOffered = disks >= 3 && disks <= 5000;

/// Returns the centres of the circles through the corners of triangles, which are the corners of Voronoi cells: [x, y, x, y, ...].
function circleCentres(triangles, places) {
  const centres = new Float64Array((2 * triangles.length) / 3);
  for (let t = 0; t < centres.length; t += 2) {
    const i = 2 * triangles[1.5 * t];
    const j = 2 * triangles[1.5 * t + 1];
    const k = 2 * triangles[1.5 * t + 2];
    const [ax, ay, bx, by] = [places[j] - places[i], places[j + 1] - places[i + 1], places[k] - places[i], places[k + 1] - places[i + 1]];
    const [a, b, area] = [ax * ax + ay * ay, bx * bx + by * by, ax * by - ay * bx];
    centres[t] = places[i] + (a * by - b * ay) / (2 * area);
    centres[t + 1] = places[i + 1] + (b * ax - a * bx) / (2 * area);
  }
  return centres;
}

/// Writes the real and imaginary part of psi, its size, and the number of neighbours of every disk into `order`; 0 neighbours where a
/// wall, or the rim of a circular box, cuts the cell off. Cells follow from the Delaunay triangulation of the disks and of images
/// outside the box: copies where it is periodic, those above a sheared one displaced, and reflections at walls, so that a disk and
/// its own reflection have the wall between them. All lengths are in mean spacings of the disks.
function findOrder(moment, order) {
  const [left, right] = box.periodic[0] ? [box.lower[0], box.upper[0]] : moment.walls;
  const [bottom, top] = box.periodic[1] ? [box.lower[1], box.upper[1]] : [moment.walls[2], moment.walls[3]];
  const spacing = Math.sqrt(((right - left) * (top - bottom)) / disks);
  const width = (right - left) / spacing;
  const height = (top - bottom) / spacing;
  const displacement = moment.displacement / spacing;
  // Along an axis, a corner of a cell is at most half a box outside, and at most half a box from the nearest image of any disk. Between
  // walls it is inside, and at most a box from that image. Images up to a box outside are all that count, under shear up to a diagonal.
  const isSheared = displacement !== 0;
  const [reachX, reachY] = [width, height].map((length, axis) => (isSheared ? Infinity : box.periodic[axis] ? length / 2 : length));
  const [mostX, mostY] = [width, height].map((length) => 1.001 * (isSheared ? Math.hypot(width, height) : length));

  /// Finds the cells from images up to `margin` outside the box. Returns whether these are enough: whether the circle round each corner
  /// of a cell through its disk, which must have no other centre in it, is where all images are.
  const findCells = (margin) => {
    const marginX = Math.min(margin, mostX);
    const marginY = Math.min(margin, mostY);
    const isBeyond = (x, y, dx, dy) => x - dx < -marginX || x + dx > width + marginX || y - dy < -marginY || y + dy > height + marginY;
    const places = [];
    for (let i = 0; i < disks; ++i) places.push((moment.x[i] - left) / spacing, (moment.y[i] - bottom) / spacing);
    const isReflected = new Array(disks).fill(false);
    for (let b = -Math.ceil(marginY / height); b * height < height + marginY; ++b) {
      const aside = b * displacement;
      for (let a = Math.floor((-marginX - aside) / width); a * width < width + marginX - aside; ++a) {
        const turnsX = !box.periodic[0] && a % 2 !== 0;
        const turnsY = !box.periodic[1] && b % 2 !== 0;
        for (let i = 0; i < disks && (a !== 0 || b !== 0); ++i) {
          const x = a * width + aside + (turnsX ? width - places[2 * i] : places[2 * i]);
          const y = b * height + (turnsY ? height - places[2 * i + 1] : places[2 * i + 1]);
          if (isBeyond(x, y, 0, 0)) continue;
          places.push(x, y);
          isReflected.push(turnsX || turnsY);
        }
      }
    }
    const { triangles, halfedges } = new Delaunator(places);
    const corners = circleCentres(triangles, places);
    const perimeter = new Float64Array(disks);
    const isCut = new Array(disks).fill(false);
    for (const numbers of [order.re, order.im, order.neighbours]) numbers.fill(0);
    for (let e = 0; e < triangles.length; ++e) {
      const i = triangles[e];
      if (i >= disks) continue;
      if (halfedges[e] < 0) return false;
      // The side between i and j ends at the corners of the two triangles that share the edge e from i to j.
      const j = triangles[e % 3 === 2 ? e - 2 : e + 1];
      const from = 2 * Math.floor(e / 3);
      const to = 2 * Math.floor(halfedges[e] / 3);
      const [x, y] = [corners[from], corners[from + 1]];
      const radius = Math.hypot(x - places[2 * i], y - places[2 * i + 1]);
      if (isBeyond(x, y, Math.min(radius, reachX), Math.min(radius, reachY))) return false;
      if (box.isCircle && Math.hypot(x - width / 2, y - height / 2) > width / 2) isCut[i] = true;
      const length = Math.hypot(corners[to] - x, corners[to + 1] - y);
      if (length < 1e-9) continue;
      if (isReflected[j]) {
        isCut[i] = true;
        continue;
      }
      const angle = 6 * Math.atan2(places[2 * j + 1] - places[2 * i + 1], places[2 * j] - places[2 * i]);
      order.re[i] += length * Math.cos(angle);
      order.im[i] += length * Math.sin(angle);
      perimeter[i] += length;
      ++order.neighbours[i];
    }
    for (let i = 0; i < disks; ++i) {
      order.re[i] /= Math.max(perimeter[i], 1e-9);
      order.im[i] /= Math.max(perimeter[i], 1e-9);
      order.size[i] = Math.hypot(order.re[i], order.im[i]);
      if (isCut[i]) order.neighbours[i] = 0;
    }
    return triangles.length > 0;
  };
  for (let margin = 3; !findCells(margin) && margin < Math.max(mostX, mostY); margin *= 2);
}
