// Puts the player to work, and keeps it going: one frame after the other for as long as something changes.
//
// For scripts: window.carom is the player; data-errors of the document says what went wrong.
"use strict";

/// Moves on by so many seconds, and draws where something has changed.
function frame(seconds) {
  advance(seconds);
  if (!isStale) return;
  isStale = false;
  followView(moment);
  drawMoment(moment);
  drawCollision(moment);
  showReadings(moment);
  showScrub();
  ++window.carom.frames;
}

function describeRun() {
  control("title").textContent = description.title || "A run of Carom";
  const badge = control("how");
  badge.textContent = description.exact ? "exact" : "interpolated";
  badge.classList.toggle("interpolated", !description.exact);
  const nearest = description.exact ? description.distance + description.rounding : 0;
  control("how-text").textContent = description.exact
    ? `Every instant is computed from ${counted(columns.time.length, "recorded event")}: free flight between collisions, ` +
      (nearest > 0 ? `within ${nearest.toExponential(0)} of where the run had the disks.` : "just where the run had the disks.")
    : `Interpolated between ${counted(description.samples.count, "sample")}, because ${description.whyNot}: ` +
      "disks move in straight lines from each sample to the next, and collisions in between are not shown." +
      (description.samples.every > 1 ? ` One sample in ${description.samples.every} is kept.` : "");
  listFacts();
  for (const name of ["collisions", "walls"]) readings[name].closest("div").hidden = !totals;
  if (description.whyNoZ) say("pressure-label", `no pressure Z: ${description.whyNoZ}`);
  else if (!totals) say("pressure-label", "pressure Z of the run");
}

window.carom = {
  description,
  settings,
  moment,
  duration,
  frames: 0,
  seek: (time) => {
    change({ isPlaying: false });
    showTime(time);
    frame(0);
  },
  frame,
  change,
  pixel: (x, y) => [pixelX(x), pixelY(y)],
  view,
  columns,
};

if (window.parent !== window) document.documentElement.dataset.embedded = "";  // the page round it has title and facts
fillLists();
connectControls();
connectKeyboard();
connectPointer(canvas, moment);
describeRun();
listeners.push(showSettings);
showTime(0, description.exact ? 0 : 1);
showSettings();
keepShowing(frame, [canvas, plot], () => {
  resizeView();
  resizePlot();
});
