// The moment that is shown, and how it changes: by the reader's clock, from collision to collision, or to a chosen time.
"use strict";

const moment = emptyMoment();
const duration = replay.duration;
const steps = replay.stepTimes;  // of the collisions, or of the samples where there is no log
let isStale = true;              // the screen does not show `moment` and the settings yet

/// Shows a time, after all events up to it; or after `done` events, which distinguishes events at one time.
function showTime(time, done = undefined) {
  const within = Math.min(Math.max(time, 0), duration);
  replay.read(within, done ?? replay.doneAt(within), moment);
  isStale = true;
}

/// Shows the state just after the next event, or after the one before.
function stepEvent(direction) {
  change({ isPlaying: false });
  if (direction > 0) {
    if (moment.done < steps.length) showTime(steps[moment.done], moment.done + 1);
    else showTime(duration);
    return;
  }
  const last = moment.done - 1;
  const target = last >= 0 && moment.time > steps[last] ? last : last - 1;
  if (target >= 0) showTime(steps[target], target + 1);
  else showTime(0, description.exact ? 0 : 1);
}

/// Advances by a number of seconds of the reader's clock. At an end of the run playing starts again or stops.
function advance(seconds) {
  if (!settings.isPlaying || !(duration > 0)) return;
  let time = moment.time + (settings.isBackwards ? -1 : 1) * settings.rate * seconds;
  if (time > duration || time < 0) {
    if (settings.loop) {
      time -= Math.floor(time / duration) * duration;
    } else {
      change({ isPlaying: false });
    }
  }
  showTime(time);
}

/// Plays or pauses. At the end of the run playing starts again from the other end.
function togglePlay() {
  const atEnd = settings.isBackwards ? moment.time <= 0 : moment.time >= duration;
  if (!settings.isPlaying && atEnd) showTime(settings.isBackwards ? duration : 0);
  change({ isPlaying: !settings.isPlaying });
}

/// Returns the nearest of the round rates ..., 0.5, 1, 2, 5, 10, ...
function roundRate(rate) {
  const power = 10 ** Math.floor(Math.log10(rate));
  const lead = rate / power;
  return (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power;
}

/// Returns the next round rate above or below one.
const fasterRate = (rate) => roundRate(rate * (roundRate(rate) > 1.01 * rate ? 1 : 2.2));
const slowerRate = (rate) => roundRate(rate / (roundRate(rate) < 0.99 * rate ? 1 : 2.2));

// A disk of typical speed crosses the box in some six seconds. The whole run takes some four at least.
const usualRate = roundRate(Math.min((0.16 * Math.min(extent[1] - extent[0], extent[3] - extent[2])) / speedScale, duration / 4) || 1);
settings.rate = usualRate;
