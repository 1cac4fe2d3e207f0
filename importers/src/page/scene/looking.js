// Where things are in the view, what is under the pointer, and what is framed and followed.

const orbit = new Orbit(camera, view, () => requestDraw());

// Where a point of the world is in the view, in CSS pixels from the view's corner; null if it is behind the camera.
const projected = new THREE.Vector3();
function toView(point) {
  projected.fromArray(cast.toScene(point)).applyMatrix4(camera.matrixWorldInverse);
  if (!(projected.z <= -camera.near)) return null;
  projected.applyMatrix4(camera.projectionMatrix);
  return [(projected.x + 1) / 2 * view.clientWidth, (1 - projected.y) / 2 * view.clientHeight];
}

// The middle of a body's shape, or a node's origin.
function centerOf(node, cursor) {
  const {position, linear: part} = placeAt(recording, node, cursor);
  return node.shape ? times3(part, node.shape.position).map((value, i) => value + position[i]) : position;
}

// The smallest distance of the camera when it frames something.
const leastDistance = () => 0.02 * cast.radius;
let framedWhole = true;  // until the user changes the view
function frameAll() {
  orbit.frame(cast.reachOf(cast.bounds), leastDistance());
  framedWhole = true;
}

function frameChosen() {
  if (!state.chosen) return frameAll();
  const family = new Set([state.chosen]);
  for (const node of nodes) if (node.parent >= 0 && family.has(nodes[node.parent])) family.add(node);
  const bounds = drawnBounds(cast.deformed, cast.dressed, {only: node => family.has(node), instants: [cursorNow()], bare: everything});
  if (!bounds.boxes.length) return;
  orbit.frame(cast.reachOf(bounds), Math.hypot(...bounds.box().slice(0, 3).map((low, i) => bounds.box()[3 + i] - low)) > 0
    ? leastDistance() : 0.8 * cast.radius);
  framedWhole = false;
  updateScene();
}

// Moves the camera along with the chosen node.
let followed = null;
function follow() {
  if (!state.follow || !state.chosen || !state.chosen.shown) { followed = null; return; }
  const place = cast.toScene(centerOf(state.chosen, cursorNow()));
  if (followed && followed.node === state.chosen)
    orbit.shift(new THREE.Vector3(...place.map((value, i) => value - followed.place[i])));
  followed = {node: state.chosen, place};
}

// The node under a point of the view; null for the ground.
function nodeAtPoint(x, y) {
  if (state.skeleton) {
    let best = null, least = 9;
    for (const node of cast.bones) {
      const place = toView(placeAt(recording, node, cursorNow()).position);
      const away = place ? Math.hypot(place[0] - x, place[1] - y) : Infinity;
      if (away < least) { least = away; best = node; }
    }
    if (best) return best;
  }
  const caster = new THREE.Raycaster();
  caster.setFromCamera({x: 2 * x / view.clientWidth - 1, y: 1 - 2 * y / view.clientHeight}, camera);
  for (const hit of caster.intersectObjects(scene.children, true)) {
    if (!hit.object.isMesh) continue;
    const {deformed: held, node} = hit.object.userData;
    if (node) return node.shape.plane ? null : node;
    return held.skin ? nodes[held.skin.joints[strongestJoint(held.mesh, hit.face.a)]] : held.node;
  }
  return null;
}
