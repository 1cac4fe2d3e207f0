#include "handles/handle_places.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/components.h"
#include "keys/tangent_rules.h"

namespace tweenfall::handling {
namespace {

// The length of an automatic handle, as a share of the span. Source: Blender, calchandleNurb_intern.
constexpr double automatic_share = 1 / 2.5614;

[[noreturn]] void refuse(std::span<const HandleKey> keys, std::size_t i, const std::string& what) {
  throw std::invalid_argument("key " + std::to_string(i) + " (time " + spans::text_of(keys[i].time) + " s, value " +
                              spans::text_of(keys[i].value) + ") " + what);
}

void check(std::span<const HandleKey> keys) {
  if (keys.empty()) throw std::invalid_argument("a curve needs at least one key; none were given");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const HandleKey& key = keys[i];
    if (!std::isfinite(key.time)) refuse(keys, i, "must have a finite time");
    if (!std::isfinite(key.value)) refuse(keys, i, "must have a finite value");
    if (i > 0 && !(key.time > keys[i - 1].time))
      refuse(keys, i, "must come after the key before it, at " + spans::text_of(keys[i - 1].time) + " s");
    for (const Handle* handle : {&key.in, &key.out}) {
      const bool in = handle == &key.in;
      if (handle->kind != TangentKind::given && handle->kind != TangentKind::aligned) continue;
      const std::string side = in ? "\"in\"" : "\"out\"";
      if (!std::isfinite(handle->time) || !std::isfinite(handle->value))
        refuse(keys, i,
               "has the non-finite handle (" + spans::text_of(handle->time) + ", " + spans::text_of(handle->value) +
                   ") in " + side);
      const bool inner = in ? i > 0 : i + 1 < keys.size();
      if (inner && handle->kind == TangentKind::given && (in ? handle->time > key.time : handle->time < key.time))
        refuse(keys, i,
               "has its handle " + side + " at " + spans::text_of(handle->time) + " s; it must not lie " +
                   (in ? "after" : "before") + " the key");
    }
  }
}

// Both sides of key i as its handles see them: around a loop from its other end, at an open end mirrored.
keying::KeyNeighbors neighbors_of(const std::vector<PlacedKey>& keys, std::size_t i, Ends ends) {
  const std::size_t last = keys.size() - 1;
  const auto secant = [&keys](std::size_t span) {
    return (keys[span + 1].value - keys[span].value) / (keys[span + 1].time - keys[span].time);
  };
  const auto duration = [&keys](std::size_t span) { return keys[span + 1].time - keys[span].time; };
  const bool wrap = ends == Ends::wrap;
  const std::size_t before = i > 0 ? i - 1 : wrap ? last - 1 : 0;
  const std::size_t after = i < last ? i : wrap ? 0 : last - 1;
  return {secant(before), secant(after), duration(before), duration(after)};
}

void put_automatic(PlacedKey& key, const keying::KeyNeighbors& n, bool open_end, bool even_acceleration) {
  double before = n.duration_before, after = n.duration_after, share = automatic_share;
  if (even_acceleration) {
    share = 1.0 / 3;
  } else {
    before = std::min(before, 5 * after);
    after = std::min(after, 5 * before);
  }
  const double in_time = share * before, out_time = share * after;
  double slope = keying::neighbor_slope(TangentKind::automatic, n), in_slope = slope, out_slope = slope;
  if (!open_end && (key.in_kind == TangentKind::auto_clamped || key.out_kind == TangentKind::auto_clamped)) {
    const bool in_clamped = key.in_kind == TangentKind::auto_clamped;
    const bool out_clamped = key.out_kind == TangentKind::auto_clamped;
    if (keying::is_extreme(n.secant_before, n.secant_after)) {
      if (in_clamped) in_slope = 0;
      if (out_clamped) out_slope = 0;
      key.locked = true;
    } else {
      // Where both handles would leave the values of their spans, the arriving side decides.
      const double in_most = std::abs(n.secant_before) * n.duration_before / in_time;
      const double out_most = std::abs(n.secant_after) * n.duration_after / out_time;
      const double size = std::abs(slope);
      const double limit = in_clamped && size > in_most ? in_most : out_clamped && size > out_most ? out_most : size;
      in_slope = out_slope = std::clamp(slope, -limit, limit);
      // Limiting one side turns the other with it, whatever its kind.
      if (limit < size) {
        key.in.value = in_slope * key.in.time;
        key.out.value = out_slope * key.out.time;
      }
    }
  }
  if (is_smooth(key.in_kind)) key.in = {in_time, in_slope * in_time};
  if (is_smooth(key.out_kind)) key.out = {out_time, out_slope * out_time};
}

// Places handles of the kinds that have a slope of their own and a third of the span as length.
void put_third(HandleReach& reach, TangentKind kind, double secant, double duration, const keying::KeyNeighbors& n,
               bool open_end) {
  if (kind == TangentKind::given || kind == TangentKind::aligned || kind == TangentKind::mirrored || is_smooth(kind))
    return;
  const double slope = kind == TangentKind::vector ? secant : open_end ? 0 : keying::neighbor_slope(kind, n);
  reach = {duration / 3, slope * (duration / 3)};
}

}  // namespace
}  // namespace tweenfall::handling

