#include "fbx/surface/deformers.h"
#include "model/model_influences.h"

#include <cmath>
#include <numbers>

namespace tweenfall::fbx {

namespace {

Affine affine_of(const Reals& m) {
  Affine result;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) result.linear(row, column) = m[static_cast<std::size_t>(4 * column + row)];
  result.translation = Vec3(m[12], m[13], m[14]);
  return result;
}

bool all_finite(const Reals& numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number)) return false;
  return true;
}

class SkinReader {
 public:
  SkinReader(std::size_t control_points, const Objects& objects, const Nodes& nodes, models::ModelProblems& problems)
      : objects_(objects), nodes_(nodes), problems_(problems), pulls_(control_points) {}

  SkinData read(std::size_t geometry, std::size_t model) {
    place_ = "mesh \"" + objects_[geometry].name + "\"";
    model_ = model;
    for (const std::size_t skin : objects_.below(geometry, "Deformer", "Skin")) {
      const Record* type = objects_[skin].record->find("SkinningType");
      if (type && (type->text(0) == "DualQuaternion" || type->text(0) == "Blend"))
        problems_.repair(place_, "is skinned by dual quaternions; it is shown skinned linearly");
      for (const std::size_t cluster : objects_.below(skin, "Deformer", "Cluster")) read_cluster(cluster);
    }
    if (result_.skin.joints.empty()) return {};
    hang_loose_points(model);
    models::InfluenceTally tally;
    for (auto& pulls : pulls_) result_.influences.push_back(models::summing_to_one(std::move(pulls), tally));
    tally.report(place_, problems_);
    return std::move(result_);
  }

 private:
  void read_cluster(std::size_t index) {
    const Object& cluster = objects_[index];
    const std::vector<std::size_t> bones = objects_.below(index, "Model");
    const std::size_t node = bones.empty() ? no_node : nodes_.of(bones[0]);
    const Integers points = cluster.record->integers("Indexes");
    const Reals weights = cluster.record->reals("Weights"), bind = cluster.record->reals("Transform");
    if (node == no_node) {
      if (!points.empty()) problems_.repair(place_, "has a cluster without a joint; it was left out");
      return;
    }
    if (points.size() != weights.size())
      objects_.source().fail(cluster.record->at, "a cluster has " + std::to_string(points.size()) + " points for " +
                                                     std::to_string(weights.size()) + " weights");
    if (bind.size() < 16 && !points.empty())
      problems_.repair(place_, "has a cluster without a transform; it was bound where everything rests");
    if (!all_finite(weights) || !all_finite(bind))
      objects_.source().fail(cluster.record->at, "a cluster holds a number that is not finite");
    const auto joint = static_cast<std::uint32_t>(result_.skin.joints.size());
    result_.skin.joints.push_back(node);
    result_.skin.inverse_binds.push_back(bind.size() < 16 ? bound_at_rest(model_, bones[0]) : affine_of(bind));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] < 0 || static_cast<std::size_t>(points[i]) >= pulls_.size())
        objects_.source().fail(cluster.record->at, "a cluster pulls on point " + std::to_string(points[i]) +
                                                       "; the mesh has " + std::to_string(pulls_.size()));
      pulls_[static_cast<std::size_t>(points[i])].push_back({joint, weights[i]});
    }
  }

  /// The map from the mesh's node to the joint, with both at rest.
  Affine bound_at_rest(std::size_t model, std::size_t bone) const {
    const WorldMotion mesh = nodes_.at_rest(model), joint = nodes_.at_rest(bone);
    Affine result;
    if (!(std::abs(joint.linear.determinant()) > 0)) return result;
    const Mat3 back = joint.linear.inverse();
    result.linear = back * mesh.linear;
    result.translation = back * (mesh.motion.pose.position - joint.motion.pose.position);
    return result;
  }

  void hang_loose_points(std::size_t model) {
    const auto own = static_cast<std::uint32_t>(result_.skin.joints.size());
    bool any = false;
    for (auto& pulls : pulls_) {
      bool held = false;
      for (const Influence& pull : pulls) held = held || pull.weight > 0;
      if (held) continue;
      pulls = {{own, 1}};
      any = true;
    }
    if (!any) return;
    result_.skin.joints.push_back(nodes_.of(model));
    result_.skin.inverse_binds.emplace_back();
  }

  const Objects& objects_;
  const Nodes& nodes_;
  models::ModelProblems& problems_;
  std::vector<std::vector<Influence>> pulls_;
  SkinData result_{};
  std::size_t model_ = no_node;
  std::string place_;
};

}  // namespace

Affine geometric_transform(const Objects& objects, std::size_t model) {
  const Object& object = objects[model];
  EulerOrder order;
  order.intrinsic = false;
  const Vec3 angles = objects.vector(object, "GeometricRotation", Vec3(0, 0, 0)) * (std::numbers::pi / 180);
  const Vec3 scale = objects.vector(object, "GeometricScaling", Vec3(1, 1, 1));
  Affine result;
  result.translation = objects.vector(object, "GeometricTranslation", Vec3(0, 0, 0));
  if (!angles.allFinite() || !scale.allFinite() || !result.translation.allFinite())
    objects.source().fail(object.record->at, "a geometric transform of \"" + object.name + "\" is not finite");
  result.linear = from_euler(angles, order).toRotationMatrix() * scale.asDiagonal();
  return result;
}

SkinData read_skin(std::size_t geometry, std::size_t model, std::size_t control_points, const Objects& objects,
                   const Nodes& nodes, models::ModelProblems& problems) {
  return SkinReader(control_points, objects, nodes, problems).read(geometry, model);
}

}  // namespace tweenfall::fbx
