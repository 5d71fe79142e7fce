// Starts the page and draws one frame after the other for as long as it is open. The parts that only one kind of player has are
// its `panel`.
//
// For scripts: window.carom is the player; data-errors of the document lists errors.
"use strict";

/// Advances by a number of seconds, and draws if something has changed.
function frame(seconds) {
  const before = moment.time;
  const wasPlaying = settings.isPlaying;
  advance(seconds);
  if (!isStale) return;
  isStale = false;
  const { time } = moment;
  const isFilm = wasPlaying && Math.abs(time - before) <= 1.001 * settings.rate * seconds;  // false where playing has started again
  followView(moment);
  panel.show(isFilm ? before : time);
  say("time", `${clockText(time)} / ${shortNumber(duration)}`);
  say("followed", settings.followed >= 0 ? `disk ${settings.followed}: ${panel.ofDisk(settings.followed)}` : "click a disk to follow it");
  showLegendEnds();
  showScrub();
  ++window.carom.frames;
}

/// Calls frame(seconds since the last one) for as long as the page is open. When a canvas changes its size, which clears it, calls
/// frame(0) at once.
function keepShowing() {
  const resize = () => {
    resizeView();
    resizePlots();
  };
  resize();
  const resized = new ResizeObserver(() => {
    resize();
    isStale = true;
    frame(0);
  });
  for (const element of [canvas, ...plots.map((plot) => plot.element)]) resized.observe(element);
  let shownAt = 0;
  const animate = (now) => {
    const longest = 0.1;  // seconds: after a pause of the browser the run continues where it was
    frame(Math.min((now - shownAt) / 1000, longest));
    shownAt = now;
    requestAnimationFrame(animate);
  };
  requestAnimationFrame((now) => {
    shownAt = now;
    animate(now);
  });
}

window.carom = {
  description,
  settings,
  moment,
  duration,
  frames: 0,
  seek: (time) => {
    if (Number.isNaN(Number(time))) throw new RangeError(`${time} is not a time`);
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

if (window.parent !== window) document.documentElement.dataset.embedded = "";  // the enclosing page shows title and facts
fillLists();
connectControls();
connectKeyboard();
connectPointer(canvas, moment);
control("title").textContent = document.title;
panel.describe();
listFacts();
listeners.push(showSettings);
showTime(0, description.exact ? 0 : 1);
showSettings();
if (location.hash === "#play") change({ isPlaying: true });
keepShowing();
