// Rotations as quaternions [x, y, z, w], and 3 by 3 matrices column by column.

const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross3 = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const times3 = (m, v) => [0, 1, 2].map(i => m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2]);
const product3 = (a, b) => [0, 3, 6].flatMap(at => times3(a, [b[at], b[at + 1], b[at + 2]]));
const transposed3 = m => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];

const turnProduct = (a, b) => [
  a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
  a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
  a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
  a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
const turnBack = q => [-q[0], -q[1], -q[2], q[3]];

// The rotation by |v| radians about v.
function turnOf(v) {
  const angle = Math.hypot(v[0], v[1], v[2]), factor = angle > 1e-9 ? Math.sin(angle / 2) / angle : 0.5;
  return [v[0] * factor, v[1] * factor, v[2] * factor, Math.cos(angle / 2)];
}

// The shorter rotation vector of q.
function vectorOf(q) {
  const sign = q[3] < 0 ? -1 : 1, sine = Math.hypot(q[0], q[1], q[2]);
  const factor = sign * (sine > 1e-9 ? 2 * Math.atan2(sine, sign * q[3]) / sine : 2);
  return [q[0] * factor, q[1] * factor, q[2] * factor];
}

function matrixOfTurn([x, y, z, w]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 2 * (x * y - z * w), 1 - 2 * (x * x + z * z),
    2 * (y * z + x * w), 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)];
}

function turnOfMatrix(m) {
  const [a, b, c, d, e, f, g, h, i] = m, trace = a + e + i;
  const q = trace > 0 ? [f - h, g - c, b - d, 1 + trace]
    : a > e && a > i ? [1 + a - e - i, b + d, c + g, f - h]
    : e > i ? [b + d, 1 + e - a - i, f + h, g - c] : [c + g, f + h, 1 + i - a - e, b - d];
  const length = Math.hypot(...q);
  return q.map(part => part / length);
}

// A matrix as a rotation times a stretch, R S: R is the frame of the columns, orthogonalized one after the other.
function turnAndStretch(m) {
  const first = [m[0], m[1], m[2]], x = Math.hypot(...first);
  const along = first.map(part => part / x);
  const lean = dot3(along, [m[3], m[4], m[5]]), second = [3, 4, 5].map((at, i) => m[at] - lean * along[i]);
  const y = Math.hypot(...second);
  if (!(x > 1e-30 && y > 1e-12 * x)) return null;
  const up = second.map(part => part / y), frame = [...along, ...up, ...cross3(along, up)];
  return {turn: turnOfMatrix(frame), frame, stretch: product3(transposed3(frame), m)};
}

// Angles in degrees about x, then the rotated y, then the twice rotated z; of equivalent triples the nearest to `last`.
function anglesOf(m, last) {
  const half = 180, to = 180 / Math.PI, y = Math.asin(Math.max(-1, Math.min(1, m[6])));
  const level = Math.abs(m[6]) > 0.9999999;
  const one = (level ? [Math.atan2(m[5], m[4]), y, 0] : [Math.atan2(-m[7], m[8]), y, Math.atan2(-m[3], m[0])]).map(a => a * to);
  if (!last) return one;
  const other = [one[0] + half, half - one[1], one[2] + half];
  const near = triple => triple.map((angle, i) => angle + 360 * Math.round((last[i] - angle) / 360));
  const away = triple => triple.reduce((sum, angle, i) => sum + Math.abs(angle - last[i]), 0);
  const [a, b] = [near(one), near(other)];
  return away(b) < away(a) ? b : a;
}
