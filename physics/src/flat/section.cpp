#include "flat/section.h"

#include <limits>

#include "flat/sections.h"
#include "planar/contacts/manifold.h"

namespace tweenfall::flat {

Section::Section(const Shape& shape, WorldPlane plane)
    : axes_(Axes::of(plane)), plates_(planar::inner::plates_of(section_of(shape, axes_), Vec2(0, 0))) {}

Manifold Section::touch(const Pose& node, const Vec3& ball, double radius, double reach) const {
  using planar::inner::Turn;
  planar::inner::Plate disc;
  disc.corners.push_back({Vec2(0, 0), Vec2(0, 0)});
  disc.skin = disc.reach = disc.size = disc.least = radius;
  const Vec2 center = axes_.flat(node.position), middle = axes_.flat(ball);
  const Turn turn = Turn::of(axes_.angle(node.rotation));
  Manifold manifold;
  double least = std::numeric_limits<double>::infinity();
  for (const planar::inner::Plate& plate : plates_) {
    const planar::inner::Found found =
        planar::inner::find_manifold({&plate, center, turn}, {&disc, middle, Turn{}}, reach);
    if (found.count == 0 || !(found.points[0].gap < least)) continue;
    const planar::inner::FoundPoint& point = found.points[0];
    least = point.gap;
    const Vec2 on_ball = middle + point.core_b - radius * found.normal;
    manifold.normal = axes_.space(found.normal);
    manifold.count = 1;
    manifold.points[0] = {axes_.space(Vec2(on_ball - 0.5 * point.gap * found.normal)), -point.gap, point.feature};
  }
  return manifold;
}

}  // namespace tweenfall::flat
