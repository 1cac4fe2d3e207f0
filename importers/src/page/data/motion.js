// Where things are between the frames: each node follows the cubic that has the position and velocity, the rotation and
// angular velocity of both frames. A hand-off or an impact between two frames splits the cubic; a node that jumps stays
// where it is until the next frame.

// {frame, share}: `share` of the way from `frame` to the next.
function cursorAt(recording, time) {
  const {times, frameCount} = recording, frame = Math.max(0, recording.frameBefore(time));
  if (frame + 1 >= frameCount) return {frame: frameCount - 1, share: 0, time: recording.endTime};
  const share = Math.max(0, (time - times[frame]) / (times[frame + 1] - times[frame]));
  return {frame, share, time, span: times[frame + 1] - times[frame], next: times[frame + 1]};
}

const slice = (values, at, count) => Array.from(values.subarray(at, at + count));

// A node at a frame: position, linear part, and the rates of both.
function stateAt(node, frame) {
  const at = offsetOf(node.matrices, frame, 12), turn = offsetOf(node.twists, frame, 6);
  const velocity = node.velocities ? slice(node.velocities, offsetOf(node.velocities, frame, 3), 3) : slice(node.twists, turn, 3);
  return {linear: slice(node.matrices, at, 9), position: slice(node.matrices, at + 9, 3), velocity,
    angular: slice(node.twists, turn + 3, 3),
    stretching: node.stretches ? slice(node.stretches, offsetOf(node.stretches, frame, 9), 9) : null};
}

// The same at a hand-off, which knows the motion just before and just after; twists there are at the center of mass.
function stateAtHandoff(node, motion, like) {
  const frame = matrixOfTurn(motion.rotation), shape = turnAndStretch(like.linear);
  const linear = shape ? product3(frame, shape.stretch) : frame;
  const lift = cross3(motion.angular, times3(linear, node.center));
  return {linear, position: motion.position, velocity: motion.velocity.map((v, i) => v - lift[i]), angular: motion.angular,
    stretching: null};
}

// Source: Kim, Kim, Shin, "A general construction scheme for unit quaternion curves", 1995: a cumulative cubic, here with
// the velocities of both ends.
function turnBetween(from, to, wFrom, wTo, span, u) {
  const third = span / 3, start = wFrom.map(w => w * third), end = wTo.map(w => w * third);
  const middle = vectorOf(turnProduct(turnOf(end.map(w => -w)),
    turnProduct(to, turnProduct(turnBack(from), turnOf(start.map(w => -w))))));
  // `middle` is the rotation that is left, in the world's axes; more than the velocities can explain is a jump.
  if (Math.hypot(...middle) > 6 * (Math.hypot(...start) + Math.hypot(...end)) + 2e-3) return null;
  const v = 1 - u, first = 1 - v * v * v, second = u * u * (3 - 2 * u), last = u * u * u;
  return turnProduct(turnOf(end.map(w => w * last)), turnProduct(turnOf(middle.map(w => w * second)),
    turnProduct(turnOf(start.map(w => w * first)), from)));
}

function cubic(a, b, rateA, rateB, span, u) {
  const v = 1 - u;
  return v * v * (1 + 2 * u) * a + u * u * (3 - 2 * u) * b + span * u * v * (v * rateA - u * rateB);
}

function linearBetween(a, b, span, u) {
  const one = turnAndStretch(a.linear), two = turnAndStretch(b.linear);
  if (!one || !two) return a.linear.map((value, i) => value + u * (b.linear[i] - value));
  const whole = vectorOf(turnProduct(two.turn, turnBack(one.turn))), spin = Math.hypot(...a.angular) * span;
  const angular = spin < 2.5 ? arrival(whole.map(value => value / span), a.angular, b.angular) : b.angular;
  const turn = turnBetween(one.turn, two.turn, a.angular, angular, span, u);
  if (!turn) return a.linear;
  // Rates of the stretch are given in the world's axes.
  const rates = (state, shape) => state.stretching && product3(transposed3(shape.frame), state.stretching);
  const rateA = rates(a, one), rateB = rates(b, two);
  const stretch = one.stretch.map((value, i) => rateA && rateB
    ? cubic(value, two.stretch[i], rateA[i], rateB[i], span, u) : value + u * (two.stretch[i] - value));
  return product3(matrixOfTurn(turn), stretch);
}

