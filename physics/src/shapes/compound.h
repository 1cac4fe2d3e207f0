#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// A shape placed relative to another shape's solid, expressed relative to that one's node.
[[nodiscard]] Shape on_node(const Shape& part, const Pose& offset) noexcept;

/// A compound with its offset moved into its parts; other shapes as they are.
[[nodiscard]] Shape without_offset(const Shape& shape);

[[nodiscard]] double volume_of(const Compound& compound) noexcept;  ///< m^3, the sum over the parts
/// For parts of equal density, by the parallel-axis theorem; in the compound's own space.
[[nodiscard]] MassProperties mass_of(const Compound& compound, double mass);
[[nodiscard]] Bounds bounds_of(const Compound& compound, const Shape& shape, const Pose& node) noexcept;

}  // namespace tweenfall::shapes
