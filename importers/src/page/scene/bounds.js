// Boxes around all that is drawn, one per node and instant, and how far they reach in any direction.

const mostInstants = 480;       // most instants of the recording that are examined
const mostPlaces = 2e5;         // most positions of nodes, over all instants
const mostVertexMoves = 4e6;    // most vertices that are deformed while the page opens

class Bounds {
  constructor() {
    this.boxes = [];  // [low x, y, z, high x, y, z]
  }

  add(box) {
    if (box.every(Number.isFinite) && box[0] <= box[3]) this.boxes.push(box);
  }

  // The largest dot product of `direction` with a point in a box; -Infinity if there is no box.
  reach([x, y, z]) {
    const [i, j, k] = [x > 0 ? 3 : 0, y > 0 ? 4 : 1, z > 0 ? 5 : 2];
    let most = -Infinity;
    for (const box of this.boxes) most = Math.max(most, x * box[i] + y * box[j] + z * box[k]);
    return most;
  }

  box() {
    const out = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const box of this.boxes)
      for (let i = 0; i < 3; ++i) {
        out[i] = Math.min(out[i], box[i]);
        out[3 + i] = Math.max(out[3 + i], box[3 + i]);
      }
    return this.boxes.length ? out : [-1, -1, -1, 1, 1, 1];
  }

  // Without things that flew off: if the whole is far larger than what holds 96 of 100 boxes, only boxes near these count.
  trimmed() {
    if (this.boxes.length < 50) return this;
    const whole = this.box(), share = Math.floor(this.boxes.length / 50);
    const sorted = [0, 1, 2, 3, 4, 5].map(i => Float64Array.from(this.boxes, box => box[i]).sort());
    const low = [0, 1, 2].map(i => sorted[i][share]), high = [3, 4, 5].map(i => sorted[i][this.boxes.length - 1 - share]);
    const size = Math.max(...high.map((value, i) => value - low[i]));
    const far = [0, 1, 2].some(i => whole[3 + i] - whole[i] > 6 * size);
    if (!far) return this;
    const kept = new Bounds();
    kept.boxes = this.boxes.filter(box => [0, 1, 2].every(i => box[i] >= low[i] - size && box[3 + i] <= high[i] + size));
    return kept;
  }
}

function boxOfPoints(positions, matrix) {
  const out = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let v = 0; v < positions.length; v += 3)
    for (let row = 0; row < 3; ++row) {
      const value = matrix ? matrix[row] * positions[v] + matrix[4 + row] * positions[v + 1] +
        matrix[8 + row] * positions[v + 2] + matrix[12 + row] : positions[v + row];
      if (value < out[row]) out[row] = value;
      if (value > out[3 + row]) out[3 + row] = value;
    }
  return out;
}

// The box around a ball of radius `radius` about `at` after it is transformed by `matrix`.
function boxOfBall(matrix, at, radius) {
  const out = [];
  for (const sign of [-1, 1])
    for (let row = 0; row < 3; ++row)
      out.push(matrix[row] * at[0] + matrix[4 + row] * at[1] + matrix[8 + row] * at[2] + matrix[12 + row] +
        sign * radius * Math.hypot(matrix[row], matrix[4 + row], matrix[8 + row]));
  return out;
}
const boxAround = (a, b) => a.map((value, i) => (i < 3 ? Math.min(value, b[i]) : Math.max(value, b[i])));

// The extent of a body's shape, as balls or as corner points in the node's space.
function solidOf(shape) {
  const turn = matrixOfTurn(shape.rotation), place = point => times3(turn, point).map((v, i) => v + shape.position[i]);
  if (shape.sphere !== undefined) return {balls: [[shape.position, shape.sphere]]};
  if (shape.capsule) {
    const [radius, half] = shape.capsule;
    return {balls: [[place([0, half, 0]), radius], [place([0, -half, 0]), radius]]};
  }
  const corners = shape.hull ? shape.hull.vertices
    : shape.corners ? shape.corners
    : shape.turned ? shape.turned.flatMap(([radius, height]) => [0, 1, 2, 3, 4, 5, 6, 7].map(i =>
      [radius * Math.cos(i * Math.PI / 4), height, radius * Math.sin(i * Math.PI / 4)]))
    : [0, 1, 2, 3, 4, 5, 6, 7].map(i => shape.box.map((half, axis) => (i >> axis & 1 ? half : -half)));
  return {points: Float64Array.from(corners.flatMap(place))};
}

