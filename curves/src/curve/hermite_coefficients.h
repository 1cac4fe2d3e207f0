#pragma once

// Polynomials over 0 to 1 with given values and derivatives at both ends, in power basis.

namespace tweenfall::spans {

/// The cubic from `from` that moves by `change`, with the slopes d0 and d1 at its ends.
template <class V>
void cubic_coefficients(const V& from, const V& change, const V& d0, const V& d1, V* c) {
  c[0] = from;
  c[1] = d0;
  c[2] = 3 * change - 2 * d0 - d1;
  c[3] = d0 + d1 - 2 * change;
}

/// The same over `duration` seconds; `ends` holds the first value, its rate, the last value and its rate.
template <class V>
void cubic_through(const V* ends, double duration, V* c) {
  const V change = ends[2] - ends[0], d0 = duration * ends[1], d1 = duration * ends[3];
  cubic_coefficients(ends[0], change, d0, d1, c);
}

/// The quintic from values and slopes as above, with the second derivatives e0 and e1 too.
template <class V>
void quintic_coefficients(const V& from, const V& change, const V& d0, const V& d1, const V& e0, const V& e1, V* c) {
  // By how much the quadratic from the start misses value, slope and second derivative at the end.
  const V value = change - d0 - 0.5 * e0, slope = d1 - d0 - e0, bend = e1 - e0;
  c[0] = from;
  c[1] = d0;
  c[2] = 0.5 * e0;
  c[3] = 10 * value - 4 * slope + 0.5 * bend;
  c[4] = -15 * value + 7 * slope - bend;
  c[5] = 6 * value - 3 * slope + 0.5 * bend;
}

}  // namespace tweenfall::spans
