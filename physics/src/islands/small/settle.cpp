#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/surfaces/surface.h"
#include "step/solver.h"

/// Small islands are solved to the end, however different their masses.

namespace tweenfall::step {

namespace {

/// A change of velocity below this no longer matters, relative to the greatest speed and in m/s.
constexpr double settled = 1e-14;
constexpr double rounding = 1e-15;
/// Passes that are nearly always enough.
constexpr int plain_passes = 6;
/// After this many passes the result has to do; there are more if much rests on several far lighter bodies, since the
/// remaining error would throw those out.
constexpr int most_passes = 160, most_far_apart = 500;
/// Number of passes without improvement after which none is expected.
constexpr int most_idle = 40, idle_far_apart = 200;
/// How often normals and friction of a single contact take turns; and how often without improvement.
constexpr int most_turns = 40, most_idle_turns = 5;
/// A change is wild if it exceeds the least one before by this factor.
constexpr double wild = 100;

/// An extrapolation beyond this multiple of the greatest impulse is not worth trying.
constexpr double far = 1e4;
/// Ratio of masses from which bodies count as unlike.
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

/// Which points press, and which of these slide.
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

/// Whether everything that acts in the island is contacts that push and rub.
bool Solver::extrapolates(const std::vector<state::Body>& bodies, Springs springs) const {
  if (contacts_.size() > to_the_end || !springs.empty()) return false;
  // With several bodies of similar mass, the usual passes come close enough.
  if (contacts_.size() > 1 && heaviest_ < unlike * lightest_) return false;
  for (const SolvedContact& contact : contacts_)
    if (contact.rolling_friction > 0 || contact.spinning_friction > 0) return false;
  // A body that touches several triangles has contacts that come and go.
  for (std::size_t i = 1; i < contacts_.size(); ++i) {
    const SolvedContact &one = contacts_[i - 1], &other = contacts_[i];
    if (one.a == other.a && one.b == other.b &&
        (surfaces::surface_of(bodies[one.a].shape().solid) || surfaces::surface_of(bodies[one.b].shape().solid)))
      return false;
  }
  // Between two bodies with wills of their own, no impulse is enough.
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
  // At least the effect of the greatest impulse's rounding on the lightest body.
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
      // What presses, holds or slides has changed: what was learned belongs to another problem.
      extrapolation_.begin(from_.size());
      std::swap(from_, to_);
      continue;
    }
    const std::vector<double>& next = extrapolation_.next(from_, to_);
    if (greatest(next) > far * greatest(to_)) {
      // With such impulses, their rounding would remain in the velocities.
      extrapolation_.begin(from_.size());
      std::swap(from_, to_);
      continue;
    }
    set_impulses(next);
    read_impulses(from_);
  }
  if (contacts_.size() == 1) {
    set_impulses(best_);
    // A turning led body may ask its points for slips that no body can have: then no turn is better than the last.
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0, since = 0; k < most_turns && since < most_idle_turns; ++k) {
      press_at_once(contacts_.front(), rows_.data());
      const double change = pass(false);
      if (change < enough) return;
      since = change < 0.5 * nearest ? 0 : since + 1;
      nearest = std::min(nearest, change);
    }
  }
  // If no end is in sight, it is no better than the last pass.
  if (pass(false) > before) set_impulses(best_);
}

}  // namespace tweenfall::step
