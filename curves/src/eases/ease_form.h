#pragma once

// What an ease is made of.

#include <tweenfall/curves/ease.h>

#include "slopes/c2_slopes.h"

namespace tweenfall {

struct Ease::Form {
  Rule rule = Rule::slopes;
  std::string name;
  SlopeRule slopes = nullptr;
  std::array<double, 4> parameters{};
  TurnRule turns = nullptr;
  ShapeRule shape = nullptr;  ///< set where the pieces depend on the duration
  std::vector<Piece> pieces{};
  bool continuous_acceleration = false;  ///< of the slopes
  /// Set where the slopes are those of a C2 spline: what its ends are, with the first two parameters as given numbers.
  std::optional<slopes::C2End::Kind> c2_ends{};
  Ease (*with_ends)(double start, double end) = nullptr;  ///< the same ease with other first two parameters
};

}  // namespace tweenfall
