// Works every control of a player as a reader would, by mouse and by key, and notes what does not follow. Run behind
// page_checks.js, which counts.
const { moment, settings, view, duration } = carom;
const events = carom.columns.time;

// Time.
carom.seek(0.25 * duration);
check("the seek", moment.time === 0.25 * duration && !settings.isPlaying);
for (const [name, act] of [["play button", () => byId("play").click()], ["space", () => press(" ")], ["K", () => press("k")]]) {
  const before = moment.time;
  act();
  carom.frame(0.01);
  check(`${name} plays`, settings.isPlaying && near(moment.time, before + 0.01 * settings.rate));
  check(`${name} shows it`, byId("play").getAttribute("aria-pressed") === "true" && byId("play").title.startsWith("Pause"));
  act();
  const at = moment.time;
  carom.frame(0.01);
  check(`${name} pauses`, !settings.isPlaying && moment.time === at);
}
// A click on a button leaves Space to play, and does not have it press the button again.
for (const id of ["arrows", "trails", "next"]) {
  byId(id).focus();
  byId(id).click();
  const isOn = settings[id];
  for (const plays of [true, false]) {
    const isTaken = !byId(id).dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true, cancelable: true }));
    check(`space after a click on ${id} ${plays ? "plays" : "pauses"}`, settings.isPlaying === plays && isTaken && settings[id] === isOn);
  }
  check(`${id} has lost the focus`, document.activeElement !== byId(id));
  if (isOn) byId(id).click();
}
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
byId("play").click();
check("playing at the end begins anew", moment.time === 0 && settings.isPlaying);
byId("play").click();
give("rate", -60, "input");
const slowest = settings.rate;
give("rate", 60, "input");
check("the slider of speed spans nine decades", near(Math.log10(settings.rate / slowest), 9));
give("rate", 0, "input");
const usual = settings.rate;
press("ArrowUp");
check("arrow up", near(settings.rate, usual * Math.SQRT2));
press("ArrowDown");
check("arrow down", near(settings.rate, usual));
check("the speed is told", byId("rate-text").textContent.includes("per second"));

// Colours.
carom.seek(0.3 * duration);
const options = (id) => [...byId(id).options].map((option) => option.value);
check("all colourings are offered", options("colour").join() === "speed,species,collisions,id,psi6");
const seen = new Set();
for (const value of options("colour")) {
  give("colour", value, "change");
  check(`colour ${value}`, settings.colourBy === value && byId("legend").childElementCount > 0);
  seen.add(picture());
}
check("every colouring is another picture", seen.size === 5);
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

// Numbers against slow or other ways to them.
const order = (i) => {
  const { lower, upper, periodic } = carom.description.box;
  const away = (a, b, axis) => (periodic[axis] ? a - b - Math.round((a - b) / (upper[axis] - lower[axis])) * (upper[axis] - lower[axis]) : a - b);
  const others = [...moment.x.keys()].filter((j) => j !== i).map((j) => [away(moment.x[j], moment.x[i], 0), away(moment.y[j], moment.y[i], 1)]);
  const six = others.sort((a, b) => Math.hypot(...a) - Math.hypot(...b)).slice(0, 6).map(([x, y]) => 6 * Math.atan2(y, x));
  const mean = (f) => six.reduce((sum, angle) => sum + f(angle), 0) / 6;
  return Math.hypot(mean(Math.cos), mean(Math.sin));
};
give("colour", "psi6", "change");
for (const share of [0, 0.31, 0.77]) {
  carom.seek(share * duration);
  check(`sixfold order at ${share}`, [...moment.x.keys()].every((i) => Math.abs(psi[i] - order(i)) < 1e-12));
}
give("colour", "speed", "change");
carom.seek(duration);
// Velocities in the page are rounded to 24 bits, 6e-8 of the speed, and momenta handed over are seldom a hundredth of mass times speed.
check("Z of all collisions is the run's", Math.abs(compressibility(moment, energyOf(moment).temperature) / carom.description.Z - 1) < 1e-5);
carom.seek(0.3 * duration);

// Trails, arrows, ghosts.
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
check("and follows nobody", settings.followed === -1);
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
byId("trails").focus();
byId("trails").dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true }));
check("space on a button does not play", !settings.isPlaying);

noteChecks();
