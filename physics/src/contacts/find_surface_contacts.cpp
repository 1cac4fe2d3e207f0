#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "collision/collide_pairs.h"
#include "collision/passage.h"
#include "collision/surfaces/first_meetings.h"
#include "collision/surfaces/touch.h"
#include "contacts/adopt.h"
#include "contacts/found_manifold.h"
#include "state/world_data.h"

namespace tweenfall {

namespace contacts {
namespace {

using collision::Passage;
using surfaces::Surface;

/// How far a body may move in a step and use its contacts with a surface again, in parts of what was near enough when
/// they were found. Anything farther away cannot touch then.
constexpr double calm = 0.25;

/// Contacts of one solid with one surface, as they are found.
class SurfaceContacts {
 public:
  static constexpr std::size_t most = 12;

  /// @param pair  bodies, and the part of the solid's body
  /// @param stand_b  where the second body was at the start of the step before
  SurfaceContacts(const PairInContact& pair, const Surface& surface, const Passage& way_surface, const Passage& way,
                  bool surface_is_a, const state::Stand& stand_b, double dt)
      : pair_(pair),
        surface_(surface),
        way_surface_(way_surface),
        way_(way),
        way_a_(surface_is_a ? way_surface : way),
        way_b_(surface_is_a ? way : way_surface),
        surface_is_a_(surface_is_a),
        stand_b_(stand_b),
        dt_(dt),
        near_(near_enough_of(way_surface, way)),
        swing_(way.swing +
               way_surface.spin * ((way.body->center - way_surface.body->center).norm() + way.body->radius())) {}

  /// Upper bound of how far a point of the solid moves relative to the surface in the step, m.
  [[nodiscard]] double way() const {
    const Vec3 velocity = way_.course.linear - way_surface_.course.linear;
    const Vec3 acceleration = way_.course.acceleration - way_surface_.course.acceleration;
    return (velocity.norm() + acceleration.norm() * dt_ + swing_) * dt_;
  }

  /// Uses all remembered contacts again, or none.
  bool take_up_all(const state::ContactMemories& memories, std::span<const std::uint32_t> places) {
    if (places.empty() || places.size() > most || way() > calm * near_) return false;
    count_ = 0;
    for (const std::uint32_t place : places) {
      ContactConstraint& constraint = add();
      if (!take_up(memories, memories[place], *way_a_.body, *way_b_.body, swing_, dt_, constraint)) {
        count_ = 0;
        return false;
      }
      constraint.kept = true;
      constraint.memory = place;
      std::tie(constraint.part_a, constraint.part_b) = memories.parts(memories[place]);
    }
    return true;
  }

  void find() {
    const double reach = near_ + (swing_ * dt_ > near_ ? swing_ * dt_ : 0);
    std::array<surfaces::KnownPlane, surfaces::Touch::most> known;
    std::size_t count = 0;
    const surfaces::Touch now = touched(way_surface_.placed, way_.placed, near_, reach);
    for (std::size_t i = 0; i < now.count; ++i) {
      known[count++] = {now.manifolds[i].normal, height_of(now.manifolds[i])};
      found(now.manifolds[i], way_surface_.placed, 0);
    }
    if (!(way() > 0)) return;
    const surfaces::FirstMeetings first =
        surfaces::first_meetings(surface_, way_surface_, way_, std::span(known).first(count), near_, dt_);
    for (std::size_t i = 0; i < first.count; ++i) {
      const double time = first.meetings[i].time;
      const shapes::Placed surface = placed(way_surface_, time);
      // Includes what a spin brings down in the rest of the step.
      const double rest = near_ + swing_ * (dt_ - time);
      const surfaces::Touch then = touched(surface, placed(way_, time), rest, rest);
      for (std::size_t k = 0; k < then.count; ++k) found(then.manifolds[k], surface, time);
    }
  }

  template <class Contact>
  [[nodiscard]] auto& number_of(Contact& contact) const {
    return surface_is_a_ ? contact.part_a : contact.part_b;
  }
  [[nodiscard]] std::uint32_t number_in(const state::ContactMemories& memories, std::uint32_t place) const {
    const auto [part_a, part_b] = memories.parts(memories[place]);
    return surface_is_a_ ? part_a : part_b;
  }

  /// Numbers the contacts: each takes the number, and the memory, of the remembered contact that was nearest to it
  /// on the solid; the others take the remaining numbers.
  void number(const state::ContactMemories& memories, std::span<const std::uint32_t> places) {
    std::array<bool, most> numbered{};
    std::array<bool, 2 * most> taken{};
    const std::size_t known = std::min(places.size(), taken.size());
    for (;;) {
      std::size_t best = most, from = 0;
      double least = 0.3 * way_.body->radius();
      for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = 0; k < known; ++k) {
          if (numbered[i] || taken[k]) continue;
          const double away = (place_of(contacts_[i]) - place_in(memories, places[k])).norm();
          if (!(away < least)) continue;
          least = away;
          best = i;
          from = k;
        }
      if (best == most) break;
      numbered[best] = taken[from] = true;
      contacts_[best].memory = places[from];
      number_of(contacts_[best]) = number_in(memories, places[from]);
    }
    std::uint32_t next = 0;
    const auto used = [&](std::uint32_t number) {
      for (std::size_t k = 0; k < known; ++k)
        if (number_in(memories, places[k]) == number) return true;
      return false;
    };
    for (std::size_t i = 0; i < count_; ++i) {
      if (numbered[i]) continue;
      while (used(next)) ++next;
      number_of(contacts_[i]) = next++;
    }
  }

  [[nodiscard]] std::span<ContactConstraint> contacts() { return std::span(contacts_).first(count_); }

