// Draws one moment: box, fixed shapes, disks to scale, and the trails, arrows and images that the reader has switched on.
"use strict";

let context = canvas.getContext("2d", { alpha: false });  // context of the canvas that is drawn on
const stageContext = context;
const bucket = new Uint8Array(disks);        // colour number of each disk
const ordered = new Uint32Array(disks);      // disks by colour, so that each colour is set once
const bucketEnd = new Uint32Array(colourSteps + 2);  // one colour more is that of disks without a value
let colours = [];

/// Sorts the disks by their colours at the moment.
function colourDisks(moment) {
  const colouring = colourings[settings.colourBy];
  colours = colouring.colours ? colouring.colours() : scaleColours.cached(settings.palette, theme.isDark);
  const uncoloured = colours.length;
  if (colouring.isCut) colours = [...colours, theme.frame];
  if (colouring.prepare) colouring.prepare(moment);
  bucketEnd.fill(0);
  for (let i = 0; i < disks; ++i) {
    const value = colouring.value(moment, i);
    bucket[i] = colouring.isKind ? value : Math.min(Math.max(Math.floor(value * colourSteps), 0), colourSteps - 1);
    if (colouring.isCut?.(i)) bucket[i] = uncoloured;
    ++bucketEnd[bucket[i] + 1];
  }
  for (let b = 0; b <= colourSteps; ++b) bucketEnd[b + 1] += bucketEnd[b];
  const place = bucketEnd.slice(0, colourSteps + 1);
  for (let i = 0; i < disks; ++i) ordered[place[bucket[i]]++] = i;
}
scaleColours.cached = (() => {
  let key = "";
  let kept = [];
  return (name, isDark) => {
    if (key !== name + isDark) kept = scaleColours(name, isDark);
    key = name + isDark;
    return kept;
  };
})();

/// Draws each disk that can be seen within `frame` (in pixels) as a circle of its own, which browsers draw faster than many in
/// one path.
function drawDisks(moment, shifts, frame) {
  const isOutlined = moment.scale * view.scale * largestRadius >= outlinedFrom;
  context.strokeStyle = theme.isDark ? "rgba(255,255,255,0.35)" : "rgba(0,0,0,0.4)";
  context.lineWidth = 1;
  for (const shift of shifts) {
    const offsetX = shift[0] * box.lengths[0] + shift[1] * moment.displacement;
    const offsetY = shift[1] * box.lengths[1];
    const isImage = shift[0] !== 0 || shift[1] !== 0;
    context.globalAlpha = isImage && settings.ghosts ? 0.32 : 1;
    for (let b = 0; b < colours.length; ++b) {
      if (bucketEnd[b] < bucketEnd[b + 1]) context.fillStyle = colours[b];
      for (let k = bucketEnd[b]; k < bucketEnd[b + 1]; ++k) {
        const i = ordered[k];
        const r = radius[i] * moment.scale * view.scale;
        const px = pixelX(moment.x[i] + offsetX);
        const py = pixelY(moment.y[i] + offsetY);
        if (px + r < frame.left || px - r > frame.right || py + r < frame.top || py - r > frame.bottom) continue;
        if (r < 1) {
          context.fillRect(px - r, py - r, 2 * r, 2 * r);  // smaller than a pixel: a square looks the same
        } else {
          context.beginPath();
          context.arc(px, py, r, 0, 2 * Math.PI);
          context.fill();
          if (isOutlined) context.stroke();
        }
      }
    }
  }
  context.globalAlpha = 1;
}
const outlinedFrom = 5;  // pixels: the outline would cover a smaller disk
const largestRadius = radius.reduce((most, r) => Math.max(most, r), 0);

function boxPath(moment) {
  const [left, right, bottom, top] = moment.walls;
  context.beginPath();
  if (box.isCircle) return circlePath((left + right) / 2, (bottom + top) / 2, (right - left) / 2, 0);
  context.rect(pixelX(left), pixelY(top), (right - left) * view.scale, (top - bottom) * view.scale);
}

