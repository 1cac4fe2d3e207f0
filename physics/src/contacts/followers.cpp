#include "contacts/followers.h"

#include <algorithm>

#include "collision/collide_pairs.h"
#include "contacts/adopt.h"
#include "contacts/meeting.h"
#include "state/world_data.h"

/// Bodies that fly one behind the other do not meet on their present paths. But if the first is stopped, the next runs
/// into it within the same step: without a contact it would be far inside at the end of the step.

namespace tweenfall {

namespace contacts {

namespace {

/// A blow is passed on through at most this many bodies: it gets no farther in a step.
constexpr int most_rounds = 8;

/// Number of contacts that are worth a task of their own.
constexpr std::size_t links_worth_a_part = 128;

/// A blow that displaces a body in a step by less than this part of what is near enough for it is none.
constexpr double hardly_moved = 0.25;

/// A blow that displaces a body in a step by more than this part of its radius may send it where it had no pairs; so
/// may one that displaces it by more than what is near enough, and this many times as far as it was going: by its own
/// speed it was to follow nothing that far away.
constexpr double far_off = 0.25, much_faster = 4;

/// Two bodies may approach faster than blows along their normals tell, by this part of what these change: friction and
/// turning bring it about.
constexpr double astray = 0.25;

/// Which bodies the blows of a step reach, when, and how hard at most.
class Blows {
 public:
  Blows(std::vector<Struck>& struck, const std::vector<collision::Passage>& passages, double dt)
      : struck_(struck), passages_(passages), dt_(dt) {
    struck_.assign(passages.size(), {dt});
  }
  /// Whether anything was struck since the last call.
  [[nodiscard]] bool spread() { return std::exchange(spread_, false); }

  /// Ignores what is hardly more than was known, so that this soon ends: for each body by itself, since what
  /// happens to others elsewhere must not affect it.
  void strike(std::uint32_t body, double time, const Vec3& change) {
    Struck& struck = struck_[body];
    const double size = change.norm();
    if (!(size * (dt_ - time) > hardly_moved * near_enough_of(passages_[body]))) return;
    if (!(time < struck.time - 0.01 * dt_ || size > 0.05 * struck.most)) return;
    struck.time = std::min(struck.time, time);
    struck.change += change;
    struck.most = struck.change.norm();
    struck.when = now_;
    spread_ = true;
    if (is_hard(struck, passages_[body]) && (hard_.empty() || hard_.back() != body)) hard_.push_back(body);
  }
  /// Bodies that were struck hard since the last call.
  [[nodiscard]] std::vector<std::uint32_t> struck_hard() { return std::exchange(hard_, {}); }
  /// Whether a blow reaches one of the two.
  [[nodiscard]] bool reach(const Link& link) const { return struck_[link.a].time < dt_ || struck_[link.b].time < dt_; }
  /// Whether a blow can bring two together that are at least `gap` apart.
  [[nodiscard]] bool may_bring(const Link& link, double closing) const {
    const Struck &a = struck_[link.a], &b = struck_[link.b];
    return surely * link.gap < (closing + (1 + astray) * (a.most + b.most)) * (dt_ - std::min(a.time, b.time));
  }
  /// Passes a blow on through a pair. @return how far the two may approach in the rest of the step, m; 0
  /// if they do not meet
  double hand_on(const Link& link) {
    const Struck &a = struck_[link.a], &b = struck_[link.b];
    const double begin = std::min(a.time, b.time), closing = link.closing + link.normal.dot(a.change - b.change);
    const double most = closing + astray * (a.most + b.most);
    if (!(begin < dt_ && link.gap < most * (dt_ - begin))) return 0;
    if (closing > 0) {
      const double met = begin + std::max(0.0, link.gap) / std::max(closing, most);
      const Vec3 exchanged = closing / (link.inverse_mass_a + link.inverse_mass_b) * link.normal;
      if (link.inverse_mass_a > 0) strike(link.a, met, -link.inverse_mass_a * exchanged);
      if (link.inverse_mass_b > 0) strike(link.b, met, link.inverse_mass_b * exchanged);
    }
    return most * (dt_ - begin);
  }

  /// The same for one of many links that are visited in their order, round by round. A link neither of whose ends was
  /// struck since the last visit has already passed on what it could.
  void hand_on_again(const Link& link, int round, std::size_t number) {
    const std::uint64_t last = now_of(round, number);
    now_ = now_of(round + 1, number);
    if (struck_[link.a].when >= last || struck_[link.b].when >= last) hand_on(link);
  }

