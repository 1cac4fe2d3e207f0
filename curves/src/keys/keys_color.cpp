#include "color/alpha.h"
#include "keys/key_check.h"
#include "keys/key_pins.h"
#include "keys/keys_converted.h"

namespace tweenfall::keying {
namespace {

constexpr double full_turn = 0x1.921fb54442d18p+2;

// The turn from one hue to another, both from 0 to a full turn.
// Source: W3C, "CSS Color Module Level 4", 12.4: between equal hues the longer way is a whole turn upward; between
// opposite ones both ways follow the numbers.
double hue_step(double from, double to, HueRule rule) noexcept {
  constexpr double same = 1e-9;  // tolerance for hues to be equal or opposite: the rounding of their colors
  double step = to - from;       // the shorter way
  const bool opposite = std::abs(std::abs(step) - full_turn / 2) <= same;
  if (step > full_turn / 2 && !opposite) step -= full_turn;
  if (step < -full_turn / 2 && !opposite) step += full_turn;
  const bool equal = std::abs(step) <= same;
  switch (rule) {
    case HueRule::shorter:
      return step;
    case HueRule::longer:
      if (opposite) return step;
      return step > 0 && !equal ? step - full_turn : step + full_turn;
    case HueRule::increasing:
      return step < 0 && !equal ? step + full_turn : step;
    case HueRule::decreasing:
      return step > 0 && !equal ? step - full_turn : step;
  }
  return step;
}

// Coordinates at a key, arriving and leaving.
struct Stop {
  Vec4 arriving, leaving;
  bool jumps;  // the arriving color differs from the leaving one
};

// A hue that counts the turns made on the way to it.
class TurnedHue {
 public:
  [[nodiscard]] double angle() const noexcept { return angle_; }
  void turn_to(double hue, HueRule rule) noexcept {
    // From 0 to a full turn, the angle of the color without the turns, which would round it.
    const double to = hue < 0 ? hue + full_turn : hue;
    angle_ += hue_step(hue_, to, rule);
    hue_ = to;
  }
  /// To the same hue again, for a color without a hue, which takes that of the other end.
  void turn_to_itself(HueRule rule) noexcept { angle_ += hue_step(hue_, hue_, rule); }

 private:
  double hue_ = 0, angle_ = 0;
};

// A color that shows no hue takes that of the other end of its span: it may arrive with one and leave with another.
// Source: W3C, "CSS Color Module Level 4", 12.2.
void join_hues(std::vector<Stop>& stops, ColorSpace space, HueRule rule) {
  const int hue = hue_index(space);
  const auto shows = [space](const Vec4& v) { return v[3] != 0 && has_hue(v, space); };
  TurnedHue last;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    Vec4 &from = stops[i].leaving, &to = stops[i + 1].arriving;
    const bool from_shows = shows(from), to_shows = shows(to);
    if (from_shows ? i == 0 || stops[i].jumps : to_shows) last.turn_to((from_shows ? from : to)[hue], HueRule::shorter);
    from[hue] = last.angle();
    if (from_shows && to_shows)
      last.turn_to(to[hue], rule);
    else if (from_shows || to_shows)
      last.turn_to_itself(rule);
    to[hue] = last.angle();
  }
  Vec4& final = stops.back().leaving;
  if (shows(final)) last.turn_to(final[hue], HueRule::shorter);
  final[hue] = last.angle();
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
  result->rate = color_spaces::premultiplied(s, hue).rate;
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

Curve<Color> keying::color_curve(std::span<const Key<Color>> keys, const KeyOptions& options) {
  if (keys.size() == 1) return CurveAccess::one_key(keys[0].value, keys[0].time);
  const ColorSpace space = options.space;
  const int hue = hue_index(space);
  std::vector<keying::Stop> stops;
  for (const Key<Color>& key : keys)
    stops.push_back({to_space(key.value_in ? *key.value_in : key.value, space), to_space(key.value, space),
                     key.value_in.has_value()});
  if (hue >= 0) keying::join_hues(stops, space, options.hue);

  std::vector<Key<Vec4>> inner;
  const Vec4 none = Vec4::Zero();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key<Color>& key = keys[i];
    const Vec4 &arriving = stops[i].arriving, &leaving = stops[i].leaving;
    Key<Vec4> k{key.time, color_spaces::premultiplied({leaving, none, none}, hue).value, key.ease};
    const bool held = i > 0 && keys[i - 1].ease.rule() == Ease::Rule::hold && !keys[i - 1].out && !key.in;
    if (i > 0 && !held && (key.value_in || arriving != leaving))
      k.value_in = color_spaces::premultiplied({arriving, none, none}, hue).value;
    keying::convert_tangent(k.out, key.out, key.value, leaving, space);
    keying::convert_tangent(k.in, key.in, key.value_in ? *key.value_in : key.value, arriving, space);
    inner.push_back(k);
  }
  KeyOptions inner_options;
  inner_options.ends = options.ends;
  inner_options.overlong = options.overlong;
  return keying::seen_through_keys<Color>(
      keyed_curve<Vec4>(std::span<const Key<Vec4>>(inner), inner_options),
      std::make_shared<const keying::KeyPins<Color>>(keys),
      [space, hue](const Sample<Vec4>& s) { return from_space(color_spaces::divided(s, hue), space); });
}

}  // namespace tweenfall
