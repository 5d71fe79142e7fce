// The panel beside the box: numbers of the moment, and the histogram of speeds with the equilibrium distribution.
"use strict";

const speedPlot = plotOn("speeds");
const speedCounts = new Uint32Array(speedBins);

function drawSpeeds(moment, temperature) {
  const { context, width, height } = speedPlot;
  const bottom = height - 18;
  const top = 4;
  countSpeeds(moment, speedCounts);
  clearPlot(speedPlot);
  let most = 1;
  for (const count of speedCounts) most = Math.max(most, count);
  const points = 120;
  if (temperature > 0)
    for (let k = 1; k <= points; ++k) most = Math.max(most, 1.25 * maxwellCount((k / points) * speedRange, temperature));
  const level = (count) => bottom - ((bottom - top) * count) / most;
  context.fillStyle = theme.accent;
  context.globalAlpha = 0.45;
  const step = width / speedBins;
  for (let b = 0; b < speedBins; ++b) context.fillRect(b * step + 0.5, level(speedCounts[b]), step - 1, bottom - level(speedCounts[b]));
  context.globalAlpha = 1;
  if (temperature > 0) {
    context.beginPath();
    for (let k = 0; k <= points; ++k)
      context.lineTo((k / points) * width, level(maxwellCount((k / points) * speedRange, temperature)));
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5;
    context.stroke();
  }
  context.strokeStyle = theme.frame;
  context.lineWidth = 1;
  context.strokeRect(0.5, bottom + 0.5, width - 1, 0);
  context.fillStyle = theme.muted;
  for (const [share, align] of [[0, "left"], [0.5, "center"], [1, "right"]]) {
    context.textAlign = align;
    context.fillText(shortNumber(share * speedRange), share * width, height - 4);
  }
}

function showReadings(moment) {
  const { kinetic, potential, temperature } = energyOf(moment);
  const hasPotential = description.acceleration[0] !== 0 || description.acceleration[1] !== 0;
  say("energy", shortNumber(kinetic + (hasPotential ? potential : 0)));
  if (hasPotential) say("energy-label", `energy (${shortNumber(kinetic)} kinetic)`);
  say("temperature", shortNumber(temperature));
  say("pressure", shortNumber(compressibility(moment, temperature)));
  if (totals) {
    say("collisions", totals.pairs[moment.done].toLocaleString("en"));
    say("walls", totals.walls[moment.done].toLocaleString("en"));
  }
  drawSpeeds(moment, temperature);
}

/// The parts of this page that other players do not have.
const panel = {
  describe() {
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
    for (const name of ["collisions", "walls"]) readings[name].closest("div").hidden = !totals;
    if (description.whyNoZ) say("pressure-label", `no pressure Z: ${description.whyNoZ}`);
    else if (!totals) say("pressure-label", "pressure Z of the run");
  },
  show() {
    drawMoment(moment);
    drawCollision(moment);
    showReadings(moment);
  },
  ofDisk(i) {
    const collisions = description.exact ? `, ${replay.collisionsOf(i)} collisions` : "";
    return `speed ${shortNumber(speedOf(moment, i))}${collisions}`;
  },
};
