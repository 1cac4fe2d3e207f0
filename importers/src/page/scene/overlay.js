// What is drawn in 2-D over the 3-D view: the chosen node's path, its velocity and its name.

const overlay = document.getElementById("overlay");

// The path of a node's center, with twice as many points as frames if the frames are few.
let pathOf = {node: null};
function pathPoints(node) {
  if (pathOf.node === node) return pathOf.points;
  const count = Math.min(1200, Math.max(2 * recording.frameCount, 200)), points = [];
  for (let i = 0; i <= count; ++i) {
    const time = recording.startTime + recording.duration * i / count;
    points.push({time, place: centerOf(node, cursorAt(recording, time)),
      owner: node.fixed ? "fixed" : recording.ownerAt(node, time)});
  }
  pathOf = {node, points};
  return points;
}

function drawTrail(context, node) {
  let last = null, lastOwner = "";
  for (const {time, place: point, owner} of pathPoints(node)) {
    const place = toView(point), past = time <= state.time;
    context.globalAlpha = past ? 0.95 : 0.35;
    if (place && last) line(context, last[0], last[1], place[0], place[1], colors[owner], past ? 2.5 : 1.5);
    if (place && last && owner !== lastOwner) {
      context.globalAlpha = 1;
      context.fillStyle = colors.panel;
      context.strokeStyle = colors[owner];
      context.lineWidth = 2;
      context.beginPath();
      context.arc(place[0], place[1], 4, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
    last = place;
    lastOwner = owner;
  }
  context.globalAlpha = 1;
}

function drawVelocity(context, node) {
  const center = centerOf(node, cursorNow()), twist = twistAt(recording, node, cursorNow());
  const speed = Math.hypot(twist[0], twist[1], twist[2]);
  if (!(speed * cast.unit > 1e-3)) return;
  const from = toView(center), to = toView(center.map((value, axis) => value + 0.15 * twist[axis]));
  if (!from || !to) return;
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  if (length < 6) return;
  const ux = (to[0] - from[0]) / length, uy = (to[1] - from[1]) / length;
  line(context, from[0], from[1], to[0] - 6 * ux, to[1] - 6 * uy, colors.ink, 2);
  context.fillStyle = colors.ink;
  context.beginPath();
  context.moveTo(to[0], to[1]);
  context.lineTo(to[0] - 9 * ux - 4 * uy, to[1] - 9 * uy + 4 * ux);
  context.lineTo(to[0] - 9 * ux + 4 * uy, to[1] - 9 * uy - 4 * ux);
  context.fill();
}

function drawName(context, node) {
  const place = toView(centerOf(node, cursorNow()));
  if (!place) return;
  context.font = font(12, 600);
  const name = fittedName(context, node.name, Math.min(260, context.width - 30)), width = context.measureText(name).width + 16;
  const x = Math.max(4, Math.min(context.width - width - 4, place[0] + 18));
  const y = Math.max(4, Math.min(context.height - 26, place[1] - 34));
  context.globalAlpha = 0.9;
  context.fillStyle = colors.panel;
  context.fillRect(x, y, width, 21);
  context.globalAlpha = 1;
  context.fillStyle = colors[node.hasBody ? recording.shownOwner(node, state.time) : "quiet"];
  context.fillRect(x, y, 3, 21);
  context.fillStyle = colors.ink;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(name, x + 9, y + 11);
}

function drawBones(context) {
  for (const node of cast.bones) {
    const place = toView(placeAt(recording, node, cursorNow()).position);
    if (!place) continue;
    context.fillStyle = node === state.chosen ? colors.accent : colors.quiet;
    context.beginPath();
    context.arc(place[0], place[1], node === state.chosen ? 4.5 : 2.5, 0, 2 * Math.PI);
    context.fill();
  }
}

function drawOverlay() {
  const context = prepared(overlay);
  if (!context || !renderer) return;
  if (state.skeleton) drawBones(context);
  if (state.joints) drawJointEnds(context);
  if (state.contacts && recording.details) drawContacts(context);
  const node = state.chosen;
  if (!node || !node.shown) return;
  if (state.trail && node.moves) drawTrail(context, node);
  if (node.moves) drawVelocity(context, node);
  drawName(context, node);
}
