#include "jet.h"
#include "key_check.h"
#include "key_pins.h"
#include "keys_converted.h"

namespace tweenfall {
namespace {

constexpr double turn = 0x1.921fb54442d18p+2;

// Coordinates times alpha, but for a hue, with rates by the product rule.
Sample<Vec4> premultiplied(const Sample<Vec4>& s, int hue) noexcept {
  Sample<Vec4> result = s;
  const Jet alpha{s.value[3], s.rate[3], s.acceleration[3]};
  for (int i = 0; i < 3; ++i) {
    if (i == hue) continue;
    const Jet p = Jet{s.value[i], s.rate[i], s.acceleration[i]} * alpha;
    result.value[i] = p.v;
    result.rate[i] = p.d;
    result.acceleration[i] = p.dd;
  }
  return result;
}

// The way back; where nothing is visible the coordinates are 0 and rest.
Sample<Vec4> divided(const Sample<Vec4>& s, int hue) noexcept {
  Sample<Vec4> result = s;
  const Jet alpha{s.value[3], s.rate[3], s.acceleration[3]};
  const Jet inverse = alpha.v == 0 ? Jet{} : reciprocal(alpha);
  for (int i = 0; i < 3; ++i) {
    if (i == hue) continue;
    const Jet p = Jet{s.value[i], s.rate[i], s.acceleration[i]} * inverse;
    result.value[i] = p.v;
    result.rate[i] = p.d;
    result.acceleration[i] = p.dd;
  }
  return result;
}

double next_hue(double from, double to, HueRule rule) noexcept {
  double step = to - from - turn * std::floor((to - from) / turn);  // 0 to a turn
  switch (rule) {
    case HueRule::shorter:
      if (step > turn / 2) step -= turn;
      break;
    case HueRule::longer:
      if (step > 0 && step < turn / 2) step -= turn;
      break;
    case HueRule::increasing:
      break;
    case HueRule::decreasing:
      if (step > 0) step -= turn;
      break;
  }
  return from + step;
}

// Coordinates of all keys, arriving and leaving, in the order in which the curve meets them.
struct Stop {
  Vec4 value;
  bool gray;
};

void join_hues(std::vector<Stop>& stops, int hue, HueRule rule) {
  const Stop* colored = nullptr;
  for (const Stop& s : stops)
    if (!s.gray && !colored) colored = &s;
  if (!colored) return;
  // A gray takes the hue of the color before it, else of the first that has one.
  double last = colored->value[hue];
  for (Stop& s : stops) {
    s.value[hue] = s.gray ? last : next_hue(last, s.value[hue], &s == colored ? HueRule::shorter : rule);
    last = s.value[hue];
  }
}

void convert_tangent(std::optional<Tangent<Vec4>>& result, const std::optional<Tangent<Color>>& tangent,
                     const Color& color, const Vec4& coordinates, ColorSpace space) {
  if (!tangent) return;
  result.emplace();
  result->kind = tangent->kind;
  result->weight = tangent->weight;
  Sample<Vec4> s = to_space(Sample<Color>{color, tangent->rate, Vec4::Zero()}, space);
  const int hue = hue_index(space);
  if (hue >= 0) s.value[hue] = coordinates[hue];
  result->rate = premultiplied(s, hue).rate;
}

}  // namespace

Curve<Color> color_curve(std::span<const Key<Color>> keys, const KeyOptions& options) {
  if (keys.size() == 1) return CurveAccess::one_key(keys[0].value, keys[0].time);
  const ColorSpace space = options.space;
  const int hue = hue_index(space);
  std::vector<Stop> stops;
  const auto add = [&](const Color& color) {
    const Vec4 v = to_space(color, space);
    const bool gray = hue >= 0 && !(v[1] > 0);
    stops.push_back({v, gray});
  };
  for (const Key<Color>& key : keys) {
    if (key.value_in) add(*key.value_in);
    add(key.value);
  }
  if (hue >= 0) join_hues(stops, hue, options.hue);

  std::vector<Key<Vec4>> inner;
  std::size_t next = 0;
  const Vec4 none = Vec4::Zero();
  for (const Key<Color>& key : keys) {
    Key<Vec4> k{key.time, none, key.ease};
    Vec4 arriving = none;
    if (key.value_in) {
      arriving = stops[next++].value;
      k.value_in = premultiplied({arriving, none, none}, hue).value;
    }
    const Vec4 leaving = stops[next++].value;
    k.value = premultiplied({leaving, none, none}, hue).value;
    convert_tangent(k.out, key.out, key.value, leaving, space);
    convert_tangent(k.in, key.in, key.value_in ? *key.value_in : key.value, key.value_in ? arriving : leaving, space);
    inner.push_back(k);
  }
  KeyOptions inner_options;
  inner_options.ends = options.ends;
  inner_options.overlong = options.overlong;
  return seen_through_keys<Color>(keyed_curve<Vec4>(std::span<const Key<Vec4>>(inner), inner_options),
                                  std::make_shared<const KeyPins<Color>>(keys),
                                  [space, hue](const Sample<Vec4>& s) { return from_space(divided(s, hue), space); });
}

}  // namespace tweenfall
