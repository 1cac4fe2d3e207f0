#pragma once

// Tracks made from tracks of numbers: mixes of values by weights, and aspect ratios.

#include <tweenfall/curves/curve.h>

#include "document/read/clip_times.h"
#include "document/report/problems.h"

#include <optional>
#include <vector>

namespace tweenfall::document {

// A track of numbers: keys, or a function.
[[nodiscard]] std::optional<Curve<double>> read_numbers(const json::Value& track, const ClipTimes& times,
                                                        Problems& problems);

// The weights of "barycentric", one for each of its values; empty where they are faulty, which is reported.
[[nodiscard]] std::optional<std::vector<Curve<double>>> read_mix_weights(const json::Value& mix, const ClipTimes& times,
                                                                         Problems& problems);

// Its values, each for all times.
template <class T, class ValueOf>
std::optional<std::vector<Curve<T>>> read_mix_values(const json::Value& mix, const ValueOf& value_of) {
  std::vector<Curve<T>> values;
  const json::Value list = mix.find("values");
  if (!list) return {};
  for (const json::Value& each : list.items())
    if (const std::optional<T> value = value_of(each)) values.push_back(Curve<T>(*value));
  if (values.empty() || values.size() != list.items().size()) return {};
  return values;
}

// Keys of ratios of width to height, mixed by their logarithm, as a scale that keeps the area in x and y.
[[nodiscard]] std::optional<Curve<Vec3>> read_aspect(const json::Value& ratios, const ClipTimes& times,
                                                     Problems& problems);

}  // namespace tweenfall::document
