#include "recording/user_numbers.h"

#include <algorithm>
#include <type_traits>

namespace tweenfall::recordings {

namespace {

std::size_t longest(const UserTrackRecord& track) {
  std::size_t most = 0;
  for (const UserValue& value : track.value)
    if (const auto* all = std::get_if<std::vector<Sample<double>>>(&value)) most = std::max(most, all->size());
  return most;
}

template <class T>
std::vector<double> parts_of(const T& value) {
  if constexpr (std::is_same_v<T, double>)
    return {value};
  else if constexpr (std::is_same_v<T, Color>)
    return parts_of(value.rgba);
  else if constexpr (std::is_same_v<T, Quat>)
    return parts_of(Vec4(value.coeffs()));
  else
    return std::vector<double>(value.data(), value.data() + value.size());
}

/// What `pick` takes of each sample; nothing of texts and switches.
template <class Pick>
std::vector<double> parts_at(const UserValue& value, std::size_t width, const Pick& pick) {
  return std::visit(
      [&]<class T>(const T& sample) -> std::vector<double> {
        if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, bool>) {
          return {};
        } else if constexpr (std::is_same_v<T, std::vector<Sample<double>>>) {
          std::vector<double> parts(std::max(width, sample.size()), 0);
          for (std::size_t i = 0; i < sample.size(); ++i) parts[i] = pick(sample[i]);
          return parts;
        } else {
          return parts_of(pick(sample));
        }
      },
      value);
}

}  // namespace

std::vector<std::string> number_names(const UserTrackRecord& track) {
  if (track.value.empty()) return {};
  const UserValue& first = track.value.front();
  if (std::holds_alternative<std::string>(first)) return {};
  if (std::holds_alternative<Sample<Color>>(first)) return {"r", "g", "b", "a"};
  std::vector<std::string> names;
  if (std::holds_alternative<std::vector<Sample<double>>>(first)) {
    const std::size_t count = longest(track);
    for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i));
    return names;
  }
  const std::size_t count = numbers_at(track, 0, 0).size();
  if (count == 1) return {""};
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(1, "xyzw"[i]);
  return names;
}

std::vector<double> numbers_at(const UserTrackRecord& track, std::size_t frame, std::size_t width) {
  if (const auto* on = std::get_if<bool>(&track.value[frame])) return {*on ? 1.0 : 0.0};
  return parts_at(track.value[frame], width, [](const auto& sample) { return sample.value; });
}

std::vector<double> rates_at(const UserTrackRecord& track, std::size_t frame, std::size_t width) {
  return parts_at(track.value[frame], width, [](const auto& sample) { return sample.rate; });
}

}  // namespace tweenfall::recordings
