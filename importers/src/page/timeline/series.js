// The numbers of one node over time, in panels: what the curves draw.

const mostGathered = 6000;  // most frames of a node that are examined for the range of its curves
const seriesColors = ["x", "y", "z", "w", "driven", "free", "keyed", "key"];

// The inverse of a 3 by 3 matrix, column by column; null if it is singular.
function inverse3(m) {
  const x = [m[0], m[1], m[2]], y = [m[3], m[4], m[5]], z = [m[6], m[7], m[8]], volume = dot3(x, cross3(y, z));
  if (!(Math.abs(volume) > 1e-30)) return null;
  return transposed3([...cross3(y, z), ...cross3(z, x), ...cross3(x, y)].map(value => value / volume));
}

// A node's position and linear part in the world, or in its parent's space.
function placeIn(node, cursor, local) {
  const own = placeAt(recording, node, cursor);
  if (!local || node.parent < 0) return own;
  const parent = placeAt(recording, nodes[node.parent], cursor), back = inverse3(parent.linear);
  if (!back) return own;
  return {position: times3(back, own.position.map((value, i) => value - parent.position[i])), linear: product3(back, own.linear)};
}

// All numbers of a node at one instant; the angles are those nearest to `last`.
function numbersAt(node, cursor, local, last) {
  const place = placeIn(node, cursor, local), twist = twistAt(recording, node, cursor), {linear} = place;
  const shape = turnAndStretch(linear);
  const numbers = {position: place.position, velocity: twist.slice(0, 3), angular: twist.slice(3),
    rotation: shape ? anglesOf(shape.frame, last && last.rotation) : last ? last.rotation : [0, 0, 0],
    scale: [0, 3, 6].map(at => Math.hypot(linear[at], linear[at + 1], linear[at + 2])),
    color: [], weights: []};
  if (shape && shape.stretch[8] < 0) numbers.scale[2] *= -1;
  if (node.colors) numbers.color = colorOfNode(node, cursor);
  if (node.weights) numbers.weights = weightsOfNode(node, cursor);
  return numbers;
}

const xyz = ["x", "y", "z"];
function panelsOf(node) {
  const held = recording.instances.find(instance => instance.node === node.index && recording.meshes[instance.mesh].morphs.length);
  const morphs = held ? recording.meshes[held.mesh].morphs : [];
  const small = 1e-6 * cast.radius / cast.unit;
  // `least`: smaller changes are rounding.
  return [
    {name: "position", title: "position", unit: "m", names: xyz, track: "position", least: small},
    {name: "velocity", title: "velocity", unit: "m/s", names: xyz, least: 10 * small},
    {name: "rotation", title: "rotation", unit: "\u00b0", names: xyz, track: "rotation", least: 1e-3},
    {name: "angular", title: "angular velocity", unit: "rad/s", names: xyz, least: 1e-3},
    {name: "scale", title: "scale", unit: "", names: xyz, track: "scale", least: 1e-5},
    {name: "color", title: "color", unit: "linear", names: ["r", "g", "b", "a"], track: "color", least: 1e-5},
    {name: "weights", title: "weights", unit: "", track: "weights", least: 1e-5,
      names: Array.from({length: node.weightCount}, (_, i) => (morphs[i] && morphs[i].name) || String(i + 1))},
  ];
}

// The panels of a node with their values at the frames: `series[i][k]` at `gathered.times[k]`.
let gatheredCurves = {node: null};
function gather(node, local = state.local) {
  if (gatheredCurves.node === node && gatheredCurves.local === local) return gatheredCurves;
  const stride = Math.ceil(recording.frameCount / mostGathered), when = times.filter((_, i) => i % stride === 0);
  const all = [];
  for (const time of when) all.push(numbersAt(node, cursorAt(recording, time), local, all[all.length - 1]));
  const panels = panelsOf(node).filter(panel => all[0][panel.name].length);
  for (const panel of panels) {
    panel.series = panel.names.map((_, i) => Float64Array.from(all, numbers => numbers[panel.name][i]));
    panel.low = Infinity;
    panel.high = -Infinity;
    for (const values of panel.series)
      for (const value of values) if (Number.isFinite(value)) {
        panel.low = Math.min(panel.low, value);
        panel.high = Math.max(panel.high, value);
      }
    if (!(panel.low <= panel.high)) panel.low = panel.high = 0;
    panel.flat = panel.high - panel.low <= panel.least + 1e-6 * Math.abs(panel.high);
    // The lanes of tracks of the whole value, and of single numbers of it.
    panel.lanes = node.lanes.filter(lane => panel.track && (lane.property === panel.track || lane.property.startsWith(panel.track + ".")));
    panel.lane = panel.lanes[0];
    // Values that hardly change are shown as a flat line, without their rounding errors.
    const room = panel.flat ? Math.max(0.5 * Math.abs(panel.high), 1e4 * panel.least) : (panel.high - panel.low) * 0.08;
    panel.high += room;
    panel.low -= room;
  }
  // A scale that is 1 throughout is not shown.
  const shown = panels.filter(panel => panel.lane || panel.name !== "scale" || !panel.flat ||
    panel.series.some(values => Math.abs(values[0] - 1) > 1e-4));
  // Panels that never change and are not keyed come last.
  const idle = panel => panel.flat && !panel.lane;
  gatheredCurves = {node, local, times: when, all, panels: shown, inOrder: shown.filter(panel => !idle(panel)).concat(shown.filter(idle))};
  return gatheredCurves;
}

// The numbers at any instant, with angles continuous with those of the frames.
function gatheredAt(gathered, time) {
  const near = gathered.all[Math.max(0, lastNotAbove(gathered.times.length, i => gathered.times[i], time))];
  return numbersAt(gathered.node, cursorAt(recording, time), gathered.local, near);
}

// The numbers along the span that is shown: about `count`, and one at each frame if the frames are few.
function alongStretch(gathered, count) {
  const key = `${state.from} ${state.until} ${count}`;
  if (gathered.key === key) return gathered.along;
  const instants = [];
  for (let i = 0; i <= count; ++i) instants.push(state.from + stretch() * i / count);
  const first = Math.max(0, recording.frameBefore(state.from)), last = recording.frameBefore(state.until);
  if (last - first < 2 * count) for (let frame = first; frame <= last; ++frame) instants.push(times[frame]);
  const {breaks, jumps} = gathered.node, corners = Array.from(breaks.values(), ({time}) => time);
  for (const times of Object.values(jumps)) corners.push(...times.values());
  for (const time of corners)
    if (time > state.from && time < state.until && instants.length < 4 * count) instants.push(time - 1e-9, time + 1e-9);
  instants.sort((a, b) => a - b);
  gathered.key = key;
  gathered.along = instants.filter(time => time >= recording.startTime && time <= recording.endTime)
    .map(time => ({time, numbers: gatheredAt(gathered, time)}));
  return gathered.along;
}
