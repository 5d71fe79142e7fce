// The stage: disks by WebGL where there is one, pixel by pixel elsewhere; walls, obstacles and tools on a canvas above.
"use strict";

const stage = document.getElementById("stage");
const overlay = document.getElementById("overlay");
const view = { width: 1, height: 1, density: 1, scale: 1, x: 0, y: 0, isFitted: true };
let panes = [{ left: 0, top: 0, width: 1, height: 1 }];  // one, or two beside each other with one view

const pixelX = (x, pane = panes[0]) => pane.left + (x - view.x) * view.scale + pane.width / 2;
const pixelY = (y, pane = panes[0]) => pane.top + pane.height / 2 - (y - view.y) * view.scale;
const placeX = (px, pane = panes[0]) => (px - pane.left - pane.width / 2) / view.scale + view.x;
const placeY = (py, pane = panes[0]) => (pane.top + pane.height / 2 - py) / view.scale + view.y;

/// Divides the stage, and fits the box into each part where the reader has not zoomed.
function layOut(isDouble) {
  const { width, height } = stage.getBoundingClientRect();
  Object.assign(view, { width, height, density: Math.min(window.devicePixelRatio || 1, 2) });
  for (const canvas of [stage, overlay]) {
    const size = [Math.max(1, Math.round(width * view.density)), Math.max(1, Math.round(height * view.density))];
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
  }
  const isWide = width >= height;
  panes = !isDouble ? [{ left: 0, top: 0, width, height }]
    : isWide ? [{ left: 0, top: 0, width: width / 2 - 2, height }, { left: width / 2 + 2, top: 0, width: width / 2 - 2, height }]
    : [{ left: 0, top: 0, width, height: height / 2 - 2 }, { left: 0, top: height / 2 + 2, width, height: height / 2 - 2 }];
  if (view.isFitted) fitView();
}

function fitView() {
  view.isFitted = true;
  if (!run.description) return;
  const { lower, upper } = run.description;
  const [left, right, bottom, top] = run.extent ?? [lower[0], upper[0], lower[1], upper[1]];
  view.scale = 0.9 * Math.min(panes[0].width / (right - left), panes[0].height / (top - bottom));
  view.x = (left + right) / 2;
  view.y = (bottom + top) / 2;
}

function zoom(factor, px = panes[0].width / 2, py = panes[0].height / 2) {
  const pane = panes.find((one) => px >= one.left && px <= one.left + one.width && py >= one.top && py <= one.top + one.height) ?? panes[0];
  const x = placeX(px, pane);
  const y = placeY(py, pane);
  view.isFitted = false;
  view.scale *= factor;
  view.x += x - placeX(px, pane);
  view.y += y - placeY(py, pane);
  run.isStale = true;
}

