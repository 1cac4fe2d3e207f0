#include "pose/clip_values.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace tweenfall::pose {

namespace {

struct Nothing {
  template <class T>
  UserValue operator()(const Curve<T>&) const {
    if constexpr (std::is_same_v<T, double>)
      return Sample<double>{0, 0, 0};
    else if constexpr (std::is_same_v<T, Quat>)
      return Sample<Quat>{Quat::Identity(), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    else if constexpr (std::is_same_v<T, Color>)
      return Sample<Color>{Color{Vec4(0, 0, 0, 0)}, Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)};
    else
      return Sample<T>{T::Zero(), T::Zero(), T::Zero()};
  }
  UserValue operator()(const WeightCurves& curves) const {
    return std::vector<Sample<double>>(curves.size(), Sample<double>{0, 0, 0});
  }
  UserValue operator()(const StepCurve<bool>&) const { return false; }
  UserValue operator()(const StepCurve<std::string>&) const { return std::string(); }
};

struct AtClock {
  const ClipClock& clock;

  [[nodiscard]] bool gains() const noexcept { return clock.climbs && clock.cycle != 0; }

  template <class T>
  [[nodiscard]] Sample<T> plain(const Curve<T>& curve) const {
    Sample<T> sample = curve.sample(clock.time, clock.side);
    sample.rate *= clock.rate;
    sample.acceleration *= 0;
    return sample;
  }
  UserValue operator()(const Curve<Color>& curve) const { return plain(curve); }
  UserValue operator()(const Curve<Quat>& curve) const {
    Sample<Quat> sample = plain(curve);
    if (!gains()) return sample;
    const Vec3 once = log_map(curve.value(clock.to, Side::in) * curve.value(clock.from).conjugate());
    const Quat turned = exp_map(Vec3(clock.cycle * once));
    sample.value = turned * sample.value;
    sample.rate = turned * sample.rate;
    return sample;
  }
  template <class T>
  UserValue operator()(const Curve<T>& curve) const {
    Sample<T> sample = plain(curve);
    if (gains()) sample.value += clock.cycle * (curve.value(clock.to, Side::in) - curve.value(clock.from));
    return sample;
  }
  UserValue operator()(const WeightCurves& curves) const {
    std::vector<Sample<double>> all;
    all.reserve(curves.size());
    for (const Curve<double>& curve : curves) all.push_back(plain(curve));
    return all;
  }
  template <class T>
  UserValue operator()(const StepCurve<T>& curve) const {
    return curve.value(clock.time, clock.side);
  }
};

template <class T>
Sample<T> mean(std::span<const Sample<T>> samples, std::span<const Sample<double>> weights) {
  Sample<T> result = [&] {
    if constexpr (std::is_same_v<T, Color>)
      return barycentric(samples, weights, ColorSpace::linear);
    else
      return barycentric<T>(samples, weights);
  }();
  result.acceleration *= 0;
  return result;
}

template <class T>
UserValue mean_of_kind(std::span<const UserValue> values, std::span<const Sample<double>> weights) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    std::size_t heaviest = 0;
    double most = -1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double sum = 0;
      for (std::size_t k = i; k < values.size(); ++k)
        if (std::get<T>(values[k]) == std::get<T>(values[i])) sum += weights[k].value;
      if (sum <= most) continue;
      heaviest = i;
      most = sum;
    }
    return values[heaviest];
  } else if constexpr (std::is_same_v<T, std::vector<Sample<double>>>) {
    std::vector<Sample<double>> all;
    std::size_t size = 0;
    for (const UserValue& value : values) size = std::max(size, std::get<T>(value).size());
    for (std::size_t k = 0; k < size; ++k) {
      std::vector<Sample<double>> samples;
      for (const UserValue& value : values)
        samples.push_back(k < std::get<T>(value).size() ? std::get<T>(value)[k] : Sample<double>{0, 0, 0});
      all.push_back(mean<double>(samples, weights));
    }
    return all;
  } else {
    std::vector<T> samples;
    samples.reserve(values.size());
    for (const UserValue& value : values) samples.push_back(std::get<T>(value));
    return mean(std::span<const T>(samples), weights);
  }
}

}  // namespace

bool is_user_track(const Track& track) noexcept {
  return property_named(track.property) == Property::user && !component_named(track.property);
}

const Track& user_track_named(std::span<const Clip> clips, std::string_view name) {
  const auto is_it = [name](const Track& track) {
    const std::size_t dot = track.node.size();
    return name.size() == dot + 1 + track.property.size() && name[dot] == '.' && name.starts_with(track.node) &&
           name.ends_with(track.property) && is_user_track(track);
  };
  for (const Clip& clip : clips) {
    const auto found = std::ranges::find_if(clip.tracks, is_it);
    if (found != clip.tracks.end()) return *found;
  }
  std::vector<std::string> names;
  for (const Clip& clip : clips)
    for (const Track& track : clip.tracks)
      if (is_user_track(track)) names.push_back(track.name());
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no user track \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

UserValue nothing_of(const TrackCurve& kind) {
  return std::visit(Nothing(), kind);
}

UserValue user_value_of(const TrackCurve& curve, const ClipClock& clock) {
  return std::visit(AtClock{clock}, curve);
}

UserValue mean_of(std::span<const UserValue> values, std::span<const Sample<double>> weights) {
  return std::visit([&](const auto& first) { return mean_of_kind<std::decay_t<decltype(first)>>(values, weights); },
                    values.front());
}

bool has_sums(const UserValue& value) noexcept {
  return !std::holds_alternative<Sample<Quat>>(value) && !std::holds_alternative<bool>(value) &&
         !std::holds_alternative<std::string>(value);
}

void add_share(UserValue& sum, const UserValue& value, const Sample<double>& share) {
  const auto add = [&]<class T>(T& to) {
    if constexpr (std::is_same_v<T, std::vector<Sample<double>>>) {
      const T& all = std::get<T>(value);
      if (to.size() < all.size()) to.resize(all.size(), Sample<double>{0, 0, 0});
      for (std::size_t i = 0; i < all.size(); ++i) {
        add_share(to[i], all[i], share);
        to[i].acceleration = 0;
      }
    } else if constexpr (!std::is_same_v<T, bool> && !std::is_same_v<T, std::string> &&
                         !std::is_same_v<T, Sample<Quat>>) {
      add_share(to, std::get<T>(value), share);
      to.acceleration *= 0;
    }
  };
  std::visit(add, sum);
}

}  // namespace tweenfall::pose
