// Joints, drawn in 2-D over the 3-D view: their two ends, the axis that they turn about or slide along, and limits.

// The rotation and position of a node without its scale; those of the world if `index` is negative.
function frameOfNode(index, cursor) {
  if (index < 0) return {position: [0, 0, 0], frame: [1, 0, 0, 0, 1, 0, 0, 0, 1]};
  const {position, linear} = placeAt(recording, nodes[index], cursor), parts = turnAndStretch(linear);
  return {position, frame: parts ? parts.frame : [1, 0, 0, 0, 1, 0, 0, 0, 1]};
}

// Both ends in the world: {origin, axes}, axes column by column.
function endsOf(joint, cursor) {
  return [[joint.a, joint.frames[0]], [joint.b, joint.frames[1]]].map(([node, [px, py, pz, ...turn]]) => {
    const {position, frame} = frameOfNode(node, cursor);
    return {origin: times3(frame, [px, py, pz]).map((value, i) => value + position[i]),
      axes: product3(frame, matrixOfTurn(turn))};
  });
}

const holdsAt = (joint, time) => joint.gone === null || time < joint.gone;

function drawWay(context, points, color, width) {
  let last = null;
  for (const point of points) {
    const place = toView(point);
    if (place && last) line(context, last[0], last[1], place[0], place[1], color, width);
    last = place;
  }
}

// Draws the limits as a sector about the x axis of a's frame, with angles from its y axis, and b's own y axis as a line.
function drawTurn(context, joint, [a, b], reach) {
  const axis = i => [a.axes[3 * i], a.axes[3 * i + 1], a.axes[3 * i + 2]];
  const at = (angle, far) => a.origin.map((value, i) => value + far * (Math.cos(angle) * axis(1)[i] + Math.sin(angle) * axis(2)[i]));
  if (joint.angles && joint.angles[1] - joint.angles[0] < 2 * Math.PI) {
    const [low, high] = joint.angles, way = [];
    for (let i = 0; i <= 24; ++i) way.push(at(low + (high - low) * i / 24, reach));
    drawWay(context, [a.origin, ...way, a.origin], colors.event, 1.5);
  }
  drawWay(context, [b.origin, b.origin.map((value, i) => value + reach * b.axes[3 + i])], colors.ink, 1.5);
}

function drawJointEnds(context) {
  const cursor = cursorNow(), reach = 0.06 * cast.radius / cast.unit;
  for (const joint of recording.joints) {
    if (!holdsAt(joint, state.time)) continue;
    const ends = endsOf(joint, cursor), [a, b] = ends;
    if (joint.over) drawWay(context, [a.origin, ...joint.over, b.origin], colors.accent, 1.5);
    else drawWay(context, [a.origin, b.origin], colors.accent, 1.5);
    if (joint.axis) {
      const along = far => a.origin.map((value, i) => value + far * reach * a.axes[i]);
      drawWay(context, [along(-1), along(1)], colors.accent, 2);
    }
    if (joint.turns) drawTurn(context, joint, ends, reach);
    for (const {origin} of ends) {
      const place = toView(origin);
      if (!place) continue;
      context.fillStyle = colors.accent;
      context.beginPath();
      context.arc(place[0], place[1], 3, 0, 2 * Math.PI);
      context.fill();
    }
  }
}
