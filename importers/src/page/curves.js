// Curves of the chosen node over time: position, velocity, angular speed.

const curvesCanvas = document.getElementById("curves");
const margin = {left: 46, right: 10, top: 20, bottom: 18};

// Values of all frames, gathered when a node is chosen.
let gathered = {node: null};
function gather(node) {
  if (gathered.node === node) return gathered;
  const panels = [
    {title: "position", unit: "m", names: ["x", "y", "z"], series: [0, 1, 2].map(() => new Float64Array(frameCount))},
    {title: "velocity", unit: "m/s", names: ["x", "y", "z"], series: [0, 1, 2].map(() => new Float64Array(frameCount))},
    {title: "angular speed", unit: "rad/s", names: ["w"], series: [new Float64Array(frameCount)]},
  ];
  for (let frame = 0; frame < frameCount; ++frame) {
    const place = positionOf(node, frame), twist = twistOf(node, frame);
    for (let axis = 0; axis < 3; ++axis) {
      panels[0].series[axis][frame] = place[axis];
      panels[1].series[axis][frame] = twist[axis];
    }
    panels[2].series[0][frame] = Math.hypot(twist[3], twist[4], twist[5]);
  }
  for (const panel of panels) {
    panel.low = Infinity;
    panel.high = -Infinity;
    for (const values of panel.series) for (const value of values) {
      panel.low = Math.min(panel.low, value);
      panel.high = Math.max(panel.high, value);
    }
    if (panel.title === "angular speed") panel.low = 0;
    // What hardly changes is shown flat, not its rounding.
    const room = panel.high - panel.low > 1e-6 * Math.max(1, Math.abs(panel.high)) ? (panel.high - panel.low) * 0.06 : 0.5;
    panel.high += room;
    panel.low -= panel.title === "angular speed" ? 0 : room;
  }
  return gathered = {node, panels};
}

function drawPanel(context, panel, top, bottom) {
  const left = margin.left, right = context.width - margin.right;
  const x = time => left + (duration > 0 ? (time - startTime) / duration : 0) * (right - left);
  const y = value => bottom - (value - panel.low) / (panel.high - panel.low) * (bottom - top);
  const step = niceStep(panel.high - panel.low, Math.max(2, (bottom - top) / 32)), digits = decimalsOf(step);
  context.font = font(10);
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (let k = Math.ceil(panel.low / step); k * step <= panel.high; ++k) {
    line(context, left, y(k * step), right, y(k * step), colors.line, k === 0 ? 1.5 : 0.75);
    context.fillStyle = colors.quiet;
    context.fillText(number(k * step, digits), left - 5, y(k * step));
  }
  for (const handoff of shownHandoffs)
    if (handoff.node === gathered.node.index) {
      context.setLineDash([4, 3]);
      line(context, x(handoff.time), top - 3, x(handoff.time), bottom, colors[handoff.to], 1.5);
      context.setLineDash([]);
    }
  const stride = Math.max(1, Math.floor(frameCount / (2 * (right - left))));
  panel.series.forEach((values, i) => {
    context.strokeStyle = colors[panel.names[i]];
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.beginPath();
    for (let frame = 0; frame < frameCount; frame += stride) context.lineTo(x(times[frame]), y(values[frame]));
    context.lineTo(x(endTime), y(values[frameCount - 1]));
    context.stroke();
  });
  const now = x(times[state.frame]);
  line(context, now, top - 3, now, bottom, colors.accent, 1);
  panel.series.forEach((values, i) => {
    context.fillStyle = colors[panel.names[i]];
    context.beginPath();
    context.arc(now, y(values[state.frame]), 3, 0, 2 * Math.PI);
    context.fill();
  });
  context.textAlign = "left";
  context.font = font(11, 600);
  context.fillStyle = colors.ink;
  context.fillText(panel.title, left, top - 11);
  let at = left + context.measureText(panel.title).width + 5;
  context.font = font(11);
  context.fillStyle = colors.quiet;
  context.fillText(panel.unit, at, top - 11);
  if (panel.names.length > 1) {
    at = right;
    context.textAlign = "right";
    context.font = font(11, 600);
    for (const name of [...panel.names].reverse()) {
      context.fillStyle = colors[name];
      context.fillText(name, at, top - 11);
      at -= 13;
    }
  }
}

function drawCurves() {
  const context = prepared(curvesCanvas);
  if (!context) return;
  if (!state.chosen) {
    context.font = font(12);
    context.fillStyle = colors.quiet;
    context.textAlign = "center";
    context.fillText("Click a node to see its curves.", context.width / 2, context.height / 2);
    return;
  }
  const {panels} = gather(state.chosen);
  const shares = [0.38, 0.38, 0.24], gap = margin.top + 6;
  const room = context.height - margin.bottom - panels.length * gap;
  let top = 0;
  panels.forEach((panel, i) => {
    top += gap;
    drawPanel(context, panel, top, top + shares[i] * room);
    top += shares[i] * room;
  });
  const step = niceStep(duration || 1, (context.width - 60) / 55), digits = decimalsOf(step);
  context.font = font(10);
  context.fillStyle = colors.quiet;
  context.textAlign = "center";
  for (let k = Math.ceil(startTime / step - 1e-9); k * step <= endTime + 1e-9; ++k)
    context.fillText((k * step).toFixed(digits), margin.left + (k * step - startTime) / (duration || 1) *
      (context.width - margin.left - margin.right), top + 9);
}

function scrubCurves() {
  const toTime = event => {
    const box = curvesCanvas.getBoundingClientRect();
    const share = (event.clientX - box.left - margin.left) / (box.width - margin.left - margin.right);
    change({playing: false});
    seek(startTime + Math.min(1, Math.max(0, share)) * duration);
  };
  curvesCanvas.addEventListener("pointerdown", event => {
    curvesCanvas.setPointerCapture(event.pointerId);
    toTime(event);
  });
  curvesCanvas.addEventListener("pointermove", event => { if (event.buttons & 1) toTime(event); });
}
