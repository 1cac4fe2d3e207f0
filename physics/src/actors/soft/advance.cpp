#include <tweenfall/curves/hermite.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "actors/soft/blowing.h"
#include "actors/soft/meetings/apart.h"
#include "actors/soft/meetings/between.h"
#include "actors/soft/meetings/meetings.h"
#include "actors/soft/sub_step.h"
#include "flat/axes.h"
#include "islands/islands.h"
#include "state/countable.h"
#include "state/world_data.h"

namespace tweenfall {

namespace soft {
namespace {

constexpr double most_sub_steps = 1000;
/// How often soft bodies that hold the same body are solved again, and which part of the energy of what they give may
/// still change when this ends.
constexpr int most_rounds = 12;
constexpr double agreed = 1e-10;

Vec3 mean_velocity(const SoftBody& body) {
  Vec3 momentum(0, 0, 0);
  double mass = 0;
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    momentum += body.made->masses[i] * body.velocities[i];
    mass += body.made->masses[i];
  }
  return momentum / mass;
}

/// Of all edges that are stretched too far, tears the most stretched; it goes alone, and takes the load off its
/// neighbors.
void tear_one(SoftBody& body, double time) {
  const SoftSettings& made = *body.made;
  std::size_t worst = made.edges.size();
  double most = 1;
  for (std::size_t i = 0; i < made.edges.size(); ++i) {
    const SoftEdge& edge = made.edges[i];
    if (std::isinf(edge.tear) || body.torn[i] != 0) continue;
    const double strain = (body.positions[edge.a] - body.positions[edge.b]).norm() / *edge.length - 1;
    if (!(strain > most * edge.tear)) continue;
    most = strain / edge.tear;
    worst = i;
  }
  if (worst == made.edges.size()) return;
  tear(body, worst);
  const SoftEdge& edge = made.edges[worst];
  body.tears.push_back({worst, time, 0.5 * (body.positions[edge.a] + body.positions[edge.b])});
}

/// What all soft bodies share in a step.
struct Surroundings {
  std::vector<state::Body>& bodies;
  Partners& partners;
  const WorldSettings& settings;
  const std::vector<Blowing>& winds;
  double began;  ///< start time of the step, s
  double dt;
};

/// Of one soft body: kept from step to step, so that a settled one takes no memory.
struct CourseMemory {
  std::vector<Near> near;
  std::vector<Vec3> starts, start_rates;  ///< of the pinned nodes
  std::vector<Vec3> places;               ///< of all nodes, before a sub-step
  std::vector<Held> held;
  std::vector<NodeContact> contacts;
  std::vector<Vec3> first_places, first_velocities;  ///< before a sub-step that may be repeated
  std::vector<Gift> gifts;                           ///< in it, by partner
  std::vector<Gift> gifts_before, gifts_after;
  KeptChains chains;
};

/// One soft body in a step.
class Course {
 public:
  Course(SoftBody& body, const Surroundings& around, CourseMemory& memory)
      : body_(body),
        bodies_(around.bodies),
        partners_(around.partners),
        settings_(around.settings),
        winds_(around.winds),
        began_(around.began),
        dt_(around.dt),
        memory_(memory),
        near_(memory.near),
        starts_(memory.starts),
        start_rates_(memory.start_rates),
        places_(memory.places),
        held_(memory.held),
        contacts_(memory.contacts),
        gifts_(memory.gifts) {
    body.tears.clear();
    find_near(body, bodies_, partners_, settings_, dt_, near_);
    starts_.clear();
    start_rates_.clear();
    held_.clear();
    contacts_.clear();
    gifts_.clear();
    for (PinState& state : body.pins) {
      state.force = Vec3(0, 0, 0);
      starts_.push_back(body.positions[state.pin.node]);
      start_rates_.push_back(body.velocities[state.pin.node]);
      if (state.pin.body != BodyId{}) static_cast<void>(partners_.number_of(state.pin.body.index));
    }
  }

