#include "limbs/place.h"

#include <tweenfall/curves/number_text.h>

#include "chains/problems.h"

namespace tweenfall::graphs {

Sample<Vec3> BoundPlace::sample(const Log& log, const Moment& moment, const Hierarchy& nodes,
                                std::span<const Motion> pose) const noexcept {
  Sample<Vec3> place;
  for (int i = 0; i < 3; ++i) {
    const Sample<double> number = at_[static_cast<std::size_t>(i)].sample(log, moment.time, moment.side);
    place.value[i] = number.value;
    place.rate[i] = number.rate;
    place.acceleration[i] = 0;
  }
  if (node_ == no_node) return place;
  const WorldMotion world = world_of(node_, nodes, pose);
  return {world.point(place.value), world.point_velocity(place.value) + world.linear * place.rate, Vec3(0, 0, 0)};
}

std::optional<BoundPlace> bound_place(const GraphPlace& described, const Place& place, std::size_t carried,
                                      Binder& binder) {
  std::size_t node = no_node;
  if (!described.node.empty()) {
    node = binder.node(described.node, place);
    if (node == no_node) return std::nullopt;
    if (carried != no_node && (node == carried || chains::is_below(binder.nodes(), node, carried))) {
      binder.fault(place, "\"" + described.node + "\" is carried by the joints that turn toward it");
      return std::nullopt;
    }
  }
  return BoundPlace(node, {binder.number(described.at[0], place), binder.number(described.at[1], place),
                           binder.number(described.at[2], place)});
}

Number bound_share(const GraphNumber& weight, const Place& place, Binder& binder) {
  Number bound = binder.number(weight, place);
  const std::optional<double> said = bound.constant();
  if (said && !(*said >= 0 && *said <= 1)) binder.fault(place, "a weight is 0 to 1; it is " + brief_text(*said));
  return bound;
}

}  // namespace tweenfall::graphs
