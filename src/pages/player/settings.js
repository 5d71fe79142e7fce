// The reader's settings. Other files read them here; change() changes them and calls the listeners.
"use strict";

const settings = {
  colourBy: description.species.length > 1 ? "species" : "speed",
  palette: "viridis",
  theme: "auto",
  trails: false,
  arrows: false,
  ghosts: false,
  loop: false,
  isBackwards: false,
  isPlaying: false,
  rate: 1,  // units of the run's time per second
  followed: -1,
  areMany: disks > 1000,  // disks are drawn pixel by pixel
};
const listeners = [];

function change(changes) {
  Object.assign(settings, changes);
  for (const listener of listeners) listener(changes);
}

/// Sets the attribute by which player.css chooses dark or light: the reader's choice, or that of the screen.
const darkScreen = matchMedia("(prefers-color-scheme: dark)");
function applyTheme() {
  const isDark = settings.theme === "auto" ? darkScreen.matches : settings.theme === "dark";
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue(name).trim();
  Object.assign(theme, {
    isDark,
    ink: value("--ink"),
    muted: value("--muted"),
    rule: value("--rule"),
    frame: value("--frame"),
    paper: value("--paper"),
    stage: value("--stage"),
    accent: value("--accent"),
    solid: value("--solid"),
    overlap: value("--overlap"),
    font: value("--text-font"),
  });
}
const theme = {};
applyTheme();
darkScreen.addEventListener("change", () => change({ theme: settings.theme }));
listeners.push((changes) => "theme" in changes && applyTheme());
