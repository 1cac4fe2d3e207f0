#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/surfaces/surface.h"
#include "step/solver.h"

/// Small islands are solved to the end, however unlike their masses.

namespace tweenfall::step {

namespace {

/// A change of velocity that no longer matters, parts of the greatest speed and m/s.
constexpr double settled = 1e-14;
constexpr double rounding = 1e-15;
/// Passes that nearly always do.
constexpr int plain_passes = 6;
/// Passes after which what is left must do; more where much rests on several that are far lighter, for there what is
/// left would throw them out.
constexpr int most_passes = 160, most_far_apart = 500;
/// Passes in which nothing gets better, so that nothing will.
constexpr int most_idle = 40, idle_far_apart = 200;
/// Times that normals and friction of a single contact take turns; and those in which nothing gets better.
constexpr int most_turns = 40, most_idle_turns = 5;
/// A change that is so many times the least before.
constexpr double wild = 100;

/// What is extrapolated to so many times the greatest impulse is not worth trying.
constexpr double far = 1e4;
/// Bodies of which one is so many times as heavy as another.
constexpr double unlike = 10;
constexpr double far_apart = 300;
constexpr std::size_t several = 3;

double greatest(const std::vector<double>& impulses) {
  double most = 0;
  for (const double impulse : impulses) most = std::max(most, std::abs(impulse));
  return most;
}

}  // namespace

void Solver::read_impulses(std::vector<double>& impulses) const {
  impulses.clear();
  for (std::size_t n = 0; n < contacts_.size(); ++n) {
    const SolvedContact& contact = contacts_[n];
    for (int i = 0; i < contact.count; ++i) {
      const SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      const PointRows& rows = rows_[4 * n + static_cast<std::size_t>(i)];
      impulses.push_back(point.normal_impulse * rows.scale);
      if (!(contact.friction > 0)) continue;
      impulses.push_back(rows.along.first.dot(point.friction_impulse) * rows.scale);
      impulses.push_back(rows.along.second.dot(point.friction_impulse) * rows.scale);
    }
  }
}

/// Which points press, and which of them slide.
void Solver::read_holds(std::vector<char>& holds) const {
  holds.clear();
  for (const SolvedContact& contact : contacts_)
    for (int i = 0; i < contact.count; ++i) {
      const SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      const double grip = contact.friction * point.normal_impulse;
      holds.push_back(point.normal_impulse > 0 ? 1 : 0);
      holds.push_back(point.friction_impulse.squaredNorm() >= 0.999999 * grip * grip ? 1 : 0);
    }
}

void Solver::set_impulses(const std::vector<double>& impulses) {
  std::size_t next = 0;
  for (std::size_t n = 0; n < contacts_.size(); ++n) {
    SolvedContact& contact = contacts_[n];
    SolverBody& a = at(contact.a);
    SolverBody& b = at(contact.b);
    for (int i = 0; i < contact.count; ++i) {
      SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      const PointRows& rows = rows_[4 * n + static_cast<std::size_t>(i)];
      const double unit = 1 / rows.scale;
      const double normal = std::max(0.0, impulses[next++] * unit);
      Vec3 change = (normal - point.normal_impulse) * contact.normal;
      point.normal_impulse = normal;
      if (contact.friction > 0) {
        const double first = impulses[next++] * unit, second = impulses[next++] * unit;
        const Vec3 friction = first * rows.along.first + second * rows.along.second;
        change += friction - point.friction_impulse;
        point.friction_impulse = friction;
      }
      push(a, -change, point.arm_a);
      push(b, change, point.arm_b);
    }
  }
}

/// Whether all that acts in the island are contacts that push and rub.
bool Solver::extrapolates(const std::vector<state::Body>& bodies, Springs springs) const {
  if (contacts_.size() > to_the_end || !springs.empty()) return false;
  // Of several alike bodies the passes that all get come near enough.
  if (contacts_.size() > 1 && heaviest_ < unlike * lightest_) return false;
  for (const SolvedContact& contact : contacts_)
    if (contact.rolling_friction > 0 || contact.spinning_friction > 0) return false;
  // What touches several triangles has contacts that come and go.
  for (std::size_t i = 1; i < contacts_.size(); ++i) {
    const SolvedContact &one = contacts_[i - 1], &other = contacts_[i];
    if (one.a == other.a && one.b == other.b &&
        (surfaces::surface_of(bodies[one.a].shape().solid) || surfaces::surface_of(bodies[one.b].shape().solid)))
      return false;
  }
  // Between two that go their own ways no impulse is enough.
  const auto wills =
      std::count_if(bodies_.begin(), bodies_.end(), [](const SolverBody& body) { return !body.movable; });
  if (wills > 1 && !led_.empty()) return false;
  return std::none_of(bodies_.begin(), bodies_.end(), [&](const SolverBody& body) {
    return body.movable && bodies[body.index].drive.owner() == Owner::driven;
  });
}

void Solver::settle(int passes, const std::function<double(bool backward)>& pass) {
  double fastest = 1;
  for (const SolverBody& body : bodies_)
    if (body.movable) fastest = std::max(fastest, body.linear.norm());
  double enough = settled * fastest;
  double last = 0;
  for (int k = 0; k < passes; ++k) {
    last = pass(k % 2 == 1);
    if (last < enough) return;
    if (extrapolating_ && k + 1 == plain_passes) break;
  }
  if (!extrapolating_) return;
  read_impulses(from_);
  best_ = from_;
  extrapolation_.begin(from_.size());
  // Not less than what the rounding of the greatest impulse does to the lightest body.
  for (std::size_t n = 0; n < contacts_.size(); ++n)
    for (int i = 0; i < contacts_[n].count; ++i) {
      const double scale = rows_[4 * n + static_cast<std::size_t>(i)].scale;
      enough =
          std::max(enough, rounding * contacts_[n].points[static_cast<std::size_t>(i)].normal_impulse * scale * scale);
    }
  double least = last;
  const double before = last;
  int idle = 0;
  read_holds(holds_);
  const bool burdened = contacts_.size() >= several && heaviest_ > far_apart * lightest_;
  const int end = burdened ? most_far_apart : most_passes, bored = burdened ? idle_far_apart : most_idle;
  for (int k = plain_passes; k < end && idle <= bored; ++k) {
    const double change = pass(false);
    if (change < enough) return;
    read_impulses(to_);
    idle = change < 0.5 * least ? 0 : idle + 1;
    if (change < least) {
      least = change;
      best_ = to_;
    }
    std::swap(holds_, held_);
    read_holds(holds_);
    if (holds_ != held_ || change > wild * least) {
      // What presses, holds or slides has changed: what was learned is of another problem.
      extrapolation_.begin(from_.size());
      std::swap(from_, to_);
      continue;
    }
    const std::vector<double>& next = extrapolation_.next(from_, to_);
    if (greatest(next) > far * greatest(to_)) {
      // Of such impulses the rounding would stay behind in the velocities.
      extrapolation_.begin(from_.size());
      std::swap(from_, to_);
      continue;
    }
    set_impulses(next);
    read_impulses(from_);
  }
  if (contacts_.size() == 1) {
    set_impulses(best_);
    // What leads and turns asks its points for slips of which no body is capable: then each turn is like the last.
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0, since = 0; k < most_turns && since < most_idle_turns; ++k) {
      press_at_once(contacts_.front(), rows_.data());
      const double change = pass(false);
      if (change < enough) return;
      since = change < 0.5 * nearest ? 0 : since + 1;
      nearest = std::min(nearest, change);
    }
  }
  // Where no end is in sight it is worth as much as the last pass.
  if (pass(false) > before) set_impulses(best_);
}

}  // namespace tweenfall::step
