// The stage in three dimensions: one group a node, moved to the recorded places.

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(38, 1, 0.01, 1000);
const view = document.getElementById("view");
let renderer = null;
try {
  // Asked first, because three.js complains aloud.
  if (!document.createElement("canvas").getContext("webgl")) throw new Error("no WebGL");
  renderer = new THREE.WebGLRenderer({canvas: document.getElementById("scene"), antialias: true});
  renderer.gammaOutput = true;
  renderer.gammaFactor = 2.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
} catch (problem) {
  document.getElementById("no-webgl").hidden = false;
}

const linear = css => new THREE.Color(css).convertSRGBToLinear();
let ownerColors = {};

// Where things are for most of the time; what flies off at the end does not count.
const extent = (() => {
  const parts = [[], [], []], stride = Math.max(1, Math.floor(frameCount / 200));
  let reach = 0;
  for (const node of nodes) {
    if (node.shape && node.shape.plane) continue;
    if (node.shape && !node.fixed) reach = Math.max(reach, reachOf(node.shape));
    for (let frame = 0; frame < frameCount; frame += stride)
      positionOf(node, frame).forEach((value, axis) => parts[axis].push(value));
  }
  const low = [], high = [];
  for (const values of parts) {
    values.sort((a, b) => a - b);
    low.push((values[Math.floor(values.length * 0.02)] || 0) - reach);
    high.push((values[Math.ceil(values.length * 0.98) - 1] || 0) + reach);
  }
  const center = new THREE.Vector3(...low.map((value, axis) => (value + high[axis]) / 2));
  const radius = 0.5 * Math.hypot(...low.map((value, axis) => high[axis] - value)) || 1;
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(i =>
    new THREE.Vector3(...low.map((value, axis) => (i >> axis & 1 ? high[axis] : value))));
  return {center, radius, low, corners};
})();

const groups = nodes.map(node => {
  const group = new THREE.Group();
  group.matrixAutoUpdate = false;
  group.userData.node = node;
  scene.add(group);
  return group;
});

// Nodes that meshes clothe: their physical shapes are drawn on request only.
const dressed = new Set();
for (const instance of instances) {
  if (instance.skin >= 0) skins[instance.skin].joints.forEach(joint => dressed.add(joint));
  else for (let n = nodes[instance.node], up = 0; n && up < 2; n = nodes[n.parent], ++up) {
    dressed.add(n.index);
    if (n.hasBody) break;
  }
}

const solids = [];   // what is colored frame by frame: {node, material}
const wires = [];    // outlines of clothed bodies
const grounds = [];

function placeOffset(object, shape) {
  object.position.set(...shape.position);
  object.quaternion.set(...shape.rotation);
}

const gridStep = niceStep(2 * extent.radius, 8);

function addGround(parent, normal, offset) {
  const grid = new THREE.LineSegments(gridGeometry(gridStep, 40), new THREE.LineBasicMaterial({transparent: true}));
  const up = new THREE.Vector3(...normal);
  grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
  grid.position.copy(up).multiplyScalar(offset + 0.0008 * extent.radius);
  parent.add(grid);
  grounds.push({grid});
}

for (const node of nodes) {
  if (!node.shape) continue;
  const geometry = shapeGeometry(node.shape, 80 * gridStep);
  if (dressed.has(node.index)) {
    const wire = new THREE.LineSegments(new THREE.WireframeGeometry(geometry),
      new THREE.LineBasicMaterial({transparent: true, opacity: 0.5}));
    placeOffset(wire, node.shape);
    groups[node.index].add(wire);
    wires.push({node, wire});
    continue;
  }
  const material = new THREE.MeshStandardMaterial({vertexColors: THREE.VertexColors, roughness: 0.7, metalness: 0});
  const mesh = new THREE.Mesh(geometry, material);
  placeOffset(mesh, node.shape);
  mesh.castShadow = !node.shape.plane;
  mesh.receiveShadow = true;
  mesh.userData.node = node;
  groups[node.index].add(mesh);
  if (node.shape.box) {
    const edges = new THREE.LineSegments(new THREE.EdgesGeometry(geometry),
      new THREE.LineBasicMaterial({color: 0x000000, transparent: true, opacity: 0.35}));
    mesh.add(edges);
  }
  if (node.shape.plane) Object.assign(material, {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4});
  if (node.shape.plane && node.fixed) {
    grounds.push({material});
    addGround(mesh, node.shape.plane, node.shape.offset);
  } else {
    solids.push({node, material});
  }
}
if (!grounds.length) {
  const base = new THREE.Group();
  base.position.y = Math.abs(extent.low[1]) < 0.2 * extent.radius ? 0 : extent.low[1];
  scene.add(base);
  addGround(base, [0, 1, 0], 0);
}

const deformed = instances.map(instance => {
  const held = new DeformedMesh(instance);
  const material = new THREE.MeshStandardMaterial({vertexColors: THREE.VertexColors, roughness: 0.75, metalness: 0,
    side: THREE.DoubleSide});
  const mesh = new THREE.Mesh(held.geometry, material);
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.frustumCulled = false;
  mesh.userData.deformed = held;
  (held.skin ? scene : groups[instance.node]).add(mesh);
  return held;
});

const links = nodes.filter(node => node.parent >= 0);
const linkGeometry = new THREE.BufferGeometry();
linkGeometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6 * links.length), 3));
const linkLines = new THREE.LineSegments(linkGeometry, new THREE.LineBasicMaterial({depthTest: false, transparent: true}));
linkLines.frustumCulled = false;
linkLines.renderOrder = 2;
scene.add(linkLines);
state.skeleton = links.length > 0 && instances.length === 0;
// Where nothing can change hands, owners' colors say nothing.
state.byOwner = nodes.some(node => node.hasBody && !node.fixed);

