#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/physics/particles.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "actors/particles/colliders.h"
#include "state/checks.h"

namespace tweenfall {

namespace particles {
namespace {

/// Random numbers for one particle, the same whatever else happens.
/// Source: Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014 (splitmix64).
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  double unit() {  // 0 to 1
    return static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

std::uint64_t mixed(std::uint64_t seed, std::uint64_t with) {
  Chance chance(seed ^ (with * 0xd1342543de82ef95u));
  return chance.bits();
}

/// Whole numbers nearer than this share count as reached.
constexpr double nearly = 1e-9;

/// How many were released until a time within the present stretch.
template <class Source>
double reached_until(const Source& source, double time) {
  const double until = std::clamp(time, source.from, std::min(source.to, source.emitter.end));
  return source.let_go.value(until) - source.let_go.value(source.from) + source.before;
}

template <class Source>
std::uint64_t count_until(const Source& source, double time) {
  const double reached = reached_until(source, time);
  return reached > 0 ? static_cast<std::uint64_t>(reached + nearly * std::max(1.0, reached)) : 0;
}

/// When this many have been released, within a stretch of time in which that happens. By Newton's method, halving the
/// interval when a step leaves it.
template <class Source>
double time_of(const Source& source, double many, double low, double high) {
  constexpr int most_steps = 80;
  double time = high;
  for (int step = 0; step < most_steps; ++step) {
    const double off = reached_until(source, time) - many;
    if (std::abs(off) <= 1e-13 * std::max(1.0, many) || !(high - low > 1e-15 * std::max(1.0, std::abs(high)))) break;
    (off > 0 ? high : low) = time;
    const double rate = source.emitter.rate.value(time, off > 0 ? Side::in : Side::out);
    const double next = rate > 0 ? time - off / rate : low;
    time = next > low && next < high ? next : 0.5 * (low + high);
  }
  return time;
}

Vec3 on_sphere(double height, double turn) {
  const elementary::SinCos angle = elementary::sin_cos(2 * std::numbers::pi * turn);
  const double across = std::sqrt(std::max(0.0, (1 - height) * (1 + height)));
  return {across * angle.cos, height, across * angle.sin};
}

/// A direction within a cone about another, evenly distributed over the cone.
Vec3 in_cone(const Vec3& along, double half_angle, double u, double turn) {
  const double length = along.norm();
  if (!(length > 0) || half_angle == 0) return along;
  const Vec3 cap = on_sphere(1 - u * (1 - elementary::cos(half_angle)), turn);
  const Vec3 axis = along / length;
  const Vec3 side = axis.cross(std::abs(axis.x()) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
  return length * (cap.x() * side + cap.y() * axis + cap.z() * axis.cross(side));
}

void require_rates(const Range& rates) {
  state::require(rates.low >= 0, "the rate of an emitter must never be negative");
  state::require(rates.high <= 1e9, "an emitter releases at most 1e9 particles per second");
}

/// Takes the rate's next stretch: a formula has no ends, but its integral needs some.
template <class Source>
void go_on(Source& source, double from) {
  constexpr double stretch = 600, latest = 1e6;
  Emitter& emitter = source.emitter;
  const bool first = from == emitter.start;
  source.from = from;
  source.to = emitter.end;
  emitter.rate = source.rate;
  const bool endless = !std::isfinite(source.rate.start()) || !std::isfinite(source.rate.end());
  if (endless && from >= latest) {
    emitter.rate = Curve<double>(0.0);
  } else if (endless && emitter.end > from) {
    source.to = std::min(emitter.end, from + stretch);
    emitter.rate = trimmed(source.rate, from, source.to);
  }
  const double low = std::max(from, emitter.rate.start() - 1);
  const Range rates = range(emitter.rate, low, std::max(low, std::min(source.to, emitter.rate.end() + 1)));
  if (first) require_rates(rates);
  if (!(rates.low >= 0 && rates.high <= 1e9)) emitter.rate = Curve<double>(0.0);
  source.let_go = antiderivative(emitter.rate);
}

void validate(const Emitter& emitter) {
  state::require(std::isfinite(emitter.start) && emitter.start >= 0 && emitter.end >= emitter.start,
                 "an emitter must start at 0 s or later, and end after that");
  state::require(state::countable(emitter.inherit),
                 "the share of its velocity that an emitter passes on must be finite");
  state::require(emitter.spread >= 0 && emitter.spread <= std::numbers::pi, "spread of an emitter must lie in 0 to pi");
  state::require(emitter.speed_spread >= 0 && emitter.speed_spread <= 1, "spread of speeds must lie in 0 to 1");
  state::require_amount(emitter.size, "size of an emitter");
}

}  // namespace
}  // namespace particles

void Particles::add(const Emitter& emitter) {
  particles::validate(emitter);
  Source source{.emitter = emitter, .rate = emitter.rate, .let_go = Curve<double>(0.0)};
  particles::go_on(source, emitter.start);
  source.seed = particles::mixed(settings_.seed, sources_.size() + 1);
  while (time_ > source.to && source.to < emitter.end) {
    source.before = particles::reached_until(source, source.to);
    particles::go_on(source, source.to);
  }
  source.number = particles::count_until(source, time_);
  sources_.push_back(std::move(source));
}

void Particles::place(std::size_t emitter, const Curve<Vec3>& position, const Curve<Quat>& rotation) {
  state::require(emitter < sources_.size(), "there is no emitter number " + std::to_string(emitter));
  sources_[emitter].emitter.position = position;
  sources_[emitter].emitter.rotation = rotation;
}

void Particles::halt(std::size_t emitter) {
  state::require(emitter < sources_.size(), "there is no emitter number " + std::to_string(emitter));
  double& end = sources_[emitter].emitter.end;
  end = std::min(end, std::max(time_, sources_[emitter].emitter.start));
}

void Particles::emit(const Vec3& position, const Vec3& velocity) {
  state::require_finite(position, "position of a particle");
  state::require_finite(velocity, "velocity of a particle");
  constexpr std::uint64_t by_hand = std::uint64_t{1} << 63;
  particles::Chance chance(particles::mixed(settings_.seed, by_hand | by_hand_));
  add_one(position, velocity, time_, chance.unit(), by_hand | by_hand_++);
}

void Particles::add_one(const Vec3& position, const Vec3& velocity, double at, double share, std::uint64_t number) {
  ++emitted_;
  if (size() >= settings_.most) {
    ++left_out_;
    return;
  }
  x_.push_back(position.x());
  y_.push_back(position.y());
  z_.push_back(position.z());
  vx_.push_back(velocity.x());
  vy_.push_back(velocity.y());
  vz_.push_back(velocity.z());
  born_.push_back(at);
  const double life =
      std::isfinite(settings_.life) ? settings_.life * (1 + settings_.life_spread * (2 * share - 1)) : settings_.life;
  dies_.push_back(at + life);
  number_.push_back(number);
}

void Particles::let_go(double until, const particles::Colliders* colliders) {
  struct Leaving {
    double time;
    std::size_t source;
    std::uint64_t number;
  };
  std::vector<Leaving> leaving;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    Source& source = sources_[s];
    const Emitter& emitter = source.emitter;
    if (until < emitter.start || time_ > emitter.end) continue;
    for (;;) {
      const double high = std::min({until, emitter.end, source.to});
      const std::uint64_t count = particles::count_until(source, high);
      double low = std::max({time_, emitter.start, source.from});
      // Particles beyond the limit could not stay, and are not searched for one by one.
      const std::uint64_t most = settings_.most - std::min<std::uint64_t>(settings_.most, size()) + source.number;
      for (; source.number < std::min(count, most); ++source.number) {
        low = particles::time_of(source, static_cast<double>(source.number + 1), low, high);
        leaving.push_back({low, s, source.number});
      }
      if (count > source.number) {
        emitted_ += count - source.number;
        left_out_ += count - source.number;
        source.number = count;
      }
      if (until <= source.to || source.to >= emitter.end) break;
      source.before = particles::reached_until(source, source.to);
      particles::go_on(source, source.to);
    }
  }
  std::stable_sort(leaving.begin(), leaving.end(), [](const Leaving& a, const Leaving& b) { return a.time < b.time; });
  for (const Leaving& one : leaving) {
    const Source& source = sources_[one.source];
    const Emitter& emitter = source.emitter;
    particles::Chance chance(particles::mixed(source.seed, one.number));
    // All are drawn, in this order, whatever the emitter uses.
    const double life = chance.unit(), speed = chance.unit(), cone = chance.unit(), turn = chance.unit();
    const double height = chance.unit(), around = chance.unit(), out = chance.unit();
    const Sample<Vec3> place = emitter.position.sample(one.time, Side::in);
    const Sample<Quat> axes = emitter.rotation.sample(one.time, Side::in);
    const Vec3 arm = emitter.size > 0
                         ? Vec3(emitter.size * elementary::cbrt(out) * particles::on_sphere(2 * height - 1, around))
                         : Vec3(0, 0, 0);
    const Vec3 own = particles::in_cone(emitter.velocity.value(one.time), emitter.spread, cone, turn) *
                     (1 + emitter.speed_spread * (2 * speed - 1));
    const Vec3 offset = axes.value * arm;
    const Vec3 carried = place.rate + axes.rate.cross(offset);
    const std::size_t before = size();
    add_one(place.value + offset, axes.value * own + emitter.inherit * carried, one.time, life,
            (static_cast<std::uint64_t>(one.source) << 40) | one.number);
    if (size() > before && until > one.time) move(before, size(), one.time, until - one.time, colliders);
  }
}

}  // namespace tweenfall
