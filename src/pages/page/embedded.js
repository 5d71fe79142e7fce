// Pages within the page. Where such a page is narrow and stacks its parts, its frame gets the height of all of them. Errors in it
// are shown on the enclosing page too.
"use strict";

function connectEmbedded(frame) {
  const inside = frame.contentDocument;
  const { errors } = inside.documentElement.dataset;
  if (errors) pageError(`${frame.title}: ${errors}`);
  frame.contentWindow.addEventListener("error", (event) => pageError(`${frame.title}: ${event.message}`));
  const isStacked = () => frame.contentWindow.getComputedStyle(inside.body).overflowY !== "hidden";
  const fit = () => {
    const border = frame.offsetHeight - frame.clientHeight;
    const height = isStacked() ? `${inside.body.offsetHeight + border}px` : "";
    if (frame.style.height !== height) frame.style.height = height;
  };
  // In the next frame: a height that changes while sizes are being told of is an error of the browser.
  new frame.contentWindow.ResizeObserver(() => requestAnimationFrame(fit)).observe(inside.body);
  window.addEventListener("resize", fit);
  fit();
}

for (const frame of document.querySelectorAll("figure.embedded iframe")) {
  const isThere = frame.contentDocument?.URL === "about:srcdoc" && frame.contentDocument.readyState === "complete";
  if (isThere) connectEmbedded(frame);
  else frame.addEventListener("load", () => connectEmbedded(frame), { once: true });
}