/// Adds a circle to the path, its radius longer by some pixels.
function circlePath(x, y, radius, more) {
  const length = radius * view.scale + more;
  context.moveTo(pixelX(x) + length, pixelY(y));
  context.arc(pixelX(x), pixelY(y), length, 0, 2 * Math.PI);
}

/// Draws walls as solid lines outside the box, and periodic edges as dashed lines.
function drawEdges(moment) {
  const [left, right, bottom, top] = moment.walls;
  const thick = 3;
  if (box.isCircle) {
    context.strokeStyle = theme.ink;
    context.lineWidth = thick;
    context.beginPath();
    circlePath((left + right) / 2, (bottom + top) / 2, (right - left) / 2, thick / 2);
    context.stroke();
    return;
  }
  const lines = [
    [left, bottom, left, top, -1, 0],
    [right, bottom, right, top, 1, 0],
    [left, bottom, right, bottom, 0, 1],
    [left, top, right, top, 0, -1],
  ];
  lines.forEach(([x0, y0, x1, y1, outX, outY], side) => {
    const isPeriodic = box.periodic[side < 2 ? 0 : 1];
    const off = isPeriodic ? 0 : thick / 2;
    context.strokeStyle = isPeriodic ? theme.frame : theme.ink;
    context.lineWidth = isPeriodic ? 1 : thick;
    context.setLineDash(isPeriodic ? [5, 5] : []);
    context.lineCap = isPeriodic ? "butt" : "square";
    context.beginPath();
    context.moveTo(pixelX(x0) + outX * off, pixelY(y0) + outY * off);
    context.lineTo(pixelX(x1) + outX * off, pixelY(y1) + outY * off);
    context.stroke();
  });
  context.setLineDash([]);
  context.lineCap = "round";
}

/** The fixed shapes at a time: the scene may change them. */
function shapesAt(time) {
  let shapes = description.shapes;
  for (const change of description.laterShapes ?? []) {
    if (change.time < time) shapes = change.shapes;
  }
  return shapes;
}

function drawShapes(shifts, time) {
  const shapes = shapesAt(time);
  for (const [a, b] of shifts) {
    context.beginPath();
    for (const shape of shapes) {
      if (shape.centre === undefined || shape.angles !== undefined) continue;
      const px = pixelX(shape.centre[0] + a * box.lengths[0]);
      const py = pixelY(shape.centre[1] + b * box.lengths[1]);
      context.moveTo(px + shape.radius * view.scale, py);
      context.arc(px, py, shape.radius * view.scale, 0, 2 * Math.PI);
    }
    context.fillStyle = theme.solid;
    context.fill();
    context.beginPath();
    for (const { centre, radius: size, angles } of shapes) {
      if (angles === undefined || (box.isCircle && angles[1] - angles[0] >= 360)) continue;
      const [first, last] = angles.map((angle) => (-angle * Math.PI) / 180);
      const [px, py] = [pixelX(centre[0] + a * box.lengths[0]), pixelY(centre[1] + b * box.lengths[1])];
      context.moveTo(px + size * view.scale * Math.cos(first), py + size * view.scale * Math.sin(first));
      context.arc(px, py, size * view.scale, first, last, true);
    }
    for (const { from, to } of shapes) {
      if (from === undefined) continue;
      context.moveTo(pixelX(from[0] + a * box.lengths[0]), pixelY(from[1] + b * box.lengths[1]));
      context.lineTo(pixelX(to[0] + a * box.lengths[0]), pixelY(to[1] + b * box.lengths[1]));
    }
    context.strokeStyle = theme.solid;
    context.lineWidth = 2;
    context.stroke();
  }
}

