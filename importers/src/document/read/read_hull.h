#pragma once

#include <tweenfall/physics/shape.h>

#include "document/report/problems.h"

#include <optional>

namespace tweenfall::document {

// The convex hull that a shape's "hull", "lathe" or "sweep" means; points that have none are a problem.
[[nodiscard]] std::optional<Hull> read_hull(const JsonValue& shape, Problems& problems);

}  // namespace tweenfall::document
