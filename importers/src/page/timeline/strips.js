// What is drawn along the time axis: the ruler with its events, bars of owners, keys; and the tooltip of each.

const eventText = event => `${event.time.toFixed(3)} s  ${event.name}` + (event.kind && ": " + event.kind) +
  (event.nodes.length ? "\n" + event.nodes.map(node => nodes[node].name).join(" and ") : "") +
  (event.impulse ? `, ${number(event.impulse, 3)} N s` : "");
const handoffText = handoff => `${handoff.time.toFixed(4)} s  ${nodes[handoff.node].name}\n` +
  `${handoff.from} to ${handoff.to}, by ${handoff.cause}`;
const keyText = (lane, i) => {
  const key = lane.keys[lane.keyOf[i]];
  return `${lane.property} at ${number(lane.times[i], 4)} s` + (key ? `\n${key.value}\n${key.ease}` : "");
};

function diamond(context, x, y, size) {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.fill();
}

function drawRuler(canvas) {
  const context = prepared(canvas);
  if (!context) return;
  context.font = font(11);
  context.textBaseline = "top";
  for (const [time, text] of ticks(context.width, 80)) {
    const x = xOfTime(time, context.width);
    line(context, x, 15, x, 20, colors.quiet);
    context.fillStyle = colors.quiet;
    context.textAlign = x < 20 ? "left" : x > context.width - 20 ? "right" : "center";
    context.fillText(text + (time === 0 ? " s" : ""), x < 20 ? 2 : x > context.width - 20 ? context.width - 2 : x, 2);
  }
  context.globalAlpha = recording.events.length > 200 ? 0.35 : 0.8;
  let last = -10;
  for (const event of recording.events) {
    const x = xOfTime(event.time, context.width);
    if (x < -5 || x > context.width + 5) continue;
    if (event.nodes.length) {
      if (x - last < 0.4) continue;
      line(context, x, 30, x, 37, colors.event, 1);
      last = x;
    } else {
      context.fillStyle = colors.ink;
      diamond(context, x, 32, 4);
    }
  }
  context.globalAlpha = 1;
  for (const handoff of recording.handoffs) {
    const x = xOfTime(handoff.time, context.width);
    context.fillStyle = colors[handoff.to];
    context.beginPath();
    context.moveTo(x, 26);
    context.lineTo(x + 5.5, 19);
    context.lineTo(x - 5.5, 19);
    context.fill();
    line(context, x, 26, x, 40, colors[handoff.to], 1.5);
  }
}

function drawOwners(context, node) {
  const top = 6, high = context.height - 12;
  context.font = font(10, 600);
  context.textBaseline = "middle";
  context.textAlign = "left";
  const runs = node.fixed ? [[-Infinity, "fixed"]] : node.owners;
  runs.forEach(([from, owner], i) => {
    const x0 = Math.max(-4, xOfTime(Math.max(from, recording.startTime), context.width));
    const x1 = Math.min(context.width + 4, xOfTime(i + 1 < runs.length ? runs[i + 1][0] : recording.endTime, context.width));
    if (x1 < x0) return;
    context.fillStyle = colors[owner];
    context.globalAlpha = owner === "fixed" ? 0.35 : 1;
    context.fillRect(x0, top, Math.max(1, x1 - x0), high);
    context.globalAlpha = 1;
    if (x1 - x0 > 48 && owner !== "fixed") {
      context.fillStyle = owner === "free" ? "#1b1b1b" : colors.panel;
      context.fillText(owner, Math.max(4, x0) + 6, top + high / 2 + 0.5);
    }
  });
}

// Diamonds at the times of `list`, thinned where they would overlap.
function drawKeys(context, list, color, size = 3.5) {
  context.fillStyle = color;
  let last = -10;
  for (const time of list) {
    const x = xOfTime(time, context.width);
    if (x < -5 || x > context.width + 5 || Math.abs(x - last) < 0.75) continue;
    diamond(context, x, context.height / 2, size);
    last = x;
  }
}

function drawStrip(canvas, row) {
  if (row.graph) return drawGraphStrip(canvas, row);
  const context = prepared(canvas);
  if (!context) return;
  const middle = context.height / 2;
  if (!row.lane) {
    if (row.node.hasBody) drawOwners(context, row.node);
    if (row.folded && !row.node.hasBody) for (const lane of row.node.lanes) drawKeys(context, lane.times, colors.quiet, 3);
    drawKeys(context, recording.handoffs.filter(h => h.node === row.node.index).map(h => h.time), colors.ink, 4);
    return;
  }
  line(context, axisEdge, middle, context.width - axisEdge, middle, colors.line);
  drawKeys(context, row.lane.times, colors.key);
  if (row.lane.times.length) return;
  context.fillStyle = colors.quiet;
  context.font = font(10);
  context.textAlign = "left";
  context.textBaseline = "middle";
  const width = context.measureText("formula").width;
  context.clearRect(axisEdge, 0, width + 10, context.height);
  context.fillText("formula", axisEdge + 4, middle);
}

const nearest = (list, timeOf, x, width, reach = 5) => {
  let best = -1, least = reach;
  list.forEach((item, i) => {
    const away = Math.abs(xOfTime(timeOf(item), width) - x);
    if (away < least) { least = away; best = i; }
  });
  return best;
};

function stripTip(row, x, width) {
  if (row.graph) return graphTip(row, x, width);
  if (row.lane) {
    const key = nearest(row.lane.times, time => time, x, width);
    return key < 0 ? "" : keyText(row.lane, key);
  }
  const own = recording.handoffs.filter(h => h.node === row.node.index), found = nearest(own, h => h.time, x, width);
  if (found >= 0) return handoffText(own[found]);
  return row.node.hasBody ? row.node.fixed ? "fixed" : recording.ownerAt(row.node, timeOfX(x, width)) : "";
}

function rulerTip(x, width) {
  const handoff = nearest(recording.handoffs, h => h.time, x, width), event = nearest(recording.events, e => e.time, x, width);
  return [handoff >= 0 && handoffText(recording.handoffs[handoff]), event >= 0 && eventText(recording.events[event])]
    .filter(Boolean).join("\n");
}
