// Meshes deformed by morph targets and skins, on the CPU: a few thousand vertices at a time.

const jointMatrix = new Float64Array(16);

// Matrices from rest positions to world positions, 12 numbers per joint, column by column.
function jointMatrices(skin, cursor, out) {
  skin.joints.forEach((joint, j) => {
    const b = skin.inverseBinds, at = 12 * j;
    if (joint < 0) { out.fill(0, at, at + 12); return; }
    matrixAt(recording, nodes[joint], cursor, jointMatrix);
    const m = jointMatrix;
    for (let column = 0; column < 4; ++column)
      for (let row = 0; row < 3; ++row)
        out[at + 3 * column + row] = m[row] * b[at + 3 * column] + m[4 + row] * b[at + 3 * column + 1] +
          m[8 + row] * b[at + 3 * column + 2] + (column === 3 ? m[12 + row] : 0);
  });
}

function addMorphs(mesh, weights, positions, normals) {
  mesh.morphs.forEach((morph, i) => {
    const weight = weights[i] || 0;
    if (!weight) return;
    for (let k = 0; k < positions.length; ++k) positions[k] += weight * morph.positions[k];
    if (morph.normals) for (let k = 0; k < normals.length; ++k) normals[k] += weight * morph.normals[k];
  });
}

function bend(mesh, matrices, positions, normals) {
  const {joints, jointWeights, influences} = mesh, count = positions.length / 3;
  for (let v = 0; v < count; ++v) {
    const x = positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2];
    const nx = normals[3 * v], ny = normals[3 * v + 1], nz = normals[3 * v + 2];
    let px = 0, py = 0, pz = 0, qx = 0, qy = 0, qz = 0;
    for (let k = influences * v; k < influences * (v + 1); ++k) {
      const w = jointWeights[k];
      if (!w) continue;
      const a = 12 * joints[k], m = matrices;
      px += w * (m[a] * x + m[a + 3] * y + m[a + 6] * z + m[a + 9]);
      py += w * (m[a + 1] * x + m[a + 4] * y + m[a + 7] * z + m[a + 10]);
      pz += w * (m[a + 2] * x + m[a + 5] * y + m[a + 8] * z + m[a + 11]);
      qx += w * (m[a] * nx + m[a + 3] * ny + m[a + 6] * nz);
      qy += w * (m[a + 1] * nx + m[a + 4] * ny + m[a + 7] * nz);
      qz += w * (m[a + 2] * nx + m[a + 5] * ny + m[a + 8] * nz);
    }
    const length = Math.hypot(qx, qy, qz) || 1;
    positions[3 * v] = px; positions[3 * v + 1] = py; positions[3 * v + 2] = pz;
    normals[3 * v] = qx / length; normals[3 * v + 1] = qy / length; normals[3 * v + 2] = qz / length;
  }
}

// The joint with the largest weight at a vertex.
function strongestJoint(mesh, vertex) {
  const {joints, jointWeights, influences} = mesh;
  let most = influences * vertex;
  for (let k = most + 1; k < influences * (vertex + 1); ++k) if (jointWeights[k] > jointWeights[most]) most = k;
  return joints[most];
}

// A mesh on the stage: its geometry, and how to update it to a time.
class DeformedMesh {
  constructor(instance) {
    this.node = nodes[instance.node];
    this.mesh = recording.meshes[instance.mesh];
    this.skin = instance.skin >= 0 && this.mesh.joints ? recording.skins[instance.skin] : null;
    const geometry = this.geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.mesh.positions.slice(), 3));
    geometry.setIndex(new THREE.BufferAttribute(this.mesh.triangles, 1));
    if (!this.mesh.normals) {
      geometry.computeVertexNormals();
      this.mesh.normals = geometry.attributes.normal.array.slice();
    }
    geometry.setAttribute("normal", new THREE.BufferAttribute(this.mesh.normals.slice(), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(this.mesh.positions.length).fill(1), 3));
    if (this.skin) this.matrices = new Float64Array(12 * this.skin.joints.length);
    this.shown = this.skin ? this.skin.joints.every(joint => joint < 0 || nodes[joint].shown) : this.node.shown;
    this.shown = this.shown && allFinite(this.mesh.positions);
    this.changes = !!this.skin || this.mesh.morphs.length > 0;
    this.painted = "";
  }

  weightsAt(cursor) {
    if (!this.node || !this.node.weights) return this.mesh.restWeights;
    return weightsOfNode(this.node, cursor);
  }

  update(cursor) {
    if (!this.changes || !this.shown) return;
    const position = this.geometry.attributes.position, normal = this.geometry.attributes.normal;
    position.array.set(this.mesh.positions);
    normal.array.set(this.mesh.normals);
    addMorphs(this.mesh, this.weightsAt(cursor), position.array, normal.array);
    if (this.skin) {
      jointMatrices(this.skin, cursor, this.matrices);
      bend(this.mesh, this.matrices, position.array, normal.array);
    }
    position.needsUpdate = normal.needsUpdate = true;
    this.geometry.boundingSphere = null;
  }

  // Gives each vertex the color of its strongest joint; `colorOf` gives [r, g, b] of a node.
  paint(colorOf) {
    const key = (this.skin ? this.skin.joints : [this.node.index]).map(joint => colorOf(nodes[joint]).join()).join(";");
    if (key === this.painted) return;
    this.painted = key;
    const color = this.geometry.attributes.color;
    const fixed = this.skin ? null : colorOf(this.node);
    const ofJoint = this.skin && this.skin.joints.map(joint => colorOf(nodes[joint]));
    for (let v = 0; v < color.count; ++v) color.array.set(fixed || ofJoint[strongestJoint(this.mesh, v)], 3 * v);
    color.needsUpdate = true;
  }
}
