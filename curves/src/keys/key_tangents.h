#pragma once

// The slopes and weights of keys that state tangents, for numbers and vectors.

#include <tweenfall/curves/handles.h>

#include "curve/curve_data.h"
#include "keys/key_check.h"
#include "keys/span_slopes.h"
#include "keys/tangent_rules.h"

namespace tweenfall::keying {

/// The slope and weight at both sides of each key, from the tangents that keys state and the slopes of their eases.
template <class T>
class KeyTangents {
 public:
  KeyTangents(std::span<const Key<T>> keys, const SlopeRequest& request, const Slopes& slopes)
      : keys_(keys), request_(request), slopes_(slopes) {}

  [[nodiscard]] T leaving(std::size_t span) const { return slope({span, Side::out}); }
  [[nodiscard]] T arriving(std::size_t span) const { return slope({span + 1, Side::in}); }
  [[nodiscard]] HandleWidths widths(std::size_t span) const {
    return {weight({span, Side::out}), weight({span + 1, Side::in})};
  }

  /// Slopes that the outer sides of the end keys state, for a curve that goes on straight.
  [[nodiscard]] std::optional<Rate<T>> before() const { return outer({0, Side::in}); }
  [[nodiscard]] std::optional<Rate<T>> after() const { return outer({keys_.size() - 1, Side::out}); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Place {
    std::size_t key;
    Side side;
  };

  [[nodiscard]] const std::optional<Tangent<T>>& tangent(const Place& p) const {
    return p.side == Side::out ? keys_[p.key].out : keys_[p.key].in;
  }
  [[nodiscard]] std::size_t span_of(const Place& p) const { return p.side == Side::out ? p.key : p.key - 1; }

  // The same key's other side; at the seam of a loop, that of the key at its other end. Key `none` where there is none.
  [[nodiscard]] Place across(const Place& p) const {
    const std::size_t last = keys_.size() - 1;
    const std::size_t end = p.side == Side::out ? 0 : last;
    const Side other = p.side == Side::out ? Side::in : Side::out;
    if (p.key != end) return {p.key, other};
    return {request_.ends == Ends::wrap ? last - end : none, other};
  }

  [[nodiscard]] double secant(std::size_t span, int c) const {
    return request_.secants[span * request_.dimensions + static_cast<std::size_t>(c)];
  }

  [[nodiscard]] double weight(const Place& p) const {
    constexpr double third = 1.0 / 3;
    const auto& own = tangent(p);
    if (!own) return third;
    if (own->kind != TangentKind::mirrored) return own->weight;
    const Place other = across(p);
    if (other.key == none) return third;
    const auto& theirs = tangent(other);
    const double length = theirs && !follows_other_side(theirs->kind) ? theirs->weight : third;
    return length * request_.durations[span_of(other)] / request_.durations[span_of(p)];
  }

  [[nodiscard]] std::optional<T> outer(const Place& p) const {
    const auto& own = tangent(p);
    if (!own) return std::nullopt;
    if (own->kind == TangentKind::given) return own->rate;
    if (own->kind == TangentKind::flat) return spans::zero_rate<T>();
    return std::nullopt;
  }

  [[nodiscard]] T slope(const Place& p) const {
    const auto& own = tangent(p);
    if (own && own->kind == TangentKind::given) return own->rate;
    T result{};
    for (int c = 0; c < spans::dimensions<T>; ++c) spans::component_of(result, c) = slope(p, c);
    return result;
  }

  [[nodiscard]] double slope(const Place& p, int c) const {
    const auto& own = tangent(p);
    if (!own) return chosen(p, c);
    switch (own->kind) {
      case TangentKind::automatic:
        return chosen(p, c);
      case TangentKind::flat:
        return 0;
      case TangentKind::given:
        return spans::component(own->rate, c);
      case TangentKind::vector:
        return secant(span_of(p), c);
      case TangentKind::aligned:
      case TangentKind::mirrored: {
        const Place other = across(p);
        if (other.key == none || (tangent(other) && follows_other_side(tangent(other)->kind))) return chosen(p, c);
        return slope(other, c);
      }
      default:
        return from_neighbors(p, c);
    }
  }

  [[nodiscard]] double from_neighbors(const Place& p, int c) const {
    const Place other = across(p);
    if (other.key == none) return 0;
    const Place in = p.side == Side::in ? p : other, out = p.side == Side::in ? other : p;
    const std::size_t a = span_of(in), b = span_of(out);
    return neighbor_slope(tangent(p)->kind, {secant(a, c), secant(b, c), request_.durations[a], request_.durations[b],
                                             weight(in), weight(out)});
  }

  // The slope of the span itself at a side that states none.
  [[nodiscard]] double chosen(const Place& p, int c) const {
    const std::size_t span = span_of(p);
    if (request_.span_eases[span]) {
      const std::vector<double>& rule = p.side == Side::out ? slopes_.leaving : slopes_.arriving;
      return rule[span * request_.dimensions + static_cast<std::size_t>(c)];
    }
    const Ease& ease = keys_[span].ease;
    if (ease.rule() == Ease::Rule::hold) return 0;
    if (ease.rule() != Ease::Rule::shape) return secant(span, c);
    return secant(span, c) * (p.side == Side::out ? ease.progress(0) : ease.progress(1, Side::in)).rate;
  }

  std::span<const Key<T>> keys_;
  const SlopeRequest& request_;
  const Slopes& slopes_;
};

}  // namespace tweenfall::keying
