#pragma once

// A glTF animation sampler as a curve: STEP, LINEAR and CUBICSPLINE become exactly those.

#include <tweenfall/anim/track.h>

#include <vector>

namespace tweenfall::gltf {

enum class Interpolation { step, linear, cubic };

/// A sampler's keys, already checked: times strictly increase; the outputs have `width` numbers for each key or, if
/// cubic, three times as many: in-tangents, values, out-tangents.
struct Sampler {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;  ///< s
  std::vector<double> outputs;
  std::size_t width = 3;

  [[nodiscard]] const double* value(std::size_t key) const { return part(key, 1); }
  [[nodiscard]] const double* in(std::size_t key) const { return part(key, 0); }
  [[nodiscard]] const double* out(std::size_t key) const { return part(key, 2); }

 private:
  [[nodiscard]] const double* part(std::size_t key, std::size_t which) const {
    const bool cubic = interpolation == Interpolation::cubic;
    return outputs.data() + (cubic ? (3 * key + which) * width : key * width);
  }
};

/// @throws std::invalid_argument for a value that no curve can hold, such as a zero quaternion.
[[nodiscard]] Curve<Vec3> vector_curve(const Sampler& sampler);
[[nodiscard]] Curve<Quat> rotation_curve(const Sampler& sampler);
[[nodiscard]] WeightCurves weight_curves(const Sampler& sampler);

}  // namespace tweenfall::gltf
