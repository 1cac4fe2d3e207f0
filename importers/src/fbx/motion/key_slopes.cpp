#include "fbx/motion/key_slopes.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::fbx {

namespace {

/// A weight from its four decimals; 3333 means exactly a third.
double weight_of(std::uint32_t packed) {
  if (packed == 3333) return 1.0 / 3;
  return std::clamp(static_cast<double>(packed) * 1e-4, 1e-4, 1.0);
}

/// A key between two others, for the automatic rule.
struct Between {
  const FileKey &before, &key, &after;

  [[nodiscard]] double secant_in() const { return (key.value - before.value) / (key.time - before.time); }
  [[nodiscard]] double secant_out() const { return (after.value - key.value) / (after.time - key.time); }
  [[nodiscard]] double chord() const { return (after.value - before.value) / (after.time - before.time); }
};

/// The part of an automatic key's bias beyond 500 adds a slope of its own.
double beyond(double bias) {
  const double excess = std::abs(bias) / 100 - 5;
  return excess > 0 ? excess * excess * 40 : 0;
}

/// Limits the slope so that the curve stays within the neighbors' values.
double within(double slope, const Between& at, const KeySlopes& weights) {
  const double sign = slope >= 0 ? 1 : -1;
  const auto most = [&](double change, double range) { return range > 0 ? std::max(sign * change / range, 0.0) : 0.0; };
  return sign * std::min({sign * slope,
                          most(at.key.value - at.before.value, weights.in_weight * (at.key.time - at.before.time)),
                          most(at.after.value - at.key.value, weights.out_weight * (at.after.time - at.key.time))});
}

/// Whether two values are equal, for clamping; files state values as floats.
bool level(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

/// The automatic slope. Source: as found by ufbx; the mix of secants is that of Maya's auto tangents.
double automatic(const Between& at, double bias, const KeySlopes& weights) {
  const std::uint32_t flags = at.key.flags;
  if ((flags & key_clamp) && (level(at.key.value, at.before.value) || level(at.key.value, at.after.value))) return 0;
  double slope = at.chord();
  if (!(flags & key_time_independent)) {
    const double in = at.secant_in(), out = at.secant_out();
    const double share = (at.key.time - at.before.time) / (at.after.time - at.before.time);
    slope = slope / 2 + (in * (1 - share) + out * share) / 2;
    const double weight = std::abs(bias) / 100;
    if (weight > 0.0001) {
      const double target = bias > 0 ? out : in, change = target - slope;
      slope = slope * (1 - weight) + target * weight;
      slope += std::copysign(beyond(bias), std::abs(change) > 0.00001 ? change : bias);
    }
  }
  return flags & key_clamp_progressive ? within(slope, at, weights) : slope;
}

/// The same for the first and the last key, which have one neighbor.
double automatic_end(const FileKey& key, const FileKey& neighbor, double bias) {
  if (key.flags & key_clamp_progressive) return 0;
  if ((key.flags & key_clamp) && level(key.value, neighbor.value)) return 0;
  double slope = (neighbor.value - key.value) / (neighbor.time - key.time);
  if (!(key.flags & key_time_independent)) slope += std::copysign(beyond(bias), bias);
  return slope;
}

/// Source: Kochanek and Bartels, "Interpolating splines with local tension, continuity and bias control", 1984.
void set_tcb(const std::vector<FileKey>& keys, std::size_t i, KeySlopes& slopes) {
  const FileKey& key = keys[i];
  const bool edge = i == 0 || i + 1 == keys.size();
  const double in = i > 0 ? (key.value - keys[i - 1].value) / (key.time - keys[i - 1].time) : 0;
  const double out = i + 1 < keys.size() ? (keys[i + 1].value - key.value) / (keys[i + 1].time - key.time) : 0;
  const double tension = static_cast<double>(key.data[0]), continuity = static_cast<double>(key.data[1]);
  const double bias = static_cast<double>(key.data[2]);
  const double common = (edge ? 1 : 0.5) * (1 - tension);
  slopes.in = common * ((1 + bias) * (1 - continuity) * in + (1 - bias) * (1 + continuity) * out);
  slopes.out = common * ((1 + bias) * (1 + continuity) * in + (1 - bias) * (1 - continuity) * out);
}

void set_automatic(const std::vector<FileKey>& keys, std::size_t i, KeySlopes& slopes) {
  const FileKey& key = keys[i];
  const double in_bias = -slopes.in, out_bias = slopes.out;
  if (i > 0 && i + 1 < keys.size()) {
    const Between at{keys[i - 1], key, keys[i + 1]};
    const bool one = std::abs(slopes.in + slopes.out) <= 0.0001;
    slopes.out = automatic(at, out_bias, slopes);
    slopes.in = one ? slopes.out : automatic(at, in_bias, slopes);
  } else if (keys.size() > 1) {
    slopes.in = slopes.out = automatic_end(key, i > 0 ? keys[i - 1] : keys[i + 1], i > 0 ? in_bias : out_bias);
  } else {
    slopes.in = slopes.out = 0;
  }
}

}  // namespace

std::vector<KeySlopes> key_slopes(const std::vector<FileKey>& keys) {
  std::vector<KeySlopes> all(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const FileKey& key = keys[i];
    KeySlopes& slopes = all[i];
    // A key states its own slope to the right and the next key's to the left. Where the rule is automatic these two
    // numbers are biases instead.
    slopes.out = static_cast<double>(key.data[0]);
    double next_in = static_cast<double>(key.data[1]), next_weight = 1.0 / 3;
    if (key.flags & key_weighted_right) slopes.out_weight = weight_of(key.packed_weights & 0xffff);
    if (key.flags & key_weighted_next_left) next_weight = weight_of(key.packed_weights >> 16);
    if (key.flags & key_constant) {
      slopes.out = next_in = 0;
      slopes.out_weight = next_weight = 1.0 / 3;
    } else if (key.flags & key_cubic) {
      if (key.flags & key_tcb) {
        set_tcb(keys, i, slopes);
        next_in = 0;
        next_weight = 1.0 / 3;
      } else if (!(key.flags & key_user)) {
        set_automatic(keys, i, slopes);
      }
    } else {
      slopes.out_weight = next_weight = 1.0 / 3;
      slopes.out = next_in = i + 1 < keys.size() ? (keys[i + 1].value - key.value) / (keys[i + 1].time - key.time) : 0;
    }
    if (i + 1 < keys.size()) {
      all[i + 1].in = next_in;
      all[i + 1].in_weight = next_weight;
    }
  }
  return all;
}

}  // namespace tweenfall::fbx
