#include "fbx/motion/stacks.h"

#include "fbx/motion/key_curve.h"
#include "model/model_names.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace tweenfall::fbx {

namespace {

/// Properties that move a node or morph a mesh; others in the file are for lights, materials and the like.
const std::set<std::string_view>& read_properties() {
  static const std::set<std::string_view> all{"Lcl Translation", "Lcl Rotation",  "Lcl Scaling",  "RotationOffset",
                                              "RotationPivot",   "ScalingOffset", "ScalingPivot", "PreRotation",
                                              "PostRotation",    "DeformPercent", "Weight"};
  return all;
}

std::size_t part_of(std::string_view property) {
  return property.ends_with('Y') ? 1 : property.ends_with('Z') ? 2 : 0;
}

/// A share from 0 to 1 from percent, at rest where it is clamped.
Sample<double> share(const Sample<double>& percent) {
  if (percent.value < 0) return {0, 0, 0};
  if (percent.value > 99.999) return {1, 0, 0};
  return {percent.value / 100, percent.rate / 100, percent.acceleration / 100};
}

class StackReader {
 public:
  StackReader(const Objects& objects, models::ModelProblems& problems) : objects_(objects), problems_(problems) {}

  Stack read(std::size_t index, const std::string& name) {
    const Object& object = objects_[index];
    Stack stack;
    stack.name = name;
    clip_ = "clip \"" + name + "\"";
    const bool local = time(object, "LocalStart") != 0 || time(object, "LocalStop") != 0;
    const char* const begins = local ? "LocalStart" : "ReferenceStart";
    stack.end = time(object, local ? "LocalStop" : "ReferenceStop");
    const std::vector<std::size_t> layers = objects_.below(index, "AnimationLayer");
    const auto says = [&](std::size_t layer, const char* what) {
      return objects_.whole(objects_[layer], what, 0) != 0;
    };
    const bool alone = std::ranges::any_of(layers, [&](std::size_t layer) { return says(layer, "Solo"); });
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const bool left_out = alone ? !says(layers[i], "Solo") : says(layers[i], "Mute");
      if (!left_out) read_layer(layers[i], i, stack);
      stack.layers.resize(i + 1);
      if (left_out)
        problems_.repair(clip_, "its layer \"" + objects_[layers[i]].name + "\" is " +
                                    (alone ? "not the one in solo" : "muted") + "; it was left out");
    }
    // Where the stack does not state a start, it begins with its keys.
    const double start = objects_.property(object, begins) ? time(object, begins) : first_key(stack);
    if (start < 0)
      problems_.repair(clip_, "begins at " + number_text(start) + " s; what lies before 0 s is not played");
    return stack;
  }

 private:
  double time(const Object& object, const char* property) const {
    return static_cast<double>(objects_.whole(object, property, 0)) / objects_.ticks();
  }

  static double first_key(const Stack& stack) {
    double first = std::numeric_limits<double>::infinity();
    for (const auto& [driven, drivers] : stack.drivers)
      for (const Driver& driver : drivers)
        for (const Curve<double>& part : driver.parts)
          if (!part.knots().empty()) first = std::min(first, part.start());
    return first;
  }

  void read_layer(std::size_t index, std::size_t place, Stack& stack) {
    const Object& object = objects_[index];
    Layer layer;
    const std::int64_t blend = objects_.whole(object, "BlendMode", 0);
    layer.blend = blend == 0 ? Layer::Blend::add : blend == 2 ? Layer::Blend::mix : Layer::Blend::replace;
    layer.whole_rotations = objects_.whole(object, "RotationAccumulationMode", 0) == 0;
    layer.factors = objects_.whole(object, "ScaleAccumulationMode", 0) == 0;
    const double percent = objects_.number(object, "Weight", 100);
    layer.weight = Curve<double>(share({std::isfinite(percent) ? percent : 100, 0, 0}).value);
    for (const std::size_t node : objects_.below(index, "AnimationCurveNode"))
      for (const Connection& target : objects_.from(node))
        if (!target.property.empty()) read_driver(node, target, index, place, layer, stack);
    stack.layers.push_back(std::move(layer));
  }

  void read_driver(std::size_t node, const Connection& target, std::size_t layer_object, std::size_t place,
                   Layer& layer, Stack& stack) {
    if (!read_properties().contains(target.property)) return;
    const bool number = target.property == "DeformPercent" || target.property == "Weight";
    if (target.property == "Weight" && target.to != layer_object) return;
    Driver driver{place, {}};
    for (std::size_t part = 0; part < (number ? 1u : 3u); ++part)
      driver.parts.push_back(Curve<double>(resting(node, part, number, target)));
    std::array<bool, 3> given{};
    for (const Connection& curve : objects_.to(node)) {
      if (objects_[curve.from].kind != "AnimationCurve") continue;
      const std::size_t part = number ? 0 : part_of(curve.property);
      if (std::exchange(given[part], true)) tell_of_two(target, "has two curves for one number; the last is used");
      if (auto read = key_curve(objects_[curve.from], objects_, 1, problems_)) driver.parts[part] = *read;
    }
    if (target.property == "Weight") {
      layer.weight = composed<double>(
          [percent = driver.parts[0]](double at, Side side) { return share(percent.sample(at, side)); },
          Knots().of(driver.parts[0]));
      return;
    }
    std::vector<Driver>& drivers = stack.drivers[{target.to, std::string(target.property)}];
    if (!drivers.empty() && drivers.back().layer == place)
      return tell_of_two(target, "is driven twice in one layer; the first is used");
    drivers.push_back(std::move(driver));
  }

  void tell_of_two(const Connection& target, const std::string& what) {
    problems_.repair(clip_,
                     "\"" + utf8_or_latin1(target.property) + "\" of \"" + objects_[target.to].name + "\" " + what);
  }

  /// The value of a part without keys: the one stated by the curve node, else that of the driven object.
  double resting(std::size_t node, std::size_t part, bool number, const Connection& target) const {
    const Object& object = objects_[node];
    const std::string letter(1, "XYZ"[part]);
    double value = 0;
    if (number) {
      value = objects_.number(object, "d|" + std::string(target.property),
                              objects_.number(objects_[target.to], target.property, 0));
    } else {
      const double base = target.property == "Lcl Scaling" ? 1 : 0;
      const Vec3 own = objects_.vector(objects_[target.to], target.property, Vec3(base, base, base));
      value =
          objects_.number(object, "d|" + letter, objects_.number(object, letter, own[static_cast<Eigen::Index>(part)]));
    }
    return std::isfinite(value) ? value : 0;
  }

  const Objects& objects_;
  models::ModelProblems& problems_;
  std::string clip_;  ///< its name in problems
};

}  // namespace

std::vector<Stack> read_stacks(const Objects& objects, models::ModelProblems& problems) {
  std::vector<Stack> stacks;
  models::UniqueNames names;
  StackReader reader(objects, problems);
  for (std::size_t i = 0; i < objects.all().size(); ++i) {
    if (objects[i].kind != "AnimationStack") continue;
    const std::string& name = objects[i].name;
    stacks.push_back(reader.read(i, names.unique(name.empty() ? "animation_" + std::to_string(stacks.size()) : name)));
  }
  return stacks;
}

}  // namespace tweenfall::fbx