/// Draws disks as instances of a square, of which the shader keeps a disc.
class WebGLDisks {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error("no WebGL 2");
    this.gl = gl;
    this.name = "WebGL";
    const compiled = (type, source) => {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      return shader;
    };
    const program = gl.createProgram();
    gl.attachShader(program, compiled(gl.VERTEX_SHADER, `#version 300 es
      layout(location = 0) in vec2 corner;
      layout(location = 1) in vec4 disk;  // x, y, radius in pixels of the pane, colour
      uniform vec2 size;
      out vec2 place; out float radius; flat out int colour;
      void main() {
        radius = disk.z;
        place = corner * (disk.z + 1.0);
        colour = int(disk.w);
        vec2 pixel = disk.xy + place;
        gl_Position = vec4(pixel.x / size.x * 2.0 - 1.0, 1.0 - pixel.y / size.y * 2.0, 0.0, 1.0);
      }`));
    gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, `#version 300 es
      precision highp float;
      in vec2 place; in float radius; flat in int colour;
      uniform sampler2D palette; uniform float opacity, rim; uniform vec3 rimColour;
      out vec4 result;
      void main() {
        float distance = length(place);
        float cover = clamp(radius + 0.5 - distance, 0.0, 1.0);
        if (cover <= 0.0) discard;
        vec3 inside = texelFetch(palette, ivec2(colour, 0), 0).rgb;
        float edge = rim * clamp(distance - radius + 1.6, 0.0, 1.0);
        vec3 shown = mix(inside, mix(inside, rimColour, 0.45), edge);
        result = vec4(shown, 1.0) * cover * opacity;
      }`));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    this.uniform = Object.fromEntries(["size", "palette", "opacity", "rim", "rimColour"].map((name) => [name, gl.getUniformLocation(program, name)]));
    gl.useProgram(program);
    const corners = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, corners);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    this.buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(1, 1);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  }
  begin() {
    const { gl } = this;
    gl.disable(gl.SCISSOR_TEST);
    gl.viewport(0, 0, stage.width, stage.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.uniform2f(this.uniform.size, view.width, view.height);
  }
  setPalette(colours) {
    const { gl } = this;
    const bytes = new Uint8Array(colours.flatMap((colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16)).concat(255)));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, colours.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }
  /// `instances` holds x, y, radius and colour of each disk, in pixels; `clip` is a rectangle of the page's pixels.
  draw(instances, count, clip, isOutlined, isDark) {
    const { gl, uniform } = this;
    const d = view.density;
    gl.enable(gl.SCISSOR_TEST);
    const bottom = Math.round(stage.height - (clip.top + clip.height) * d);
    gl.scissor(Math.round(clip.left * d), bottom, Math.max(0, Math.round(clip.width * d)), Math.max(0, Math.round(clip.height * d)));
    gl.bufferData(gl.ARRAY_BUFFER, instances.subarray(0, 4 * count), gl.DYNAMIC_DRAW);
    gl.uniform1f(uniform.opacity, 1);
    gl.uniform1f(uniform.rim, isOutlined ? 1 : 0);
    gl.uniform3f(uniform.rimColour, isDark ? 1 : 0, isDark ? 1 : 0, isDark ? 1 : 0);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
  }
}

const blueGreenRed = (text) => parseInt(text.slice(5, 7) + text.slice(3, 5) + text.slice(1, 3), 16);

/// Draws disks pixel by pixel, on a canvas.
class CanvasDisks {
  constructor(canvas) {
    this.context = canvas.getContext("2d");
    this.name = "canvas";
  }
  begin() {
    this.context.clearRect(0, 0, stage.width, stage.height);
  }
  setPalette(colours) {
    this.colours = colours;
  }
  draw(instances, count, clip, isOutlined, isDark) {
    const d = view.density;
    const [left, top] = [Math.round(d * clip.left), Math.round(d * clip.top)];
    const [width, height] = [Math.round(d * (clip.left + clip.width)) - left, Math.round(d * (clip.top + clip.height)) - top];
    if (!(width > 0 && height > 0)) return;
    clearRaster(width, height);
    const insides = this.colours.map(blueGreenRed);
    const rims = isOutlined ? this.colours.map((text) => blueGreenRed(mixed(text, isDark ? "#ffffff" : "#000000", 0.35))) : insides;
    for (let k = 0; k < 4 * count; k += 4)
      rasterCircle(d * instances[k] - left, d * instances[k + 1] - top, d * instances[k + 2], insides[instances[k + 3]], rims[instances[k + 3]], 255);
    this.context.putImageData(raster.image, left, top);
  }
}

/// Whether WebGL is drawn by a graphics card. A canvas keeps the kind of context that it has had first: another one is asked.
function hasGraphicsCard() {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return false;
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}

/// WebGL where a graphics card does it: what imitates one is slower than pixel by pixel. `?draw=canvas` and `?draw=webgl` ask for one.
function disksDrawer() {
  const asked = parameters.get("draw");
  if (asked === "webgl" || (asked !== "canvas" && hasGraphicsCard())) {
    try {
      return new WebGLDisks(stage);
    } catch (error) {
      console.info(`drawing on a canvas: ${error.message}`);
    }
  }
  return new CanvasDisks(stage);
}