// A frame stores the rate just after it. If a straight stretch ends in a corner at the next frame, as at linear keys, that
// frame's rate is not the rate of arrival: then the stretch's own rate `along` is taken. On smooth motion `along` lies
// halfway between the rates of both ends; on a straight stretch it is the rate of its start.
function arrival(along, from, to) {
  const early = Math.hypot(...along.map((value, i) => value - from[i])), late = Math.hypot(...along.map((value, i) => value - to[i]));
  return early < 0.05 * late ? along : to;
}

// Position and linear part at share `u` of the way from state `a` to state `b`.
function between(a, b, span, u) {
  const excess = Math.hypot(...a.position.map((p, i) => b.position[i] - p - span * (a.velocity[i] + b.velocity[i]) / 2));
  const reach = 2 * span * (Math.hypot(...a.velocity) + Math.hypot(...b.velocity));
  const rounding = 1e-6 * Math.max(...a.position.map(Math.abs), ...b.position.map(Math.abs)) + 1e-30;
  if (excess > reach + rounding) return a;
  const velocity = arrival(a.position.map((p, i) => (b.position[i] - p) / span), a.velocity, b.velocity);
  const position = a.position.map((p, i) => cubic(p, b.position[i], a.velocity[i], velocity[i], span, u));
  return {position, linear: linearBetween(a, b, span, u)};
}

// The state of a node that continues from `a` at constant velocity for `time` s.
function onward(a, time) {
  const turn = matrixOfTurn(turnOf(a.angular.map(w => w * time)));
  return {...a, position: a.position.map((p, i) => p + a.velocity[i] * time), linear: product3(turn, a.linear)};
}

function placeAt(recording, node, cursor) {
  const a = stateAt(node, cursor.frame);
  if (!node.moves || cursor.share <= 0) return a;
  const b = stateAt(node, cursor.frame + 1), found = node.breaks.get(cursor.frame), jump = node.jumps.place.get(cursor.frame);
  if (!found && jump !== undefined)
    return cursor.time < jump ? onward(a, cursor.time - recording.times[cursor.frame]) : onward(b, cursor.time - cursor.next);
  if (!found) return between(a, b, cursor.span, cursor.share);
  const before = found.time - recording.times[cursor.frame], after = cursor.next - found.time;
  const early = cursor.time < found.time;
  let corner;
  if (found.handoff) {
    corner = stateAtHandoff(node, early ? found.handoff.before : found.handoff.after, a);
  } else {
    // Both sides continue straight to the corner; it is halfway between where they arrive.
    const one = onward(a, before), two = onward(b, -after);
    const met = one.position.map((p, i) => (p + two.position[i]) / 2);
    corner = {...(early ? one : two), position: met, linear: one.linear};
  }
  return early ? between(a, corner, before, before > 0 ? (cursor.time - recording.times[cursor.frame]) / before : 1)
    : between(corner, b, after, after > 0 ? (cursor.time - found.time) / after : 0);
}

// Column-major 4 by 4, written into `out`.
function matrixAt(recording, node, cursor, out) {
  const {position, linear} = placeAt(recording, node, cursor);
  for (let column = 0; column < 3; ++column) {
    for (let row = 0; row < 3; ++row) out[4 * column + row] = linear[3 * column + row];
    out[4 * column + 3] = 0;
  }
  for (let row = 0; row < 3; ++row) out[12 + row] = position[row];
  out[15] = 1;
  return out;
}

// Values stored frame by frame, interpolated linearly; at a jump they change at once to those of the next frame.
function valuesAt(values, count, cursor, jump) {
  const at = offsetOf(values, cursor.frame, count);
  if (values.length === count || cursor.share <= 0) return slice(values, at, count);
  const share = jump === undefined ? cursor.share : cursor.time < jump ? 0 : 1;
  return slice(values, at, count).map((value, i) => value + share * (values[at + count + i] - value));
}
const twistAt = (recording, node, cursor) => {
  const broken = node.breaks.get(cursor.frame);
  return valuesAt(node.twists, 6, cursor, broken ? broken.time : node.jumps.place.get(cursor.frame));
};
const colorOfNode = (node, cursor) => valuesAt(node.colors, 4, cursor, node.jumps.color.get(cursor.frame));
const weightsOfNode = (node, cursor) => valuesAt(node.weights, node.weightCount, cursor, node.jumps.weights.get(cursor.frame));
