// What the person looking has set: one object, and those who want to know of changes.

const state = {frame: 0, playing: false, speed: 1, loop: true, chosen: null, byOwner: true, trail: true,
  skeleton: false, colliders: false};
const listeners = [];
const onChange = listener => listeners.push(listener);

function change(values) {
  let any = false;
  for (const name in values)
    if (state[name] !== values[name]) { state[name] = values[name]; any = true; }
  if (any) for (const listener of listeners) listener(values);
}

let playTime = startTime;  // where playing stands between two frames

function seek(time) {
  playTime = Math.min(endTime, Math.max(startTime, time));
  change({frame: frameAt(playTime)});
}
function toFrame(frame) {
  const clamped = Math.min(frameCount - 1, Math.max(0, frame));
  playTime = times[clamped];
  change({frame: clamped});
}
function step(count) {
  change({playing: false});
  toFrame(state.frame + count);
}
function play() {
  if (state.frame === frameCount - 1) toFrame(0);
  change({playing: true});
}
const pause = () => change({playing: false});

let lastTick = 0;
function tick(now) {
  if (state.playing && lastTick) {
    let time = playTime + Math.min(0.25, (now - lastTick) / 1000) * state.speed;
    if (time >= endTime) {
      if (state.loop && duration > 0) time = startTime + (time - endTime) % duration;
      else change({playing: false});
    }
    seek(time);
  }
  lastTick = now;
  requestAnimationFrame(tick);
}
