#include <algorithm>
#include <stdexcept>

#include <tweenfall/curves/handles.h>

#include "curve/components.h"
#include "curve/time_bezier.h"

namespace tweenfall::handling {
namespace {

struct Point {
  double time, value;
};

Point between(const Point& a, const Point& b, double s) noexcept {
  return {a.time + s * (b.time - a.time), a.value + s * (b.value - a.value)};
}

// Handles as the curve uses them: no longer than the rule allows.
void shorten(HandleKey& a, HandleKey& b, Overlong rule) {
  const double duration = b.time - a.time;
  const HandleWidths asked{(a.out.time - a.time) / duration, (b.time - b.in.time) / duration};
  const HandleWidths fit = resolved(asked, rule);
  if (fit.start != asked.start) {
    const Point end = between({a.time, a.value}, {a.out.time, a.out.value}, fit.start / asked.start);
    a.out = {TangentKind::given, end.time, end.value};
  }
  if (fit.end != asked.end) {
    const Point end = between({b.time, b.value}, {b.in.time, b.in.value}, fit.end / asked.end);
    b.in = {TangentKind::given, end.time, end.value};
  }
}

// Source: de Casteljau's subdivision.
HandleKey divided(HandleKey& a, HandleKey& b, double time) {
  const double duration = b.time - a.time;
  const Warp warp = spans::time_bezier_warp((a.out.time - a.time) / duration, (b.in.time - a.time) / duration);
  const double s = warp.function((time - a.time) / duration, warp.parameters).s;
  const Point first{a.out.time, a.out.value}, second{b.in.time, b.in.value};
  const Point start = between({a.time, a.value}, first, s), middle = between(first, second, s),
              end = between(second, {b.time, b.value}, s);
  const Point in = between(start, middle, s), out = between(middle, end, s);
  a.out = {TangentKind::given, start.time, start.value};
  b.in = {TangentKind::given, end.time, end.value};
  HandleKey key{time, between(in, out, s).value};
  key.in = {TangentKind::given, std::min(in.time, time), in.value};
  key.out = {TangentKind::given, std::max(out.time, time), out.value};
  return key;
}

// The new key on a span that leaves `a`, key number `index`, by an ease.
HandleKey between(const HandleKey& a, const HandleKey& b, double time, std::size_t index) {
  double value = a.value;
  if (a.ease->rule() == Ease::Rule::linear)
    value = a.value + (time - a.time) / (b.time - a.time) * (b.value - a.value);
  else if (a.ease->rule() != Ease::Rule::hold)
    throw std::invalid_argument("a key cannot be inserted into the ease \"" + a.ease->name() + "\" that leaves key " +
                                std::to_string(index));
  const Handle handle{TangentKind::given, time, value};
  return {time, value, handle, handle, a.ease};
}

}  // namespace
}  // namespace tweenfall::handling

namespace tweenfall {

std::vector<HandleKey> insert_key(std::span<const HandleKey> keys, double time, const HandleOptions& options) {
  std::vector<HandleKey> result = placed_handles(keys, options);
  if (!(time >= result.front().time && time <= result.back().time))
    throw std::invalid_argument("a key can be inserted from " + spans::text_of(result.front().time) + " s to " +
                                spans::text_of(result.back().time) + " s, not at " + spans::text_of(time) + " s");
  for (std::size_t i = 0; i + 1 < result.size(); ++i)
    if (!result[i].ease) handling::shorten(result[i], result[i + 1], options.overlong);
  const auto next =
      std::find_if(result.begin(), result.end(), [time](const HandleKey& key) { return key.time >= time; });
  if (next->time == time) return result;
  HandleKey &b = *next, &a = *(next - 1);
  const auto place = next - result.begin();
  const HandleKey key =
      a.ease ? handling::between(a, b, time, static_cast<std::size_t>(place - 1)) : handling::divided(a, b, time);
  result.insert(next, key);
  return result;
}

}  // namespace tweenfall
