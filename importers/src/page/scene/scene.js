// The scene around the cast: camera, light, ground, and colors.

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(38, 1, 0.01, 1000);
const view = document.getElementById("view");
let renderer = null;

function isSoftware(context) {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  return !!info && /swiftshader|llvmpipe|softpipe|software|basic render/i.test(context.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

try {
  // Tried first, because three.js prints errors on failure.
  const context = document.createElement("canvas").getContext("webgl");
  if (!context) throw new Error("no WebGL");
  // Without a graphics card, antialiasing takes as long as all the rest.
  renderer = new THREE.WebGLRenderer({canvas: document.getElementById("scene"), antialias: !isSoftware(context)});
  renderer.gammaOutput = true;
  renderer.gammaFactor = 2.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
} catch (problem) {
  document.getElementById("no-webgl").hidden = false;
}

const linear = css => new THREE.Color(css).convertSRGBToLinear();
let ownerColors = {};

const cast = new Cast();
scene.add(cast.root);
const grids = [];

function addGrid(parent, normal, offset) {
  const grid = new THREE.LineSegments(gridGeometry(cast.gridStep, 40), new THREE.LineBasicMaterial({transparent: true}));
  const up = new THREE.Vector3(...normal);
  grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
  grid.position.copy(up).multiplyScalar(offset + 0.0008 * cast.radius / cast.unit);
  parent.add(grid);
  grids.push(grid);
}

for (const {node, mesh} of cast.grounds) addGrid(mesh, node.shape.plane, node.shape.offset);
if (!cast.grounds.length) {
  const base = new THREE.Group(), size = cast.radius / cast.unit;
  base.position.set(Math.hypot(cast.center[0], cast.center[2]) < 20 * size ? 0 : cast.center[0],
    Math.abs(cast.low[1]) < 0.2 * size ? Math.min(0, cast.low[1]) : cast.low[1],
    Math.hypot(cast.center[0], cast.center[2]) < 20 * size ? 0 : cast.center[2]);
  cast.root.add(base);
  addGrid(base, [0, 1, 0], 0);
}

const middle = new THREE.Vector3(...cast.toScene(cast.center));
const skyLight = new THREE.HemisphereLight(0xffffff, 0x77746f, 0.62);
const sun = new THREE.DirectionalLight(0xffffff, 0.48);
sun.position.copy(middle).add(new THREE.Vector3(0.5, 1.6, 0.8).multiplyScalar(2 * cast.radius));
sun.target.position.copy(middle);
sun.castShadow = true;
sun.shadow.mapSize.set(1024, 1024);
sun.shadow.bias = -0.0006;
Object.assign(sun.shadow.camera, {left: -1.6 * cast.radius, right: 1.6 * cast.radius, top: 1.6 * cast.radius,
  bottom: -1.6 * cast.radius, near: 0.1 * cast.radius, far: 8 * cast.radius});
scene.add(skyLight, sun, sun.target);

const neutral = [0.55, 0.55, 0.55];
function ownColorAndAlpha(node) {
  for (let n = node; n; n = nodes[n.parent]) {
    if (n.colors) return colorOfNode(n, cursorNow());
    if (n.color) return n.color;
    if (n.hasBody) break;
  }
  return null;
}
function ownColor(node) {
  const color = ownColorAndAlpha(node);
  return color && Array.from(color).slice(0, 3);
}
// The opacity of a node, 0 to 1, in whatever color it is drawn.
function alphaAt(node) {
  const color = ownColorAndAlpha(node);
  return color ? Math.min(1, Math.max(0, color[3])) : 1;
}
const usualColor = (node, material) =>
  (state.byOwner ? ownerColors[recording.shownOwner(node, state.time)] : ownColor(node) || material || neutral);
function colorAt(node, material) {
  const color = state.islands ? islandColor(node) : usualColor(node, material);
  return state.sleepers && isAsleep(node) ? faded(color) : color;
}

function applyColors() {
  for (const word of ["keyed", "driven", "free", "fixed"]) ownerColors[word] = linear(colors[word]).toArray();
  // This release of three.js neither encodes the background nor the fog.
  scene.background = new THREE.Color(colors.sky);
  scene.fog = new THREE.Fog(scene.background.getHex(), 1, 2);
  for (const grid of grids) grid.material.color.copy(linear(colors.grid));
  for (const {material} of cast.grounds) material.color.copy(linear(colors.ground));
  cast.linkLines.material.color.copy(linear(colors.ink));
  for (const held of cast.deformed) held.painted = "";
}

function updateScene() {
  cast.update(cursorNow(), colorAt, alphaAt);
  updateBoxes();
  scene.updateMatrixWorld();
}

// Fits the canvas to the view. Returns whether its size changed; it is then black until it is drawn again.
function fitView() {
  const width = view.clientWidth, height = view.clientHeight, ratio = window.devicePixelRatio || 1;
  if (!width || !height) return false;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  if (!renderer) return false;
  const size = renderer.getSize(new THREE.Vector2());
  if (size.x === width && size.y === height && renderer.getPixelRatio() === ratio) return false;
  renderer.setPixelRatio(ratio);
  renderer.setSize(width, height, false);
  return true;
}

function drawScene() {
  if (!renderer) return;
  scene.fog.near = 1.2 * orbit.distance + cast.radius;
  scene.fog.far = 5 * orbit.distance + 7 * cast.radius;
  renderer.render(scene, camera);
}
