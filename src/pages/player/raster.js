// Draws disks pixel by pixel. For more than a thousand disks this is several times as fast as the browser's circles. Hard disks do
// not overlap, so the cost is a few operations per pixel of the canvas at any zoom.
"use strict";

const raster = { canvas: new OffscreenCanvas(1, 1), image: null, pixels: null };
raster.context = raster.canvas.getContext("2d");

/// Makes the raster as large as it is told, and empty.
function clearRaster(width, height) {
  if (raster.image && raster.image.width === width && raster.image.height === height) {
    raster.pixels.fill(0);
    return;
  }
  raster.canvas.width = width;
  raster.canvas.height = height;
  raster.image = raster.context.createImageData(width, height);
  raster.pixels = new Uint32Array(raster.image.data.buffer);
  stamps.clear();
}

const stamps = new Map();  // the pixels of small circles, by radius and place within a pixel, all in eighths of a pixel

/// Returns the pixels of a circle, counted from the one that its middle is in: those inside, and those at the edge with their coverage.
function stampOf(eighths, across, down) {
  const key = (eighths * 8 + down) * 8 + across;
  const known = stamps.get(key);
  if (known) return known;
  const r = eighths / 8;
  const inside = [];
  const edge = [];
  const shares = [];
  for (let row = -eighths; row <= eighths; ++row) {
    for (let column = -eighths; column <= eighths; ++column) {
      const square = (column + 0.5 - (across + 0.5) / 8) ** 2 + (row + 0.5 - (down + 0.5) / 8) ** 2;
      if (square >= (r + 0.5) ** 2) continue;
      if (r >= 1 && square <= (r - 1) ** 2) inside.push(row * raster.image.width + column);
      else edge.push(row * raster.image.width + column) && shares.push(Math.round(255 * Math.min(r + 0.5 - Math.sqrt(square), 1)));
    }
  }
  const made = { inside: Int32Array.from(inside), edge: Int32Array.from(edge), shares: Uint8Array.from(shares) };
  stamps.set(key, made);
  return made;
}

/// Fills a small circle that is whole within the raster: within a sixteenth of a pixel as rasterCircle() does, several times as fast.
function stampCircle(x, y, r, colour, rim) {
  const { pixels } = raster;
  const [column, row] = [Math.floor(x), Math.floor(y)];
  const { inside, edge, shares } = stampOf(Math.round(8 * r), Math.floor(8 * (x - column)), Math.floor(8 * (y - row)));
  const middle = row * raster.image.width + column;
  const whole = (0xff000000 | colour) >>> 0;
  for (let k = 0; k < inside.length; ++k) pixels[middle + inside[k]] = whole;
  for (let k = 0; k < edge.length; ++k) {
    const share = shares[k];
    if (share > pixels[middle + edge[k]] >>> 24) pixels[middle + edge[k]] = ((share << 24) | rim) >>> 0;
  }
}

/// Fills a circle, with its outermost pixels in the colour of the rim. The coverage of a pixel follows from the distance of its
/// middle from the edge.
function rasterCircle(x, y, r, colour, rim, opacity) {
  const { width, height } = raster.image;
  const { pixels } = raster;
  const reach = r + 2;
  if (r < 8 && opacity === 255 && x > reach && x < width - reach && y > reach && y < height - reach) return stampCircle(x, y, r, colour, rim);
  const inner = Math.max(r - 1, 0) ** 2;
  const outer = (r + 0.5) ** 2;
  const left = Math.max(Math.floor(x - r - 0.5), 0);
  const right = Math.min(Math.ceil(x + r + 0.5), width);
  const bottom = Math.min(Math.ceil(y + r + 0.5), height);
  const whole = ((opacity << 24) | colour) >>> 0;
  for (let row = Math.max(Math.floor(y - r - 0.5), 0); row < bottom; ++row) {
    const dy = row + 0.5 - y;
    for (let column = left, at = row * width + left; column < right; ++column, ++at) {
      const dx = column + 0.5 - x;
      const square = dx * dx + dy * dy;
      if (square >= outer) continue;
      if (square <= inner) {
        pixels[at] = whole;
      } else {
        const share = Math.round(opacity * Math.min(r + 0.5 - Math.sqrt(square), 1));
        if (share > pixels[at] >>> 24) pixels[at] = ((share << 24) | rim) >>> 0;
      }
    }
  }
}

function rasterDisks(moment, shifts, frame) {
  clearRaster(canvas.width, canvas.height);
  const { density } = view;
  const number = (text) => parseInt(text.slice(5, 7) + text.slice(3, 5) + text.slice(1, 3), 16);  // blue, green, red
  const numbers = colours.map(number);
  const isOutlined = moment.scale * view.scale * largestRadius >= outlinedFrom;
  const rims = isOutlined ? colours.map((text) => number(mixed(text, theme.isDark ? "#ffffff" : "#000000", 0.35))) : numbers;
  for (const [a, b] of shifts) {
    const offsetX = a * box.lengths[0] + b * moment.displacement;
    const offsetY = b * box.lengths[1];
    const opacity = (a !== 0 || b !== 0) && settings.ghosts ? 82 : 255;
    for (let i = 0; i < disks; ++i) {
      const r = radius[i] * moment.scale * view.scale;
      const px = pixelX(moment.x[i] + offsetX);
      const py = pixelY(moment.y[i] + offsetY);
      if (px + r < frame.left || px - r > frame.right || py + r < frame.top || py - r > frame.bottom) continue;
      rasterCircle(density * px, density * py, density * r, numbers[bucket[i]], rims[bucket[i]], opacity);
    }
  }
  raster.context.putImageData(raster.image, 0, 0);
  context.save();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.drawImage(raster.canvas, 0, 0);
  context.restore();
}