function drawTrails(moment, shifts, frame) {
  const isOne = disks > 5000;  // the trails of more disks would cover the box
  const fallen = Math.hypot(...description.acceleration) * trailTime;
  context.strokeStyle = theme.accent;
  context.globalAlpha = 0.45;
  context.lineWidth = 1;  // browsers draw broader lines many times more slowly
  for (const [a, b] of shifts) {
    for (let i = 0; i < disks; ++i) {
      if (isOne && i !== settings.followed) continue;
      const px = pixelX(moment.x[i] + a * box.lengths[0] + b * moment.displacement);
      const py = pixelY(moment.y[i] + b * box.lengths[1]);
      // The path of an image outside the frame reaches into it only if the disk was much faster before.
      const reach = 2 * (speedOf(moment, i) + fallen) * trailTime * view.scale;
      if (px + reach < frame.left || px - reach > frame.right || py + reach < frame.top || py - reach > frame.bottom) continue;
      context.beginPath();
      tracePath(context, i, moment, px, py);
      context.stroke();
    }
  }
  context.globalAlpha = 1;
}

/// Draws velocities as arrows from the rim of each disk; the typical speed is 3.5 % of the box long.
function drawArrows(moment) {
  const unit = (0.035 * Math.min(extent[1] - extent[0], extent[3] - extent[2]) * view.scale) / speedScale;
  const head = 4;
  context.strokeStyle = theme.ink;
  context.lineWidth = 1;
  for (let i = 0; i < disks; ++i) {
    const dx = moment.vx[i] * unit;
    const dy = -moment.vy[i] * unit;
    const length = Math.hypot(dx, dy);
    if (length < 1) continue;
    const ux = dx / length;
    const uy = dy / length;
    const r = radius[i] * moment.scale * view.scale;
    const px = pixelX(moment.x[i]) + r * ux;
    const py = pixelY(moment.y[i]) + r * uy;
    const size = Math.min(head, length / 2);
    context.beginPath();
    context.moveTo(px, py);
    context.lineTo(px + dx, py + dy);
    context.moveTo(px + dx - size * (ux + 0.6 * uy), py + dy - size * (uy - 0.6 * ux));
    context.lineTo(px + dx, py + dy);
    context.lineTo(px + dx - size * (ux - 0.6 * uy), py + dy - size * (uy + 0.6 * ux));
    context.stroke();
  }
}

function drawRing(moment, i, colour, width) {
  context.beginPath();
  context.arc(pixelX(moment.x[i]), pixelY(moment.y[i]), radius[i] * moment.scale * view.scale + 1 + width, 0, 2 * Math.PI);
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

/// Marks the disks that have just collided, where the moment is that of a collision.
function drawCollision(moment) {
  const e = moment.done - 1;
  if (!description.exact || settings.isPlaying || e < 0 || columns.time[e] !== moment.time) return;
  if (columns.partner[e] === disks + 4) return;
  drawRing(moment, columns.disk[e], theme.ink, 2);
  if (columns.partner[e] < disks) drawRing(moment, columns.partner[e], theme.ink, 2);
}

/// Draws the moment on a canvas of the size of the stage.
function drawMoment(moment, target = stageContext) {
  context = target;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, canvas.width, canvas.height);  // with the last row and column, of which the page may show a part
  context.setTransform(view.density, 0, 0, view.density, 0, 0);
  boxPath(moment);
  context.fillStyle = theme.stage;
  context.fill();
  colourDisks(moment);
  const showsImages = settings.ghosts && (box.periodic[0] || box.periodic[1]);
  const shifts = visibleShifts(showsImages, moment);
  context.save();
  if (!showsImages) {
    boxPath(moment);
    context.clip();  // an image shows on the other side what the edge cuts off
  }
  drawShapes(shifts, moment.time);
  const [left, right, bottom, top] = moment.walls;
  const boxFrame = { left: pixelX(left), right: pixelX(right), top: pixelY(top), bottom: pixelY(bottom) };
  const frame = showsImages ? { left: 0, right: view.width, top: 0, bottom: view.height } : boxFrame;
  if (settings.trails) drawTrails(moment, shifts, frame);
  if (settings.areMany) rasterDisks(moment, shifts, frame);
  else drawDisks(moment, shifts, frame);
  context.restore();
  if (settings.arrows) drawArrows(moment);
  drawEdges(moment);
  if (settings.followed >= 0) drawRing(moment, settings.followed, theme.accent, 3);
}
