#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// A shape whose place is told relative to another one's solid, relative to that one's node.
[[nodiscard]] Shape on_node(const Shape& part, const Pose& offset) noexcept;

/// A compound whose parts stand where its offset puts them, so that it needs none; other shapes as they are.
[[nodiscard]] Shape without_offset(const Shape& shape);

[[nodiscard]] double volume_of(const Compound& compound) noexcept;  ///< m^3, of the parts in all
/// Of parts of one density, by the parallel-axis theorem; in the compound's own space.
[[nodiscard]] MassProperties mass_of(const Compound& compound, double mass);
[[nodiscard]] Bounds bounds_of(const Compound& compound, const Shape& shape, const Pose& node) noexcept;

}  // namespace tweenfall::shapes
