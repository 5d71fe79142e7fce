// The panel beside the box: numbers of the moment, and the histogram of speeds with the curve of equilibrium.
"use strict";

const plot = document.getElementById("speeds");
const plotContext = plot.getContext("2d");
const speedCounts = new Uint32Array(speedBins);

/// Takes the plot as large as the page has it: asked for in every frame, its size would have the page laid out in every frame.
const plotSize = { width: 1, height: 1, density: 1 };
function resizePlot() {
  Object.assign(plotSize, { width: plot.clientWidth, height: plot.clientHeight, density: window.devicePixelRatio || 1 });
  plot.width = Math.round(plotSize.width * plotSize.density);
  plot.height = Math.round(plotSize.height * plotSize.density);
}

function drawSpeeds(moment, temperature) {
  const { width, height, density } = plotSize;
  const bottom = height - 18;
  const top = 4;
  countSpeeds(moment, speedCounts);
  plotContext.setTransform(density, 0, 0, density, 0, 0);
  plotContext.clearRect(0, 0, width, height);
  let most = 1;
  for (const count of speedCounts) most = Math.max(most, count);
  const points = 120;
  if (temperature > 0)
    for (let k = 1; k <= points; ++k) most = Math.max(most, 1.25 * maxwellCount((k / points) * speedRange, temperature));
  const level = (count) => bottom - ((bottom - top) * count) / most;
  plotContext.fillStyle = theme.accent;
  plotContext.globalAlpha = 0.45;
  const step = width / speedBins;
  for (let b = 0; b < speedBins; ++b) plotContext.fillRect(b * step + 0.5, level(speedCounts[b]), step - 1, bottom - level(speedCounts[b]));
  plotContext.globalAlpha = 1;
  if (temperature > 0) {
    plotContext.beginPath();
    for (let k = 0; k <= points; ++k)
      plotContext.lineTo((k / points) * width, level(maxwellCount((k / points) * speedRange, temperature)));
    plotContext.strokeStyle = theme.ink;
    plotContext.lineWidth = 1.5;
    plotContext.stroke();
  }
  plotContext.strokeStyle = theme.frame;
  plotContext.lineWidth = 1;
  plotContext.strokeRect(0.5, bottom + 0.5, width - 1, 0);
  plotContext.fillStyle = theme.muted;
  plotContext.font = `11px ${theme.font}`;
  for (const [share, align] of [[0, "left"], [0.5, "center"], [1, "right"]]) {
    plotContext.textAlign = align;
    plotContext.fillText(shortNumber(share * speedRange), share * width, height - 4);
  }
}

function showReadings(moment) {
  const { kinetic, potential, temperature } = energyOf(moment);
  const hasPotential = description.gravity[0] !== 0 || description.gravity[1] !== 0;
  say("energy", shortNumber(kinetic + (hasPotential ? potential : 0)));
  if (hasPotential) say("energy-label", `energy (${shortNumber(kinetic)} kinetic)`);
  say("temperature", shortNumber(temperature));
  say("pressure", shortNumber(compressibility(moment, temperature)));
  if (totals) {
    say("collisions", totals.pairs[moment.done].toLocaleString("en"));
    say("walls", totals.walls[moment.done].toLocaleString("en"));
  }
  say("time", `${moment.time.toPrecision(9).replace(/\.?0+$/, "")} / ${shortNumber(replay.duration)}`);
  const i = settings.followed;
  if (i >= 0) {
    const speed = speedOf(moment, i);
    const collisions = description.exact ? `, ${replay.collisionsOf(i)} collisions` : "";
    say("followed", `disk ${i}: speed ${shortNumber(speed)}${collisions}`);
  } else {
    say("followed", "click a disk to follow it");
  }
  showLegendEnds();
  drawSpeeds(moment, temperature);
}
