#pragma once

// The slopes for which cubics through given values have a continuous second derivative, in linear time.

#include "slopes/slope_rule.h"

#include <vector>

namespace tweenfall::slopes {

/// The condition at one end of a run of spans.
struct C2End {
  enum class Kind { slope, second, not_a_knot };
  Kind kind = Kind::second;
  std::vector<double> given{};  ///< slope or second derivative, one per component; empty: zero
};

/// Fills the run's slopes. With not-a-knot the first (last) two spans are one cubic; where there are too few spans for
/// that, the polynomial of least degree through the values.
/// Source: de Boor, "A Practical Guide to Splines", chapter IV.
void solve_c2(const SlopeProblem& problem, const C2End& start, const C2End& end);

/// The run as one period: slope and second derivative at its end are those at its start.
void solve_c2_periodic(const SlopeProblem& problem);

/// The automatic choice of ends: one period where the run is a whole loop; flat at the ends of a curve whose options
/// say so; else `usual`.
void solve_c2_automatic(const SlopeProblem& problem, C2End::Kind usual);

/// @throws std::invalid_argument unless both numbers at the ends of a run are finite.
void check_ends(const char* what, double start, double end);

}  // namespace tweenfall::slopes
