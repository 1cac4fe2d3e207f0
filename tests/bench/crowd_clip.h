#pragma once

// The figure and the clip on which speeds of animation are compared: 67 joints in a spine and limbs of five, ten
// seconds at 30 keys per second on position, rotation and scale of every joint.

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace tweenfall::bench {

inline double unit_hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x / 4294967296.0;
}

struct CrowdFigure {
  static constexpr std::uint32_t frames = 301;
  static constexpr double duration = 10;

  static double random(std::uint32_t joint, std::uint32_t salt) { return unit_hash(977 * joint + 131071 * salt + 17); }

  static double wave(double hz, double time, double phase) {
    return std::sin(2 * std::numbers::pi * (hz * time + phase));
  }

  static std::size_t parent_of(std::uint32_t joint) {
    if (joint == 0) return no_node;
    if (joint < 5 || (joint - 5) % 5 > 0) return joint - 1;
    return (joint - 5) / 5 % 5;
  }

  static Vec3 position(std::uint32_t joint, double time) {
    Vec3 p;
    for (std::uint32_t c = 0; c < 3; ++c)
      p[c] = 0.007 * wave(0.3 + 0.7 * random(joint, 10 + c), time, random(joint, 30 + c)) +
             0.003 * wave(1 + 1.5 * random(joint, 20 + c), time, random(joint, 40 + c));
    p.y() += 0.12;
    if (joint == 0) p += Vec3(0, 0.9 + 0.05 * wave(1.8, time, 0), 1.5 * time);
    return p;
  }

  static Quat rotation(std::uint32_t joint, double time) {
    Vec3 r;
    for (std::uint32_t c = 0; c < 3; ++c)
      r[c] = 0.40 * wave(0.4 + 0.6 * random(joint, 50 + c), time, random(joint, 70 + c)) +
             0.10 * wave(1.2 + 1.8 * random(joint, 60 + c), time, random(joint, 80 + c));
    return exp_map(r);
  }

  static Vec3 scale(std::uint32_t joint, double time) {
    Vec3 s;
    for (std::uint32_t c = 0; c < 3; ++c) s[c] = 1 + 0.02 * wave(0.5, time, random(joint, 90 + c));
    return s;
  }

  static std::shared_ptr<const Hierarchy> nodes(std::uint32_t joints) {
    auto all = std::make_shared<Hierarchy>();
    for (std::uint32_t joint = 0; joint < joints; ++joint)
      all->add({"joint" + std::to_string(joint), parent_of(joint), {.position = {0, 0.12, 0}}});
    return all;
  }

  static Clip clip(std::uint32_t joints, const Ease& ease) {
    Clip clip{.name = "crowd", .duration = duration, .loop = {.mode = LoopMode::repeat}};
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
      std::vector<Key<Vec3>> positions, scales;
      std::vector<Key<Quat>> rotations;
      for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const double time = frame / 30.0;
        positions.push_back({.time = time, .value = position(joint, time), .ease = ease});
        rotations.push_back({.time = time, .value = rotation(joint, time), .ease = ease});
        scales.push_back({.time = time, .value = scale(joint, time), .ease = ease});
      }
      const std::string name = "joint" + std::to_string(joint);
      clip.tracks.push_back({name, "position", keyed_curve<Vec3>(positions)});
      clip.tracks.push_back({name, "rotation", keyed_curve<Quat>(rotations)});
      clip.tracks.push_back({name, "scale", keyed_curve<Vec3>(scales)});
    }
    return clip;
  }
};

}  // namespace tweenfall::bench
