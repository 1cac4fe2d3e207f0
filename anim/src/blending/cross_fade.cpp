#include <tweenfall/anim/blend.h>

namespace tweenfall {

void cross_fade(std::span<const Motion> a, std::span<const Motion> b, const Sample<double>& weight,
                std::span<Motion> out, const JointMask& mask) noexcept {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = mix(a[i], b[i], mask[i] * weight.value, mask[i] * weight.rate);
}

}  // namespace tweenfall
