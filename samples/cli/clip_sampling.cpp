#include "clip_sampling.h"

#include "arguments.h"
#include "did_you_mean.h"
#include "json_text.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <limits>
#include <set>

namespace tweenfall::cli {

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

/// Where the clip's clock stands, and what it does to values and rates.
struct Clock {
  const Clip& clip;
  double time;
  double rate = 1;
  int cycle = 0;
  Side side = Side::out;

  Clock(const Clip& played, double asked) : clip(played), time(asked) {
    if (clip.loop.mode == LoopMode::once) return;
    const ClipClock clock = clock_at(Play{}, clip, asked);
    time = clock.time;
    rate = clock.rate;
    side = clock.side;
    if (clip.loop.mode == LoopMode::repeat_offset) cycle = clock.cycle;
  }
};

template <class T>
TrackSample plain(const Curve<T>& curve, const Clock& clock) {
  const Sample<T> sample = curve.sample(clock.time, clock.side);
  return {parts(sample.value), parts(Rate<T>(sample.rate * clock.rate)), {}};
}

/// A repeat-offset loop starts from where it ended.
template <class T>
TrackSample continued(const Curve<T>& curve, const Clock& clock) {
  Sample<T> sample = curve.sample(clock.time, clock.side);
  if (clock.cycle != 0) sample.value += clock.cycle * (curve.value(clock.clip.duration, Side::in) - curve.value(0.0));
  return {parts(sample.value), parts(Rate<T>(sample.rate * clock.rate)), {}};
}

TrackSample continued(const Curve<Quat>& curve, const Clock& clock) {
  Sample<Quat> sample = curve.sample(clock.time, clock.side);
  if (clock.cycle != 0) {
    const Vec3 once = log_map(curve.value(clock.clip.duration, Side::in) * curve.value(0.0).conjugate());
    const Quat turned = exp_map(Vec3(clock.cycle * once));
    sample.value = turned * sample.value;
    sample.rate = turned * sample.rate;
  }
  return {parts(sample.value), parts(Vec3(sample.rate * clock.rate)), {}};
}

struct Sampler {
  const Clock& clock;
  bool is_scale;

  TrackSample operator()(const Curve<Color>& curve) const { return plain(curve, clock); }
  template <class T>
  TrackSample operator()(const Curve<T>& curve) const {
    return is_scale ? plain(curve, clock) : continued(curve, clock);
  }
  TrackSample operator()(const Curve<Quat>& curve) const { return continued(curve, clock); }
  TrackSample operator()(const WeightCurves& curves) const {
    TrackSample all;
    for (const Curve<double>& curve : curves) {
      const TrackSample one = plain(curve, clock);
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

const char* kind_of(const TrackCurve& curve) noexcept {
  constexpr const char* kinds[] = {"number",   "vector",  "vector", "vector", "color",
                                   "rotation", "weights", "switch", "text"};
  static_assert(std::size(kinds) == std::variant_size_v<TrackCurve>);
  return kinds[curve.index()];
}

std::vector<std::size_t> choose_tracks(const Clip& clip, const std::vector<std::string>& patterns) {
  std::set<std::size_t> chosen;
  std::vector<std::string> names;
  for (const Track& track : clip.tracks) names.push_back(track.name());
  for (std::size_t i = 0; i < names.size() && patterns.empty(); ++i) chosen.insert(i);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != pattern && !matches(pattern, names[i])) continue;
      chosen.insert(i);
      any = true;
    }
    if (!any)
      throw UsageError("clip \"" + clip.name + "\" has no track \"" + pattern + "\"" + did_you_mean(pattern, names));
  }
  return {chosen.begin(), chosen.end()};
}

TrackSample sample_track(const Clip& clip, const Track& track, double time) {
  return std::visit(Sampler{Clock(clip, time), track.property == "scale"}, track.curve);
}

std::string value_json(const TrackCurve& curve, const TrackSample& sample) {
  if (std::holds_alternative<StepCurve<std::string>>(curve)) return json_string(sample.text);
  if (std::holds_alternative<StepCurve<bool>>(curve)) return sample.value[0] != 0 ? "true" : "false";
  if (std::holds_alternative<Curve<double>>(curve)) return json_number(sample.value[0]);
  return json_array(sample.value);
}

std::string rate_json(const TrackCurve& curve, const TrackSample& sample) {
  return std::holds_alternative<Curve<double>>(curve) ? json_number(sample.rate[0]) : json_array(sample.rate);
}

std::vector<WorldMotion> sample_world(const Animation& animation, double time) {
  const std::size_t count = animation.nodes().size();
  std::vector<Motion> local(count);
  std::vector<WorldMotion> world(count);
  animation.sample(time, local);
  animation.nodes().world_motions(local, world);
  return world;
}

Animation animation_of(const StageDescription& stage, std::size_t clip) {
  auto nodes = std::make_shared<Hierarchy>();
  for (const NodeDescription& node : stage.nodes) nodes->add({node.name, node.parent, node.rest});
  Clip played = stage.clips[clip];
  // Without a loop nothing stops the clock, so that curves go on as they do for their tracks.
  if (played.loop.mode == LoopMode::once) played.duration = std::numeric_limits<double>::infinity();
  return {std::move(nodes), {std::move(played)}, {Play{}}};
}

}  // namespace tweenfall::cli
