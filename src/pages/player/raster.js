// Draws disks pixel by pixel. For more than a thousand disks this is several times as fast as the browser's circles. Hard disks do
// not overlap, so the cost is a few operations per pixel of the canvas at any zoom.
"use strict";

const raster = { canvas: new OffscreenCanvas(1, 1), image: null, pixels: null };
raster.context = raster.canvas.getContext("2d");

/// Makes the raster as large as the canvas, and empty.
function clearRaster() {
  if (raster.image && raster.image.width === canvas.width && raster.image.height === canvas.height) {
    raster.pixels.fill(0);
    return;
  }
  raster.canvas.width = canvas.width;
  raster.canvas.height = canvas.height;
  raster.image = raster.context.createImageData(canvas.width, canvas.height);
  raster.pixels = new Uint32Array(raster.image.data.buffer);
}

/// Fills a circle, with its outermost pixels in the colour of the rim. The coverage of a pixel follows from the distance of its
/// middle from the edge.
function rasterCircle(x, y, r, colour, rim, opacity) {
  const { width, height } = raster.image;
  const { pixels } = raster;
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
  clearRaster();
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