 private:
  [[nodiscard]] bool is_hard(const Struck& struck, const collision::Passage& passage) const {
    const double way = struck.most * (dt_ - struck.time), own = much_faster * dt_;
    return way > far_off * passage.radius ||
           (way > near_enough_of(passage) && way * way > own * own * passage.course.linear.squaredNorm());
  }
  /// Nothing comes before the first round.
  static std::uint64_t now_of(int round, std::size_t number) {
    return round == 0 ? 0 : (static_cast<std::uint64_t>(round) << 32) + number;
  }

  std::vector<Struck>& struck_;
  const std::vector<collision::Passage>& passages_;
  double dt_;
  std::uint64_t now_ = 1;  ///< rises from link to link
  bool spread_ = false;
  std::vector<std::uint32_t> hard_;
};

}  // namespace

void note_blow(const ContactConstraint& contact, const collision::Passage& a, const collision::Passage& b, double dt,
               std::vector<Blow>& blows) {
  const Vec3& normal = contact.manifold.normal;
  const double along_a = normal.dot(a.course.acceleration), along_b = normal.dot(b.course.acceleration);
  const double tremble = 2 * std::max(std::abs(along_a), std::abs(along_b)) * dt;
  Blow blow{contact.a, contact.b, dt};
  double change = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    const PointConstraint& point = contact.points[i];
    const double closing = normal.dot((a.course.linear + a.course.angular.cross(point.start_arm_a)) -
                                      (b.course.linear + b.course.angular.cross(point.start_arm_b)));
    const auto [time, speed] = meeting_of(point.start_gap, closing, along_a - along_b, dt);
    if (!(speed > tremble)) continue;
    blow.time = std::min(blow.time, time);
    change = std::max(change, (1 + contact.restitution) * speed);
  }
  if (!(change > 0)) return;
  blow.change = change * normal;
  blows.push_back(blow);
}

}  // namespace contacts

