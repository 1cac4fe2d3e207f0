#include "contacts/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "collision/convex/distance.h"
#include "collision/surfaces/convex_piece.h"
#include "contacts/adopt.h"

namespace tweenfall::contacts {
namespace {

/// How far from a contact its part is looked at, and within what parts lie flush, in parts of what is near enough.
constexpr double looked_around = 1, flush = 5e-3;
/// Sine of the angle by which a contact may lean from the edge that it is at.
constexpr double askew = 0.02;
/// How far over what it lies on a body passes edges, in parts of what is near enough: farther than what counts as met.
constexpr double clear = 0.1;
/// How far a body is taken to go over a seam, in parts of its radius.
constexpr double well_over = 0.25;
/// Cosine of the angle within which normals are one.
constexpr double one_normal = 1 - 1e-12;

/// Contacts of one compound's parts.
class Seams {
 public:
  /// @param contacts  with one part of the other body
  Seams(const collision::Passage& way, const collision::Passage& other, bool is_a, std::span<const Shape> parts)
      : way_(way), other_(other), is_a_(is_a), parts_(parts), near_(near_enough_of(way, other)) {}

  /// Of contacts with one part of the other body, marks those to drop.
  void mark(std::span<const ContactConstraint* const> contacts, std::vector<bool>& dropped) {
    contacts_ = contacts;
    see_all();
    std::vector<std::size_t> order(contacts.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto anyone = [](std::size_t) { return true; };
    std::vector<double> overhangs(contacts.size());
    for (std::size_t i = 0; i < order.size(); ++i) overhangs[i] = overhang(i, anyone);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return overhangs[a] < overhangs[b]; });
    std::vector<bool> before(contacts.size());
    for (const std::size_t i : order) {
      // Of two that cover each other, the one that leans less into the other stays.
      dropped[i] = overhangs[i] > 0 && overhang(i, [&](std::size_t other) { return before[other]; }) > 0;
      before[i] = true;
    }
  }

 private:
  /// A contact in the compound's own space, when its bodies meet.
  struct Seen {
    const Shape* part;
    Vec3 normal;  ///< out of the part
    std::array<Vec3, 4> points;
  };

  void see_all() {
    seen_.clear();
    for (const ContactConstraint* contact : contacts_) {
      const Pose node =
          contact->impact_time == 0 ? way_.body->motion.pose : way_.course.at(contact->impact_time).node(*way_.body);
      const Quat into = node.rotation.conjugate();
      const Vec3 out = out_of(*contact);
      Seen one{&parts_[is_a_ ? contact->part_a : contact->part_b], into * out, {}};
      for (std::size_t i = 0; i < static_cast<std::size_t>(contact->count); ++i) {
        const ContactPoint& point = contact->manifold.points[i];
        one.points[i] = into * (point.position + 0.5 * point.penetration * out - node.position);
      }
      seen_.push_back(one);
    }
  }
  [[nodiscard]] Vec3 out_of(const ContactConstraint& contact) const {
    return is_a_ ? contact.manifold.normal : Vec3(-contact.manifold.normal);
  }

