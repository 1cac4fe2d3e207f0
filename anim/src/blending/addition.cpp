#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/elementary.h>

namespace tweenfall {

namespace blending {
namespace {

// s r^w with its rate.
void grow(double& scale, double& rate, double ratio, double ratio_rate, double weight, double weight_rate) noexcept {
  double factor, factor_rate;
  if (ratio == 1 && ratio_rate == 0) return;
  if (ratio > 0) {
    const double logarithm = elementary::log(ratio);
    factor = weight == 0 ? 1 : weight == 1 ? ratio : elementary::exp(weight * logarithm);
    factor_rate = factor * (weight_rate * logarithm + weight * (ratio_rate / ratio));
  } else {
    factor = 1 + weight * (ratio - 1);
    factor_rate = weight_rate * (ratio - 1) + weight * ratio_rate;
  }
  rate = rate * factor + scale * factor_rate;
  scale *= factor;
}

}  // namespace
}  // namespace blending

Motion difference(const Motion& reference, const Motion& pose) noexcept {
  Motion result;
  const Quat back = reference.pose.rotation.conjugate();
  result.pose.position = pose.pose.position - reference.pose.position;
  result.pose.rotation = back * pose.pose.rotation;
  result.twist.linear = pose.twist.linear - reference.twist.linear;
  result.twist.angular = back * Vec3(pose.twist.angular - reference.twist.angular);
  for (int i = 0; i < 3; ++i) {
    const double from = reference.pose.scale[i], to = pose.pose.scale[i];
    if (from == 0) continue;
    result.pose.scale[i] = to / from;
    result.scale_rate[i] = (pose.scale_rate[i] - result.pose.scale[i] * reference.scale_rate[i]) / from;
  }
  return result;
}

Motion add(const Motion& base, const Motion& difference, const Sample<double>& weight) noexcept {
  const double w = weight.value, w_rate = weight.rate;
  if (w == 0 && w_rate == 0) return base;
  // The part of the difference is a mix of the identity and the whole difference.
  const Motion part = mix(Motion{}, difference, w, w_rate);
  Motion result = base;
  result.pose.position += part.pose.position;
  result.twist.linear += part.twist.linear;
  if (w != 0) result.pose.rotation = base.pose.rotation * part.pose.rotation;
  result.twist.angular += base.pose.rotation * part.twist.angular;
  for (int i = 0; i < 3; ++i)
    blending::grow(result.pose.scale[i], result.scale_rate[i], difference.pose.scale[i], difference.scale_rate[i], w,
                   w_rate);
  return result;
}

void difference(std::span<const Motion> reference, std::span<const Motion> pose, std::span<Motion> out) noexcept {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = difference(reference[i], pose[i]);
}

void add(std::span<const Motion> base, std::span<const Motion> difference, const Sample<double>& weight,
         std::span<Motion> out, const JointMask& mask) noexcept {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = add(base[i], difference[i], {mask[i] * weight.value, mask[i] * weight.rate, 0});
}

}  // namespace tweenfall
