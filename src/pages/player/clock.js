// The moment that is shown, and how it moves on: with the reader's clock, from collision to collision, or where it is put.
"use strict";

const moment = emptyMoment();
const duration = replay.duration;
const steps = replay.stepTimes;  // of the collisions, or of the samples where there is no log
let isStale = true;              // what is on the screen is no longer what it should be

/// To a time, after all that happened by then; or after `done` events, for stops between events at one time.
function showTime(time, done = undefined) {
  const within = Math.min(Math.max(time, 0), duration);
  replay.read(within, done ?? replay.doneAt(within), moment);
  isStale = true;
}

/// To just after the next event, or the one before.
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

/// On by so many seconds of the reader's clock. At an end of the run it begins again, or stays.
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

/// Playing from an end in its own direction begins anew.
function togglePlay() {
  const atEnd = settings.isBackwards ? moment.time <= 0 : moment.time >= duration;
  if (!settings.isPlaying && atEnd) showTime(settings.isBackwards ? duration : 0);
  change({ isPlaying: !settings.isPlaying });
}

// A disk of typical speed takes some six seconds through the box, but the run at least four from its beginning to its end.
const usualRate = Math.min((0.16 * Math.min(extent[1] - extent[0], extent[3] - extent[2])) / speedScale, duration / 4) || 1;
settings.rate = usualRate;
