// The numbers beside the disks, each with its unit.
"use strict";

const saying = {};
function put(name, text, unit = "") {
  const key = `${text} ${unit}`;
  if (saying[name] === key) return;
  saying[name] = key;
  const place = document.querySelector(`[data-number="${name}"]`);
  place.textContent = text;
  if (unit) {
    const small = document.createElement("small");
    small.textContent = ` ${unitText(unit)}`;
    place.append(small);
  }
}

const grouped = (value) => Math.round(value).toLocaleString(language);

function showNumbers() {
  const n = run.numbers;
  const d = run.description;
  const m = run.measured;
  put("time", short(n[at.time], 5), "time");
  put("disks", grouped(disks));
  put("collisions", grouped(collisions()));
  put("rate", run.isPlaying ? t("perSecond", { count: grouped(run.pairsPerSecond) }) : "–");
  put("kT", short(n[at.kT], 4), "energy");
  put("energy", short(n[at.kinetic] + n[at.spin] + n[at.potential] + n[at.pistons], 5), "energy");
  const sides = halves();
  put("sides", `${short(sides.leftT)} | ${short(sides.rightT)}`, "energy");
  put("counts", `${sides.leftCount} | ${sides.rightCount}`);
  put("packing", short((d.packing * n[at.scale] ** 2 * areaAtStart()) / area(), 3));

  const isZ = d.whyNoZ === "";
  const isTheory = d.theoryZ !== null && disks >= 20;
  byId("Zrow").hidden = byId("factorRow").hidden = !isZ;
  byId("theoryRow").hidden = byId("theoryOfZ").hidden = !isTheory;
  const infinite = d.theoryIsInfinite ? t("number.theoryInfinite") : null;
  byId("theoryRow").textContent = infinite ?? t("number.theory");
  byId("theoryName").textContent = infinite ?? t("number.theoryZ");
  byId("noZ").hidden = isZ;
  if (!isZ) byId("noZ").textContent = t("noZ", { why: told(d.whyNoZ) });
  if (m && isZ) {
    put("pressure", withError(m.pressure, m.pressure_error), "energy / length²");
    put("Z", withError(m.Z, m.Z_error));
    const theory = d.theoryZ;
    if (isTheory) {
      const ideal = (disks * n[at.kT]) / area();
      put("theory", `${short(theory * ideal, 4)}`, "energy / length²");
      put("theoryZ", short(theory, 5));
    }
  }
  const hasWalls = !d.periodic[0] || !d.periodic[1];
  byId("wallsRow").hidden = !hasWalls;
  if (m && hasWalls) {
    const name = (k) => (d.isCircle ? "" : `${t(`wall.${k}`)} `);
    const shown = m.walls.map((wall, k) => (d.periodic[k < 2 ? 0 : 1] || (d.isCircle && k > 0) ? null : `${name(k)}${wall.pressure_error > 0 ? withError(wall.pressure, wall.pressure_error) : short(wall.pressure)}`)).filter(Boolean);
    put("walls", shown.join(" · "), "energy / length²");
  }
  // Paths end at posts too, which are not counted.
  byId("pathRow").hidden = d.obstacles.some((one) => one.centre);
  const theoryPath = enskogPath();
  put("path", `${short(n[at.path])}${theoryPath ? ` (${infinite ? `${infinite}:` : t("enskog")} ${short(theoryPath)})` : ""}`, "length");

  // Where disks meet that stood where a change has put them, the last digit may be missing.
  const isRounding = n[at.deepest] < 1e-9;
  put("overlaps", `${isRounding ? 0 : grouped(n[at.overlapping])}${n[at.overlapping] > 0 ? ` (${t("twin.deepest")} ${short(100 * n[at.deepest], 2)} %)` : ""}`);
  put("missed", run.fault ? run.fault : t(run.checks > 0 ? "missedNone" : "missedUnchecked", { count: run.checks }));
  put("engine", `${d.engine}`);

  const twin = run.twinNumbers;
  byId("twinTable").hidden = !twin;
  if (twin) {
    const energy = n[at.kinetic] + n[at.spin] + n[at.potential] + n[at.pistons];
    put("exactTime", short(n[at.time], 5));
    put("twinTime", short(twin.time, 5));  // behind where its steps take longer than they get
    put("twinOverlaps", `${twin.overlapping}`);
    put("twinDeepest", `${short(100 * twin.deepest, 2)} %`);
    put("twinCollisions", grouped(twin.collisions));
    put("twinEnergy", energy > 0 ? `${short(100 * (twin.energy / energy - 1), 2)} %` : "–");
    put("exactDeepest", `${short(100 * n[at.deepest], 2)} %`);
  }

  const back = m?.reversed_at !== null && m?.reversed_at !== undefined;
  byId("wayBackSection").hidden = !back;
  if (back) {
    const last = m.way_back.at(-1);
    put("wayBack", last ? short(last[1], 3) : "–", "length");
    byId("wayBackWords").textContent = t(!isReversible(d) ? "wayBackNone" : last && last[1] > 0.1 * (run.radius[0] ?? 1) ? "wayBackLost" : "wayBackGood");
  }
  put("changes", t("changesSoFar", { count: n[at.changes] }) + (n[at.pending] > 0 ? ` · ${t("changesLeft", { count: n[at.pending] })}` : ""));
  byId("late").hidden = !(run.isLate && run.isPlaying);
  if (run.isLate && run.isPlaying) byId("late").textContent = t("late", { count: grouped(run.pairsPerSecond) });
}

/// Whether reversed disks go back to where they came from but for rounding: no effect loses energy, draws numbers or goes on in its own
/// direction of time.
function isReversible(d) {
  const isSmoothOrRough = d.roughness === null || Math.abs(d.roughness) === 1;
  return isSmoothOrRough && (d.restitution ?? 1) === 1 && !d.drag && !d.tumbling && !d.brownian?.rate && !d.thermostatRate && !d.shear && !d.growth &&
    d.walls.every((wall) => (wall.restitution ?? 1) === 1 && wall.temperature === null && !wall.velocity && !wall.vibration && !wall.amplitude && !wall.slides);
}

/// The area of a box of this width and height; one that is a circle fills pi / 4 of them.
const areaOf = (width, height) => (box.isCircle ? Math.PI / 4 : 1) * width * height;
const area = () => areaOf(run.numbers[at.right] - run.numbers[at.left], run.numbers[at.top] - run.numbers[at.bottom]);
const areaAtStart = () => areaOf(...box.lengths);

let hashTimer = 0;
/// Shows the hash of the state of now, which is that of `carom run` at this time.
async function showHash() {
  clearTimeout(hashTimer);
  hashTimer = setTimeout(async () => {
    try {
      const { hash } = await run.engine.ask("hash");
      put("hash", hash);
    } catch (error) {
      notify(error.message);
    }
  }, 30);
}

/// Compares the engine's plan with an exhaustive search now and then: no collision is missed.
async function checkNow() {
  if (!run.description || disks > 1500 || disks === 0 || !run.isPlaying) return;
  try {
    const { fault } = await run.engine.ask("check");
    ++run.checks;
    run.fault = fault;
  } catch {
    // A scene that stands still has nothing to check.
  }
}
