// What is drawn in three dimensions: bodies, meshes, colliders and bones of one recording, below one group that scales
// very small, very large and far stages to a size that graphics can handle.

function placeOffset(object, shape) {
  object.position.set(...shape.position);
  object.quaternion.set(...shape.rotation);
}

// Nodes covered by meshes: their physical shapes are drawn on request only.
function dressedNodes() {
  const dressed = new Set();
  for (const instance of recording.instances) {
    if (instance.skin >= 0) recording.skins[instance.skin].joints.forEach(joint => dressed.add(joint));
    else for (let n = nodes[instance.node], up = 0; n && up < 2; n = nodes[n.parent], ++up) {
      dressed.add(n.index);
      if (n.hasBody) break;
    }
  }
  return dressed;
}

// Nodes that are drawn as dots: those without a body that move or are linked to others, or, if there are none, all without
// a body. Lone static nodes, such as cameras and lights, are of no interest.
function bareNodes() {
  const bare = nodes.filter(node => !node.hasBody && node.shown), linked = bare.filter(node => node.moves || node.parent >= 0 || node.children.length);
  return new Set(linked.length ? linked : bare);
}

// Transparent meshes cast no shadow, and invisible ones are not drawn.
function fade(mesh, alpha) {
  mesh.visible = alpha > 0;
  mesh.castShadow = alpha >= 1 && !(mesh.userData.node && mesh.userData.node.shape.plane);
  mesh.material.transparent = alpha < 1;
  mesh.material.opacity = alpha;
  for (const line of mesh.children) line.material.opacity = 0.3 * alpha;
}

class Cast {
  constructor() {
    this.root = new THREE.Group();
    this.groups = new Map();  // by node; only nodes that something is attached to
    this.solids = [];         // what is colored at each instant: {node, material}
    this.grounds = [];        // planes at rest: {node, mesh, material}
    this.wires = null;        // made when first asked for
    this.dressed = dressedNodes();
    this.deformed = recording.instances.map(instance => new DeformedMesh(instance));
    this.bones = bareNodes();
    const bare = this.deformed.length ? nothing : node => node.hasBody || this.bones.has(node);
    this.particles = recording.particles.map(each => new ShownParticles(each));
    const bounds = drawnBounds(this.deformed, this.dressed, {bare});
    for (const each of this.particles) each.addBoxes(bounds);
    this.bounds = bounds.trimmed();
    const box = this.bounds.box();
    this.center = [0, 1, 2].map(i => (box[i] + box[3 + i]) / 2);
    this.low = box.slice(0, 3);
    const size = 0.5 * Math.hypot(...[0, 1, 2].map(i => box[3 + i] - box[i])) || 1;
    const ordinary = size > 0.02 && size < 5000 && Math.hypot(...this.center) < 1e4 * size;
    this.unit = ordinary ? 1 : 1 / size;
    this.origin = ordinary ? [0, 0, 0] : this.center;
    this.radius = size * this.unit;
    this.root.scale.setScalar(this.unit);
    this.root.position.set(...this.origin.map(value => -value * this.unit));
    this.gridStep = niceStep(2 * size, 8);
    for (const node of nodes) if (node.shape && node.shown && !this.dressed.has(node.index)) this.addSolid(node);
    this.deformed.forEach(held => this.addMesh(held));
    for (const each of this.particles) this.root.add(each.object(this.unit, this.radius));
    this.addLinks();
    this.root.updateMatrixWorld(true);
  }

  groupOf(node) {
    if (!this.groups.has(node)) {
      const group = new THREE.Group();
      group.matrixAutoUpdate = false;
      this.root.add(group);
      this.groups.set(node, group);
    }
    return this.groups.get(node);
  }