namespace tweenfall {

void handling::align_handles(handling::PlacedKey& key) noexcept {
  if (key.in_kind == TangentKind::mirrored) {
    key.in = key.out;
    return;
  }
  if (key.out_kind == TangentKind::mirrored) {
    key.out = key.in;
    return;
  }
  if (key.in_kind == TangentKind::given || key.out_kind == TangentKind::given) return;
  const double in = std::sqrt(key.in.time * key.in.time + key.in.value * key.in.value);
  const double out = std::sqrt(key.out.time * key.out.time + key.out.value * key.out.value);
  if (key.out_kind == TangentKind::aligned && in > 0)
    key.out = {out / in * key.in.time, out / in * key.in.value};
  else if (key.in_kind == TangentKind::aligned && out > 0)
    key.in = {in / out * key.out.time, in / out * key.out.value};
}

std::vector<HandleKey> placed_handles(std::span<const HandleKey> keys, const HandleOptions& options) {
  handling::check(keys);
  std::vector<handling::PlacedKey> placed;
  for (const HandleKey& key : keys) {
    handling::PlacedKey p{key.time, key.value, key.in.kind, key.out.kind, {}, {}};
    if (key.in.kind == TangentKind::given || key.in.kind == TangentKind::aligned)
      p.in = {key.time - key.in.time, key.value - key.in.value};
    if (key.out.kind == TangentKind::given || key.out.kind == TangentKind::aligned)
      p.out = {key.out.time - key.time, key.out.value - key.value};
    placed.push_back(p);
  }
  if (keys.size() > 1) {
    for (std::size_t i = 0; i < placed.size(); ++i) {
      handling::PlacedKey& p = placed[i];
      const bool open_end = options.ends != Ends::wrap && (i == 0 || i + 1 == placed.size());
      const keying::KeyNeighbors n = handling::neighbors_of(placed, i, options.ends);
      if (handling::is_smooth(p.in_kind) || handling::is_smooth(p.out_kind))
        handling::put_automatic(p, n, open_end, options.even_acceleration);
      handling::put_third(p.in, p.in_kind, n.secant_before, n.duration_before, n, open_end);
      handling::put_third(p.out, p.out_kind, n.secant_after, n.duration_after, n, open_end);
      handling::align_handles(p);
      if (open_end && options.ends == Ends::flat && handling::is_smooth(p.in_kind) && handling::is_smooth(p.out_kind)) {
        p.in.value = p.out.value = 0;
        p.locked = true;
      }
    }
    if (options.even_acceleration) handling::smooth_handles(placed, options.ends);
  }
  std::vector<HandleKey> result(keys.begin(), keys.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const handling::PlacedKey& p = placed[i];
    Handle &in = result[i].in, &out = result[i].out;
    // Given handles that did not move keep their places to the bit.
    if (in.kind != TangentKind::given || p.value - in.value != p.in.value)
      in = {TangentKind::given, p.time - p.in.time, p.value - p.in.value};
    if (out.kind != TangentKind::given || out.value - p.value != p.out.value)
      out = {TangentKind::given, p.time + p.out.time, p.value + p.out.value};
  }
  return result;
}

}  // namespace tweenfall
