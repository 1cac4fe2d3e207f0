#include "stage/size_offset.h"

#include <algorithm>

namespace tweenfall::staging {

SizeOffset size_offset(const Settle& settle, double time, const Motion& path, const Motion& shown) {
  SizeOffset offset{.settle = settle, .start = time, .shown = shown.pose.scale, .rate = shown.scale_rate};
  const Vec3 apart = shown.pose.scale - path.pose.scale, rate = shown.scale_rate - path.scale_rate;
  offset.any = !(apart.isZero(0) && rate.isZero(0));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    offset.quintic[i] = QuinticDecay(apart[axis], rate[axis], settle.seconds);
    offset.spring[i] = {apart[axis], rate[axis], settle.seconds};
  }
  return offset;
}

Sample<Vec3> settled_size(const SizeOffset& offset, double time, const Motion& path) noexcept {
  Sample<Vec3> size{path.pose.scale, path.scale_rate, Vec3::Zero()};
  const double since = std::max(0.0, time - offset.start);
  const Settle& settle = offset.settle;
  if (settle.kind == Settle::Kind::dead_blend) {
    // Source: Holden, "Dead Blending", 2023, as for places.
    if (since >= settle.seconds) return size;
    const double u = since / settle.seconds, left = 1 - u * u * (3 - 2 * u), rate = 6 * u * (1 - u) / settle.seconds;
    const Vec3 apart = offset.shown + since * offset.rate - size.value;
    size.rate += left * (offset.rate - size.rate) - rate * apart;
    size.value += left * apart;
    return size;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const Sample<double> left =
        settle.kind == Settle::Kind::quintic ? offset.quintic[i].sample(since) : offset.spring[i].sample(since);
    size.value[axis] += left.value;
    size.rate[axis] += left.rate;
  }
  return size;
}

}  // namespace tweenfall::staging
