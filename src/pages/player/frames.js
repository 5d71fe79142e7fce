// One frame after the other for as long as the page is open.
"use strict";

/// Calls frame(seconds since the last one); and when one of `canvases` has changed its size, resize() and frame(0), at once: a
/// canvas of another size is black.
function keepShowing(frame, canvases, resize) {
  resize();
  const resized = new ResizeObserver(() => {
    resize();
    isStale = true;
    frame(0);
  });
  canvases.forEach((canvas) => resized.observe(canvas));
  let shownAt = 0;
  const animate = (now) => {
    const longest = 0.1;  // seconds: after a pause of the browser the run goes on where it was
    frame(Math.min((now - shownAt) / 1000, longest));
    shownAt = now;
    requestAnimationFrame(animate);
  };
  requestAnimationFrame((now) => {
    shownAt = now;
    animate(now);
  });
}
