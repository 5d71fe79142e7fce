// Works every control that all players have as a reader would, by mouse and by key, and notes what does not follow. Run behind
// page_checks.js, which counts, and behind what a kind of player checks before.
const { moment, settings, view, duration } = carom;
const events = replay.stepTimes;

// Time.
carom.seek(0.25 * duration);
check("the seek", moment.time === 0.25 * duration && !settings.isPlaying);
let refusal = null;
try {
  carom.seek(NaN);
} catch (error) {
  refusal = error;
}
check("no seek to what is no time", refusal instanceof RangeError && moment.time === 0.25 * duration);
for (const [name, act] of [["play button", () => byId("play-pause").click()], ["space", () => press(" ")], ["K", () => press("k")]]) {
  const before = moment.time;
  act();
  carom.frame(0.01);
  check(`${name} plays`, settings.isPlaying && near(moment.time, before + 0.01 * settings.rate));
  check(`${name} shows it`, byId("play-pause").getAttribute("aria-pressed") === "true" && byId("play-pause").title.startsWith("Pause"));
  act();
  const at = moment.time;
  carom.frame(0.01);
  check(`${name} pauses`, !settings.isPlaying && moment.time === at);
}
// Space plays wherever the focus is, and does not work what has it.
for (const element of document.querySelectorAll("button, select, input, summary")) {
  if (element.id === "close-help" || element.disabled || element.hidden) continue;
  element.focus();
  const before = JSON.stringify({ ...settings, isPlaying: null });
  for (const plays of [true, false]) {
    const isTaken = !element.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true, cancelable: true }));
    const isReleased = !element.dispatchEvent(new KeyboardEvent("keyup", { key: " ", bubbles: true, cancelable: true }));
    check(`space on ${element.id} ${plays ? "plays" : "pauses"}`, settings.isPlaying === plays && isTaken && isReleased);
  }
  check(`space on ${element.id} does nothing else`, JSON.stringify({ ...settings, isPlaying: null }) === before);
}
document.activeElement.blur();
press("Home");
check("Home", moment.time === 0 && moment.done === 0);
byId("next").click();
check("step button", moment.time === events[0] && moment.done === 1);
press(".");
check("step key", moment.time === events[1] && moment.done === 2);
press(",");
check("step back key", moment.time === events[0] && moment.done === 1);
byId("previous").click();
check("step back button", moment.time === 0 && moment.done === 0);
carom.seek((events[4] + events[5]) / 2);
byId("previous").click();
check("step back from flight", moment.time === events[4] && moment.done === 5);
press("End");
check("End", moment.time === duration);
press("ArrowLeft");
check("arrow left", near(moment.time, 0.99 * duration));
press("ArrowLeft", { shiftKey: true });
check("shift and arrow left", near(moment.time, 0.89 * duration));
press("ArrowRight");
press("ArrowRight", { shiftKey: true });
check("arrows right", near(moment.time, duration));
give("scrub", 50000, "input");
check("scrubbing", near(moment.time, 0.5 * duration));
carom.frame(0);
check("the slider stays", byId("scrub").value === "50000");

// Direction, loop, speed.
const setRate = (rate) => carom.change({ rate });
setRate(0.1 * duration);
for (const [name, act] of [["reverse button", () => byId("reverse").click()], ["R", () => press("r")]]) {
  carom.seek(0.5 * duration);
  act();
  carom.change({ isPlaying: true });
  carom.frame(1);
  check(`${name} runs backwards`, near(moment.time, 0.4 * duration));
  act();
  carom.frame(1);
  check(`${name} again runs on`, near(moment.time, 0.5 * duration));
}
for (const [name, act] of [["loop button", () => byId("loop").click()], ["L", () => press("l")]]) {
  carom.seek(0.95 * duration);
  carom.change({ isPlaying: true });
  carom.frame(1);
  check(`without ${name} the end stays`, moment.time === duration && !settings.isPlaying);
  act();
  carom.seek(0.95 * duration);
  carom.change({ isPlaying: true });
  carom.frame(1);
  check(`${name} begins again`, near(moment.time, 0.05 * duration) && settings.isPlaying);
  carom.change({ isBackwards: true });
  carom.frame(1);
  check(`${name} backwards`, near(moment.time, 0.95 * duration));
  carom.change({ isBackwards: false });
  act();
}
carom.seek(duration);
byId("play-pause").click();
check("playing at the end begins anew", moment.time === 0 && settings.isPlaying);
byId("play-pause").click();
give("rate", -60, "input");
const slowest = settings.rate;
give("rate", 60, "input");
check("the slider of speed spans nine decades", near(Math.log10(settings.rate / slowest), 9));
give("rate", 0, "input");
const usual = settings.rate;
const digit = (rate) => Number(rate.toExponential(6).split("e")[0]);
check("the usual speed is 1, 2 or 5 times a power of ten", [1, 2, 5].includes(digit(usual)));
press("ArrowUp");
check("arrow up goes to the next such speed", near(settings.rate / usual, { 1: 2, 2: 2.5, 5: 2 }[digit(usual)]));
press("ArrowDown");
check("arrow down goes back", near(settings.rate, usual));
press("ArrowDown");
check("arrow down goes to the one before", near(usual / settings.rate, { 1: 2, 2: 2, 5: 2.5 }[digit(usual)]));
press("ArrowUp");
check("the speed is told", byId("rate-text").textContent.includes("per second"));