const skyLight = new THREE.HemisphereLight(0xffffff, 0x77746f, 0.62);
const sun = new THREE.DirectionalLight(0xffffff, 0.48);
sun.position.copy(extent.center).add(new THREE.Vector3(0.5, 1.6, 0.8).multiplyScalar(2 * extent.radius));
sun.target.position.copy(extent.center);
sun.castShadow = true;
sun.shadow.mapSize.set(1024, 1024);
sun.shadow.bias = -0.0006;
Object.assign(sun.shadow.camera, {left: -1.6 * extent.radius, right: 1.6 * extent.radius, top: 1.6 * extent.radius,
  bottom: -1.6 * extent.radius, near: 0.1 * extent.radius, far: 8 * extent.radius});
scene.add(skyLight, sun, sun.target);

const orbit = new Orbit(camera, view, () => requestDraw());

const neutral = [0.55, 0.55, 0.55];
function ownColor(node, frame) {
  for (let n = node; n; n = nodes[n.parent]) {
    if (n.colors) return Array.from(n.colors.subarray(offsetOf(n.colors, frame, 4), offsetOf(n.colors, frame, 4) + 3));
    if (n.color) return n.color.slice(0, 3);
    if (n.hasBody) break;
  }
  return null;
}
function colorAt(node, frame, material) {
  return state.byOwner ? ownerColors[shownOwner(node, frame)] : ownColor(node, frame) || material || neutral;
}

function applyColors() {
  for (const word of ["keyed", "driven", "free", "fixed"]) ownerColors[word] = linear(colors[word]).toArray();
  // This release of three.js neither encodes the background nor the fog.
  scene.background = new THREE.Color(colors.sky);
  scene.fog = new THREE.Fog(scene.background.getHex(), 1, 2);
  for (const {grid, material} of grounds) {
    if (grid) grid.material.color.copy(linear(colors.grid));
    if (material) material.color.copy(linear(colors.ground));
  }
  linkLines.material.color.copy(linear(colors.ink));
  for (const held of deformed) held.painted = "";
}

function updateScene() {
  const frame = state.frame;
  for (const node of nodes) {
    const group = groups[node.index];
    matrixOf(node, frame, group.matrix.elements);
    group.matrixWorldNeedsUpdate = true;
  }
  for (const {node, material} of solids) {
    material.color.fromArray(colorAt(node, frame));
    material.emissive.copy(material.color).multiplyScalar(node === state.chosen ? 0.22 : 0);
  }
  for (const {node, wire} of wires) {
    wire.visible = state.colliders;
    wire.material.color.fromArray(colorAt(node, frame));
  }
  for (const held of deformed) {
    held.update(frame);
    held.paint(frame, (node, at) => colorAt(node, at, held.mesh.color.slice(0, 3)));
  }
  linkLines.visible = state.skeleton;
  if (state.skeleton) {
    const place = linkGeometry.attributes.position;
    links.forEach((node, i) => {
      const ends = node.hasBody && ownerOf(node, frame) === "free";
      place.array.set(positionOf(node, frame), 6 * i);
      place.array.set(positionOf(ends ? node : nodes[node.parent], frame), 6 * i + 3);
    });
    place.needsUpdate = true;
  }
  scene.updateMatrixWorld();
}

function fitView() {
  const width = view.clientWidth, height = view.clientHeight;
  if (!width || !height) return;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  if (renderer) {
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(width, height, false);
  }
}

function drawScene() {
  if (!renderer) return;
  scene.fog.near = 1.2 * orbit.distance + extent.radius;
  scene.fog.far = 5 * orbit.distance + 7 * extent.radius;
  renderer.render(scene, camera);
}

// Where a point of the world is in the view, in CSS pixels from the view's corner; null behind the camera.
const projected = new THREE.Vector3();
function toView(point) {
  projected.fromArray(point).applyMatrix4(camera.matrixWorldInverse);
  if (projected.z > -camera.near) return null;
  projected.applyMatrix4(camera.projectionMatrix);
  return [(projected.x + 1) / 2 * view.clientWidth, (1 - projected.y) / 2 * view.clientHeight];
}

// The middle of a body's shape, or a node's origin.
function centerOf(node, frame) {
  if (!node.shape) return positionOf(node, frame);
  const matrix = new THREE.Matrix4();
  matrixOf(node, frame, matrix.elements);
  return new THREE.Vector3(...node.shape.position).applyMatrix4(matrix).toArray();
}

function nodeAtPoint(x, y) {
  if (state.skeleton) {
    let best = null, least = 9;
    for (const node of nodes) {
      const place = toView(positionOf(node, state.frame));
      const away = place ? Math.hypot(place[0] - x, place[1] - y) : Infinity;
      if (away < least && !node.hasBody) { least = away; best = node; }
    }
    if (best) return best;
  }
  const caster = new THREE.Raycaster();
  caster.setFromCamera({x: 2 * x / view.clientWidth - 1, y: 1 - 2 * y / view.clientHeight}, camera);
  for (const hit of caster.intersectObjects(scene.children, true)) {
    if (!hit.object.isMesh) continue;
    const held = hit.object.userData.deformed;
    if (!held) return hit.object.userData.node;
    if (!held.skin) return held.node;
    const {joints, jointWeights} = held.mesh;
    const slots = 3 * joints.length / held.mesh.positions.length;
    let most = slots * hit.face.a;
    for (let k = most + 1; k < slots * hit.face.a + slots; ++k) if (jointWeights[k] > jointWeights[most]) most = k;
    return nodes[held.skin.joints[joints[most]]];
  }
  return null;
}
