#pragma once

// The animation stacks of an FBX file: what each drives, by layers.

#include "fbx/motion/moving.h"
#include "fbx/objects.h"

#include <map>
#include <string>
#include <vector>

namespace tweenfall::fbx {

/// How a layer's values are combined with those below it. Source: Autodesk, FBX SDK, FbxAnimLayer.
struct Layer {
  enum class Blend { add, replace, mix };

  Blend blend = Blend::add;
  Curve<double> weight{1.0};
  bool whole_rotations = true;  ///< rotations are multiplied, not added angle by angle
  bool factors = true;          ///< scales are multiplied, not added
};

/// One animated property: the curves of its parts, constant for parts without one.
struct Driver {
  std::size_t layer = 0;
  std::vector<Curve<double>> parts;  ///< in the file's units; three, or one for a number
};

struct Stack {
  std::string name;
  double end = 0;  ///< s; 0 where the file does not state it
  std::vector<Layer> layers;
  /// By object and property, lowest layer first.
  std::map<std::pair<std::size_t, std::string>, std::vector<Driver>> drivers;

  /// What drives a property; null for nothing.
  [[nodiscard]] const std::vector<Driver>* driving(std::size_t object, const std::string& property) const {
    const auto found = drivers.find({object, property});
    return found == drivers.end() ? nullptr : &found->second;
  }
};

/// All stacks in the file's order. @throws ModelError
[[nodiscard]] std::vector<Stack> read_stacks(const Objects& objects, models::ModelProblems& problems);

}  // namespace tweenfall::fbx
