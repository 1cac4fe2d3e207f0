// Graphs on the timeline: one row per parameter and per machine; a machine's row shows its states and their weights.

const stateColors = ["keyed", "free", "driven", "w", "y", "x", "z", "key"];
const colorOfState = index => colors[stateColors[index % stateColors.length]];

// A graph's rows: `part` is a parameter or a machine, null for the graph itself.
const graphRows = recording.graphs.flatMap(graph => [{graph, part: null}, ...graph.machines.map(part => ({graph, part})),
  ...graph.parameters.map(part => ({graph, part}))]);
const graphRowName = row => (row.part ? `${row.graph.name}.${row.part.name}` : row.graph.name);

// The weights of a machine's states at a time, interpolated between the frames.
function stateWeightsAt(machine, time) {
  const first = Math.max(0, recording.frameBefore(time)), next = Math.min(first + 1, recording.frameCount - 1);
  const share = next > first ? Math.min(1, Math.max(0, (time - times[first]) / (times[next] - times[first]))) : 0;
  return machine.states.map((_, i) => (1 - share) * machine.weights[first * machine.states.length + i] +
    share * machine.weights[next * machine.states.length + i]);
}
// The last passage (entry of a state) up to a time.
const passageAt = (machine, time) =>
  machine.passages[Math.max(0, lastNotAbove(machine.passages.length, i => machine.passages[i].time, time))];
const machineStateAt = (machine, time) => machine.states[passageAt(machine, time).state];

function parameterAt(parameter, time) {
  const first = Math.max(0, recording.frameBefore(time)), next = Math.min(first + 1, recording.frameCount - 1);
  const share = next > first ? Math.min(1, Math.max(0, (time - times[first]) / (times[next] - times[first]))) : 0;
  return (1 - share) * parameter.values[first] + share * parameter.values[next];
}

const graphSnaps = row => (row.part && row.part.passages ? row.part.passages.map(passage => passage.time) : []);

// States as bands whose heights are their weights; a mark where one was entered, with its name if there is room.
function drawMachine(context, machine) {
  const top = 2, high = context.height - 4, right = Math.min(context.width, xOfTime(recording.endTime, context.width));
  const left = Math.max(0, xOfTime(recording.startTime, context.width));
  for (let x = Math.floor(left); x < right; ++x) {
    const weights = stateWeightsAt(machine, timeOfX(x + 0.5, context.width));
    let y = top;
    weights.forEach((weight, i) => {
      context.fillStyle = colorOfState(i);
      const part = Math.min(1, Math.max(0, weight)) * high;
      context.fillRect(Math.max(left, x), y, Math.min(1, right - Math.max(left, x)), part);
      y += part;
    });
  }
  context.font = font(10, 600);
  context.textBaseline = "middle";
  context.textAlign = "left";
  machine.passages.forEach((passage, i) => {
    const from = xOfTime(passage.time, context.width);
    const to = xOfTime(i + 1 < machine.passages.length ? machine.passages[i + 1].time : recording.endTime, context.width);
    if (to < 0 || from > context.width) return;
    if (i > 0) line(context, from, 0, from, context.height, colors.ink, 1.5);
    const name = machine.states[passage.state], room = Math.min(to, context.width) - Math.max(from, 0) - 12;
    if (room < 12) return;
    const text = fitted(context, name, room), wide = context.measureText(text).width;
    context.globalAlpha = 0.75;
    context.fillStyle = colors.panel;
    context.fillRect(Math.max(from, 0) + 4, top + 2, wide + 6, high - 4);
    context.globalAlpha = 1;
    context.fillStyle = colors.ink;
    context.fillText(text, Math.max(from, 0) + 7, top + high / 2 + 0.5);
  });
}

// A parameter's curve between its least and its greatest value.
function drawParameter(context, parameter) {
  const low = parameter.low, span = parameter.high - low, bottom = context.height - 3, high = context.height - 6;
  const y = value => (span > 0 ? bottom - (value - low) / span * high : context.height / 2);
  context.strokeStyle = colors.accent;
  context.lineWidth = 1.5;
  context.beginPath();
  for (let x = 0; x <= context.width; ++x) {
    const time = timeOfX(x, context.width);
    context.lineTo(xOfTime(time, context.width), y(parameterAt(parameter, time)));
  }
  context.stroke();
}

function drawGraphStrip(canvas, row) {
  const context = prepared(canvas);
  if (!context || !row.part) return;
  if (row.part.states) drawMachine(context, row.part); else drawParameter(context, row.part);
}

function graphTip(row, x, width) {
  if (!row.part) return "";
  const time = timeOfX(x, width);
  if (!row.part.states) return `${row.part.name} ${number(parameterAt(row.part, time), 4)}`;
  const near = nearest(row.part.passages, passage => passage.time, x, width), passage = row.part.passages[near];
  if (passage && passage.how)
    return `${number(passage.time, 4)} s  to ${row.part.states[passage.state]}\n${passage.how}, when ${passage.when}`;
  const settling = row.part.settling[Math.max(0, recording.frameBefore(time))] > 0 ? ", settling" : "";
  return stateWeightsAt(row.part, time).map((weight, i) => [weight, row.part.states[i]]).filter(([weight]) => weight > 0)
    .sort((a, b) => b[0] - a[0]).map(([weight, name]) => (weight > 0.9995 ? name : `${name} ${number(100 * weight, 1)} %`))
    .join("\n") + settling;
}

// What a row's label says after its name.
function graphNow(row) {
  if (!row.part) return "";
  return row.part.states ? machineStateAt(row.part, state.time) : number(parameterAt(row.part, state.time));
}
