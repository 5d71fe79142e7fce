// The two sides as replays: the collisions of the exact run, and the changes of velocity in the fixed steps. Between these, disks
// fly straight in both. The clock of the page advances from step to step.
"use strict";

const { dt, count: stepCount } = description.steps;

/// Returns the changes of velocity in the fixed steps as events of one disk each, as collisions with a wall are.
function velocityChangesAsEvents() {
  const { start, turnStep, turnDisk, turnVelocity } = columns;
  const velocity = new Float64Array(2 * turnVelocity.length);
  for (let e = 0; e < turnStep.length; ++e) velocity.set(turnVelocity.subarray(2 * e, 2 * e + 2), 4 * e);
  const time = Float64Array.from(turnStep, (step) => step * dt);
  return { start, time, disk: turnDisk, partner: new Uint32Array(turnStep.length).fill(disks), velocity };
}

const exact = exactReplay();
const stepped = exactReplay(velocityChangesAsEvents());
const stepsMoment = emptyMoment();  // state of the fixed-step method at the time of the moment shown
const stepTimes = Float64Array.from({ length: stepCount }, (_, step) => Math.min((step + 1) * dt, description.duration));

/// Reads both sides; `done` counts steps.
const replay = {
  ...exact,
  stepName: "step",
  stepTimes,
  doneAt: (time) => countUpTo(stepTimes, time),
  read(time, done, moment) {
    exact.read(time, exact.doneAt(time), moment);
    stepped.read(time, stepped.doneAt(time), stepsMoment);
    moment.done = done;
  },
};
