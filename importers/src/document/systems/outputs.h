#pragma once

// Makes the tracks of a clip from the path of a system.

#include <tweenfall/physics/expression_system.h>

#include "document/content.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tweenfall::document::systems {

// A system being read, with the values that are read when its state is known.
struct Draft {
  ExpressionSystem system;
  json::Value state{}, rates{}, parameters{}, energy{}, starts{}, portrait{}, tracks{};
};

// Expressions of t and a state.
class Expressions {
 public:
  // Invalid parameters are reported.
  Expressions(std::span<const std::string> variables, const json::Value& parameters, Problems& problems);
  // The expression of a text or a number; a fault is reported at its place.
  [[nodiscard]] std::optional<Expression> read(const json::Value& value) const;

 private:
  std::vector<std::string> names_;
  std::vector<Expression::Parameter> parameters_;
  Problems& problems_;
};

// The nodes that the tracks name: made if names are free, else looked up.
void take_track_nodes(const json::Value& tracks, Building& building);

// Without tracks of its own, and if names are free, the clip shows the state.
[[nodiscard]] Clip clip_of(const Draft& draft, const FirstOrderPath& path, const Expressions& expressions,
                           Building& building);

}  // namespace tweenfall::document::systems
