// What is drawn flat over the 3-D view: the chosen node's path, its velocity and its name.

const overlay = document.getElementById("overlay");

function drawTrail(context, node) {
  const stride = Math.max(1, Math.ceil(frameCount / 1200));
  let last = null, lastOwner = "";
  for (let frame = 0; frame < frameCount; frame += stride) {
    const place = toView(centerOf(node, frame)), owner = node.fixed ? "fixed" : ownerOf(node, frame);
    if (place && last) {
      context.globalAlpha = frame <= state.frame ? 0.95 : 0.35;
      line(context, last[0], last[1], place[0], place[1], colors[owner], frame <= state.frame ? 2.5 : 1.5);
    }
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
  const center = centerOf(node, state.frame), twist = twistOf(node, state.frame);
  const speed = Math.hypot(twist[0], twist[1], twist[2]);
  if (!(speed > 1e-3)) return;
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
  const place = toView(centerOf(node, state.frame));
  if (!place) return;
  context.font = font(12, 600);
  const width = context.measureText(node.name).width + 14;
  const x = Math.max(4, Math.min(context.width - width - 4, place[0] + 18));
  const y = Math.max(4, Math.min(context.height - 26, place[1] - 34));
  context.globalAlpha = 0.88;
  context.fillStyle = colors.panel;
  context.beginPath();
  context.rect(x, y, width, 21);
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = colors[node.hasBody ? shownOwner(node, state.frame) : "quiet"];
  context.fillRect(x, y, 3, 21);
  context.fillStyle = colors.ink;
  context.textBaseline = "middle";
  context.fillText(node.name, x + 9, y + 11);
}

function drawJoints(context) {
  for (const node of nodes) {
    if (node.hasBody) continue;
    const place = toView(positionOf(node, state.frame));
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
  if (state.skeleton) drawJoints(context);
  const node = state.chosen;
  if (!node) return;
  const moves = node.matrices.length > 12;
  if (state.trail && moves) drawTrail(context, node);
  if (moves) drawVelocity(context, node);
  drawName(context, node);
}
