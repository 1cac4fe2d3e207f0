// The dope sheet: events on top, then a row a node with a bar of its owners, and a lane a track with its keys.

const edge = 10;  // room left and right of the first and last time, px
const timeToX = (time, width) => edge + (duration > 0 ? (time - startTime) / duration : 0) * (width - 2 * edge);
const xToTime = (x, width) => startTime + Math.min(1, Math.max(0, (x - edge) / (width - 2 * edge))) * duration;

const ruler = document.querySelector("#ruler .strip");
const rowsBox = document.getElementById("rows");
const playhead = document.getElementById("playhead");
const shownHandoffs = handoffs.filter(handoff => handoff.cause !== "start");
const eventText = event => `${event.time.toFixed(3)} s  ${event.name}` +
  (event.nodes.length ? "\n" + event.nodes.map(node => nodes[node].name).join(" and ") : "") +
  (event.impulse ? `, ${number(event.impulse, 3)} N s` : "");
const handoffText = handoff => `${handoff.time.toFixed(4)} s  ${nodes[handoff.node].name}\n` +
  `${handoff.from} to ${handoff.to}, by ${handoff.cause}`;

function diamond(context, x, y, size) {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.fill();
}

function drawRuler() {
  const context = prepared(ruler);
  if (!context) return;
  const step = niceStep(duration || 1, context.width / 75), digits = decimalsOf(step);
  context.font = font(11);
  context.textAlign = "center";
  context.textBaseline = "top";
  for (let k = Math.ceil(startTime / step - 1e-9); k * step <= endTime + 1e-9; ++k) {
    const x = timeToX(k * step, context.width);
    line(context, x, 15, x, 20, colors.quiet);
    context.fillStyle = colors.quiet;
    context.textAlign = x < 20 ? "left" : x > context.width - 20 ? "right" : "center";
    context.fillText((k * step).toFixed(digits) + (k * step === 0 ? " s" : ""), x < 20 ? 2 : x, 2);
  }
  context.globalAlpha = events.length > 200 ? 0.35 : 0.8;
  for (const event of events) {
    const x = timeToX(event.time, context.width), contact = event.nodes.length > 0;
    if (contact) line(context, x, 30, x, 37, colors.event, 1);
    else {
      context.fillStyle = colors.ink;
      diamond(context, x, 32, 4);
    }
  }
  context.globalAlpha = 1;
  for (const handoff of shownHandoffs) {
    const x = timeToX(handoff.time, context.width);
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
  const runs = node.runs, top = 6, high = context.height - 12;
  context.font = font(10, 600);
  context.textBaseline = "middle";
  context.textAlign = "left";
  const bar = (owner, from, to) => {
    const x0 = timeToX(from, context.width), x1 = timeToX(to, context.width);
    context.fillStyle = colors[owner];
    context.globalAlpha = owner === "fixed" ? 0.35 : 1;
    context.fillRect(x0, top, Math.max(1, x1 - x0), high);
    context.globalAlpha = 1;
    if (x1 - x0 > 48 && high > 9 && owner !== "fixed") {
      context.fillStyle = owner === "free" ? "#1b1b1b" : colors.panel;
      context.fillText(owner, x0 + 6, top + high / 2 + 0.5);
    }
  };
  if (node.fixed) return bar("fixed", startTime, endTime);
  // Runs are known by frame; a hand-off between two frames says the exact time.
  runs.forEach(([frame, owner], i) => {
    const exact = at => {
      const found = shownHandoffs.find(h => h.node === node.index && h.time <= times[at] && h.time > times[at - 1]);
      return found ? found.time : times[at];
    };
    bar(owner, frame ? exact(frame) : startTime, i + 1 < runs.length ? exact(runs[i + 1][0]) : endTime);
  });
}

function drawHandoffs(context, node) {
  for (const handoff of shownHandoffs)
    if (handoff.node === node.index) {
      const x = timeToX(handoff.time, context.width);
      line(context, x, 1, x, context.height - 1, colors.ink, 1.5);
      context.fillStyle = colors.ink;
      diamond(context, x, context.height / 2, 3.5);
    }
}

function drawRow(row) {
  const context = prepared(row.canvas);
  if (!context) return;
  const middle = context.height / 2;
  if (!row.lane) {
    if (row.node.hasBody) drawOwners(context, row.node);
    drawHandoffs(context, row.node);
    return;
  }
  line(context, edge, middle, context.width - edge, middle, colors.line);
  context.fillStyle = colors.key;
  let last = -10;
  for (const time of row.lane.times) {
    const x = timeToX(time, context.width);
    if (x - last < 0.75) continue;
    diamond(context, x, middle, 3.5);
    last = x;
  }
  if (!row.lane.times.length) {
    context.fillStyle = colors.quiet;
    context.font = font(10);
    context.textBaseline = "middle";
    context.fillText("formula", edge + 4, middle + 5 > context.height ? middle : middle - 0.5);
  }
}

const rows = [];
function addRow(node, lane, depth) {
  const element = document.createElement("div");
  element.className = lane ? "row lane" : "row";
  const label = document.createElement("button");
  label.className = "label";
  label.style.paddingLeft = 10 + 12 * Math.min(6, depth + (lane ? 1 : 0)) + "px";
  label.title = lane ? `${node.name}.${lane.property}` : node.name;
  const dot = document.createElement("i");
  if (!lane) label.append(dot);
  label.append(lane ? lane.property : node.name);
  label.addEventListener("click", () => change({chosen: node}));
  const canvas = document.createElement("canvas");
  canvas.className = "strip";
  element.append(label, canvas);
  rowsBox.append(element);
  const row = {node, lane, element, canvas, dot, visible: false};
  scrubbing(canvas, x => rowTip(row, x));
  rows.push(row);
}

function addRows() {
  const children = new Map(nodes.map(node => [node.index, []]));
  const roots = [];
  for (const node of nodes) (node.parent >= 0 ? children.get(node.parent) : roots).push(node);
  // What moves first: things that only stand there come last.
  const moves = node => !node.fixed || children.get(node.index).length > 0;
  roots.sort((a, b) => moves(b) - moves(a));
  const visit = (node, depth) => {
    addRow(node, null, depth);
    for (const lane of lanes) if (lane.node === node) addRow(node, lane, depth);
    for (const child of children.get(node.index)) visit(child, depth + 1);
  };
  for (const root of roots) visit(root, 0);
  const observer = new IntersectionObserver(entries => {
    for (const entry of entries) {
      const row = rows.find(candidate => candidate.element === entry.target);
      row.visible = entry.isIntersecting;
      if (row.visible) drawRow(row);
      else row.canvas.width = row.canvas.height = 0;
    }
  }, {root: rowsBox, rootMargin: "60px"});
  for (const row of rows) observer.observe(row.element);
}

const nearest = (list, x, width, reach = 5) => {
  let best = null, least = reach;
  for (const item of list) {
    const away = Math.abs(timeToX(item.time, width) - x);
    if (away < least) { least = away; best = item; }
  }
  return best;
};

function rowTip(row, x) {
  const width = row.canvas.clientWidth;
  if (row.lane) {
    const key = nearest(Array.from(row.lane.times, time => ({time})), x, width);
    return key ? `${row.node.name}.${row.lane.property}\nkey at ${key.time.toFixed(4)} s` : "";
  }
  const handoff = nearest(shownHandoffs.filter(h => h.node === row.node.index), x, width);
  if (handoff) return handoffText(handoff);
  return row.node.hasBody ? row.node.fixed ? "fixed" : ownerOf(row.node, frameAt(xToTime(x, width))) : "";
}

function rulerTip(x) {
  const width = ruler.clientWidth, handoff = nearest(shownHandoffs, x, width), event = nearest(events, x, width);
  return [handoff && handoffText(handoff), event && eventText(event)].filter(Boolean).join("\n");
}

// Dragging along a strip moves time; hovering says what is there.
function scrubbing(canvas, textAt) {
  const xOf = event => event.clientX - canvas.getBoundingClientRect().left;
  const toTime = event => {
    change({playing: false});
    seek(xToTime(xOf(event), canvas.clientWidth));
  };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    toTime(event);
  });
  canvas.addEventListener("pointermove", event => {
    if (event.buttons & 1) toTime(event);
    showTip(event, textAt ? textAt(xOf(event)) : "");
  });
  canvas.addEventListener("pointerleave", event => showTip(event, ""));
}

function updateTimeline(changed) {
  const box = ruler.getBoundingClientRect(), left = document.getElementById("timeline").getBoundingClientRect().left;
  playhead.style.transform = `translateX(${box.left - left + timeToX(times[state.frame], box.width) - 0.75}px)`;
  for (const row of rows) {
    if (row.dot && row.node.hasBody) row.dot.style.background = colors[shownOwner(row.node, state.frame)];
    if (changed && "chosen" in changed) row.element.classList.toggle("chosen", row.node === state.chosen);
  }
  if (changed && "chosen" in changed && state.chosen) {
    const row = rows.find(candidate => candidate.node === state.chosen);
    row.element.scrollIntoView({block: "nearest"});
  }
}

function drawTimeline() {
  drawRuler();
  for (const row of rows) if (row.visible) drawRow(row);
  updateTimeline();
}

function filterRows(text) {
  const wanted = text.trim().toLowerCase();
  for (const row of rows) row.element.hidden = !!wanted && !row.node.name.toLowerCase().includes(wanted);
}
