// The recording as the page carries it, and questions about it.

const raw = JSON.parse(document.getElementById("data").textContent);

function bytesOf(text) {
  const binary = atob(text || "");
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}
const floats = text => new Float32Array(bytesOf(text));
const doubles = text => new Float64Array(bytesOf(text));
const integers = text => new Uint32Array(bytesOf(text));

const times = doubles(raw.times);
const frameCount = times.length;
const startTime = times[0];
const endTime = times[frameCount - 1];
const duration = endTime - startTime;

const nodes = raw.nodes.map((node, index) => ({
  index, name: node.name, parent: node.parent, shape: node.shape, fixed: !!node.fixed, hasBody: !!node.shape,
  matrices: floats(node.matrices), twists: floats(node.twists), runs: node.owner, color: node.color,
  colors: node.colors ? floats(node.colors) : null, weightCount: node.weightCount || 0,
  weights: node.weights ? floats(node.weights) : null,
}));
const nodeNamed = new Map(nodes.map(node => [node.name, node]));

const meshes = raw.meshes.map(mesh => ({
  name: mesh.name, positions: floats(mesh.positions), normals: mesh.normals ? floats(mesh.normals) : null,
  triangles: integers(mesh.triangles), joints: mesh.joints ? integers(mesh.joints) : null,
  jointWeights: mesh.jointWeights ? floats(mesh.jointWeights) : null,
  morphs: mesh.morphs.map(morph => ({name: morph.name, positions: floats(morph.positions),
    normals: morph.normals ? floats(morph.normals) : null})),
  restWeights: mesh.restWeights, color: mesh.color,
}));
const skins = raw.skins.map(skin => ({joints: skin.joints, inverseBinds: floats(skin.inverseBinds)}));
const instances = raw.instances.filter(instance => instance.node >= 0 || instance.skin >= 0);
const lanes = raw.lanes.map(lane => ({node: nodes[lane.node], property: lane.property, times: doubles(lane.times)}));
const handoffs = raw.handoffs;
const events = raw.events;

// Values that never change are stored once.
const offsetOf = (values, frame, stride) => (values.length === stride ? 0 : frame * stride);

const positionOf = (node, frame) => {
  const at = offsetOf(node.matrices, frame, 12) + 9;
  return [node.matrices[at], node.matrices[at + 1], node.matrices[at + 2]];
};
const twistOf = (node, frame) => {
  const at = offsetOf(node.twists, frame, 6);
  return Array.from(node.twists.subarray(at, at + 6));
};

// Column-major 4 by 4, written into `out`.
function matrixOf(node, frame, out) {
  const m = node.matrices, at = offsetOf(m, frame, 12);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 3; ++row) out[4 * column + row] = m[at + 3 * column + row];
    out[4 * column + 3] = column === 3 ? 1 : 0;
  }
  return out;
}

function ownerOf(node, frame) {
  const runs = node.runs;
  let low = 0, high = runs.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (runs[middle][0] <= frame) low = middle; else high = middle - 1;
  }
  return runs.length ? runs[low][1] : "keyed";
}

// How a thing hung on `node` is colored: as the body that carries it.
function shownOwner(node, frame) {
  for (let n = node; n; n = nodes[n.parent])
    if (n.hasBody) return n.fixed ? "fixed" : ownerOf(n, frame);
  return "keyed";
}

// The frame nearest to a time.
function frameAt(time) {
  let low = 0, high = frameCount - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) low = middle + 1; else high = middle;
  }
  return low > 0 && time - times[low - 1] <= times[low] - time ? low - 1 : low;
}

const number = (value, digits = 3) => {
  const text = value.toFixed(digits);
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text;
};
