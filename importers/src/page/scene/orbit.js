// A camera that the mouse turns about a target, moves and zooms.

const framed = 0.88;  // the share of the view that framed things may fill

class Orbit {
  constructor(camera, element, changed) {
    Object.assign(this, {camera, element, changed, target: new THREE.Vector3(), distance: 5, yaw: 0.42, pitch: 0.24});
    this.pointers = new Map();
    this.travelled = 0;
    element.addEventListener("pointerdown", event => this.down(event));
    element.addEventListener("pointermove", event => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, event => this.up(event));
    element.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom(Math.exp(Math.max(-120, Math.min(120, event.deltaY * (event.deltaMode ? 30 : 1))) * 0.0016));
    }, {passive: false});
    element.addEventListener("contextmenu", event => event.preventDefault());
  }

  apply() {
    const flat = Math.cos(this.pitch) * this.distance;
    this.camera.position.set(Math.sin(this.yaw) * flat, Math.sin(this.pitch) * this.distance,
      Math.cos(this.yaw) * flat).add(this.target);
    this.camera.lookAt(this.target);
    this.camera.near = this.distance / 200;
    this.camera.far = this.distance * 200;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld(true);
    this.changed();
    if (this.looked) this.looked(this.look);
  }

  // What it looks at in the world, from how far and from which side, so that another page can take the same view.
  get look() {
    return {target: cast.toWorld(this.target.toArray()), distance: this.distance / cast.unit, yaw: this.yaw, pitch: this.pitch};
  }

  set look({target, distance, yaw, pitch}) {
    this.target.fromArray(cast.toScene(target));
    Object.assign(this, {distance: distance * cast.unit, yaw, pitch});
    this.apply();
  }

  zoom(factor) {
    this.distance = Math.min(1e6, Math.max(1e-6, this.distance * factor));
    this.apply();
  }

  down(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    this.travelled = 0;
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    this.travelled += Math.abs(dx) + Math.abs(dy);
    if (this.pointers.size === 2) this.pinch(event);
    else if (event.buttons & 6 || event.shiftKey) this.pan(dx, dy);
    else this.turn(dx, dy);
    last.x = event.clientX;
    last.y = event.clientY;
  }

  up(event) {
    this.pointers.delete(event.pointerId);
  }

  turn(dx, dy) {
    this.yaw -= dx * 0.008;
    this.pitch = Math.min(1.55, Math.max(-1.55, this.pitch + dy * 0.008));
    this.apply();
  }

  pan(dx, dy) {
    const unit = 2 * this.distance * Math.tan(this.camera.fov * Math.PI / 360) / this.element.clientHeight;
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    this.target.addScaledVector(right, -dx * unit).addScaledVector(up, dy * unit);
    this.apply();
  }

  shift(by) {
    this.target.add(by);
    this.apply();
  }

  pinch(event) {
    const [a, b] = [...this.pointers.entries()].map(([id, place]) => ({id, ...place}));
    const still = a.id === event.pointerId ? b : a, moving = a.id === event.pointerId ? a : b;
    const before = Math.hypot(moving.x - still.x, moving.y - still.y);
    const after = Math.hypot(event.clientX - still.x, event.clientY - still.y);
    if (before > 0 && after > 0) this.zoom(before / after);
  }

  // Looks from the present side at all that `reach` measures (the largest dot product of a direction with a point), as
  // near as the four sides of the view allow. A point p is within the right side if (r + w b) . p <= (r + w b) . C, with
  // the camera's position C, its right r, its back b and the side's slope w; the three other sides likewise.
  frame(reach, least) {
    const high = framed * Math.tan(this.camera.fov * Math.PI / 360), wide = high * this.camera.aspect;
    this.target.set(0, 0, 0);
    this.distance = 1;
    this.apply();
    const [right, up, back] = [0, 1, 2].map(i => new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, i));
    const along = (axis, sign, slope) => reach(axis.clone().multiplyScalar(sign).addScaledVector(back, slope).toArray());
    const sides = [along(right, 1, wide), along(right, -1, wide), along(up, 1, high), along(up, -1, high)];
    if (!sides.every(Number.isFinite)) return;
    const near = reach(back.toArray()), far = -reach(back.clone().negate().toArray()), middle = (near + far) / 2;
    const depth = Math.max((sides[0] + sides[1]) / (2 * wide), (sides[2] + sides[3]) / (2 * high), middle + least);
    this.target.addScaledVector(right, (sides[0] - sides[1]) / 2).addScaledVector(up, (sides[2] - sides[3]) / 2)
      .addScaledVector(back, middle);
    this.distance = depth - middle;
    this.apply();
  }
}
