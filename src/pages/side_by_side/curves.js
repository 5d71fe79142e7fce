// The two curves, up to the moment shown: the distance between the two sides on a logarithmic scale, and the number of overlaps. A
// click on a curve shows the moment there.
"use strict";

const distancePlot = plotOn("distance");
const overlapPlot = plotOn("overlaps");
const inset = { left: 46, right: 14, top: 8, bottom: 22 };

const plotX = (plot, time) => inset.left + (time / duration) * (plot.width - inset.left - inset.right);
const plotY = (plot, share) => plot.height - inset.bottom - share * (plot.height - inset.top - inset.bottom);

/// Returns about `count` round numbers from 0 to at most `end`.
function roundTicks(end, count) {
  const rough = end / count;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * decade).find((k) => k >= rough * 0.999);
  return Array.from({ length: Math.floor(end / step + 1e-9) + 1 }, (_, k) => k * step);
}

/// Clears the plot and draws its axes; `levels` are pairs of a fraction of the height and a label.
function drawAxes(plot, levels) {
  const { context, width, height } = plot;
  clearPlot(plot);
  context.lineWidth = 1;
  context.strokeStyle = theme.rule;
  context.fillStyle = theme.muted;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const [share, text] of levels) {
    const y = Math.round(plotY(plot, share)) + 0.5;
    context.beginPath();
    context.moveTo(inset.left, y);
    context.lineTo(width - inset.right, y);
    context.stroke();
    context.fillText(text, inset.left - 6, y);
  }
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  context.fillText("time", width - inset.right - 12, height - 6);
  for (const time of roundTicks(duration, Math.max(2, Math.min(8, width / 80)))) {
    const x = plotX(plot, time);
    if (x < width - inset.right - 40) context.fillText(shortNumber(Number(time.toPrecision(12))), x, height - 6);
  }
}

/// Draws a curve through points (time, fraction of the height), and marks the last, which is the moment shown.
function drawCurve(plot, points, colour) {
  const { context } = plot;
  if (points.length === 0) return;
  context.beginPath();
  for (const [time, share] of points) context.lineTo(plotX(plot, time), plotY(plot, share));
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.lineJoin = "round";
  context.stroke();
  const [time, share] = points[points.length - 1];
  context.beginPath();
  context.arc(plotX(plot, time), plotY(plot, share), 4, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
}

const decades = { low: lowestDecade, high: Math.max(1, Math.ceil(Math.log10(Math.max(1, ...columns.distance.filter(Number.isFinite))))) };
const shareOfDistance = (distance) =>
  Math.min(Math.max((Math.log10(Math.max(distance, 1e-300)) - decades.low) / (decades.high - decades.low), 0), 1);

/// Draws the growth by e per Lyapunov time through the point at a tenth of a diameter; only the slope has a meaning.
function drawGrowth() {
  const through = columns.distance.findIndex((d) => d >= 0.1);
  if (!description.lyapunov || through < 0) return;
  const timeOf = (distance) => columns.distanceTime[through] + Math.log(distance / columns.distance[through]) / description.lyapunov.perTime;
  const { context } = distancePlot;
  context.save();
  context.beginPath();
  context.rect(inset.left, 0, distancePlot.width - inset.left - inset.right, distancePlot.height - inset.bottom);
  context.clip();
  context.setLineDash([5, 4]);
  context.strokeStyle = theme.muted;
  context.lineWidth = 1.5;
  context.beginPath();
  for (const distance of [10 ** decades.low, 1]) context.lineTo(plotX(distancePlot, timeOf(distance)), plotY(distancePlot, shareOfDistance(distance)));
  context.stroke();
  context.restore();
  context.textAlign = "left";
  context.fillStyle = theme.muted;
  context.fillText("dashed: × e per Lyapunov time", inset.left + 8, inset.top + 10);
}

function drawDistance(time, now) {
  const each = Math.ceil((decades.high - decades.low) / 6);
  const levels = [];
  for (let decade = decades.low; decade <= decades.high; decade += each) levels.push([shareOfDistance(10 ** decade), powerOfTen(decade)]);
  drawAxes(distancePlot, levels);
  drawGrowth();
  const known = countUpTo(columns.distanceTime, time);
  const points = Array.from({ length: known }, (_, k) => [columns.distanceTime[k], shareOfDistance(columns.distance[k])]);
  drawCurve(distancePlot, [...points, [time, shareOfDistance(now)]], theme.accent);
}

function drawOverlapCount(time) {
  const ticks = roundTicks(Math.max(overlapBegin.length, 1), 4).filter(Number.isInteger);
  const most = Math.max(overlapBegin.length, 1) * 1.04;
  drawAxes(overlapPlot, ticks.map((count) => [count / most, count.toLocaleString("en")]));
  const begun = overlapsBegunBy(time);
  const every = Math.max(1, Math.floor(begun / 2000));  // fewer points than pixels
  const points = [[0, 0]];
  for (let k = 0; k < begun; k += every) points.push([overlapBegin[k], k / most], [overlapBegin[k], (k + 1) / most]);
  drawCurve(overlapPlot, [...points, [time, begun / most]], theme.overlap);
}

function connectCurves() {
  for (const plot of [distancePlot, overlapPlot]) {
    const show = (event) => {
      const { left } = plot.element.getBoundingClientRect();
      showTime(((event.clientX - left - inset.left) / (plot.width - inset.left - inset.right)) * duration);
    };
    plot.element.addEventListener("pointerdown", (event) => {
      change({ isPlaying: false });
      show(event);
    });
    plot.element.addEventListener("pointermove", (event) => event.buttons & 1 && show(event));
  }
}
