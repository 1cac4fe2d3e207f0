// Curves of the chosen node over time, one canvas per panel, with the keys of its tracks and their eases.

const curvesBox = document.getElementById("curves");
const margin = {left: 46, right: 10, top: 24, bottom: 6};
const leastPanel = 96;   // px
const markApart = 9;     // px; keys closer than this have no marks
const easeHigh = 12;     // height of a line of eases below the curves, px

// The keys of a lane in the span that is shown, and whether they are too dense for marks. `x`: from time to px.
function marksOf(lane, x) {
  const seen = [];
  lane.times.forEach((time, i) => { if (time >= state.from && time <= state.until) seen.push(i); });
  const wide = seen.length ? x(lane.times[seen[seen.length - 1]]) - x(lane.times[seen[0]]) : 0;
  return {lane, seen, dense: seen.length > 2 && wide < markApart * (seen.length - 1)};
}
// Lines of eases below the curves: one per lane whose keys have marks and eases.
const easeLines = marks => marks.filter(({lane, seen, dense}) => !dense && seen.length && lane.keys.some(key => key.ease));

// Which of a panel's numbers a lane drives; -1: all.
const seriesOf = (panel, lane) => (lane.property === panel.track ? -1
  : lane.property.endsWith(".a") ? 3 : "xyzrgba".indexOf(lane.property.slice(-1)) % 3);
const colorOfSeries = (panel, i) => colors[seriesColors[i % seriesColors.length]];

class Curves {
  constructor() {
    this.canvases = [];
    this.nothing = document.createElement("p");
    this.nothing.textContent = "Click a node to see its curves.";
    this.axis = document.createElement("canvas");
    this.axis.className = "axis";
    curvesBox.append(this.nothing, this.axis);
    this.wire(this.axis, () => null);
  }

  wire(canvas, panelOf) {
    const lanes = () => (panelOf() ? panelOf().lanes : []);
    wireAxis(canvas, {left: margin.left, right: margin.right,
      snaps: () => lanes().flatMap(lane => Array.from(lane.times)), hover: x => this.tip(panelOf(), x, canvas.clientWidth)});
  }

  canvasFor(i) {
    while (this.canvases.length <= i) {
      const canvas = document.createElement("canvas"), at = this.canvases.length;
      this.axis.before(canvas);
      this.canvases.push(canvas);
      this.wire(canvas, () => state.chosen && gather(state.chosen).inOrder[at]);
    }
    return this.canvases[i];
  }

  draw() {
    const panels = state.chosen && state.chosen.shown ? gather(state.chosen).inOrder : [];
    this.nothing.hidden = panels.length > 0;
    this.axis.hidden = !panels.length;
    this.nothing.textContent = state.chosen ? "This node is beyond what a page can show." : "Click a node to see its curves.";
    const high = Math.max(leastPanel, Math.floor((curvesBox.clientHeight - 18) / Math.max(1, panels.length)));
    const x = time => xOfTime(time, curvesBox.clientWidth, margin.left, margin.right);
    panels.forEach((panel, i) => {
      const canvas = this.canvasFor(i), marks = panel.lanes.map(lane => marksOf(lane, x)), below = easeHigh * easeLines(marks).length;
      const tall = Math.max(high, leastPanel + below);
      canvas.hidden = false;
      if (canvas.style.height !== tall + "px") canvas.style.height = tall + "px";
      const top = canvas.offsetTop - curvesBox.scrollTop;
      if (top + tall > -20 && top < curvesBox.clientHeight + 20) this.drawPanel(canvas, panel, marks, below);
    });
    for (const canvas of this.canvases.slice(panels.length)) canvas.hidden = true;
    this.drawAxis();
  }

  // `below`: height of the lines of eases, px, so that they cover no curve.
  drawPanel(canvas, panel, marks, below) {
    const context = prepared(canvas);
    if (!context) return;
    const left = margin.left, right = context.width - margin.right, top = margin.top, bottom = context.height - margin.bottom - below;
    const x = time => xOfTime(time, context.width, margin.left, margin.right);
    const y = value => bottom - (value - panel.low) / (panel.high - panel.low) * (bottom - top);
    this.drawHead(context, panel, left, right);
    this.drawLevels(context, panel, left, right, top, bottom, y);
    context.save();
    context.beginPath();
    context.rect(left - 4, top - 6, right - left + 8, bottom - top + 12);
    context.clip();
    for (const handoff of recording.handoffs)
      if (handoff.node === state.chosen.index) {
        context.setLineDash([4, 3]);
        line(context, x(handoff.time), top - 3, x(handoff.time), bottom, colors[handoff.to], 1.5);
        context.setLineDash([]);
      }
    const gathered = gather(state.chosen), along = alongStretch(gathered, Math.ceil((right - left) / 1.5));
    panel.names.forEach((_, i) => {
      context.strokeStyle = colorOfSeries(panel, i);
      context.lineWidth = 1.6;
      context.lineJoin = "round";
      context.beginPath();
      for (const {time, numbers} of along) context.lineTo(x(time), y(numbers[panel.name][i]));
      context.stroke();
    });
    for (const mark of marks) this.drawKeys(context, panel, mark, gathered, x, y, bottom);
    line(context, x(state.time), top - 3, x(state.time), bottom, colors.accent, 1);
    const now = gatheredAt(gathered, state.time)[panel.name];
    panel.names.forEach((_, i) => {
      context.fillStyle = colorOfSeries(panel, i);
      context.beginPath();
      context.arc(x(state.time), y(now[i]), 3, 0, 2 * Math.PI);
      context.fill();
    });
    context.restore();
    easeLines(marks).forEach((mark, k) => this.drawEases(context, panel, mark, x, bottom + margin.bottom + easeHigh * (k + 0.5)));
  }