void World::Implementation::find_followers(std::size_t parts, double dt) {
  followers.clear();
  const std::span<contacts::FoundPart> all = std::span(found).first(parts);
  if (std::all_of(all.begin(), all.end(), [](const contacts::FoundPart& part) { return part.blows.empty(); })) return;
  contacts::Blows blows(struck_bodies, passages, dt);
  for (const contacts::FoundPart& part : all)
    for (const contacts::Blow& blow : part.blows) {
      const double a = bodies[blow.a].immovable() ? 0 : 1 / bodies[blow.a].mass().mass;
      const double b = bodies[blow.b].immovable() ? 0 : 1 / bodies[blow.b].mass().mass;
      if (a > 0) blows.strike(blow.a, blow.time, -a / (a + b) * blow.change);
      if (b > 0) blows.strike(blow.b, blow.time, b / (a + b) * blow.change);
    }
  const auto has_corners = [this](const contacts::ContactConstraint& contact) {
    const auto polyhedron = [this](std::uint32_t body) {
      return collision::is_polyhedron(passages[body].body->shape().solid);
    };
    const auto level = [&](std::uint32_t body) { return polyhedron(body) || passages[body].boundless; };
    return (polyhedron(contact.a) && level(contact.b)) || (polyhedron(contact.b) && level(contact.a));
  };
  touching_links.resize(active.size());
  cornered.assign(active.size(), 0);
  workers().ranges(active.size(), contacts::links_worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      constexpr std::size_t ahead = 4;
      if (k + ahead < end) contacts::fetch(*active[k + ahead]);
      const contacts::ContactConstraint& contact = *active[k];
      double gap = contact.points[0].start_gap;
      for (std::size_t i = 1; i < static_cast<std::size_t>(contact.count); ++i)
        gap = std::min(gap, contact.points[i].start_gap);
      touching_links[k] = contacts::link_of(contact.a, passages[contact.a], contact.b, passages[contact.b],
                                            contact.manifold.normal, gap);
      cornered[k] = contact.count < 4 && contact.impact_time == 0 && has_corners(contact);
    }
  });
  // For the positions of the bodies at the start of the step.
  const auto meet_at_start = [this, dt](contacts::ContactConstraint& contact, const Manifold& manifold) {
    contact.manifold = manifold;
    contact.kept = false;  // the memory has to find this one, which has more points
    const state::Body &a = bodies[contact.a], &b = bodies[contact.b];
    contacts::adopt(contact, passages[contact.a], {a.center, a.motion.pose.rotation}, passages[contact.b],
                    {b.center, b.motion.pose.rotation});
    if (contact.count == 0 || !contact.manifold.normal.allFinite()) return false;
    finish_contact(contact, contact.memory != state::ContactMemories::nowhere ? &memories[contact.memory] : nullptr,
                   dt);
    return true;
  };
  const auto take = [&](contacts::Followers& pair) {
    if (!blows.reach(pair.link)) return false;
    const collision::Passage &way_a = passages[pair.link.a], &way_b = passages[pair.link.b];
    if (!pair.known) {
      const double fastest = (way_a.course.linear - way_b.course.linear).norm();
      if (contacts::tell_all(way_a, way_b) && !blows.may_bring(pair.link, fastest)) return false;
      // It came from a direction of earlier steps, but the result of this step must not depend on those.
      const double near = contacts::near_enough_of(way_a, way_b);
      const Manifold apart =
          collision::collide(*way_a.course.shape, way_a.placed, *way_b.course.shape, way_b.placed, near, near);
      const double gap = collision::gap_along(way_a, way_b, apart.normal);
      pair.link = contacts::link_of(pair.link.a, way_a, pair.link.b, way_b, apart.normal, gap);
      pair.known = true;
    }
    if (!pair.beyond && !contacts::follow(way_a, way_b, pair.link.gap, dt)) return true;
    const double way = blows.hand_on(pair.link);
    if (way == 0) return false;
    contacts::ContactConstraint& constraint = followers.add();
    constraint.a = pair.link.a;
    constraint.b = pair.link.b;
    constraint.memory = pair.memory;
    const double reach = way + (way_a.swing + way_b.swing) * dt;
    if (!meet_at_start(constraint, collision::collide(*way_a.course.shape, way_a.placed, *way_b.course.shape,
                                                      way_b.placed, reach, reach)))
      followers.drop_last();
    return true;
  };
  beyond.clear();
  for (int round = 0; round < contacts::most_rounds && blows.spread(); ++round) {
    for (const std::uint32_t body : blows.struck_hard()) find_beyond(body, all, dt);
    for (std::size_t i = 0; i < touching_links.size(); ++i) blows.hand_on_again(touching_links[i], round, i);
    for (contacts::FoundPart& part : all) std::erase_if(part.followers, take);
    std::erase_if(beyond, take);
  }
  // A body on few corners may be tilted by a blow until others come down. Corners that are near are known.
  for (std::size_t i = 0; i < active.size(); ++i) {
    const contacts::Link& link = touching_links[i];
    if (cornered[i] == 0 || !blows.reach(link)) continue;
    contacts::ContactConstraint& contact = *active[i];
    const collision::Passage &way_a = passages[contact.a], &way_b = passages[contact.b];
    const double near = contacts::near_enough_of(way_a, way_b), way = blows.hand_on(link);
    if (!(way > near)) continue;
    const Vec3& normal = contact.manifold.normal;
    const double deep = near + way;
    if (collision::corners_within(way_a, normal, deep) <= contact.count ||
        collision::corners_within(way_b, -normal, deep) <= contact.count)
      continue;
    const Manifold wider =
        collision::collide(*way_a.course.shape, way_a.placed, *way_b.course.shape, way_b.placed, near, deep);
    if (wider.count > contact.count) meet_at_start(contact, wider);
  }
  auto known = static_cast<std::ptrdiff_t>(active.size());
  for (contacts::ContactConstraint& contact : followers.all()) active.push_back(&contact);
  const auto before = [](const contacts::ContactConstraint* left, const contacts::ContactConstraint* right) {
    return pairs::Pair(left->a, left->b) < pairs::Pair(right->a, right->b);
  };
  std::sort(active.begin() + known, active.end(), before);
  // They are few: the last ones get their places first, without a look at most of the others.
  std::vector<contacts::ContactConstraint*> late(active.begin() + known, active.end());
  for (auto end = active.end(); !late.empty(); late.pop_back()) {
    const auto place = std::upper_bound(active.begin(), active.begin() + known, late.back(), before);
    end = std::move_backward(place, active.begin() + known, end);
    *--end = late.back();
    known = place - active.begin();
  }
}

}  // namespace tweenfall
