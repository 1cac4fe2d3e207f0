// One recording as the page carries it: names and numbers, but nothing about how they are shown.

function bytesOf(text) {
  const binary = atob(text || "");
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}
const floats = text => new Float32Array(bytesOf(text));
const doubles = text => new Float64Array(bytesOf(text));
const integers = text => new Uint32Array(bytesOf(text));

// Values that never change are stored once.
const offsetOf = (values, frame, stride) => (values.length === stride ? 0 : frame * stride);

// The last index whose value is not above `wanted`; -1 if all are above it.
function lastNotAbove(length, valueAt, wanted) {
  let low = -1, high = length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (valueAt(middle) <= wanted) low = middle; else high = middle - 1;
  }
  return low;
}

const allFinite = values => {
  for (let i = 0; i < values.length; ++i) if (!Number.isFinite(values[i])) return false;
  return true;
};

// Whether the numbers of a shape are small enough for graphics to calculate with.
function fitsShape(shape) {
  if (!shape) return true;
  const numbers = [shape.sphere, shape.offset, shape.box, shape.capsule, shape.position, shape.turned, shape.corners, shape.hull && shape.hull.vertices];
  return numbers.flat(2).every(value => value === undefined || Math.abs(value) < 1e30);
}

class Recording {
  constructor(raw) {
    this.name = raw.name;
    this.times = doubles(raw.times);
    this.frameCount = this.times.length;
    this.startTime = this.times[0];
    this.endTime = this.times[this.frameCount - 1];
    this.duration = this.endTime - this.startTime;
    this.recordedFrames = raw.recordedFrames;
    this.nodes = raw.nodes.map((node, index) => ({
      index, name: node.name, parent: node.parent, shape: node.shape, fixed: !!node.fixed, hasBody: !!node.shape,
      matrices: floats(node.matrices), twists: floats(node.twists), runs: node.owner, color: node.color,
      velocities: node.velocities ? floats(node.velocities) : null, stretches: node.stretches ? floats(node.stretches) : null,
      center: node.center || [0, 0, 0], colors: node.colors ? floats(node.colors) : null, weightCount: node.weightCount || 0,
      weights: node.weights ? floats(node.weights) : null, children: [], lanes: [], breaks: new Map(),
      jumps: {place: new Map(), color: new Map(), weights: new Map()},
    }));
    this.named = new Map(this.nodes.map(node => [node.name, node]));
    for (const node of this.nodes) {
      node.moves = node.matrices.length > 12;
      node.shown = allFinite(node.matrices) && fitsShape(node.shape);
      if (node.parent >= 0) this.nodes[node.parent].children.push(node);
    }
    this.meshes = raw.meshes.map(mesh => ({
      name: mesh.name, positions: floats(mesh.positions), normals: mesh.normals ? floats(mesh.normals) : null,
      triangles: integers(mesh.triangles), joints: mesh.joints ? integers(mesh.joints) : null,
      jointWeights: mesh.jointWeights ? floats(mesh.jointWeights) : null,
      morphs: mesh.morphs.map(morph => ({name: morph.name, positions: floats(morph.positions),
        normals: morph.normals ? floats(morph.normals) : null})),
      restWeights: mesh.restWeights, color: mesh.color,
    }));
    for (const mesh of this.meshes) mesh.influences = mesh.joints ? 3 * mesh.joints.length / mesh.positions.length : 0;
    this.skins = raw.skins.map(skin => ({joints: skin.joints, inverseBinds: floats(skin.inverseBinds)}));
    this.instances = raw.instances.filter(instance => instance.node >= 0 || instance.skin >= 0);
    this.lanes = raw.lanes.map(lane => ({node: this.nodes[lane.node], property: lane.property, times: doubles(lane.times),
      keyOf: integers(lane.keyOf), keys: lane.keys}));
    for (const lane of this.lanes) lane.node.lanes.push(lane);
    this.joints = raw.joints || [];
    this.particles = (raw.particles || []).map(each => ({...each, starts: integers(each.starts), numbers: floats(each.numbers)}));
    this.details = raw.details ? {starts: integers(raw.details.starts), contacts: floats(raw.details.contacts),
      nodes: new Map(raw.details.nodes.map(({node, island, asleep, boxes}) => [node, {island, asleep, boxes: floats(boxes)}]))} : null;
    this.graphs = (raw.graphs || []).map(graph => ({name: graph.name,
      parameters: graph.parameters.map(({name, values}) => {
        const all = floats(values), finite = all.filter(Number.isFinite);
        return {name, values: all, low: finite.reduce((a, b) => Math.min(a, b), Infinity), high: finite.reduce((a, b) => Math.max(a, b), -Infinity)};
      }),
      machines: graph.machines.map(machine => ({...machine, weights: floats(machine.weights), settling: floats(machine.settling)}))}));
    this.handoffs = raw.handoffs.filter(handoff => handoff.cause !== "start");
    this.events = raw.events;
    this.findBreaks();
    for (const jumps of raw.jumps || []) this.findJumps(jumps);
    for (const node of this.nodes) node.owners = this.ownersOf(node);
  }

