#pragma once

/// Tracks of one number: "ball.position.y", "hinge.rotation.z", "lamp.color.a", "box.scale.x".
///
/// They may be used together or alone; numbers without a track keep the value below: for a position, a scale or a color
/// the other numbers, for a rotation the other angles of the node's own (so that one angle of a node that nothing else
/// turns is a turn about that axis). No number is driven twice.
///
/// Angles are in radians, for turns about x, y and z in the track's `order`; colors are linear.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tweenfall {

struct Component {
  Property property = Property::user;  ///< position, rotation, scale or color
  int index = 0;                       ///< 0 to 2 for x, y, z; 0 to 3 for r, g, b, a

  bool operator==(const Component&) const = default;
};

/// The meaning of a track's property such as "position.y"; empty where it is not one of our components.
[[nodiscard]] std::optional<Component> component_named(std::string_view word) noexcept;

/// The position of the dot after the node in a track's name, "node.property" or "node.property.component"; npos: none.
[[nodiscard]] std::size_t property_dot(std::string_view track_name) noexcept;

/// Whether an order has one turn about each axis, so that each angle belongs to one axis.
[[nodiscard]] bool is_of_three_axes(const EulerOrder& order) noexcept;

/// Two tracks of one clip that conflict: they drive the same number, or they are angles of one node in different
/// orders.
struct Rivals {
  std::size_t first = 0, second = 0;  ///< indices of the tracks, first < second
  std::string problem;                ///< naming both, to follow "the tracks"
};
[[nodiscard]] std::vector<Rivals> rivals(std::span<const Track> tracks);

/// The rotation made by angles.
/// @param angles  by axis, tracks of "rotation.x", "rotation.y" and "rotation.z" with one order; null for angles that
/// stay as in `rest`. At least one is not null.
[[nodiscard]] Curve<Quat> turned_by(const std::array<const Track*, 3>& angles, const Quat& rest);

/// The clip with each node's component tracks merged into tracks of whole properties; missing numbers are the node's.
/// @param node_named  the node of that name; null where there is none: its tracks stay as they are
[[nodiscard]] Clip with_whole_tracks(const Clip& clip, const std::function<const Node*(std::string_view)>& node_named);

}  // namespace tweenfall
