#pragma once

// The slopes at both ends of every span, chosen by the rules that the keys name.

#include <tweenfall/curves/keys.h>

#include <vector>

namespace tweenfall::keying {

/// How a span is to be built.
enum class SpanKind { hold, linear, shape, cubic };

struct SlopeRequest {
  std::size_t dimensions;
  std::vector<double> durations;  ///< s, one per span
  std::vector<double> secants;    ///< U/s, `dimensions` a span
  Ends ends;
  std::vector<const Ease*> eases;       ///< one per key
  std::vector<const Ease*> span_eases;  ///< one per span: the ease whose rule makes its slopes; null where none does
};

struct Slopes {
  std::vector<double> leaving, arriving;  ///< U/s, `dimensions` a span
};

[[nodiscard]] Slopes choose_slopes(const SlopeRequest& request);

/// The kind of span i, and the ease whose rule makes its slopes (the side opposite a stated tangent is as `smooth`).
struct SpanPlan {
  SpanKind kind;
  const Ease* slopes;
};

[[nodiscard]] SpanPlan plan_span(const Ease& ease, bool has_tangents);

}  // namespace tweenfall::keying