// Colours.
carom.seek(0.3 * duration);
const options = (id) => [...byId(id).options].map((option) => option.value);
const seen = new Set();
for (const value of options("colour")) {
  give("colour", value, "change");
  check(`colour ${value}`, settings.colourBy === value && byId("legend").childElementCount > 0);
  seen.add(picture());
}
check("every colouring is another picture", seen.size === options("colour").length && seen.size >= 4);
give("colour", "speed", "change");
press("c");
check("C", settings.colourBy === "species" && byId("colour").value === "species");
give("colour", "speed", "change");
const palettes = new Set();
for (const value of options("palette")) {
  give("palette", value, "change");
  palettes.add(picture());
}
check("every palette is another picture", palettes.size === options("palette").length && palettes.size >= 3);
give("palette", "viridis", "change");
press("p");
check("P", settings.palette === "cividis");
const corner = () => [...pixels().slice(0, 3)].join();
give("theme", "dark", "change");
check("dark", document.documentElement.dataset.theme === "dark" && corner() === "18,22,28");
give("theme", "light", "change");
check("light", document.documentElement.dataset.theme === "light" && corner() === "255,255,255");
press("d");
check("D", document.documentElement.dataset.theme === "dark");
give("theme", "auto", "change");
check("as the screen", document.documentElement.dataset.theme === "light");

// Trails, arrows, ghosts.
carom.seek(0.3 * duration);
for (const [id, setting, key] of [["trails", "trails", "t"], ["arrows", "arrows", "v"], ["ghosts", "ghosts", "g"]]) {
  const without = pixels().slice();
  byId(id).click();
  check(`${id} button`, settings[setting] && byId(id).getAttribute("aria-pressed") === "true");
  check(`${id} are drawn`, !same(pixels(), without));
  press(key);
  check(`${id} go`, !settings[setting] && same(pixels(), without));
}

// The view.
const scale = view.scale;
byId("zoom-in").click();
check("zoom in", near(view.scale, 1.25 * scale));
byId("zoom-out").click();
check("zoom out", near(view.scale, scale));
press("+");
check("+", near(view.scale, 1.25 * scale));
press("-");
check("-", near(view.scale, scale));
const pointed = [100, 80 + Math.ceil(stageCanvas.getBoundingClientRect().top) - stageCanvas.getBoundingClientRect().top];  // a whole pixel
const under = [(pointed[0] - view.width / 2) / view.scale + view.x, (view.height / 2 - pointed[1]) / view.scale + view.y];
pointer("wheel", ...pointed, { deltaY: -200 });
check("the wheel zooms", view.scale > scale);
check("about the pointer", carom.pixel(...under).every((place, axis) => Math.abs(place - pointed[axis]) < 1e-6));
byId("fit").click();
check("fit", near(view.scale, scale));
const centre = [view.x, view.y];
const drag = (dx, dy) => {
  pointer("pointerdown", 200, 200);
  pointer("pointermove", 200 + dx, 200 + dy);
  pointer("pointerup", 200 + dx, 200 + dy);
};
drag(50, 20);
check("dragging moves the box", near(view.x, centre[0] - 50 / scale) && near(view.y, centre[1] + 20 / scale));
check("and follows no disk", settings.followed === -1);
press("0");
check("0", near(view.x, centre[0]) && near(view.scale, scale));

// Following.
give("follow", 7, "change");
carom.frame(0);
check("following by number", settings.followed === 7 && view.x === moment.x[7] && view.y === moment.y[7]);
check("it is told of", document.querySelector("[data-reading=followed]").textContent.startsWith("disk 7"));
press("]");
check("]", settings.followed === 8);
press("[");
check("[", settings.followed === 7);
press("Escape");
check("Escape", settings.followed === -1 && byId("follow").value === "");
press("0");
carom.frame(0);
const at = carom.pixel(moment.x[11], moment.y[11]);
pointer("pointerdown", ...at);
pointer("pointerup", ...at);
check("a click follows", settings.followed === 11);
press("f");
check("F lets go", settings.followed === -1);
press("f");
check("F takes the first", settings.followed === 0);
press("f");
press("0");

// Help, and that everything can be had without a mouse.
press("?");
check("? opens the keys", byId("help").open);
byId("close-help").click();
check("and they close", !byId("help").open);
byId("keys").click();
check("the button too", byId("help").open);
byId("close-help").click();
checkReach();
noteChecks();
