#pragma once

// A track's curve as the keys of a glTF animation sampler.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <string>
#include <vector>

namespace tweenfall::gltf {

/// Keys as an animation sampler stores them; times strictly increase also as floats.
struct SamplerKeys {
  std::string interpolation;    ///< "STEP", "LINEAR" or "CUBICSPLINE"
  std::vector<double> times;    ///< s, >= 0
  std::vector<double> outputs;  ///< per key `parts` numbers; for CUBICSPLINE in-tangent, value and out-tangent
  std::size_t parts = 3;
};

/// The keys of a track of `clip` on a node: the curve's own where glTF has its form, else linear ones, `fps` per second
/// and wherever the curve kinks or jumps. Empty `times` for a track that glTF cannot hold.
/// @throws std::runtime_error for a clip without end or with more than ten million keys.
[[nodiscard]] SamplerKeys sampler_keys(const Clip& clip, const Track& track, const Pose& rest, double fps);

}  // namespace tweenfall::gltf