  /// How steeply others rise over a contact where they cover all of it; 0 where something of it is bare.
  template <class Counts>
  [[nodiscard]] double overhang(std::size_t index, const Counts& counts) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(contacts_[index]->count); ++i) {
      double most = 0;
      for (std::size_t other = 0; other < seen_.size(); ++other)
        if (seen_[other].part != seen_[index].part && counts(other))
          most = std::max(most, rise_over(index, seen_[index].points[i], other));
      least = std::min(least, most);
      if (least == 0) break;
    }
    return least;
  }

  /// The slope at which another contact's part rises from a point that it covers; 0 if it does not.
  [[nodiscard]] double rise_over(std::size_t index, const Vec3& point, std::size_t other) const {
    const Vec3& normal = seen_[index].normal;
    convex::Core core = core_around(*seen_[other].part, point);
    const Vec3 highest = core.support(normal);
    const double rise = normal.dot(highest) + core.radius, away = highest.norm() + core.radius;
    if (!(rise > 2 * flush * near_ + 1e-6 * away) || !holds(*seen_[other].part, point, flush * near_)) return 0;
    // What has sunk into the neighbor, or falls until it meets, is seen as it would lie on it.
    const Vec3 lifted = point + sunk(other, contacts_[index]->impact_time) * seen_[other].normal;
    if (bare_around(index, point, seen_[other].normal) || bare_around(index, lifted, seen_[other].normal)) return 0;
    return rise / away;
  }

  /// How deep the other body would be in the part of a contact at some time of the step, m.
  [[nodiscard]] double sunk(std::size_t index, double time) const {
    const ContactConstraint& contact = *contacts_[index];
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i)
      gap = std::min(gap, contact.points[i].start_gap);
    const Vec3 moved =
        (other_.course.at(time).center - other_.body->center) - (way_.course.at(time).center - way_.body->center);
    return std::max(0.0, -(gap + out_of(contact).dot(moved)));
  }

  /// Whether the surface of a contact's part goes on around a point, and no other part covers it there.
  [[nodiscard]] bool bare_around(std::size_t index, const Vec3& point, const Vec3& up) const {
    const Vec3& normal = seen_[index].normal;
    Vec3 along = up - normal.dot(up) * normal;
    if (!(along.norm() > 1e-3)) along = normal.unitOrthogonal();
    along.normalize();
    const Vec3 across = normal.cross(along);
    const double radius = looked_around * near_;
    const convex::Core core = core_around(*seen_[index].part, point);
    const double round = std::max(core.radius, core.half.x());
    const Shape& part = *seen_[index].part;
    // A curved surface falls away from its plane.
    const double within = 0.1 * flush * near_ + (is_flat(core) ? 0 : radius * radius / std::max(round, radius));
    // Along the rim of a square, whose middle is the point.
    for (int i = -2; i <= 2; ++i)
      for (int k = -2; k <= 2; ++k) {
        if (std::max(std::abs(i), std::abs(k)) < 2) continue;
        const Vec3 place = point + 0.5 * radius * (i * along + k * across);
        if (!holds(part, place, within) || holds(part, place + 4 * within * normal, within)) continue;
        if (std::none_of(seen_.begin(), seen_.end(), [&](const Seen& other) {
              return other.part != &part && holds(*other.part, place, flush * near_ + askew * radius);
            }))
          return true;
      }
    return false;
  }

  [[nodiscard]] static bool is_flat(const convex::Core& core) {
    return core.kind == convex::Core::Kind::box || core.kind == convex::Core::Kind::hull;
  }
  /// A part as seen from a point, so that nothing is lost far from the compound's origin.
  [[nodiscard]] static convex::Core core_around(const Shape& part, const Vec3& point) {
    shapes::Placed at = shapes::place(part, Pose{});
    at.center -= point;
    return *surfaces::convex_piece(part.solid, at);
  }
  [[nodiscard]] static bool holds(const Shape& part, const Vec3& point, double within) {
    convex::Core core = core_around(part, point);
    convex::Core dot = convex::core_of(Sphere{0}, {Vec3::Zero(), Mat3::Identity()});
    return convex::nearness_of(core, dot, std::numeric_limits<double>::infinity()).distance - core.radius <= within;
  }

  const collision::Passage& way_;
  const collision::Passage& other_;
  bool is_a_;
  std::span<const Shape> parts_;
  double near_;
  std::span<const ContactConstraint* const> contacts_;
  std::vector<Seen> seen_;
};

std::span<const Shape> compound_parts(const collision::Passage& way) {
  const auto* compound = std::get_if<Compound>(&way.body->shape().solid);
  return compound ? compound->parts() : std::span<const Shape>();
}

/// Marks contacts of the parts of one of the two bodies.
void mark_seams(std::span<const ContactConstraint> contacts, const collision::Passage& way,
                const collision::Passage& other, bool is_a, double until, std::vector<bool>& dropped) {
  const std::span<const Shape> parts = compound_parts(way);
  if (parts.size() < 2) return;
  Seams seams(way, other, is_a, parts);
  const auto touched_part = [&](std::size_t i) { return is_a ? contacts[i].part_b : contacts[i].part_a; };
  std::vector<bool> done(contacts.size());
  for (std::size_t first = 0; first < contacts.size(); ++first) {
    std::vector<std::size_t> those;
    for (std::size_t i = first; i < contacts.size(); ++i)
      if (!done[i] && contacts[i].impact_time <= until && touched_part(i) == touched_part(first)) those.push_back(i);
    if (done[first] || those.size() < 2) continue;
    std::vector<const ContactConstraint*> with_part;
    for (const std::size_t i : those) {
      done[i] = true;
      with_part.push_back(&contacts[i]);
    }
    std::vector<bool> its(those.size());
    seams.mark(with_part, its);
    for (std::size_t i = 0; i < those.size(); ++i)
      if (its[i]) dropped[those[i]] = true;
  }
}

/// Where all face one way, none is at a seam.
bool face_alike(std::span<const ContactConstraint> contacts) {
  const Vec3& normal = contacts[0].manifold.normal;
  return std::all_of(contacts.begin(), contacts.end(), [&](const ContactConstraint& contact) {
    return contact.manifold.normal.dot(normal) >= one_normal;
  });
}

