#include <tweenfall/curves/motion_curves.h>

#include "curve/curve_data.h"
#include "math/polynomial.h"
#include "rotation/moving_rotation.h"

namespace tweenfall::spans {
namespace {

// Value and rate of a cubic without the acceleration, component by component, with the same bits as `cubic_through` and
// `evaluate_polynomial` give.
struct CubicAt {
  double s, inverse, rate;

  void operator()(double c0, double c1, double c2, double c3, double& value, double& velocity) const noexcept {
    const double cubic_s = s * c3, a = c2 + cubic_s, b = a + cubic_s;
    const double slope = c1 + s * a;
    value = c0 + s * slope;
    velocity = (slope + s * b) * inverse * rate;
  }

  // @param c  four rows of coefficients
  void of_coefficients(const Vec3* c, Vec3& value, Vec3& velocity) const noexcept {
    for (int i = 0; i < 3; ++i) (*this)(c[0][i], c[1][i], c[2][i], c[3][i], value[i], velocity[i]);
  }

  // @param ends  a value and its rate at the start of a span of `duration`, and the same at its end
  void through(const Vec3* ends, double duration, Vec3& value, Vec3& velocity) const noexcept {
    for (int i = 0; i < 3; ++i) {
      double c[4];
      const double of_component[4] = {ends[0][i], ends[1][i], ends[2][i], ends[3][i]};
      cubic_through(of_component, duration, c);
      (*this)(c[0], c[1], c[2], c[3], value[i], velocity[i]);
    }
  }
};

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

// Samples at one time; remembers where it lies among the knots used last.
class MotionCurves::Sampler {
 public:
  Sampler(const MotionCurves& curves, double time, Side side, double rate) noexcept
      : curves_(curves), time_(time), side_(side), rate_(rate) {}

  void operator()(const Thing& thing, Motion& motion) noexcept {
    if (thing.position.curve >= 0) sample(thing.position, motion.pose.position, motion.twist.linear);
    if (thing.rotation.curve >= 0) sample(thing.rotation, motion.pose.rotation, motion.twist.angular);
    if (thing.scale.curve >= 0) sample(thing.scale, motion.pose.scale, motion.scale_rate);
  }

  // Prefetches the numbers of a thing that will be sampled soon.
  void fetch(const Thing& thing) const noexcept {
    fetch(thing.position);
    fetch(thing.rotation);
    fetch(thing.scale);
    if (thing.rotation.times && thing.rotation.times == times_) __builtin_prefetch(thing.rotation.starts + span_);
  }

 private:
  void fetch(const Channel& channel) const noexcept {
    if (!channel.times || channel.times != times_) return;
    const Vec3* row = channel.rows + span_ * row_count(channel);
    __builtin_prefetch(row);
    __builtin_prefetch(reinterpret_cast<const char*>(row + (channel.passed ? 4 : row_count(channel))) - 1);
  }

  // Number of rows of one span. The first row of a rotation, which is zero, is not stored.
  static std::size_t row_count(const Channel& channel) noexcept {
    return channel.passed ? 2 : static_cast<std::size_t>(channel.degree) + (channel.starts ? 0 : 1);
  }

  // Whether the time lies inside one of the curve's spans; on arrival at a knot and beyond the ends the curve itself is
  // sampled.
  bool inside(const Channel& channel) noexcept {
    if (!channel.times) return false;
    if (channel.times != times_) {
      times_ = channel.times;
      inside_ = time_ >= times_->start() && time_ < times_->end();
      if (inside_) {
        span_ = times_->locate(time_);
        inside_ = side_ == Side::out || times_->knots()[span_] != time_;
        position_ = times_->position(span_, time_);
        inverse_ = times_->inverse(span_);
      }
    }
    return inside_;
  }

  void sample(const Channel& channel, Vec3& value, Vec3& rate) noexcept {
    if (!inside(channel)) {
      const Sample<Vec3> sample = curves_.vectors_[static_cast<std::size_t>(channel.curve)].sample(time_, side_);
      value = sample.value;
      rate = sample.rate * rate_;
      return;
    }
    const Vec3* c = channel.rows + span_ * row_count(channel);
    const spans::CubicAt cubic{position_, inverse_, rate_};
    if (channel.passed) {
      cubic.through(c, times_->duration(span_), value, rate);
    } else if (channel.degree == 3) {
      cubic.of_coefficients(c, value, rate);
    } else if (channel.degree == 1) {
      value = c[1] * position_ + c[0];
      rate = c[1] * inverse_ * rate_;
    } else {
      const math::Polynomial<Vec3> p = math::evaluate_polynomial(c, channel.degree, position_);
      value = p.value;
      rate = p.first * inverse_ * rate_;
    }
  }