  addSolid(node) {
    const {shape} = node, geometry = shapeGeometry(shape, 80 * this.gridStep);
    // A little behind its lines, so that they do not flicker.
    const material = new THREE.MeshStandardMaterial({vertexColors: THREE.VertexColors, roughness: 0.7, metalness: 0,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: shape.plane ? 4 : 1});
    const mesh = new THREE.Mesh(geometry, material);
    placeOffset(mesh, shape);
    mesh.castShadow = !shape.plane;
    mesh.receiveShadow = true;
    mesh.userData.node = node;
    this.groupOf(node).add(mesh);
    if (shape.box || shape.hull || shape.turned || shape.corners) mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 20),
      new THREE.LineBasicMaterial({color: 0x000000, transparent: true, opacity: 0.3})));
    if (shape.plane && node.fixed) this.grounds.push({node, mesh, material});
    else this.solids.push({node, mesh, material});
  }

  addMesh(held) {
    if (!held.shown) return;
    const material = new THREE.MeshStandardMaterial({vertexColors: THREE.VertexColors, roughness: 0.75, metalness: 0,
      side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    const mesh = new THREE.Mesh(held.geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    mesh.userData.deformed = held;
    held.drawn = mesh;
    (held.skin ? this.root : this.groupOf(held.node)).add(mesh);
  }

  // The collision shapes, each below its node's group, which scales it.
  addWires() {
    this.wires = [];
    for (const node of nodes) {
      if (!node.shape || !node.shown || node.shape.plane) continue;
      const geometry = wireGeometry(node.shape);
      const wire = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({transparent: true, opacity: 0.85}));
      placeOffset(wire, node.shape);
      wire.userData.collider = node;
      this.groupOf(node).add(wire);
      this.wires.push({node, wire});
    }
  }

  addLinks() {
    this.links = nodes.filter(node => node.parent >= 0 && node.shown && nodes[node.parent].shown);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6 * this.links.length), 3));
    this.linkLines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({depthTest: false, transparent: true}));
    this.linkLines.frustumCulled = false;
    this.linkLines.renderOrder = 2;
    this.root.add(this.linkLines);
  }

  update(cursor, colorAt, alphaAt) {
    if (state.colliders && !this.wires) this.addWires();
    for (const [node, group] of this.groups) {
      matrixAt(recording, node, cursor, group.matrix.elements);
      group.matrixWorldNeedsUpdate = true;
    }
    for (const {node, mesh, material} of this.solids) {
      fade(mesh, alphaAt(node));
      material.color.fromArray(colorAt(node));
      material.emissive.copy(material.color).multiplyScalar(node === state.chosen ? 0.22 : 0);
    }
    for (const {node, wire} of this.wires || []) {
      wire.visible = state.colliders;
      wire.material.color.copy(state.byOwner ? new THREE.Color(colors.ink) : new THREE.Color().fromArray(ownerColors.free));
      wire.material.opacity = node === state.chosen ? 1 : 0.6;
    }
    for (const held of this.deformed) {
      held.update(cursor);
      if (!held.shown) continue;
      held.paint(node => colorAt(node, held.mesh.color.slice(0, 3)));
      if (held.node) fade(held.drawn, alphaAt(held.node));
    }
    for (const each of this.particles) each.update(cursor);
    this.linkLines.visible = state.skeleton;
    if (state.skeleton) this.updateLinks(cursor);
    this.root.updateMatrixWorld();
  }

  updateLinks(cursor) {
    const place = this.linkLines.geometry.attributes.position;
    this.links.forEach((node, i) => {
      const ends = node.hasBody && recording.ownerAt(node, cursor.time) === "free";
      place.array.set(placeAt(recording, node, cursor).position, 6 * i);
      place.array.set(placeAt(recording, ends ? node : nodes[node.parent], cursor).position, 6 * i + 3);
    });
    place.needsUpdate = true;
  }

  // How far `bounds` reaches in a direction of the scene, after the root's move and scale.
  reachOf(bounds) {
    return direction => this.unit * (bounds.reach(direction) - dot3(direction, this.origin));
  }

  // From the world to the scene, and back.
  toScene(point) {
    return point.map((value, i) => (value - this.origin[i]) * this.unit);
  }

  toWorld(point) {
    return point.map((value, i) => value / this.unit + this.origin[i]);
  }
}
