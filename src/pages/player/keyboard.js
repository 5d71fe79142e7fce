// Every control has a key. Fields and sliders with the focus keep the keys that they need. Space always plays or pauses, and Enter
// presses the button with the focus.
"use strict";

const keys = {
  " ": () => togglePlay(),
  k: () => togglePlay(),
  ".": () => stepEvent(1),
  ",": () => stepEvent(-1),
  ArrowRight: (event) => showTime(moment.time + (event.shiftKey ? 0.1 : 0.01) * duration),
  ArrowLeft: (event) => showTime(moment.time - (event.shiftKey ? 0.1 : 0.01) * duration),
  ArrowUp: () => setRate(fasterRate(settings.rate)),
  ArrowDown: () => setRate(slowerRate(settings.rate)),
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
  m: () => toggleFull(),
  "?": () => showHelp(true),
  Escape: () => follow(-1),
};

/// Adds a key that only this page has, and its entry in the list of keys.
function addKey(letter, what, action) {
  keys[letter.toLowerCase()] = action;
  const [term, key, text] = ["dt", "kbd", "dd"].map((tag) => document.createElement(tag));
  key.textContent = letter;
  text.textContent = what;
  term.append(key);
  document.querySelector("#help dl").append(term, text);
}

function connectKeyboard() {
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || control("help").open) return;
    const { tagName, type } = event.target;
    const isField = tagName === "SELECT" || (tagName === "INPUT" && type === "number");
    if (isField && event.key !== " ") return;
    if (tagName === "INPUT" && (event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End")) return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
  // Some browsers press the button with the focus when Space is released.
  window.addEventListener("keyup", (event) => {
    if (event.key === " " && !control("help").open) event.preventDefault();
  });
  // After a choice by mouse a list gives up the focus, so that letters are keys of the page again.
  window.addEventListener("change", (event) => {
    if (event.target.tagName === "SELECT" && !event.target.matches(":focus-visible")) event.target.blur();
  });
}
