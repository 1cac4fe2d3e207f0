// What the physics steps worked with: contacts, the boxes of the broad phase, islands and sleep, as of the last frame
// before the present time.

const detailFrame = () => Math.max(0, recording.frameBefore(state.time));

// The word that applies at a frame, of runs [[first frame, word], ...].
const runAt = (runs, frame) => runs[Math.max(0, lastNotAbove(runs.length, i => runs[i][0], frame))][1];

// The step details of the body that carries a node; null if there is none.
function detailOf(node) {
  for (let n = node; recording.details && n; n = nodes[n.parent]) if (n.hasBody) return recording.details.nodes.get(n.index) || null;
  return null;
}

// One hue per island, far from those of the islands before and after it; bodies in no island stay gray.
function islandColor(node) {
  const detail = detailOf(node), island = detail ? runAt(detail.island, detailFrame()) : -1;
  if (island < 0) return neutral;
  return new THREE.Color().setHSL(0.618034 * island % 1, 0.65, 0.5).convertSRGBToLinear().toArray();
}

const isAsleep = node => { const detail = detailOf(node); return !!detail && runAt(detail.asleep, detailFrame()) === 1; };

// Sleeping bodies fade toward the color of fixed ones.
const faded = color => color.map((part, i) => 0.2 * part + 0.8 * ownerColors.fixed[i] * 0.45);

function contactsNow() {
  const {starts, contacts} = recording.details, frame = detailFrame(), out = [];
  for (let i = starts[frame]; i < starts[frame + 1]; ++i)
    out.push({point: Array.from(contacts.subarray(7 * i, 7 * i + 3)), normal: Array.from(contacts.subarray(7 * i + 3, 7 * i + 6)),
      impulse: contacts[7 * i + 6]});
  return out;
}

const contactColor = "#e0245e", boxColor = "#0a9396";

// A point per contact, and its normal from the first body to the second; pale if it has no impulse.
function drawContacts(context) {
  const reach = 0.03 * cast.radius / cast.unit;
  for (const {point, normal, impulse} of contactsNow()) {
    const from = toView(point), to = toView(point.map((value, i) => value + reach * normal[i]));
    if (!from || !to) continue;
    const color = impulse > 0 ? contactColor : colors.quiet;
    line(context, from[0], from[1], to[0], to[1], color, 1.5);
    context.fillStyle = color;
    context.beginPath();
    context.arc(from[0], from[1], 2, 0, 2 * Math.PI);
    context.fill();
  }
}

// The boxes of all bodies as lines of one object, made when first needed.
let boxLines = null;
const boxEdges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]].flat();

const boxAt = (detail, frame) => {
  const from = offsetOf(detail.boxes, frame, 6), box = Array.from(detail.boxes.subarray(from, from + 6));
  return box.every(Number.isFinite) ? box : null;
};

function updateBoxes() {
  if (boxLines) boxLines.visible = state.boxes;
  if (!state.boxes || !recording.details) return;
  if (!boxLines) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(72 * recording.details.nodes.size), 3));
    boxLines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({transparent: true, opacity: 0.6, depthTest: false}));
    boxLines.frustumCulled = false;
    cast.root.add(boxLines);
  }
  boxLines.material.color.copy(linear(boxColor));
  const place = boxLines.geometry.attributes.position, frame = detailFrame();
  let at = 0;
  for (const detail of recording.details.nodes.values()) {
    const box = boxAt(detail, frame);
    if (box) for (const corner of boxEdges) place.setXYZ(at++, box[corner & 1 ? 3 : 0], box[corner & 2 ? 4 : 1], box[corner & 4 ? 5 : 2]);
  }
  place.needsUpdate = true;
  boxLines.geometry.setDrawRange(0, at);
}
