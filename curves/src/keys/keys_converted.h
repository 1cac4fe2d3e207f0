#pragma once

// Curves whose keys are interpolated in coordinates other than those of their values. Keys were checked before.

#include <tweenfall/curves/keys.h>

namespace tweenfall::keying {

[[nodiscard]] Curve<Quat> rotation_curve(std::span<const Key<Quat>> keys, const KeyOptions& options);

[[nodiscard]] Curve<Color> color_curve(std::span<const Key<Color>> keys, const KeyOptions& options);

/// @throws std::invalid_argument naming the key where a value is not > 0.
template <class T>
[[nodiscard]] Curve<T> logarithmic_curve(std::span<const Key<T>> keys, const KeyOptions& options);

}  // namespace tweenfall::keying
