// What the page of two flights alone has: both sides at one time, overlaps, distances, curves. Run behind page_checks.js.
{
  const { moment, stepsMoment, settings, view, duration, columns } = carom;
  const { dt, count } = carom.description.steps;
  const reading = (name) => document.querySelector(`[data-reading=${name}]`).textContent;
  const stepsStage = byId("steps");
  const copies = {};
  /// The levels of a canvas, read from a copy that is made for it.
  const levelsOf = (id) => {
    const { width, height } = byId(id);
    copies[id] ??= new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    copies[id].clearRect(0, 0, width, height);
    copies[id].drawImage(byId(id), 0, 0);
    return copies[id].getImageData(0, 0, width, height).data;
  };
  const picturesOf = (...ids) => {
    carom.frame(0);
    return ids.map((id) => levelsOf(id).reduce((hash, byte) => (Math.imul(hash, 31) + byte) | 0, 0));
  };
  const overlapColour = { light: [213, 94, 0], dark: [255, 122, 41] };
  const overlapPixels = (id) => {
    carom.frame(0);
    const data = levelsOf(id);
    const [r, g, b] = overlapColour[document.documentElement.dataset.theme];
    let found = 0;
    for (let at = 0; at < data.length; at += 4) if (data[at] === r && data[at + 1] === g && data[at + 2] === b) ++found;
    return found;
  };

  // Time: both sides go together, from step to step.
  // The browser may have shown some frames already, which play.
  const atMost = settings.rate * performance.now() / 1000;
  carom.frame(0);  // or none at all
  check("it begins at the start", moment.time <= atMost && stepsMoment.time === moment.time && (moment.time > 0 || carom.distance === 0));
  check("the two canvases are one size", stepsStage.width === stageCanvas.width && stepsStage.height === stageCanvas.height);
  carom.seek(0.25 * duration);
  check("the seek", moment.time === 0.25 * duration && stepsMoment.time === moment.time && !settings.isPlaying);
  carom.change({ isPlaying: true });
  carom.frame(0.01);
  check("both play", near(moment.time, 0.25 * duration + 0.01 * settings.rate) && stepsMoment.time === moment.time);
  carom.change({ isPlaying: false });
  press("Home");
  carom.frame(0);
  check("no step is taken at the beginning", reading("steps-taken") === "0");
  byId("next").click();
  check("a step on is a time step", moment.time === dt && stepsMoment.time === dt && moment.done === 1);
  carom.seek(4.5 * dt);
  byId("previous").click();
  carom.frame(0);
  check("back from between two steps", moment.time === 4 * dt && stepsMoment.time === 4 * dt && reading("steps-taken") === "4");
  check("what it steps to is told", byId("next").title.includes("step"));
  press("End");
  carom.frame(0);
  check("all steps are taken at the end", reading("steps-taken") === count.toLocaleString("en"));

  // Numbers, slowly: pairs of disks nearer than contact, and the root mean square distance.
  const away = (a, b, axis) => {
    const { lower, upper, periodic } = carom.description.box;
    const length = upper[axis] - lower[axis];
    return periodic[axis] ? a - b - Math.round((a - b) / length) * length : a - b;
  };
  const overlapping = (side) => {
    const pairs = [];
    for (let i = 0; i < side.x.length; ++i)
      for (let j = i + 1; j < side.x.length; ++j)
        if (Math.hypot(away(side.x[i], side.x[j], 0), away(side.y[i], side.y[j], 1)) < (columns.radius[i] + columns.radius[j]) * (1 - 1e-8)) pairs.push([i, j]);
    return pairs;
  };
  let withOverlaps = 0;
  let withoutAny = 0;
  for (let k = 0; k <= 60; ++k) {
    carom.seek((k / 60) * duration);
    const pairs = overlapping(stepsMoment);
    check(`overlaps at ${k}`, reading("overlaps-now") === String(pairs.length) && carom.flashing.length === pairs.length);
    check(`none on the exact side at ${k}`, overlapping(moment).length === 0 && overlapPixels("stage") === 0);
    check(`they are drawn where there are some, at ${k}`, overlapPixels("steps") > 0 === pairs.length > 0);
    if (pairs.length > 0) ++withOverlaps;
    else ++withoutAny;
    let sum = 0;
    for (let i = 0; i < moment.x.length; ++i) sum += away(moment.x[i], stepsMoment.x[i], 0) ** 2 + away(moment.y[i], stepsMoment.y[i], 1) ** 2;
    check(`distance at ${k}`, near(carom.distance, Math.sqrt(sum / moment.x.length) / carom.description.sigma));
  }
  check("both kinds of moments were seen", withOverlaps > 3 && withoutAny > 3);
  let worst = 0;
  for (let k = 0; k < columns.distance.length; ++k) {
    carom.seek(columns.distanceTime[k]);
    worst = Math.max(worst, Math.abs(carom.distance - columns.distance[k]));
  }
  // Places along flights are added up in another order: 2e-16 of a box of 10 for each of a few hundred.
  check(`the curve is that of the places drawn, within ${worst}`, worst < 1e-11);
  carom.seek(duration);
  check("all overlaps are counted at the end", reading("overlaps-so-far") === columns.overlapBegin.length.toLocaleString("en"));
  check("collisions too", reading("collisions") === [...columns.partner].filter((j) => j < carom.description.disks).length.toLocaleString("en"));

  // Next overlap, and flashes of what a frame of the film would jump over.
  carom.seek(0);
  byId("next-overlap").click();
  carom.frame(0);
  check("next overlap", carom.flashing.includes(0) && moment.time > columns.overlapBegin[0] && moment.time < columns.overlapEnd[0]);
  const first = moment.time;
  press("o");
  check("O", moment.time > first && !settings.isPlaying);
  const last = columns.overlapBegin.length - 1;
  const [begin, end] = [columns.overlapBegin[last], columns.overlapEnd[last]];
  const before = Math.max(begin - 1.5 * (end - begin), 0);
  carom.seek(before);
  carom.change({ rate: (Math.min(end + (end - begin), duration) - before) / 0.05, isPlaying: true });
  carom.frame(0.05);
  check("a film flashes what it jumps over", carom.flashing.includes(last));
  carom.change({ isPlaying: false });
  carom.seek(before);
  check("and not before", !carom.flashing.includes(last));

  // Curves grow, and a press on one goes there.
  carom.seek(0.3 * duration);
  const atThird = picturesOf("distance", "overlaps");
  carom.seek(0.6 * duration);
  const later = picturesOf("distance", "overlaps");
  check("curves grow", atThird[0] !== later[0] && atThird[1] !== later[1]);
  for (const id of ["distance", "overlaps"]) {
    const frame = byId(id).getBoundingClientRect();
    byId(id).dispatchEvent(new PointerEvent("pointerdown", { clientX: frame.left + 46 + 0.25 * (frame.width - 60), clientY: frame.top + 20, bubbles: true }));
    check(`a press on ${id}`, Math.abs(moment.time - 0.25 * duration) < 1e-9 * duration);
  }

  // View, colours, light and dark: one for both sides.
  carom.seek(0.5 * duration);
  byId("fit").click();
  const scale = view.scale;
  const whole = picturesOf("stage", "steps");
  byId("zoom-in").click();
  const nearer = picturesOf("stage", "steps");
  check("zoom", near(view.scale, 1.25 * scale) && nearer[0] !== whole[0] && nearer[1] !== whole[1]);
  stepsStage.dispatchEvent(new WheelEvent("wheel", { deltaY: 200, clientX: stepsStage.getBoundingClientRect().left + 50, clientY: 200, bubbles: true, cancelable: true }));
  check("the wheel on the right", view.scale < 1.25 * scale);
  press("0");
  check("it begins with the distance from its twin", settings.colourBy === "apart");
  byId("next-overlap").click();
  give("theme", "dark", "change");
  check("dark", document.documentElement.dataset.theme === "dark" && overlapPixels("steps") > 0 && overlapPixels("stage") === 0);
  give("theme", "light", "change");
  check("light", document.documentElement.dataset.theme === "light" && overlapPixels("steps") > 0);
  give("theme", "auto", "change");
  for (const id of ["trails", "arrows", "ghosts"]) {
    const without = picturesOf("stage", "steps");
    byId(id).click();
    const drawn = picturesOf("stage", "steps");
    check(`${id} on both`, drawn[0] !== without[0] && drawn[1] !== without[1]);
    byId(id).click();
  }
  const [px, py] = carom.pixel(stepsMoment.x[3], stepsMoment.y[3]);
  const corner = stepsStage.getBoundingClientRect();
  for (const type of ["pointerdown", "pointerup"])
    stepsStage.dispatchEvent(new PointerEvent(type, { clientX: corner.left + px, clientY: corner.top + py, pointerId: 1, bubbles: true }));
  carom.frame(0);
  check("a click on the right follows", settings.followed === 3 && reading("followed").startsWith("disk 3"));
  check("the view follows the exact one", near(view.x, moment.x[3]) && near(view.y, moment.y[3]));
  press("Escape");

  // Words.
  check("the method is named", reading("steps-words") === "guarded, dt = 0.05");
  check("steps are counted", columns.turnStep.length > 0 && count === Math.floor(duration / dt + 1e-9));
  check("the keys", byId("help").textContent.includes("next step, previous one") && byId("help").textContent.includes("Oto the next overlap"));
}
