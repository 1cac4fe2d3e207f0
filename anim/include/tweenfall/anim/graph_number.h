#pragma once

/// Numbers and places that the operations of a graph are told.

#include <tweenfall/curves/curve.h>

#include <array>
#include <string>
#include <variant>

namespace tweenfall {

/// A number of an operation: constant, keyed over the graph's time, or a parameter.
struct ByParameter {
  std::string name;
};
using GraphNumber = std::variant<double, Curve<double>, ByParameter>;

/// A place: fixed, keyed, by three parameters, or at a node, wherever that goes.
struct GraphPlace {
  std::string node{};                         ///< in whose space it is told; empty: in the world
  std::array<GraphNumber, 3> at{0., 0., 0.};  ///< m
};

}  // namespace tweenfall
