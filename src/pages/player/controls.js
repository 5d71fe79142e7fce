// Buttons, sliders and lists: each changes a setting and shows its value.
"use strict";

const control = (name) => document.getElementById(name);
const toggles = { trails: "trails", arrows: "arrows", ghosts: "ghosts", loop: "loop", reverse: "isBackwards" };
const scrubSteps = 100000;  // steps of the time slider, finer than pixels
const rateSteps = 60;       // steps of the speed slider to either side: six decades down, three up

/// The speed slider is logarithmic; its middle is `usualRate`.
const rateOf = (position) => usualRate * 10 ** (position > 0 ? (3 * position) / rateSteps : (6 * position) / rateSteps);
const positionOf = (rate) => {
  const decades = Math.log10(rate / usualRate);
  return Math.round((decades > 0 ? decades / 3 : decades / 6) * rateSteps);
};
function setRate(rate) {
  change({ rate: Math.min(Math.max(rate, usualRate * 1e-6), usualRate * 1e3) });
}

function follow(i) {
  change({ followed: Number.isInteger(i) && i >= 0 && i < disks ? i : -1 });
}

/// Chooses the next entry of a list, for keys.
function choose(name, setting, by = 1) {
  const values = [...control(name).options].map((option) => option.value);
  change({ [setting]: values[(values.indexOf(settings[setting]) + by + values.length) % values.length] });
}

function fillLists() {
  for (const [value, { label, isOffered }] of Object.entries(colourings))
    if (isOffered) control("colour").add(new Option(label, value));
  const labels = { viridis: "viridis", cividis: "colour-blind safe", plasma: "plasma", blues: "blues" };
  for (const [value, label] of Object.entries(labels)) control("palette").add(new Option(label, value));
  for (const value of ["auto", "light", "dark"]) control("theme").add(new Option(value === "auto" ? "as the screen" : value, value));
}

/// Copies the settings into the controls.
function showSettings() {
  control("play-pause").setAttribute("aria-pressed", settings.isPlaying);
  control("play-pause").querySelector("use").setAttribute("href", settings.isPlaying ? "#icon-pause" : "#icon-play");
  control("play-pause").title = settings.isPlaying ? "Pause (Space)" : "Play (Space)";
  for (const [name, setting] of Object.entries(toggles)) control(name).setAttribute("aria-pressed", settings[setting]);
  control("colour").value = settings.colourBy;
  control("palette").value = settings.palette;
  control("palette").disabled = Boolean(colourings[settings.colourBy].colours);
  control("theme").value = settings.theme;
  control("rate").value = positionOf(settings.rate);
  control("rate-text").textContent = `time ${shortNumber(settings.rate)} per second`;
  control("follow").value = settings.followed >= 0 ? settings.followed : "";
  showLegend();
  isStale = true;
}

/// Copies the moment into the time slider.
function showScrub() {
  const position = String(duration > 0 ? Math.round((scrubSteps * moment.time) / duration) : 0);
  if (control("scrub").value !== position) control("scrub").value = position;
  control("scrub").setAttribute("aria-valuetext", `time ${shortNumber(moment.time)}`);
}

function showHelp(isOpen) {
  const help = control("help");
  if (isOpen && !help.open) help.showModal();
  else if (!isOpen && help.open) help.close();
}

/// The whole page on the whole screen, and back.
function toggleFull() {
  if (document.fullscreenElement) document.exitFullscreen();
  else document.documentElement.requestFullscreen?.().catch(() => {});  // a frame may not be allowed to
}

function connectControls() {
  const onClick = (name, action) => control(name).addEventListener("click", action);
  onClick("play-pause", togglePlay);
  onClick("next", () => stepEvent(1));
  onClick("previous", () => stepEvent(-1));
  onClick("zoom-in", () => zoomBy(1.25));
  onClick("zoom-out", () => zoomBy(0.8));
  onClick("fit", fitView);
  onClick("full", toggleFull);
  onClick("keys", () => showHelp(true));
  onClick("close-help", () => showHelp(false));
  for (const [name, setting] of Object.entries(toggles)) onClick(name, () => change({ [setting]: !settings[setting] }));
  control("scrub").max = scrubSteps;
  control("scrub").addEventListener("input", (event) => showTime((duration * event.target.value) / scrubSteps));
  control("rate").min = -rateSteps;
  control("rate").max = rateSteps;
  control("rate").addEventListener("input", (event) => setRate(Number(rateOf(Number(event.target.value)).toPrecision(2))));
  control("colour").addEventListener("change", (event) => change({ colourBy: event.target.value }));
  control("palette").addEventListener("change", (event) => change({ palette: event.target.value }));
  control("theme").addEventListener("change", (event) => change({ theme: event.target.value }));
  control("follow").max = Math.max(disks - 1, 0);
  control("follow").addEventListener("change", (event) => follow(event.target.value === "" ? -1 : Number(event.target.value)));
  if (!box.periodic[0] && !box.periodic[1]) control("ghosts").hidden = true;
  control("next").title = `To the next ${replay.stepName} (.)`;
  control("previous").title = `To the previous ${replay.stepName} (,)`;
  document.querySelector("[data-step]").textContent = replay.stepName;
}

/// Zooms by a factor about the middle, and has the box drawn again.
function zoomBy(factor) {
  zoom(factor);
  isStale = true;
}
