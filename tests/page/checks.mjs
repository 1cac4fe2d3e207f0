// Counts what holds and what does not.

let failed = 0, checked = 0;

export function check(holds, sentence) {
  ++checked;
  if (holds) return;
  ++failed;
  console.error("FAILED: " + sentence);
}

export const equal = (actual, expected, sentence) =>
  check(Object.is(actual, expected), `${sentence}: ${JSON.stringify(actual)} should be ${JSON.stringify(expected)}`);

const farthest = (a, b) => (a.length === b.length ? Math.max(0, ...a.map((value, i) => Math.abs(value - b[i]))) : Infinity);

// Positions are stored in single precision.
export const near = (actual, expected, sentence, tolerance = 2e-6) =>
  check(farthest(actual, expected) <= tolerance * Math.max(1, ...expected.map(Math.abs)),
    `${sentence}: off by ${farthest(actual, expected)}`);

export function summary() {
  console.log(`${checked} checks, ${failed} failed`);
  return failed ? 1 : 0;
}
