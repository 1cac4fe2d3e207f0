#pragma once

// From a system's way to the tracks of a clip.

#include <tweenfall/physics/expression_system.h>

#include "document/content.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tweenfall::document::systems {

// A system being read, with what waits until its state is known.
struct Draft {
  ExpressionSystem system;
  json::Value state{}, rates{}, parameters{}, energy{}, starts{}, portrait{}, tracks{};
};

// Expressions of t and a state.
class Expressions {
 public:
  // Parameters that cannot be are told.
  Expressions(std::span<const std::string> variables, const json::Value& parameters, Problems& problems);
  // Of a text or a number; a fault is told at its place.
  [[nodiscard]] std::optional<Expression> read(const json::Value& value) const;

 private:
  std::vector<std::string> names_;
  std::vector<Expression::Parameter> parameters_;
  Problems& problems_;
};

// Nodes that the tracks name: made where names are free, else looked for.
void take_track_nodes(const json::Value& tracks, Building& building);

// Without tracks of its own, and where names are free, a clip shows the state.
[[nodiscard]] Clip clip_of(const Draft& draft, const FirstOrderPath& path, const Expressions& expressions,
                           Building& building);

}  // namespace tweenfall::document::systems