function boxOfSolid(solid, matrix) {
  return solid.points ? boxOfPoints(solid.points, matrix)
    : solid.balls.map(([at, radius]) => boxOfBall(matrix, at, radius)).reduce(boxAround);
}

// The corners of a box.
const cornersOf = ([a, b, c, d, e, f]) => Float64Array.from([0, 1, 2, 3, 4, 5, 6, 7].flatMap(i =>
  [i & 1 ? d : a, i & 2 ? e : b, i & 4 ? f : c]));

const everything = () => true, nothing = () => false;

// The box around those vertices of a deformed mesh whose strongest joint satisfies `only`.
function boxOfPart(held, only) {
  const positions = held.geometry.attributes.position.array;
  if (only === everything || !held.skin) return boxOfPoints(positions);
  const taken = held.skin.joints.map(joint => joint >= 0 && only(nodes[joint])), part = [];
  for (let v = 0; 3 * v < positions.length; ++v)
    if (taken[strongestJoint(held.mesh, v)]) part.push(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
  return boxOfPoints(part);
}

// All frames and the midpoints between them, or as many instants as there is time for.
function evenInstants() {
  const moving = nodes.filter(node => node.moves).length, room = Math.max(40, Math.floor(mostPlaces / Math.max(1, moving)));
  const count = Math.max(1, Math.min(2 * recording.frameCount - 1, mostInstants, room)), apart = recording.duration / Math.max(1, count - 1);
  return Array.from({length: count}, (_, i) => cursorAt(recording, clampTime(recording.startTime + i * apart)));
}

// Bounds at `instants` of the nodes that satisfy `only`: of deformed meshes, of bodies that are not in `dressed` (covered
// by a mesh), and of the positions of other nodes that satisfy `bare`.
function drawnBounds(deformed, dressed, {only = everything, instants = evenInstants(), bare = nothing} = {}) {
  const bounds = new Bounds(), matrix = new Float64Array(16);
  let bent = 0;
  for (const held of deformed)
    if (held.shown && held.changes) bent += held.mesh.positions.length / 3 * (1 + held.mesh.morphs.length);
  const sparse = Math.max(1, Math.ceil(bent * instants.length / mostVertexMoves));
  for (const held of deformed) {
    if (!held.shown || !(held.skin ? held.skin.joints.some(joint => joint >= 0 && only(nodes[joint])) : only(held.node))) continue;
    const corners = held.changes ? null : cornersOf(boxOfPoints(held.mesh.positions));
    instants.forEach((cursor, i) => {
      if (corners) {
        if (i === 0 || held.node.moves) bounds.add(boxOfPoints(corners, matrixAt(recording, held.node, cursor, matrix)));
        return;
      }
      if (i % sparse && i + 1 < instants.length) return;
      held.update(cursor);
      const box = boxOfPart(held, only);
      bounds.add(held.skin || !box.every(Number.isFinite) ? box
        : boxOfPoints(cornersOf(box), matrixAt(recording, held.node, cursor, matrix)));
    });
  }
  for (const node of nodes) {
    if (!node.shown || !only(node) || (node.shape && node.shape.plane)) continue;
    const solid = node.shape && !dressed.has(node.index) ? solidOf(node.shape) : null;
    if (!solid && !bare(node)) continue;
    for (const cursor of node.moves ? instants : instants.slice(0, 1)) {
      if (solid) bounds.add(boxOfSolid(solid, matrixAt(recording, node, cursor, matrix)));
      else { const {position} = placeAt(recording, node, cursor); bounds.add([...position, ...position]); }
    }
  }
  return bounds;
}