  // The frames after which a node's motion has a corner or a jump, and the exact times.
  findBreaks() {
    const add = (first, time, handoff) => {
      // An event exactly on a frame splits it from the one before, because a frame stores the rates just after it.
      const at = this.frameBefore(time), frame = at > 0 && this.times[at] === time ? at - 1 : at;
      if (frame < 0 || frame + 1 >= this.frameCount || time === this.times[frame]) return;
      if (handoff || !first.breaks.has(frame)) first.breaks.set(frame, {time, handoff});
      // Nodes below it turn the same corner.
      for (const waiting = [first]; waiting.length;)
        for (const child of waiting.pop().children) {
          if (child.hasBody) continue;
          if (!child.breaks.has(frame)) child.breaks.set(frame, {time, handoff: null});
          waiting.push(child);
        }
    };
    for (const event of this.events)
      if (event.impulse > 0) for (const index of event.nodes) add(this.nodes[index], event.time, null);
    for (const handoff of this.handoffs) add(this.nodes[handoff.node], handoff.time, handoff);
  }

  // Where what is scripted jumps between two frames, and when.
  findJumps({node, kind, times}) {
    for (const time of doubles(times)) {
      // What jumps on a frame stays as it is until there.
      const at = this.frameBefore(time), frame = at > 0 && this.times[at] === time ? at - 1 : at;
      if (frame < 0 || frame + 1 >= this.frameCount || time === this.times[frame]) continue;
      const waiting = [this.nodes[node]];
      while (waiting.length) {
        const each = waiting.pop();
        if (!each.jumps[kind].has(frame)) each.jumps[kind].set(frame, time);
        if (kind === "place") for (const child of each.children) if (!child.hasBody) waiting.push(child);
      }
    }
  }

  // [[start time, owner], ...]. Runs are stored by frame; a hand-off between two frames has the exact time.
  ownersOf(node) {
    const handed = this.handoffs.filter(handoff => handoff.node === node.index);
    return node.runs.map(([frame, owner]) => {
      if (!frame) return [-Infinity, owner];
      const found = handed.find(handoff => handoff.time <= this.times[frame] && handoff.time > this.times[frame - 1]);
      return [found ? found.time : this.times[frame], owner];
    });
  }

  frameBefore(time) {
    return lastNotAbove(this.frameCount, i => this.times[i], time);
  }

  frameNear(time) {
    const frame = Math.max(0, this.frameBefore(time));
    return frame + 1 < this.frameCount && this.times[frame + 1] - time < time - this.times[frame] ? frame + 1 : frame;
  }

  ownerAt(node, time) {
    if (!node.owners.length) return "keyed";
    return node.owners[Math.max(0, lastNotAbove(node.owners.length, i => node.owners[i][0], time))][1];
  }

  // The owner whose color things on `node` have: that of the body that carries it.
  shownOwner(node, time) {
    for (let n = node; n; n = this.nodes[n.parent]) if (n.hasBody) return n.fixed ? "fixed" : this.ownerAt(n, time);
    return this.ownerAt(node, time);
  }

  // Sentences about what this page leaves out or cannot show.
  limits() {
    const said = [], hidden = this.nodes.filter(node => !node.shown), list = hidden.slice(0, 3).map(node => `"${node.name}"`);
    if (!this.nodes.length) said.push("This stage has no nodes, so there is nothing to draw.");
    if (this.frameCount === 1) said.push("There is only one frame, so nothing moves.");
    if (hidden.length)
      said.push(`Not drawn, for places or sizes beyond what a page can hold (1e+30 m): ${list.join(", ")}` +
        (hidden.length > 3 ? ` and ${hidden.length - 3} more.` : "."));
    if (this.recordedFrames > this.frameCount)
      said.push(`Thinned: ${this.frameCount} of ${this.recordedFrames} frames are here, with smooth motion between them.`);
    return said;
  }
}

const number = (value, digits = 3) => {
  if (!Number.isFinite(value)) return "beyond";
  if (Math.abs(value) >= 1e6) return value.toExponential(2);
  const text = value.toFixed(digits);
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text;
};
