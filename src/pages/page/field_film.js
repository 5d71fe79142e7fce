// Maps of fields in time: a slider shows the stretches of a run one after the other, in the cells and arrows of the maps of its
// average. #film holds the stretches: colours as two hexadecimal digits for each cell, "--" where there is no value; arrows as two
// digits for x and two for y, 80 being none.
"use strict";

const film = JSON.parse(document.getElementById("film").textContent);
const slider = document.getElementById("time");
const button = document.getElementById("play");
const shown = document.getElementById("stretch");
const stretches = film.times.length;

/// Arrows of a stretch as one SVG path, drawn as those of the average are: the longest is as long as a cell is wide.
function arrowPath(digits) {
  const { across, up, width, height } = film;
  const component = (at) => ((parseInt(digits.slice(at, at + 2), 16) - 128) / 127) * Math.min(width, height);
  let path = "";
  for (let c = 0; c < across * up; ++c) {
    const dx = component(4 * c);
    const dy = -component(4 * c + 2);
    if (dx === 0 && dy === 0) continue;
    const x = ((c % across) + 0.5) * width - dx / 2;
    const y = (up - 0.5 - Math.floor(c / across)) * height - dy / 2;
    const head = [
      [-0.35 * dx + 0.2 * dy, -0.35 * dy - 0.2 * dx],
      [-0.35 * dx - 0.2 * dy, -0.35 * dy + 0.2 * dx],
    ].map((end) => end.map((number) => number.toFixed(1)).join(" "));
    const tip = `${(x + dx).toFixed(1)} ${(y + dy).toFixed(1)}`;
    path += `M${x.toFixed(1)} ${y.toFixed(1)}L${tip}l${head[0]}M${tip}l${head[1]}`;
  }
  return path;
}

/// A map: shows a stretch, or the average of the run again.
function makeMap(figure, map) {
  const paths = [...figure.querySelectorAll("path")];
  const cells = paths.slice(0, film.across * film.up);
  const arrows = paths.slice(cells.length);
  const titles = cells.map((cell) => cell.querySelector("title"));
  const words = (name) => figure.querySelector(`.${name}`);
  const average = {
    fills: cells.map((cell) => cell.getAttribute("fill")),
    titles: titles.map((title) => title.textContent),
    arrows: arrows[0]?.getAttribute("d"),
    words: ["low", "high", "longest"].map((name) => words(name)?.textContent),
  };
  const say = (numbers) =>
    ["low", "high", "longest"].forEach((name, k) => {
      if (words(name)) words(name).textContent = numbers[k];
    });
  return (stretch) => {
    if (stretch < 0) {
      cells.forEach((cell, c) => cell.setAttribute("fill", average.fills[c]));
      titles.forEach((title, c) => (title.textContent = average.titles[c]));
      for (const path of arrows) path.setAttribute("d", average.arrows);
      say(average.words);
      return;
    }
    cells.forEach((cell, c) => {
      const level = parseInt(map.cells[stretch].slice(2 * c, 2 * c + 2), 16);
      cell.setAttribute("fill", Number.isNaN(level) ? "none" : film.colours[level]);
      const value = map.low + ((map.high - map.low) * level) / 255;
      titles[c].textContent = Number.isNaN(level) ? "none" : value.toPrecision(3);
    });
    for (const path of arrows) path.setAttribute("d", arrowPath(map.arrows[stretch]));
    say([map.low, map.high, map.longest].map((number) => String(Number(number.toPrecision(3)))));
  };
}

const maps = [...document.querySelectorAll("figure")].map((figure, k) => makeMap(figure, film.maps[k]));

function show() {
  const stretch = Number(slider.value) - 1;
  for (const map of maps) map(stretch);
  const words = (time) => String(Number(time.toPrecision(4)));
  const half = film.times[0]; // the first stretch begins at time 0
  shown.textContent =
    stretch < 0 ? "average of the run" : `time ${words(film.times[stretch] - half)} to ${words(film.times[stretch] + half)}`;
}

let playing;
function stop() {
  clearInterval(playing);
  playing = undefined;
  button.textContent = "Play";
}
function play() {
  if (Number(slider.value) === stretches) slider.value = 0;
  button.textContent = "Pause";
  playing = setInterval(() => {
    slider.value = Number(slider.value) + 1;
    show();
    if (Number(slider.value) === stretches) stop();
  }, 400);
}

button.addEventListener("click", () => (playing === undefined ? play() : stop()));
slider.addEventListener("input", () => {
  stop();
  show();
});
show();
