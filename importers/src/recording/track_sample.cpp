#include <tweenfall/importers/track_sample.h>

#include <tweenfall/curves/rotation.h>

namespace tweenfall {

namespace track_samples {

namespace {

std::vector<double> parts(double number) {
  return {number};
}
template <class Vector>
std::vector<double> parts(const Vector& vector) {
  return {vector.data(), vector.data() + vector.size()};
}
std::vector<double> parts(const Color& color) {
  return parts(color.rgba);
}
std::vector<double> parts(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

struct Sampler {
  const ClipClock& clock;
  bool gains;

  template <class T>
  [[nodiscard]] TrackSample plain(const Curve<T>& curve) const {
    const Sample<T> sample = curve.sample(clock.time, clock.side);
    return {parts(sample.value), parts(Rate<T>(sample.rate * clock.rate)), {}};
  }

  TrackSample operator()(const Curve<Color>& curve) const { return plain(curve); }
  template <class T>
  TrackSample operator()(const Curve<T>& curve) const {
    if (!gains) return plain(curve);
    Sample<T> sample = curve.sample(clock.time, clock.side);
    sample.value += clock.cycle * (curve.value(clock.to, Side::in) - curve.value(clock.from));
    return {parts(sample.value), parts(Rate<T>(sample.rate * clock.rate)), {}};
  }
  TrackSample operator()(const Curve<Quat>& curve) const {
    Sample<Quat> sample = curve.sample(clock.time, clock.side);
    if (gains) {
      const Vec3 once = log_map(curve.value(clock.to, Side::in) * curve.value(clock.from).conjugate());
      const Quat turned = exp_map(Vec3(clock.cycle * once));
      sample.value = turned * sample.value;
      sample.rate = turned * sample.rate;
    }
    return {parts(sample.value), parts(Vec3(sample.rate * clock.rate)), {}};
  }
  TrackSample operator()(const WeightCurves& curves) const {
    TrackSample all;
    for (const Curve<double>& curve : curves) {
      const TrackSample one = plain(curve);
      all.value.push_back(one.value[0]);
      all.rate.push_back(one.rate[0]);
    }
    return all;
  }
  TrackSample operator()(const StepCurve<bool>& curve) const {
    return {{curve.value(clock.time, clock.side) ? 1.0 : 0.0}, {}, {}};
  }
  TrackSample operator()(const StepCurve<std::string>& curve) const {
    return {{}, {}, curve.value(clock.time, clock.side)};
  }
};

}  // namespace

}  // namespace track_samples

TrackSample sample_track(const Clip&, const Track& track, const ClipClock& clock) {
  const bool gains =
      clock.climbs && clock.cycle != 0 && track.property != "scale" && !track.property.starts_with("scale.");
  return std::visit(track_samples::Sampler{clock, gains}, track.curve);
}

}  // namespace tweenfall
