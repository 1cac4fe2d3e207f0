#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/symmetric_eigen.h>

#include <stdexcept>

#include "curve/components.h"

namespace tweenfall {

Quat weighted_mean(std::span<const Quat> rotations, std::span<const double> weights) {
  if (rotations.empty()) throw std::invalid_argument("a mean needs at least one rotation; none were given");
  if (weights.size() != rotations.size())
    throw std::invalid_argument("a mean needs one weight per rotation; there are " + std::to_string(weights.size()) +
                                " weights and " + std::to_string(rotations.size()) + " rotations");
  double largest = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::string name = "rotation " + std::to_string(i) + " (" + spans::text_of(rotations[i]) + ") ";
    if (!(weights[i] >= 0) || !std::isfinite(weights[i]))
      throw std::invalid_argument(name + "has the weight " + spans::text_of(weights[i]) +
                                  "; it must be finite and >= 0");
    if (!(std::abs(rotations[i].coeffs().squaredNorm() - 1) <= 2e-6))
      throw std::invalid_argument(name + "must have unit length");
    largest = std::max(largest, weights[i]);
  }
  if (!(largest > 0)) throw std::invalid_argument("a mean needs a weight that is not zero");
  if (rotations.size() == 1) return rotations[0];
  using Mat4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;
  Mat4 sum = Mat4::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Vec4 q = rotations[i].coeffs();
    sum += (weights[i] / largest) * q * q.transpose();
  }
  const Vec4 q = symmetric_eigen(sum).vectors.col(0);
  return hemisphere_aligned(normalized(Quat(q[3], q[0], q[1], q[2])), rotations[0]);
}

}  // namespace tweenfall
