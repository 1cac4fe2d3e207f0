// A camera that a mouse turns about a target, moves and zooms.

class Orbit {
  constructor(camera, element, changed) {
    Object.assign(this, {camera, element, changed, target: new THREE.Vector3(), distance: 5, yaw: 0.5, pitch: 0.3});
    this.pointers = new Map();
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
  }

  zoom(factor) {
    this.distance = Math.max(1e-3, this.distance * factor);
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

  pinch(event) {
    const [a, b] = [...this.pointers.entries()].map(([id, place]) => ({id, ...place}));
    const still = a.id === event.pointerId ? b : a, moving = a.id === event.pointerId ? a : b;
    const before = Math.hypot(moving.x - still.x, moving.y - still.y);
    const after = Math.hypot(event.clientX - still.x, event.clientY - still.y);
    if (before > 0 && after > 0) this.zoom(before / after);
  }

  // Looks at all `points` from the present side, as near as they allow.
  frame(points) {
    const high = Math.tan(this.camera.fov * Math.PI / 360), wide = high * this.camera.aspect;
    this.target.set(0, 0, 0);
    this.distance = 1;
    this.apply();
    const axes = [0, 1, 2].map(i => new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, i));
    // In the camera's axes, about the target: how far left and right, up and down, and how near things are.
    const placed = points.map(point => axes.map(axis => axis.dot(point)));
    const [x, y, z] = [0, 1, 2].map(i => {
      const values = placed.map(place => place[i]);
      return (Math.min(...values) + Math.max(...values)) / 2;
    });
    axes.forEach((axis, i) => this.target.addScaledVector(axis, [x, y, z][i]));
    this.distance = 1.06 * Math.max(1e-3, ...placed.map(place => place[2] - z +
      Math.max(Math.abs(place[0] - x) / wide, Math.abs(place[1] - y) / high)));
    this.apply();
  }
}
