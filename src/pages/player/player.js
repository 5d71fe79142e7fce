// Puts the page to work, and keeps it going: one frame after the other for as long as it is open. What a page shows beside what all
// players have is its `panel`.
//
// For scripts: window.carom is the player; data-errors of the document says what went wrong.
"use strict";

/// Moves on by so many seconds, and draws where something has changed.
function frame(seconds) {
  const before = moment.time;
  const wasPlaying = settings.isPlaying;
  advance(seconds);
  if (!isStale) return;
  isStale = false;
  const { time } = moment;
  const isFilm = wasPlaying && Math.abs(time - before) <= 1.001 * settings.rate * seconds;  // and has not begun again at an end
  followView(moment);
  panel.show(isFilm ? before : time);
  say("time", `${time.toPrecision(9).replace(/\.?0+$/, "")} / ${shortNumber(duration)}`);
  say("followed", settings.followed >= 0 ? `disk ${settings.followed}: ${panel.ofDisk(settings.followed)}` : "click a disk to follow it");
  showLegendEnds();
  showScrub();
  ++window.carom.frames;
}

/// Calls frame(seconds since the last one) for as long as the page is open; and frame(0) at once when a canvas has changed its size,
/// which leaves it black.
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
control("title").textContent = document.title;
panel.describe();
listFacts();
listeners.push(showSettings);
showTime(0, description.exact ? 0 : 1);
showSettings();
keepShowing();
