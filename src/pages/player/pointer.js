// Mouse and fingers on the box: drag to move it, wheel or two fingers to zoom, a click to follow a disk.
"use strict";

/// Connects mouse and fingers to a canvas that shows `moment`.
function connectPointer(canvas, moment) {
  const held = new Map();  // pointers that are down, by number
  let travelled = 0;       // pixels since the first went down; at most `click` for a click
  const click = 4;         // pixels

  const place = (event) => {
    const frame = canvas.getBoundingClientRect();
    return { x: event.clientX - frame.left, y: event.clientY - frame.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (held.size === 0) travelled = 0;
    held.set(event.pointerId, place(event));
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {
      // pointers that a script has made cannot be captured
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    const others = [...held].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    if (others.length > 0) {
      const spread = (at) => Math.hypot(at.x - others[0].x, at.y - others[0].y);
      zoom(spread(now) / Math.max(spread(before), 1), (now.x + others[0].x) / 2, (now.y + others[0].y) / 2);
      travelled = Infinity;
    } else {
      travelled += Math.hypot(now.x - before.x, now.y - before.y);
      if (travelled > click && settings.followed < 0) pan(now.x - before.x, now.y - before.y);
    }
    held.set(event.pointerId, now);
    isStale = true;
  });
  canvas.addEventListener("pointerup", (event) => {
    const at = place(event);
    if (held.delete(event.pointerId) && travelled <= click) follow(diskAt(at.x, at.y, moment));
  });
  canvas.addEventListener("pointercancel", (event) => held.delete(event.pointerId));
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { x, y } = place(event);
      const perPixel = 0.0015;
      zoom(Math.exp(-perPixel * event.deltaY * (event.deltaMode === 1 ? 16 : 1)), x, y);
      isStale = true;
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", fitView);
}