 private:
  ContactConstraint& add() {
    ContactConstraint& constraint = contacts_[count_++];
    constraint = {};
    static_cast<PairInContact&>(constraint) = pair_;
    return constraint;
  }

  [[nodiscard]] static shapes::Placed placed(const Passage& way, double time) {
    return shapes::place(*way.course.shape, way.course.at(time).node(*way.body));
  }
  [[nodiscard]] surfaces::Touch touched(const shapes::Placed& surface, const shapes::Placed& solid, double margin,
                                        double reach) const {
    return surfaces::touch(surface_, way_.course.shape->solid, surfaces::seen_from(surface, solid), margin, reach);
  }
  [[nodiscard]] static double height_of(const Manifold& manifold) {
    const ContactPoint& point = manifold.points[0];
    // Of the surface itself, since the point is midway.
    return manifold.normal.dot(point.position) + 0.5 * point.penetration;
  }

  /// Adds a contact given in the surface's space, unless it is known already.
  void found(const Manifold& manifold, const shapes::Placed& at_surface, double time) {
    if (manifold.count == 0 || count_ == most || !manifold.normal.allFinite()) return;
    const double height = height_of(manifold);
    for (std::size_t i = 0; i < count_; ++i)
      if (normals_[i].dot(manifold.normal) > 1 - 1e-4 && std::abs(heights_[i] - height) <= near_) return;
    normals_[count_] = manifold.normal;
    heights_[count_] = height;
    ContactConstraint& constraint = add();
    constraint.manifold = collision::to_world(manifold, at_surface);
    if (!surface_is_a_) constraint.manifold.normal = -constraint.manifold.normal;
    constraint.impact_time = time;
    adopt(constraint, way_a_, way_a_.course.at(time), way_b_, way_b_.course.at(time));
  }

  /// The middle of the points, from the solid's center of mass.
  [[nodiscard]] Vec3 place_of(const ContactConstraint& contact) const {
    Vec3 sum(0, 0, 0);
    for (int i = 0; i < contact.count; ++i) {
      const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
      sum += surface_is_a_ ? point.start_arm_b : point.start_arm_a;
    }
    return sum / contact.count;
  }
  [[nodiscard]] Vec3 place_in(const state::ContactMemories& memories, std::uint32_t place) const {
    const state::ContactMemory& memory = memories[place];
    const std::array<Vec3, 4> arms = arms_of(memories, memory, stand_b_);
    Vec3 sum(0, 0, 0);
    for (std::size_t i = 0; i < memory.count; ++i) sum += arms[i];
    sum /= memory.count;
    if (surface_is_a_) return sum;
    // About where both were in the step before.
    return sum + (way_b_.body->center - way_a_.body->center) - (way_b_.course.linear - way_a_.course.linear) * dt_;
  }

  const PairInContact& pair_;
  const Surface& surface_;
  const Passage& way_surface_;
  const Passage& way_;
  const Passage& way_a_;
  const Passage& way_b_;
  bool surface_is_a_;
  const state::Stand& stand_b_;
  double dt_, near_, swing_;
  std::array<ContactConstraint, most> contacts_;
  std::array<Vec3, most> normals_;
  std::array<double, most> heights_;
  std::size_t count_ = 0;
};

}  // namespace
}  // namespace contacts

void World::Implementation::find_contacts_with_surface(const contacts::PairInContact& pair,
                                                       contacts::PairMemories known, double dt,
                                                       contacts::FoundPart& part) const {
  const bool surface_is_a = surfaces::surface_of(bodies[pair.a].shape().solid) != nullptr;
  const collision::Passage& way_surface = passages[surface_is_a ? pair.a : pair.b];
  const collision::Passage& whole = passages[surface_is_a ? pair.b : pair.a];
  const surfaces::Surface& surface = *surfaces::surface_of(way_surface.body->shape().solid);
  const std::span<const std::uint32_t> all = memories.sorted().subspan(known.first, known.count);
  const std::size_t before = part.contacts.size();
  const state::Stand stand_b = all.empty() ? state::Stand{} : stands[pair.b];
  const auto find = [&](const collision::Passage& way, std::uint32_t number) {
    std::array<std::uint32_t, 2 * contacts::SurfaceContacts::most> its;
    std::size_t count = 0;
    for (const std::uint32_t place : all)
      if (const auto [part_a, part_b] = memories.parts(memories[place]);
          (surface_is_a ? part_b : part_a) == number && count < its.size())
        its[count++] = place;
    const std::span<const std::uint32_t> known_places = std::span(its).first(count);
    contacts::PairInContact its_pair = pair;
    (surface_is_a ? its_pair.part_b : its_pair.part_a) = number;
    contacts::SurfaceContacts its_contacts(its_pair, surface, way_surface, way, surface_is_a, stand_b, dt);
    if (!its_contacts.take_up_all(memories, known_places)) {
      its_contacts.find();
      its_contacts.number(memories, known_places);
    }
    for (contacts::ContactConstraint& contact : its_contacts.contacts()) {
      finish_contact(contact, contact.memory != state::ContactMemories::nowhere ? &memories[contact.memory] : nullptr,
                     dt);
      part.contacts.add() = contact;
    }
  };
  if (const auto* compound = std::get_if<Compound>(&whole.body->shape().solid)) {
    for (std::uint32_t i = 0; i < compound->parts().size(); ++i)
      find(collision::passage_of_part(whole, compound->parts()[i]), i);
  } else {
    find(whole, 0);
  }
  const auto in_order = [](const contacts::ContactConstraint& a, const contacts::ContactConstraint& b) {
    return std::tie(a.part_a, a.part_b) < std::tie(b.part_a, b.part_b);
  };
  const std::span<contacts::ContactConstraint> its_own = part.contacts.all().subspan(before);
  std::sort(its_own.begin(), its_own.end(), in_order);
}

}  // namespace tweenfall
