#include "fbx/motion/stacks.h"

#include "fbx/motion/key_curve.h"
#include "model/model_names.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tweenfall::fbx {

namespace {

/// Properties that place a node or mold a mesh; others of the file move lights, materials and the like.
const std::set<std::string_view>& read_properties() {
  static const std::set<std::string_view> all{"Lcl Translation", "Lcl Rotation",  "Lcl Scaling",  "RotationOffset",
                                              "RotationPivot",   "ScalingOffset", "ScalingPivot", "PreRotation",
                                              "PostRotation",    "DeformPercent", "Weight"};
  return all;
}

std::size_t part_of(std::string_view property) {
  return property.ends_with('Y') ? 1 : property.ends_with('Z') ? 2 : 0;
}

/// A share from 0 to 1 out of per cent, at rest where it is cut.
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
    const auto start = time(object, "LocalStart"), stop = time(object, "LocalStop");
    stack.end = stop ? stop : time(object, "ReferenceStop");
    if (start < 0)
      problems_.repair("clip \"" + name + "\"",
                       "begins at " + number_text(start) + " s; what lies before 0 s is not played");
    const std::vector<std::size_t> layers = objects_.below(index, "AnimationLayer");
    for (std::size_t i = 0; i < layers.size(); ++i) read_layer(layers[i], i, stack);
    return stack;
  }

 private:
  double time(const Object& object, const char* property) const {
    return static_cast<double>(objects_.whole(object, property, 0)) / objects_.ticks();
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
    for (const Connection& curve : objects_.to(node)) {
      if (objects_[curve.from].kind != "AnimationCurve") continue;
      const std::size_t part = number ? 0 : part_of(curve.property);
      if (auto read = key_curve(objects_[curve.from], objects_, 1, problems_)) driver.parts[part] = *read;
    }
    if (target.property == "Weight") {
      layer.weight = composed<double>(
          [percent = driver.parts[0]](double at, Side side) { return share(percent.sample(at, side)); },
          Knots().of(driver.parts[0]));
      return;
    }
    std::vector<Driver>& drivers = stack.drivers[{target.to, std::string(target.property)}];
    // A property that one layer drives twice goes by the last.
    std::erase_if(drivers, [&](const Driver& each) { return each.layer == place; });
    drivers.push_back(std::move(driver));
  }

  /// What a part without keys is: the value that the curve node states, else that of the driven object.
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