  /// A sub-step, without the effect of other soft bodies.
  void go(double time, double h, bool backward) {
    find_held(time);
    blow(body_, winds_, h);
    find_contacts(body_, near_, bodies_, partners_, settings_.gravity, settings_.push_out_speed, h, contacts_);
    was_ = held_.empty() ? mean_velocity(body_) : Vec3(0, 0, 0);
    SubStep step{body_, partners_, contacts_, held_, memory_.chains, settings_.gravity, h, backward};
    const bool between = std::ranges::any_of(near_, &Near::slips);
    if (thick() || between) places_ = body_.positions;
    (body_.made->solver == SoftSolver::positions ? solve_positions : solve_springs)(step);
    pushed_ = between && meet_between(step, near_, bodies_, places_, settings_.push_out_speed);
    if (thick()) keep_apart(as_thick(), partners_, h, backward, settings_.push_out_speed);
  }

  /// The same, so that it can be repeated.
  void go_first(double time, double h, bool backward) {
    memory_.first_places = body_.positions;
    memory_.first_velocities = body_.velocities;
    give(time, h, backward);
    for (std::uint32_t p = 0; p < gifts_.size(); ++p)
      if (gives_to(p)) ++partners_[p].givers;
  }
  /// Repeats it with what others have given meanwhile. @return how much of what it gives has changed, and how much that
  /// is, J s^2
  std::pair<double, double> go_again(double time, double h, bool backward) {
    body_.positions = memory_.first_places;
    body_.velocities = memory_.first_velocities;
    partners_.take_back(gifts_);
    std::vector<Gift>& before = memory_.gifts_before;
    std::swap(before, gifts_);
    give(time, h, backward);
    double changed = 0, all = 0;
    for (std::uint32_t p = 0; p < gifts_.size(); ++p) {
      const auto weigh = [&partner = partners_[p]](const Vec3& moved, const Vec3& turned) {
        return partner.mass * moved.squaredNorm() + turned.dot(partner.inertia * turned);
      };
      changed += weigh(gifts_[p].moved - before[p].moved, gifts_[p].turned - before[p].turned);
      all += weigh(gifts_[p].moved, gifts_[p].turned);
    }
    return {changed, all};
  }
  /// The first of the partners to which another one gives, too.
  [[nodiscard]] std::optional<std::uint32_t> first_shared() const {
    for (std::uint32_t p = 0; p < gifts_.size(); ++p)
      if (partners_[p].givers > 1 && gives_to(p)) return p;
    return std::nullopt;
  }
  /// Joins all of these.
  void join_shared(islands::Islands& joined) const {
    const std::optional<std::uint32_t> first = first_shared();
    for (std::uint32_t p = first.value_or(0); first && p < gifts_.size(); ++p)
      if (partners_[p].givers > 1 && gives_to(p)) joined.join(*first, p);
  }

  [[nodiscard]] const SoftSettings& made() const { return *body_.made; }
  [[nodiscard]] bool thick() const { return body_.made->thickness > 0; }
  [[nodiscard]] Thick as_thick() { return {&body_, &places_, held_}; }

  /// @param among  other soft bodies have pushed it
  void end(double time, double h, bool among) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
      body_.pins[i].force += held_[i].pushed / (h * dt_);
      if (held_[i].partner == Held::nobody && body_.pins[i].pin.body != BodyId{})
        partners_[partners_.number_of(body_.pins[i].pin.body.index)].taken += held_[i].pushed / h;
    }
    const bool touches = std::ranges::any_of(contacts_, [](const NodeContact& contact) { return contact.pressed > 0; });
    if (held_.empty() && !touches && !pushed_ && !among) {
      // Backward Euler lets things fall too far by half of a sub-step's gain: correct this for a body that nothing
      // holds, as a whole.
      const Vec3 early = 0.5 * h * (mean_velocity(body_) - was_);
      for (Vec3& place : body_.positions) place -= early;
    }
    stay_in_plane();
    tear_one(body_, began_ + time);
  }

  /// Pinned nodes end exactly where they are held.
  void finish() {
    for (PinState& state : body_.pins) {
      if (state.pin.body == BodyId{}) {
        state.velocity = Vec3(0, 0, 0);
        continue;
      }
      const state::Body& holder = bodies_[state.pin.body.index];
      const Pose& pose = holder.motion.pose;
      body_.positions[state.pin.node] = pose.position + pose.rotation * state.pin.point;
      if (holder.immovable())
        body_.velocities[state.pin.node] = velocity_at(holder.twist, body_.positions[state.pin.node] - holder.center);
    }
  }