  void sample(const Channel& channel, Quat& value, Vec3& rate) noexcept {
    if (!inside(channel)) {
      const Sample<Quat> sample = curves_.rotations_[static_cast<std::size_t>(channel.curve)].sample(time_, side_);
      value = sample.value;
      rate = sample.rate * rate_;
      return;
    }
    const Vec3* rows = channel.rows + span_ * row_count(channel);
    const Quat& start = channel.starts[span_];
    if (channel.degree == 1) {
      value = start * exp_map(rows[0] * position_);
      rate = start * rows[0] * inverse_ * rate_;
      return;
    }
    Vec3 turn, turn_rate;
    turn_at(rows, channel.degree, turn, turn_rate);
    const rotations::TurningRotation turned = rotations::exponential(turn, turn_rate);
    value = start * turned.value;
    rate = value * turned.velocity * inverse_ * rate_;
  }

  // How far a rotation has turned from its span's start, and how fast it turns per span.
  void turn_at(const Vec3* rows, int degree, Vec3& turn, Vec3& rate) const noexcept {
    if (degree == 3) {
      const spans::CubicAt cubic{position_, 1, 1};
      for (int i = 0; i < 3; ++i) cubic(0, rows[0][i], rows[1][i], rows[2][i], turn[i], rate[i]);
      return;
    }
    Vec3 c[max_degree + 1];
    c[0].setZero();
    std::copy_n(rows, degree, c + 1);
    const math::Polynomial<Vec3> p = math::evaluate_polynomial(c, degree, position_);
    turn = p.value;
    rate = p.first;
  }

  const MotionCurves& curves_;
  const double time_;
  const Side side_;
  const double rate_;
  const SpanTimes* times_ = nullptr;
  bool inside_ = false;
  std::size_t span_ = 0;
  double position_ = 0, inverse_ = 0;
};

MotionCurves::Channel MotionCurves::channel_of(const Curve<Vec3>* curve) {
  Channel channel;
  if (!curve) return channel;
  channel.curve = static_cast<std::int32_t>(vectors_.size());
  vectors_.push_back(*curve);
  const auto& data = CurveAccess::data(*curve);
  if (!data.times || data.kinds.size() > 1 || data.kinds[0].warped || data.rebuilt) return channel;
  channel.times = data.times.get();
  channel.passed = !data.passed.empty();
  channel.rows = channel.passed ? data.passed.data() : data.pool.data();
  channel.degree = data.kinds[0].degree;
  return channel;
}

MotionCurves::Channel MotionCurves::channel_of(const Curve<Quat>* curve) {
  Channel channel;
  if (!curve) return channel;
  channel.curve = static_cast<std::int32_t>(rotations_.size());
  rotations_.push_back(*curve);
  const auto& data = CurveAccess::data(*curve);
  if (!data.plain_turns || data.rebuilt) return channel;
  channel.times = data.times.get();
  channel.rows = data.turns.data();
  channel.starts = data.starts.data();
  channel.degree = data.kinds[0].degree;
  return channel;
}

void MotionCurves::add(std::size_t target, const Parts& parts) {
  things_.push_back({target, channel_of(parts.position), channel_of(parts.rotation), channel_of(parts.scale)});
}

void MotionCurves::sample(double time, Side side, double rate, std::span<Motion> motions) const noexcept {
  constexpr std::size_t ahead = 4;
  Sampler sampler(*this, time, side, rate);
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (i + ahead < things_.size()) sampler.fetch(things_[i + ahead]);
    sampler(things_[i], motions[things_[i].target]);
  }
}

void MotionCurves::sample_one(std::size_t thing, double time, Side side, double rate, Motion& motion) const noexcept {
  Sampler(*this, time, side, rate)(things_[thing], motion);
}

}  // namespace tweenfall
