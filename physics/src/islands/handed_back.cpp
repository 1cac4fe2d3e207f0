#include "islands/handed_back.h"

#include <algorithm>

namespace tweenfall::islands {

using contacts::ContactConstraint;
using contacts::PointConstraint;

HandedBack::HandedBack(const IslandContents& island, const std::vector<state::Body>& bodies)
    : places_(bodies.size(), nowhere) {
  std::vector<ContactConstraint*> pressing;
  pressing.reserve(island.contacts.size());
  for (ContactConstraint* contact : island.contacts) {
    const auto points = std::span(contact->points).first(static_cast<std::size_t>(contact->count));
    if (std::any_of(points.begin(), points.end(), [](const PointConstraint& point) { return point.total_normal > 0; }))
      pressing.push_back(contact);
  }
  // Round by round, those that lie one contact farther from what does not move.
  for (bool more = true; more;) {
    const std::size_t before = borne_.size();
    for (ContactConstraint* contact : pressing)
      for (const auto& [body, bearer] : {std::pair(contact->a, contact->b), std::pair(contact->b, contact->a)}) {
        if (bodies[body].immovable() || places_[body] != nowhere) continue;
        if (!bodies[bearer].immovable() && !(places_[bearer] < before)) continue;
        places_[body] = borne_.size();
        borne_.push_back({body, contact, places_[bearer]});
      }
    more = borne_.size() > before;
  }
}

void HandedBack::note(std::uint32_t body, const Vec3& change) {
  if (places_[body] != nowhere) borne_[places_[body]].change += change;
}

void HandedBack::hand_back() {
  for (std::size_t i = borne_.size(); i-- > 0;) {
    Borne& body = borne_[i];
    if (body.change == Vec3::Zero()) continue;
    Vec3& impulse = body.contact->points[0].total_friction;
    if (body.contact->b == body.body)
      impulse += body.change;
    else
      impulse -= body.change;
    if (body.bearer != nowhere) borne_[body.bearer].change += body.change;
    body.change = Vec3::Zero();
  }
}

}  // namespace tweenfall::islands
