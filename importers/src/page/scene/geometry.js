// Shapes of bodies as triangles. Round shapes have a pattern of shades, so that their rotation is visible.

const shade = 0.8;

// A surface of revolution about y through `profile`, a list of [radius, height, normal radius, normal height], from
// the top down. Sectors alternate in shade above and below the middle.
function revolved(profile, sectors) {
  const positions = [], normals = [], shades = [];
  const push = (point, angle, tone) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    positions.push(point[0] * c, point[1], point[0] * s);
    normals.push(point[2] * c, point[3], point[2] * s);
    shades.push(tone, tone, tone);
  };
  for (let ring = 0; ring + 1 < profile.length; ++ring) {
    const upper = profile[ring], lower = profile[ring + 1];
    for (let sector = 0; sector < sectors; ++sector) {
      const a = 2 * Math.PI * sector / sectors, b = 2 * Math.PI * (sector + 1) / sectors;
      const quarter = Math.floor(4 * sector / sectors) + (upper[1] + lower[1] > 0 ? 0 : 1);
      const tone = quarter % 2 ? shade : 1;
      for (const [point, angle] of [[upper, a], [upper, b], [lower, b], [upper, a], [lower, b], [lower, a]])
        push(point, angle, tone);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(shades, 3));
  return geometry;
}

function capsuleGeometry(radius, halfHeight, rings = 16, sectors = 32) {
  const profile = [];
  for (let i = 0; i <= rings; ++i) {
    const angle = Math.PI * i / rings, s = Math.sin(angle), c = Math.cos(angle);
    profile.push([radius * s, radius * c + (i <= rings / 2 ? halfHeight : -halfHeight), s, c]);
    if (2 * i === rings && halfHeight > 0) profile.push([radius, 0, 1, 0], [radius, -halfHeight, 1, 0]);
  }
  return revolved(profile, sectors);
}

function boxGeometry(half) {
  const geometry = new THREE.BoxBufferGeometry(2 * half[0], 2 * half[1], 2 * half[2]);
  const count = geometry.attributes.position.count;
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * count).fill(1), 3));
  return geometry;
}

// Faces of a polyhedron, flat, as fans of triangles.
function hullGeometry(hull) {
  const corners = [];
  for (const face of hull.faces)
    for (let i = 2; i < face.length; ++i)
      for (const corner of [face[0], face[i - 1], face[i]]) corners.push(hull.vertices[corner]);
  return cornersGeometry(corners);
}

// Flat triangles, three corners each.
function cornersGeometry(corners) {
  const positions = corners.flat();
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(positions.length).fill(1), 3));
  geometry.computeVertexNormals();
  return geometry;
}

function planeGeometry(normal, offset, size) {
  const geometry = new THREE.PlaneBufferGeometry(size, size);
  const count = geometry.attributes.position.count;
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * count).fill(1), 3));
  const up = new THREE.Vector3(...normal);
  geometry.applyMatrix(new THREE.Matrix4().makeRotationFromQuaternion(
    new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up)));
  geometry.translate(...up.multiplyScalar(offset).toArray());
  return geometry;
}

function shapeGeometry(shape, planeSize) {
  if (shape.sphere !== undefined) return capsuleGeometry(shape.sphere, 0);
  if (shape.box) return boxGeometry(shape.box);
  if (shape.capsule) return capsuleGeometry(shape.capsule[0], shape.capsule[1]);
  if (shape.hull) return hullGeometry(shape.hull);
  if (shape.turned) return revolved(shape.turned, 32);
  if (shape.corners) return cornersGeometry(shape.corners);
  return planeGeometry(shape.plane, shape.offset, planeSize);
}

// Grid lines in the x-z plane, in pieces of one cell: some drivers drop lines that reach behind the camera.
function gridGeometry(step, cells) {
  const positions = [];
  for (let i = -cells; i <= cells; ++i)
    for (let k = -cells; k < cells; ++k)
      positions.push(i * step, 0, k * step, i * step, 0, (k + 1) * step, k * step, 0, i * step, (k + 1) * step, 0, i * step);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  return geometry;
}

// The outline of a collision shape, as lines: three great circles of a ball, sides and rims of a surface of revolution, edges of the others.
function wireGeometry(shape) {
  if (shape.box) return new THREE.EdgesGeometry(boxGeometry(shape.box));
  if (shape.hull) return new THREE.EdgesGeometry(hullGeometry(shape.hull), 1);
  if (shape.corners) return new THREE.EdgesGeometry(cornersGeometry(shape.corners), 20);
  const [radius, half] = shape.capsule || [shape.sphere || 0, 0], points = [];
  const arc = (from, to, place, size = radius) => {
    const count = Math.ceil((to - from) / (Math.PI / 24));
    for (let i = 0; i < count; ++i)
      for (const end of [i, i + 1]) {
        const angle = from + (to - from) * end / count;
        points.push(...place(size * Math.cos(angle), size * Math.sin(angle)));
      }
  };
  const lines = () => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    return geometry;
  };
  if (shape.turned) {
    shape.turned.slice(1).forEach(([radiusTo, heightTo, ...normalTo], i) => {
      const [radiusFrom, heightFrom, ...normalFrom] = shape.turned[i];
      for (const [c, s] of [[1, 0], [0, 1], [-1, 0], [0, -1]])
        points.push(radiusFrom * c, heightFrom, radiusFrom * s, radiusTo * c, heightTo, radiusTo * s);
      // A rim at either end of a straight section.
      if (normalFrom.every((value, k) => value === normalTo[k]))
        for (const [r, y] of [[radiusFrom, heightFrom], [radiusTo, heightTo]])
          if (r > 0) arc(0, 2 * Math.PI, (c, s) => [r * c, y, r * s], 1);
    });
    return lines();
  }
  for (const lift of half > 0 ? [half, -half] : [0]) arc(0, 2 * Math.PI, (c, s) => [c, lift, s]);
  for (const place of [(c, s, y) => [c, s + y, 0], (c, s, y) => [0, s + y, c]]) {
    arc(0, Math.PI, (c, s) => place(c, s, half));
    arc(Math.PI, 2 * Math.PI, (c, s) => place(c, s, -half));
    if (half > 0) for (const side of [-radius, radius]) points.push(...place(side, 0, half), ...place(side, 0, -half));
  }
  return lines();
}
