// Every control has a key. Fields, sliders and buttons that have the focus keep the keys that they need themselves.
"use strict";

const keys = {
  " ": () => togglePlay(),
  k: () => togglePlay(),
  ".": () => stepEvent(1),
  ",": () => stepEvent(-1),
  ArrowRight: (event) => showTime(moment.time + (event.shiftKey ? 0.1 : 0.01) * duration),
  ArrowLeft: (event) => showTime(moment.time - (event.shiftKey ? 0.1 : 0.01) * duration),
  ArrowUp: () => setRate(settings.rate * Math.SQRT2),
  ArrowDown: () => setRate(settings.rate / Math.SQRT2),
  Home: () => showTime(0),
  End: () => showTime(duration),
  r: () => change({ isBackwards: !settings.isBackwards }),
  l: () => change({ loop: !settings.loop }),
  t: () => change({ trails: !settings.trails }),
  v: () => change({ arrows: !settings.arrows }),
  g: () => change({ ghosts: !settings.ghosts }),
  c: () => choose("colour", "colourBy"),
  p: () => choose("palette", "palette"),
  d: () => change({ theme: theme.isDark ? "light" : "dark" }),
  f: () => follow(settings.followed >= 0 ? -1 : 0),
  "]": () => follow((settings.followed + 1) % disks),
  "[": () => follow((Math.max(settings.followed, 0) + disks - 1) % disks),
  "+": () => zoomBy(1.25),
  "=": () => zoomBy(1.25),
  "-": () => zoomBy(0.8),
  0: () => fitView(),
  "?": () => showHelp(true),
  Escape: () => follow(-1),
};

function connectKeyboard() {
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || control("help").open) return;
    const { tagName, type } = event.target;
    if (tagName === "SELECT" || (tagName === "INPUT" && type === "number")) return;
    if (tagName === "INPUT" && (event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End")) return;
    if (tagName === "BUTTON" && event.key === " " && event.target === document.activeElement) return;  // it presses the button
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
  // A click leaves no focus behind, so that Space plays after it, as in any player of films; who came by keys keeps their place.
  window.addEventListener("click", (event) => {
    const isKey = event.isTrusted && event.detail === 0;
    if (!isKey && event.target.closest("button")) document.activeElement.blur();
  });
  window.addEventListener("change", (event) => {
    if (event.target.tagName === "SELECT" && !event.target.matches(":focus-visible")) event.target.blur();
  });
}