bool is_later(const ContactConstraint& contact) {
  return contact.impact_time > 0;
}

/// Drops some of the contacts from a place on.
template <class Drops>
void drop_those(FoundContacts& found, std::size_t first, const Drops& drops) {
  const std::span<ContactConstraint> contacts = found.all().subspan(first);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (drops(i)) continue;
    if (kept != i) contacts[kept] = contacts[i];
    ++kept;
  }
  for (std::size_t i = kept; i < contacts.size(); ++i) found.drop_last();
}

}  // namespace

bool LyingBody::matters(std::span<const ContactConstraint> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), is_later) &&
         !std::all_of(contacts.begin(), contacts.end(), is_later);
}

LyingBody::LyingBody(std::span<const ContactConstraint> contacts, const collision::Passage& way_a,
                     const collision::Passage& way_b)
    : way_a_(way_a), way_b_(way_b) {
  // Of two that move by themselves, the second.
  const bool first_moves = way_b.body->immovable();
  collision::Passage& way = first_moves ? way_a_ : way_b_;
  const collision::Passage& ground = first_moves ? way_b_ : way_a_;
  body_ = *way.body;
  way.body = way.course.body = &body_;
  Vec3 shift(0, 0, 0);
  for (const ContactConstraint& contact : contacts) {
    if (is_later(contact)) continue;
    const Vec3 out = first_moves ? Vec3(-contact.manifold.normal) : contact.manifold.normal;
    way.course.linear += std::max(0.0, out.dot(ground.course.linear - way.course.linear)) * out;
    way.course.acceleration += std::max(0.0, out.dot(ground.course.acceleration - way.course.acceleration)) * out;
    double depth = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i)
      depth = std::max(depth, -contact.points[i].start_gap);
    shift += std::max(0.0, depth + clear * near_enough_of(way_a, way_b) - out.dot(shift)) * out;
  }
  body_.center += shift;
  body_.motion.pose.position += shift;
  way.placed.center += shift;
}

std::vector<ContactHead> drop_contacts_of_seams(FoundContacts& found, std::size_t first,
                                                const collision::Passage& way_a, const collision::Passage& way_b,
                                                double until) {
  std::vector<ContactHead> all_dropped;
  for (const bool of_a : {true, false}) {
    const std::span<ContactConstraint> contacts = found.all().subspan(first);
    if (contacts.size() < 2 || face_alike(contacts)) break;
    std::vector<bool> dropped(contacts.size());
    mark_seams(contacts, of_a ? way_a : way_b, of_a ? way_b : way_a, of_a, until, dropped);
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (dropped[i]) all_dropped.push_back(contacts[i]);
    drop_those(found, first, [&](std::size_t i) { return dropped[i]; });
  }
  return all_dropped;
}

void find_behind_seam(ContactConstraint& contact, const collision::Passage& way_a, const collision::Passage& way_b,
                      double from, double dt) {
  const double speed = (way_a.course.linear - way_b.course.linear).norm();
  const double way = well_over * std::min(way_a.radius, way_b.radius);
  const double time = speed * (dt - from) > way ? from + way / speed : dt;
  const collision::Prediction at_a = way_a.course.at(time), at_b = way_b.course.at(time);
  contact.impact_time = time;
  contact.manifold = collide(*way_a.course.shape, at_a.node(*way_a.body), *way_b.course.shape, at_b.node(*way_b.body),
                             near_enough_of(way_a, way_b));
  adopt(contact, way_a, at_a, way_b, at_b);
  if (!contact.manifold.normal.allFinite()) contact.count = 0;
}

bool in_known_plane(const ContactConstraint& later, std::span<const ContactConstraint> contacts,
                    const collision::Passage& ground, bool is_a, double near) {
  const auto height = [&](const ContactConstraint& contact) {
    const ContactPoint& point = contact.manifold.points[0];
    const Vec3 moved = ground.course.at(contact.impact_time).center - ground.body->center;
    return later.manifold.normal.dot(point.position - moved) + (is_a ? 0.5 : -0.5) * point.penetration;
  };
  return std::any_of(contacts.begin(), contacts.end(), [&](const ContactConstraint& known) {
    return !is_later(known) && known.count > 0 && known.manifold.normal.dot(later.manifold.normal) > 1 - 1e-4 &&
           std::abs(height(known) - height(later)) <= near;
  });
}

void drop_empty(FoundContacts& found, std::size_t first) {
  const std::span<ContactConstraint> contacts = found.all().subspan(first);
  drop_those(found, first, [&](std::size_t i) { return contacts[i].count == 0; });
}

}  // namespace tweenfall::contacts
