#include "document/tracks/read_mix.h"

#include "document/read/values.h"
#include "document/tracks/read_keys.h"
#include "document/tracks/read_track.h"

#include <limits>

namespace tweenfall::document {

namespace {

// Extends factors of x and y by a constant factor of 1 for z.
Curve<Vec3> of_a_plane(const Curve<Vec2>& factors) {
  const auto widened = [](const Vec2& v, double z) { return Vec3(v.x(), v.y(), z); };
  constexpr double endless = std::numeric_limits<double>::infinity();
  return Curve<Vec3>(
      [factors, widened](double time, Side side) {
        const Sample<Vec2> s = factors.sample(time, side);
        return Sample<Vec3>{widened(s.value, 1), widened(s.rate, 0), widened(s.acceleration, 0)};
      },
      -endless, endless);
}

}  // namespace

std::optional<std::vector<Curve<double>>> read_mix_weights(const json::Value& mix, const ClipTimes& times,
                                                           Problems& problems) {
  const json::Value values = usable(mix, "values"), weights = usable(mix, "weights");
  if (!values || !weights) return {};
  if (weights.items().size() != values.items().size()) {
    problems.add(weights, "each value has a weight; there are " + std::to_string(values.items().size()) +
                              " values and " + std::to_string(weights.items().size()) + " weights");
    return {};
  }
  std::vector<Curve<double>> curves;
  for (const json::Value& each : weights.items())
    if (const std::optional<Curve<double>> curve = read_numbers(each, times, problems)) curves.push_back(*curve);
  if (curves.size() != weights.items().size()) return {};
  return curves;
}

std::optional<Curve<Vec3>> read_aspect(const json::Value& ratios, const ClipTimes& times, Problems& problems) {
  if (!ratios.is(json::Value::Kind::list)) return {};
  KeyReader<double> reader;
  reader.value = [](const json::Value& value) {
    return value.is(json::Value::Kind::number) ? std::optional(value.number()) : std::nullopt;
  };
  reader.rate = [&reader](const json::Value& rate, double) { return reader.value(rate); };
  const std::optional<Curve<double>> curve = read_keys<double>(ratios, times, reader, {.logarithmic = true}, problems);
  if (!curve) return {};
  return of_a_plane(aspect_curve(*curve));
}

}  // namespace tweenfall::document
