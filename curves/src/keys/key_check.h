#pragma once

// The checks that every list of keys must pass, whatever its values are; errors name the key.

#include <tweenfall/curves/keys.h>

#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::keying {

template <class T>
[[noreturn]] void refuse_key(std::span<const Key<T>> keys, std::size_t i, const std::string& what) {
  throw std::invalid_argument("key " + std::to_string(i) + " (time " + spans::text_of(keys[i].time) + " s, value " +
                              spans::text_of(keys[i].value) + ") " + what);
}

template <class T>
void check_tangent(std::span<const Key<T>> keys, std::size_t i, const std::optional<Tangent<T>>& tangent,
                   const char* side) {
  if (!tangent) return;
  if (tangent->kind == Tangent<T>::Kind::given && !spans::all_finite(tangent->rate))
    refuse_key(keys, i,
               std::string("has the non-finite rate ") + spans::text_of(tangent->rate) + " in \"" + side + "\"");
  if (std::is_same_v<T, Quat> && tangent->kind > TangentKind::vector)
    refuse_key(keys, i, std::string("has in \"") + side + "\" a kind of tangent that rotations do not take");
  if (!(tangent->weight > 0) || !std::isfinite(tangent->weight))
    refuse_key(keys, i,
               std::string("has the weight ") + spans::text_of(tangent->weight) + " in \"" + side +
                   "\"; a handle's share of its span must be > 0");
}

inline bool follows_other_side(TangentKind kind) {
  return kind == TangentKind::aligned || kind == TangentKind::mirrored;
}

template <class T>
void check_keys(std::span<const Key<T>> keys) {
  if (keys.empty()) throw std::invalid_argument("a curve needs at least one key; none were given");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key<T>& key = keys[i];
    if (!std::isfinite(key.time)) refuse_key(keys, i, "must have a finite time");
    if (!spans::all_finite(key.value)) refuse_key(keys, i, "must have a finite value");
    if (key.value_in && !spans::all_finite(*key.value_in))
      refuse_key(keys, i, "must have a finite arriving value; it is " + spans::text_of(*key.value_in));
    if (i > 0 && !(key.time > keys[i - 1].time))
      refuse_key(keys, i, "must come after the key before it, at " + spans::text_of(keys[i - 1].time) + " s");
    if (i > 0 && !std::isfinite(key.time - keys[0].time)) refuse_key(keys, i, "is too far from the first key");
    check_tangent(keys, i, key.in, "in");
    check_tangent(keys, i, key.out, "out");
    if (key.out && key.ease.rule() != Ease::Rule::smooth_clamped)
      refuse_key(keys, i, "has both the ease \"" + key.ease.name() + "\" and an \"out\" tangent; one of them decides");
    if (key.in && key.out && follows_other_side(key.in->kind) && follows_other_side(key.out->kind))
      refuse_key(keys, i, "has two tangents that each take the slope of the other; one of them must state a slope");
    if (key.value_in && i == 0)
      refuse_key(keys, i, "is the first, so nothing arrives and it cannot have an arriving value");
    if (key.value_in && keys[i - 1].ease.rule() == Ease::Rule::hold && !keys[i - 1].out && !key.in)
      refuse_key(keys, i, "has an arriving value, but the key before it holds its own value until then");
  }
}

}  // namespace tweenfall::keying