 private:
  void give(double time, double h, bool backward) {
    partners_.tell_given(gifts_);
    go(time, h, backward);
    std::vector<Gift>& all = memory_.gifts_after;
    partners_.tell_given(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].moved -= gifts_[i].moved;
      all[i].turned -= gifts_[i].turned;
      all[i].taken -= gifts_[i].taken;
    }
    std::swap(gifts_, all);
  }
  [[nodiscard]] bool gives_to(std::uint32_t partner) const {
    return gifts_[partner].moved != Vec3::Zero() || gifts_[partner].turned != Vec3::Zero();
  }

  /// The plane bears what points out of it.
  void stay_in_plane() {
    if (settings_.plane == WorldPlane::none) return;
    const int normal = flat::Axes::of(settings_.plane).normal;
    for (Vec3& place : body_.positions) place[normal] = 0;
    for (Vec3& velocity : body_.velocities) velocity[normal] = 0;
  }

  void find_held(double time) {
    held_.clear();
    const double share = time / dt_;
    for (std::size_t i = 0; i < body_.pins.size(); ++i) {
      const PinState& state = body_.pins[i];
      Held held{.node = state.pin.node};
      if (state.pin.body == BodyId{}) {
        const bool led = share < 1 && state.target != starts_[i];
        const Sample<Vec3> way =
            led ? hermite::sample<Vec3>(starts_[i], start_rates_[i], state.target, state.velocity, dt_, share)
                : Sample<Vec3>{state.target, state.velocity, Vec3(0, 0, 0)};
        held.place = way.value;
        held.velocity = way.rate;
      } else {
        const std::uint32_t number = partners_.number_of(state.pin.body.index);
        const Partner& partner = partners_[number];
        held.arm = partner.now.rotation * (state.pin.point - bodies_[partner.body].mass().center);
        held.place = partner.now.center + held.arm;
        if (partner.moves()) held.partner = number;
      }
      held_.push_back(held);
    }
  }

  SoftBody& body_;
  std::vector<state::Body>& bodies_;
  Partners& partners_;
  const WorldSettings& settings_;
  const std::vector<Blowing>& winds_;
  double began_, dt_;
  CourseMemory& memory_;
  std::vector<Near>& near_;
  std::vector<Vec3>&starts_, &start_rates_, &places_;
  std::vector<Held>& held_;
  std::vector<NodeContact>& contacts_;
  std::vector<Gift>& gifts_;
  Vec3 was_{0, 0, 0};    ///< mean velocity before the sub-step, if nothing holds it
  bool pushed_ = false;  ///< a contact between its nodes pushed it in the sub-step
};

/// Kept from step to step: a settled one takes no memory.
struct Memory {
  Partners partners;
  std::vector<Blowing> winds;
  std::vector<std::unique_ptr<CourseMemory>> of_courses;
  std::vector<Course> courses;
  std::vector<std::size_t> among;  ///< indices of those that may meet another one
  std::vector<Thick> thick;
  std::vector<char> pushed;
  islands::Islands joined;
  std::vector<std::vector<Course*>> sharing;

  [[nodiscard]] CourseMemory& of_course(std::size_t index) {
    while (of_courses.size() <= index) of_courses.push_back(std::make_unique<CourseMemory>());
    return *of_courses[index];
  }
};

/// Those that give something to the same bodies, directly or through others, each in their order.
std::span<const std::vector<Course*>> find_sharing(Memory& memory) {
  const std::size_t count = memory.partners.size();
  memory.joined.reset(count);
  for (const Course& course : memory.courses) course.join_shared(memory.joined);
  if (memory.sharing.size() < count) memory.sharing.resize(count);
  for (std::vector<Course*>& some : memory.sharing) some.clear();
  for (Course& course : memory.courses)
    if (const std::optional<std::uint32_t> first = course.first_shared())
      memory.sharing[memory.joined.of(*first)].push_back(&course);
  return std::span(memory.sharing).first(count);
}

