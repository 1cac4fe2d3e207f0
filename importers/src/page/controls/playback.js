// Time: seeking, stepping, playing, and jumping to the next key or event.

const clampTime = time => Math.min(recording.endTime, Math.max(recording.startTime, time));
const seek = time => change({time: clampTime(time)});
const toFrame = frame => seek(times[Math.min(recording.frameCount - 1, Math.max(0, frame))]);

// From a time between two frames, one step goes to the nearest frame in its direction.
function step(count) {
  change({playing: false});
  const before = recording.frameBefore(state.time), on = times[before] === state.time;
  toFrame(before + count + (on || count > 0 ? 0 : 1));
}
function play() {
  if (state.time >= recording.endTime) toFrame(0);
  change({playing: true});
}
const pause = () => change({playing: false});

const keyTimesOf = node => node.lanes.flatMap(lane => Array.from(lane.times))
  .concat(recording.handoffs.filter(handoff => handoff.node === node.index).map(handoff => handoff.time));
const allKeyTimes = () => (state.chosen && keyTimesOf(state.chosen).length ? keyTimesOf(state.chosen)
  : recording.lanes.flatMap(lane => Array.from(lane.times)));
const allEventTimes = () => recording.events.concat(recording.handoffs).map(event => event.time);

// Goes to the nearest time of `list` after the present one, or before it if `direction` is negative.
function toNext(list, direction) {
  change({playing: false});
  const ahead = list.filter(time => (time - state.time) * direction > 1e-9);
  if (ahead.length) seek(ahead.reduce((a, b) => ((b - a) * direction < 0 ? b : a)));
}

let lastTick = 0;
function tick(now) {
  if (state.playing && !state.led && lastTick) {
    let time = state.time + Math.min(0.25, (now - lastTick) / 1000) * state.speed;
    if (time >= recording.endTime) {
      if (state.loop && recording.duration > 0)
        time = recording.startTime + (time - recording.endTime) % recording.duration;
      else change({playing: false});
    }
    seek(time);
  }
  lastTick = now;
  requestAnimationFrame(tick);
}