  drawHead(context, panel, left, right) {
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.font = font(11, 600);
    context.fillStyle = colors.ink;
    context.fillText(panel.title, left, 11);
    const at = left + context.measureText(panel.title).width + 5;
    context.font = font(11);
    context.fillStyle = colors.quiet;
    const local = state.local && panel.track && state.chosen.parent >= 0 ? " in parent" : "";
    context.fillText(panel.unit + local, at, 11);
    let to = right, room = right - at - context.measureText(panel.unit + local).width - 6;
    context.textAlign = "right";
    context.font = font(11, 600);
    const names = panel.names.map(name => fitted(context, name, 70));
    const widths = names.map(name => context.measureText(name).width + 7);
    let count = 0;
    for (; count < names.length && widths[count] <= room; ++count) room -= widths[count];
    for (let i = count - 1; i >= 0; --i) {
      context.fillStyle = colorOfSeries(panel, i);
      context.fillText(names[i], to, 11);
      to -= widths[i];
    }
  }

  drawLevels(context, panel, left, right, top, bottom, y) {
    const levels = step => Math.floor(panel.high / step) - Math.ceil(panel.low / step) + 1;
    let count = Math.max(2, (bottom - top) / 30), step = niceStep(panel.high - panel.low, count);
    // One level alone does not tell how much anything is.
    for (; levels(step) < 2 && count < 16; count *= 1.5) step = niceStep(panel.high - panel.low, count);
    const digits = Math.min(6, decimalsOf(step));
    context.font = font(10);
    context.textAlign = "right";
    for (let k = Math.ceil(panel.low / step); k * step <= panel.high; ++k) {
      line(context, left, y(k * step), right, y(k * step), colors.line, k === 0 ? 1.5 : 0.75);
      context.fillStyle = colors.quiet;
      context.fillText(number(k * step, digits), left - 5, y(k * step));
    }
  }

  drawKeys(context, panel, {lane, seen, dense}, gathered, x, y, bottom) {
    if (dense) return drawTicks(context, seen.map(i => x(lane.times[i])), bottom);
    const only = seriesOf(panel, lane);
    for (const i of seen) {
      const values = gatheredAt(gathered, lane.times[i])[panel.name];
      values.forEach((value, axis) => {
        if (only >= 0 && axis !== only) return;
        context.fillStyle = colors.panel;
        diamond(context, x(lane.times[i]), y(value), 5);
        context.fillStyle = colorOfSeries(panel, axis);
        diamond(context, x(lane.times[i]), y(value), 3.5);
      });
    }
  }

  // Writes the ease's name between two keys if there is room for it, once for consecutive keys with the same ease.
  drawEases(context, panel, {lane, seen}, x, y) {
    const only = seriesOf(panel, lane);
    const wordOf = k => (lane.keys[lane.keyOf[seen[k]]] || {}).ease;
    context.font = font(9.5);
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (let k = 0, end; k + 1 < seen.length; k = end) {
      const word = wordOf(k);
      for (end = k + 1; end + 1 < seen.length && wordOf(end) === word;) ++end;
      if (!word || word === "end") continue;
      const from = x(lane.times[seen[k]]), to = x(lane.times[seen[end]]);
      line(context, from, y - 3, from, y + 3, colors.line);
      line(context, to, y - 3, to, y + 3, colors.line);
      context.fillStyle = only < 0 ? colors.quiet : colorOfSeries(panel, only);
      if (context.measureText(word).width <= to - from - 5) context.fillText(word, (from + to) / 2, y);
    }
  }

  drawAxis() {
    const context = prepared(this.axis);
    if (!context) return;
    context.font = font(10);
    context.fillStyle = colors.quiet;
    context.textBaseline = "top";
    for (const [time, text] of ticks(context.width - margin.left, 55)) {
      const x = xOfTime(time, context.width, margin.left, margin.right);
      context.textAlign = x > context.width - 16 ? "right" : "center";
      context.fillText(text, x > context.width - 16 ? context.width - 2 : x, 2);
    }
  }

  tip(panel, x, width) {
    if (!panel) return "";
    const at = time => xOfTime(time, width, margin.left, margin.right);
    for (const lane of panel.lanes) {
      let best = -1, least = 6;
      lane.times.forEach((time, i) => {
        if (Math.abs(at(time) - x) < least) { least = Math.abs(at(time) - x); best = i; }
      });
      if (best >= 0) return keyText(lane, best);
    }
    const time = timeOfX(x, width, margin.left, margin.right), values = gatheredAt(gather(state.chosen), time)[panel.name];
    return `${number(time, 4)} s\n` + panel.names.map((name, i) => `${name} ${number(values[i])}`).slice(0, 8).join("  ");
  }
}

function drawTicks(context, list, bottom) {
  let last = -10;
  for (const x of list) {
    if (x - last < 1) continue;
    line(context, x, bottom - 4, x, bottom, colors.key, 1);
    last = x;
  }
}
