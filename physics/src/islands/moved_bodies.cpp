#include "islands/moved_bodies.h"

#include <algorithm>
#include <span>

#include "joints/kinds/kinds.h"

namespace tweenfall::islands {

MovedBodies::MovedBodies(const IslandContents& island, const std::vector<state::Body>& bodies,
                         const std::vector<char>& moved) {
  const auto end = [&](std::uint32_t index, bool holds) {
    const state::Body& body = bodies[index];
    passive = passive && !body.conveys && !(body.immovable() && body.displaces());
    if (body.immovable())
      held = held || holds;
    else if (moved[index] != 0)
      all.push_back(index);
  };
  const auto ends = [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t index : {a, b}) {
      if (index == joints::JointLink::world)
        held = true;
      else
        end(index, true);
    }
  };
  for (const contacts::ContactConstraint* contact : island.contacts) {
    const std::span<const contacts::PointConstraint> points = contact->points;
    const bool pushed = std::ranges::any_of(points.first(static_cast<std::size_t>(contact->count)),
                                            [](const auto& point) { return point.total_normal > 0; });
    end(contact->a, pushed);
    end(contact->b, pushed);
  }
  for (const joints::JointLink* link : island.joints) {
    ends(link->a, link->b);
    const JointKind& kind = link->joint->settings.kind;
    if (std::holds_alternative<SpringJoint>(kind))
      sprung = true;
    else
      passive = passive && !joints::gives_energy(kind);
  }
  for (const step::SpringRow* spring : island.springs) {
    ends(spring->a, spring->b);
    sprung = true;
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

}  // namespace tweenfall::islands