/// A sub-step of all soft bodies. Those that hold the same body are solved in turn until they agree on where it goes:
/// what the first gives it does not account for the load of the last.
void go_together(Memory& memory, double time, double h, bool backward) {
  std::vector<Course>& courses = memory.courses;
  if (courses.size() == 1) return courses.front().go(time, h, backward);
  for (Course& course : courses) course.go_first(time, h, backward);
  for (const std::vector<Course*>& some : find_sharing(memory))
    for (int round = 1; round < most_rounds; ++round) {
      double changed = 0, all = 0;
      for (Course* const course : some) {
        const auto [change, whole] = course->go_again(time, h, backward);
        changed += change;
        all += whole;
      }
      if (!(changed > agreed * all)) break;
    }
}

void find_meeting_each_other(const std::vector<Course>& courses, std::vector<std::size_t>& found) {
  found.clear();
  for (std::size_t i = 0; i < courses.size(); ++i)
    if (std::ranges::any_of(courses, [&](const Course& other) {
          return &other != &courses[i] && meet_each_other(courses[i].made(), other.made());
        }))
      found.push_back(i);
}

}  // namespace
}  // namespace soft

void World::Implementation::note_soft_starts() {
  soft_starts.clear();
  if (std::ranges::none_of(softs, &soft::SoftBody::alive)) return;
  for (const state::Body& body : bodies) soft_starts.push_back({body.center, body.motion.pose.rotation, body.twist});
}

void World::Implementation::advance_softs(double dt, double whole) {
  if (softs.empty()) return;
  double longest = 0;
  for (const soft::SoftBody& body : softs)
    if (body.alive) longest = longest > 0 ? std::min(longest, *body.made->sub_step) : *body.made->sub_step;
  if (!(longest > 0)) return;
  const auto count_of = [longest](double span) {
    return std::clamp(std::ceil(span / longest - 1e-9), 1.0, soft::most_sub_steps);
  };
  const double count = count_of(dt), h = dt / count, pace = whole / count_of(whole);
  const int sub_steps = settings.plane == WorldPlane::none ? 1 : flat.own().sub_steps();
  thread_local soft::Memory memory;
  soft::Partners& partners = memory.partners;
  partners.begin(bodies, soft_starts, loads, settings, sub_steps, dt);
  soft::find_winds(forces, time, memory.winds);
  const soft::Surroundings around{bodies, partners, settings, memory.winds, time, dt};
  std::vector<soft::Course>& courses = memory.courses;
  courses.clear();
  for (soft::SoftBody& body : softs)
    if (body.alive) {
      body.pace = pace;
      courses.emplace_back(body, around, memory.of_course(courses.size()));
    }
  const std::vector<std::size_t>& among = memory.among;
  soft::find_meeting_each_other(courses, memory.among);
  std::vector<soft::Thick>& thick = memory.thick;
  for (double i = 1; i <= count; ++i) {
    const double since = i < count ? i * h : dt;
    partners.go_to(since, h);
    const bool backward = static_cast<int>(i) % 2 == 0;
    soft::go_together(memory, since, h, backward);
    thick.clear();
    for (const std::size_t member : among) thick.push_back(courses[member].as_thick());
    std::vector<char>& pushed = memory.pushed;
    pushed.assign(courses.size(), 0);
    if (!thick.empty()) {
      const std::vector<char>& its =
          soft::keep_apart_from_each_other(thick, partners, h, backward, settings.push_out_speed);
      for (std::size_t m = 0; m < among.size(); ++m) pushed[among[m]] = its[m];
    }
    for (std::size_t k = 0; k < courses.size(); ++k) courses[k].end(since, h, pushed[k] != 0);
    partners.accept(h);
  }
  partners.finish();
  for (soft::Course& course : courses) course.finish();
  courses.clear();
}

void World::Implementation::check_softs() const {
  for (std::uint32_t i = 0; i < softs.size(); ++i) {
    if (!softs[i].alive) continue;
    for (std::uint32_t node = 0; node < softs[i].positions.size(); ++node)
      if (!state::countable(softs[i].positions[node]) || !state::countable(softs[i].velocities[node]))
        throw SoftNotFinite({i, softs[i].generation}, node, time);
  }
}

}  // namespace tweenfall
