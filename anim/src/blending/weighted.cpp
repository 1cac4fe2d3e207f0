#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/barycentric.h>

#include "blending/mixer.h"

namespace tweenfall {

void blend(std::span<const PoseLayer> layers, std::span<const Motion> rest, std::span<Motion> out,
           double least) noexcept {
  const auto mean = [](std::span<const Motion> motions, std::span<const Sample<double>> shares) noexcept {
    const double all = shares[0].value + shares[1].value;
    if (shares.size() > 2 || !(all > 0)) return barycentric(motions, shares);
    const double share = shares[1].value / all;
    return mix(motions[0], motions[1], share, (shares[1].rate - share * (shares[0].rate + shares[1].rate)) / all);
  };
  blending::Mixer<Motion, decltype(mean)> mixer(mean);
  for (std::size_t joint = 0; joint < out.size(); ++joint) {
    const auto weight = [&layers, joint](std::size_t i) noexcept {
      const double part = layers[i].mask ? (*layers[i].mask)[joint] : 1;
      const Sample<double> given = blending::above_nothing(layers[i].weight);
      return Sample<double>{part * given.value, part * given.rate, 0};
    };
    const auto value = [&layers, joint](std::size_t i) noexcept -> const Motion& { return layers[i].pose[joint]; };
    const bool any = blending::fill(mixer, layers.size(), weight, value, rest[joint], least);
    out[joint] = any ? mixer.mixed() : rest[joint];
  }
}

}  // namespace tweenfall
