// The span of time that the timeline and the curves show: zoomed by the wheel, moved by dragging.

const axisEdge = 10;  // room left and right of the first and last time, px
const leastStretch = () => Math.max(1e-6, recording.duration / 1e5);

const stretch = () => Math.max(state.until - state.from, 1e-12);
const xOfTime = (time, width, left = axisEdge, right = axisEdge) =>
  left + (recording.duration > 0 ? (time - state.from) / stretch() : 0) * (width - left - right);
const timeOfX = (x, width, left = axisEdge, right = axisEdge) =>
  clampTime(state.from + (x - left) / (width - left - right) * (recording.duration > 0 ? stretch() : 0));
const zoomed = () => recording.duration > 0 && stretch() < recording.duration * (1 - 1e-9);

function showStretch(from, length) {
  const fitting = Math.min(recording.duration, Math.max(leastStretch(), length));
  const start = Math.min(recording.endTime - fitting, Math.max(recording.startTime, from));
  change({from: start, until: fitting >= recording.duration ? recording.endTime : start + fitting});
}
const showAllTime = () => change({from: recording.startTime, until: recording.endTime});
function zoomTime(factor, about = state.time) {
  const length = Math.min(recording.duration, Math.max(leastStretch(), stretch() * factor));
  showStretch(about - (about - state.from) * length / stretch(), length);
}
const panTime = by => showStretch(state.from + by, stretch());

// While playing, the shown span moves on to begin at the present time when the time leaves it.
function keepTimeInSight() {
  if (!state.playing || !zoomed() || (state.time >= state.from && state.time <= state.until)) return;
  showStretch(state.time, stretch());
}

// Snaps to the nearest of `list` within some pixels.
function snapped(time, list, width, left, right) {
  if (!state.snap) return time;
  let best = time, least = 6;
  for (const candidate of list) {
    const away = Math.abs(xOfTime(candidate, width, left, right) - xOfTime(time, width, left, right));
    if (away < least) { least = away; best = candidate; }
  }
  return best;
}

// Makes an element scrub, zoom and pan. `left` and `right`: its margins beside the axis; `snaps` gives times to snap to;
// `pans`: whether a drag moves the span while zoomed in (a click still goes to its time).
function wireAxis(element, {left = axisEdge, right = axisEdge, snaps = () => [], pans = false, hover = () => ""} = {}) {
  const place = event => event.clientX - element.getBoundingClientRect().left;
  const timeAt = event => {
    const time = timeOfX(place(event), element.clientWidth, left, right);
    return event.altKey ? time : snapped(time, snaps(), element.clientWidth, left, right);
  };
  let last = null, travelled = 0, panning = false;
  const go = event => {
    change({playing: false});
    seek(timeAt(event));
  };
  element.addEventListener("pointerdown", event => {
    element.setPointerCapture(event.pointerId);
    last = event.clientX;
    travelled = 0;
    panning = event.button === 1 || event.button === 2 || (pans && zoomed());
    if (!panning) go(event);
  });
  element.addEventListener("pointermove", event => {
    showTip(event, event.buttons ? "" : hover(place(event)));
    if (!event.buttons || last === null) return;
    const dx = event.clientX - last;
    travelled += Math.abs(dx);
    last = event.clientX;
    if (!panning) go(event);
    else if (travelled > 3) panTime(-dx / (element.clientWidth - left - right) * stretch());
  });
  element.addEventListener("pointerup", event => {
    if (panning && travelled <= 3 && event.button === 0) go(event);
    last = null;
  });
  element.addEventListener("pointerleave", event => showTip(event, ""));
  element.addEventListener("dblclick", showAllTime);
  element.addEventListener("contextmenu", event => event.preventDefault());
  element.addEventListener("wheel", event => {
    event.preventDefault();
    const lines = event.deltaMode ? 30 : 1;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY))
      panTime((event.deltaX || event.deltaY) * lines / 600 * stretch());
    else zoomTime(Math.exp(Math.max(-120, Math.min(120, event.deltaY * lines)) * 0.002), timeOfX(place(event), element.clientWidth, left, right));
  }, {passive: false});
}

// Round times to label, in the span that is shown: [[time, text], ...].
function ticks(width, apart) {
  const step = niceStep(recording.duration > 0 ? stretch() : 1, width / apart), digits = decimalsOf(step), out = [];
  for (let k = Math.ceil(state.from / step - 1e-9); k * step <= state.until + 1e-9 * step && out.length < 200; ++k)
    out.push([k * step, Math.abs(k * step) >= 1e6 ? (k * step).toExponential(2) : (k * step).toFixed(Math.min(9, digits))]);
  return out;
}
