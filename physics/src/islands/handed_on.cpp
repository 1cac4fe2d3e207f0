#include "islands/handed_on.h"

#include <algorithm>
#include <span>

namespace tweenfall::islands {

using contacts::ContactConstraint;
using contacts::PointConstraint;

namespace {

/// The point that presses hardest.
PointConstraint& hardest_of(ContactConstraint& contact) {
  const auto points = std::span(contact.points).first(static_cast<std::size_t>(contact.count));
  return *std::max_element(points.begin(), points.end(),
                           [](const auto& one, const auto& other) { return one.total_normal < other.total_normal; });
}

bool pushes(const ContactConstraint& contact) {
  const auto points = std::span(contact.points).first(static_cast<std::size_t>(contact.count));
  return std::any_of(points.begin(), points.end(), [](const auto& point) { return point.total_normal > 0; });
}

}  // namespace

void HandedOn::begin(std::size_t bodies) {
  knots_.assign(bodies, {});
  any_ = false;
}

void HandedOn::note(std::uint32_t body, const Vec3& change) {
  knots_[body].change += change;
  any_ = any_ || change != Vec3::Zero();
}

void HandedOn::join(const Link& link) {
  if (link.a >= knots_.size() || link.b >= knots_.size() || joined_.of(link.a) == joined_.of(link.b)) return;
  joined_.join(link.a, link.b);
  for (const std::uint32_t body : {link.a, link.b}) {
    ++knots_[body].links;
    knots_[body].which ^= static_cast<std::uint32_t>(tree_.size());
  }
  tree_.push_back(link);
}

/// A contact that pushes still does afterwards, and one that does not, does not: the next step asks for that.
void HandedOn::tell(const Link& link, const Vec3& on_b, double dt) {
  if (link.joint) {
    link.joint->joint->force += on_b / dt;
    return;
  }
  PointConstraint& point = hardest_of(*link.contact);
  const Vec3& normal = link.contact->manifold.normal;
  const double more = point.total_normal > 0 ? std::max(on_b.dot(normal), -0.5 * point.total_normal) : 0;
  point.total_normal += more;
  point.total_friction += on_b - more * normal;
}

void HandedOn::hand_on(const IslandContents& island, double dt,
                       const std::function<std::uint32_t(std::uint32_t)>& slot_of) {
  if (!any_) return;
  tree_.clear();
  joined_.reset(knots_.size());
  const auto join_by = [&](ContactConstraint* contact) {
    join({slot_of(contact->a), slot_of(contact->b), contact, nullptr});
  };
  for (ContactConstraint* contact : island.contacts)
    if (pushes(*contact)) join_by(contact);
  for (joints::JointLink* joint : island.joints)
    if (joint->a != joints::JointLink::world) join({slot_of(joint->a), slot_of(joint->b), nullptr, joint});
  for (ContactConstraint* contact : island.contacts)
    if (contact->count > 0 && !pushes(*contact)) join_by(contact);
  // From the ends of the tree inward: a body with one link left must get all of its change by that.
  for (std::uint32_t end = 0; end < knots_.size(); ++end)
    for (std::uint32_t body = end; knots_[body].links == 1;) {
      Knot& knot = knots_[body];
      const std::uint32_t place = knot.which;
      const Link& link = tree_[place];
      const bool is_b = link.b == body;
      tell(link, is_b ? knot.change : Vec3(-knot.change), dt);
      const std::uint32_t other = is_b ? link.a : link.b;
      knots_[other].change += knot.change;
      knots_[other].which ^= place;
      --knots_[other].links;
      knot.links = 0;
      if (other > end) break;
      body = other;
    }
}

}  // namespace tweenfall::islands
