#pragma once

// The figures in a side view of a recording: a few points each, placed in the picture for every frame.

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::figures {

/// From the world to the picture.
/// Where a picture is seen from.
enum class Facing {
  front,  ///< +z: x runs to the right, y upward
  side,   ///< -x: z runs to the right, y upward
  above,  ///< +y: x runs to the right, z downward
};

/// As seen from there, in meters, downward.
[[nodiscard]] Vec2 flattened(const Vec3& point, Facing facing);

struct SideView {
  Facing facing = Facing::front;
  double scale = 1;              ///< px/m
  double left = 0, top = 0;      ///< px
  double low = 0, high = 0;      ///< world coordinates at the picture's left edge and at its upper edge, m
  double width = 0, height = 0;  ///< px

  [[nodiscard]] Vec2 place(const Vec3& point) const {
    const Vec2 flat = flattened(point, facing);
    return {left + (flat.x() - low) * scale, top + (high + flat.y()) * scale};
  }
};

inline constexpr std::size_t hull_outline = 24;

struct Figure {
  enum class Kind {
    ball,   ///< points: center, and one on its surface that shows how it turns; radius
    stick,  ///< points: two; drawn as thick as 2 radius with round ends
    box,    ///< points: eight corners
    bones,  ///< points: pairs, a line each
    lines,  ///< points: several lists, each joined to a line
    hull,   ///< points: center of mass, `hull_outline` around the outline, then pairs, a line each
  };
  Kind kind = Kind::box;
  std::size_t node = no_node;  ///< the node whose owner colors it
  double radius = 0;           ///< px
  std::size_t vertices = 0;    ///< of a hull, before its outline is taken
  bool fixed = false;
  std::string name = {};                  ///< of things that are not nodes, else empty
  std::optional<Color> color = {};        ///< its own
  std::vector<std::size_t> starts{};      ///< of lines: the first point of each
  std::vector<std::vector<Vec2>> points;  ///< [frame][point], px
};

struct SideScene {
  SideView view;
  std::vector<Figure> figures;
};

/// Soft bodies, wheels, bodies that are not planes, meshes without skin as their boxes, and one stick figure for each
/// skin and for each tree of other nodes without bodies and meshes; in a view that contains all of them at all times,
/// at most `width` by `height` px with the upper left corner at (left, top). It is seen from +z, or
/// from -x or above where what moves is a line from there. Things that fly off disproportionately far
/// are ignored.
[[nodiscard]] SideScene side_scene(const Recording& recording, const StageDescription& stage, double left, double top,
                                   double width, double height);

/// The description of each recorded node, null for one that the stage does not have.
[[nodiscard]] std::vector<const NodeDescription*> descriptions(const Recording& recording,
                                                               const StageDescription& stage);

}  // namespace tweenfall::figures
