// Puts the page to work, as player.js does the player.
//
// For scripts: window.carom; data-errors of the document says what went wrong.
"use strict";

const stepsCanvas = document.getElementById("steps");
const stepsContext = stepsCanvas.getContext("2d", { alpha: false });

/// Moves on by so many seconds, and draws where something has changed. Overlaps since the last frame of a film flash in this one.
function frame(seconds) {
  const before = moment.time;
  const wasPlaying = settings.isPlaying;
  advance(seconds);
  if (!isStale) return;
  isStale = false;
  const { time } = moment;
  const isFilm = wasPlaying && Math.abs(time - before) <= 1.001 * settings.rate * seconds;  // and has not begun again at an end
  readSteps(time);
  const distance = measureTwins();
  followView(moment);
  drawMoment(moment);
  drawMoment(stepsMoment, stepsContext);
  const flashing = isFilm ? overlapsBetween(Math.min(before, time), Math.max(before, time)) : overlapsBetween(time, time);
  drawOverlaps(stepsMoment, flashing);
  drawDistance(time, distance);
  drawOverlapCount(time);
  showSides(time, distance);
  showScrub();
  Object.assign(window.carom, { frames: window.carom.frames + 1, distance, flashing });
}

function showSides(time, distance) {
  say("distance", distance < 1e-10 ? "0, to rounding" : shortNumber(distance));
  say("overlaps-now", overlapsBetween(time, time).length.toLocaleString("en"));
  say("overlaps-so-far", overlapsBegunBy(time).toLocaleString("en"));
  say("deepest", overlapsBegunBy(time) > 0 ? `${(100 * deepestBy(time)).toPrecision(2)} % of a diameter` : "–");
  say("collisions", totals.pairs[exact.doneAt(time)].toLocaleString("en"));
  say("steps-taken", moment.done.toLocaleString("en"));
  say("time", `${time.toPrecision(9).replace(/\.?0+$/, "")} / ${shortNumber(duration)}`);
  say("followed", settings.followed >= 0 ? `disk ${settings.followed}: ${shortNumber(apart[settings.followed])} diameters apart` : "click a disk to follow it");
  showLegendEnds();
}

function describeSides() {
  const { method } = description.steps;
  control("title").textContent = description.title || "Exact events and fixed steps";
  control("how").textContent = "side by side";
  control("how-text").textContent = description.words.what;
  for (const name of ["growth", "window", "energy"]) say(name, description.words[name]);
  say("exact-words", "from event to event");
  say("steps-words", `${method}, dt = ${Number(dt.toPrecision(4))}`);
  control("next-overlap").disabled = overlapBegin.length === 0;
  listFacts();
}

const takeOverlapColour = () => (theme.overlap = getComputedStyle(document.documentElement).getPropertyValue("--overlap").trim());
takeOverlapColour();
darkScreen.addEventListener("change", takeOverlapColour);
listeners.push((changes) => "theme" in changes && takeOverlapColour());

window.carom = {
  description,
  settings,
  moment,
  stepsMoment,
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

/// A key of this page alone, in the list of keys too.
function addKey(letter, what, action) {
  keys[letter.toLowerCase()] = action;
  const [term, key, text] = ["dt", "kbd", "dd"].map((tag) => document.createElement(tag));
  key.textContent = letter;
  text.textContent = what;
  term.append(key);
  document.querySelector("#help dl").append(term, text);
}

addKey("O", "to the next overlap", showNextOverlap);
fillLists();
connectControls();
control("next-overlap").addEventListener("click", showNextOverlap);
connectKeyboard();
connectPointer(canvas, moment);
connectPointer(stepsCanvas, stepsMoment);
connectCurves();
describeSides();
listeners.push(showSettings);
showTime(0);
showSettings();
keepShowing(frame, [canvas, distancePlot.element, overlapPlot.element], () => {
  resizeView();
  stepsCanvas.width = canvas.width;
  stepsCanvas.height = canvas.height;
  resizeCurves();
});
