// The panel beside two runs from one start: the distance between them, overlaps, and curves of both.
"use strict";

const stepsCanvas = stages[1];
const stepsContext = stepsCanvas.getContext("2d", { alpha: false });

/// The parts of this page that other players do not have.
const panel = {
  describe() {
    control("how").textContent = "side by side";
    control("how-text").textContent = description.words.what;
    for (const name of ["growth", "window", "energy"]) say(name, description.words[name]);
    say("steps-words", `${description.steps.method}, dt = ${Number(dt.toPrecision(4))}`);
    control("next-overlap").disabled = overlapBegin.length === 0;
    window.carom.stepsMoment = stepsMoment;
  },
  /// Draws the moment. While the page plays, overlaps since the last frame are marked too.
  show(since) {
    const { time } = moment;
    const distance = measureDistances();
    drawMoment(moment);
    drawMoment(stepsMoment, stepsContext);
    const flashing = overlapsBetween(Math.min(since, time), Math.max(since, time));
    drawOverlaps(stepsMoment, flashing);
    drawDistance(time, distance);
    drawOverlapCount(time);
    say("distance", distance < 1e-10 ? "0, to rounding" : shortNumber(distance));
    say("overlaps-now", overlapsBetween(time, time).length.toLocaleString("en"));
    say("overlaps-so-far", overlapsBegunBy(time).toLocaleString("en"));
    say("deepest", overlapsBegunBy(time) > 0 ? `${(100 * deepestBy(time)).toPrecision(2)} % of a diameter` : "–");
    say("collisions", totals.pairs[exact.doneAt(time)].toLocaleString("en"));
    say("steps-taken", moment.done.toLocaleString("en"));
    Object.assign(window.carom, { distance, flashing });
  },
  ofDisk: (i) => `${shortNumber(apart[i])} diameters apart`,
};

control("next-overlap").addEventListener("click", showNextOverlap);
addKey("O", "to the next overlap", showNextOverlap);
connectPointer(stepsCanvas, stepsMoment);
connectCurves();
