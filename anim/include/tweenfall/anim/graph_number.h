#pragma once

/// Numbers and places given to the operations of a graph.

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

/// A place: fixed, keyed, given by three parameters, or attached to a node.
struct GraphPlace {
  std::string node{};                         ///< the node in whose space `at` is given; empty: the world
  std::array<GraphNumber, 3> at{0., 0., 0.};  ///< m
};

}  // namespace tweenfall
