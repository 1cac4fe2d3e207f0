// Particles as dots: those of the last frame, moved on by their own velocities.

const dotPicture = (() => {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  context.fillStyle = "#ffffff";
  context.arc(16, 16, 15, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
})();

class ShownParticles {
  constructor(particles) {
    Object.assign(this, particles);
    const most = this.starts.reduce((most, start, frame) => Math.max(most, frame ? start - this.starts[frame - 1] : 0), 0);
    this.geometry = new THREE.BufferGeometry();
    this.places = new THREE.BufferAttribute(new Float32Array(3 * Math.max(1, most)), 3);
    this.geometry.setAttribute("position", this.places);
    this.geometry.setDrawRange(0, 0);
  }

  // Their boxes, frame by frame.
  addBoxes(bounds) {
    for (let frame = 0; frame + 1 < this.starts.length; ++frame) {
      const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
      for (let i = this.starts[frame]; i < this.starts[frame + 1]; ++i)
        for (let axis = 0; axis < 3; ++axis) {
          box[axis] = Math.min(box[axis], this.numbers[6 * i + axis]);
          box[3 + axis] = Math.max(box[3 + axis], this.numbers[6 * i + axis]);
        }
      bounds.add(box);
    }
  }

  // @param unit, radius  of the cast: the drawn length of a meter, and the drawn size of all
  object(unit, radius) {
    // Sizes in three.js are those for a field of view of 90 degrees.
    const size = Math.max(2 * this.radius * unit, 0.009 * radius) / Math.tan(camera.fov * Math.PI / 360);
    this.material = new THREE.PointsMaterial({size, map: dotPicture, alphaTest: 0.5, sizeAttenuation: true,
      color: new THREE.Color().fromArray(this.color)});
    const points = new THREE.Points(this.geometry, this.material);
    points.frustumCulled = false;
    return points;
  }

  update(cursor) {
    const first = this.starts[cursor.frame], count = this.starts[cursor.frame + 1] - first, out = this.places.array;
    const since = cursor.time - recording.times[cursor.frame];
    for (let i = 0; i < count; ++i)
      for (let axis = 0; axis < 3; ++axis)
        out[3 * i + axis] = this.numbers[6 * (first + i) + axis] + since * this.numbers[6 * (first + i) + 3 + axis];
    this.geometry.setDrawRange(0, count);
    this.shown = count;
    this.places.needsUpdate = true;
  }
}
