#include <tweenfall/anim/joint_chain.h>

#include "chains/moving.h"
#include "chains/problems.h"

#include <utility>

namespace tweenfall {

JointChain::JointChain(const Hierarchy& nodes, const JointChainSettings& settings)
    : nodes_(nodes), method_(settings.method), sweeps_(settings.sweeps), leaps_(settings.leaps) {
  chains::Problems problems("joint chain");
  const std::size_t count = settings.links.size();
  problems.at({"joints"})
      .require(count >= 2, "it has " + std::to_string(count) + (count == 1 ? " joint" : " joints") +
                               "; it needs at least one that turns and the end that it carries");
  problems.require(count <= most_joints + 1, "it has " + std::to_string(count) + " joints; it may have at most " +
                                                 std::to_string(most_joints + 1));
  problems.at({"sweeps"})
      .require(sweeps_ >= 0 && sweeps_ <= 1000, "sweeps is " + std::to_string(sweeps_) + "; it must be from 0 to 1000");
  std::vector<NodeRef> told;
  told.reserve(count);
  for (const ChainLink& link : settings.links) told.push_back(link.node);
  const std::vector<std::size_t> found = problems.chain(nodes, told);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "joint " + std::to_string(i + 1) + " (" + chains::called(nodes, told[i]) + ")";
    const JointLimit& limit = settings.links[i].limit;
    const auto at = [&](const char* kind, const char* member) -> chains::Problems& {
      return problems.at({"joints", std::to_string(i), kind, member});
    };
    if (const auto* hinge = std::get_if<HingeLimit>(&limit)) {
      at("hinge", "axis").require_finite(hinge->axis, "axis of " + name);
      at("hinge", "axis").require(hinge->axis.norm() > 0, "axis of " + name + " is zero");
      at("hinge", "limits").require_in(hinge->low, -std::numbers::pi, std::numbers::pi, "low of " + name);
      at("hinge", "limits").require_in(hinge->high, hinge->low, std::numbers::pi, "high of " + name);
    } else if (const auto* cone = std::get_if<ConeLimit>(&limit)) {
      at("socket", "swing").require_in(cone->swing, 0, 3.1, "swing of " + name);
      at("socket", "twist").require_in(cone->twist_low, -std::numbers::pi, std::numbers::pi, "twist_low of " + name);
      at("socket", "twist").require_in(cone->twist_high, cone->twist_low, std::numbers::pi, "twist_high of " + name);
    }
    if (i + 1 == count && count > 1)
      problems.at({"joints", std::to_string(i)})
          .require(std::holds_alternative<std::monostate>(limit),
                   name + " is the end, which does not turn; it takes no limit");
  }
  problems.report();

  end_ = found.back();
  std::vector<Motion> rest(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
  joints_.reserve(count - 1);
  Vec3 above(1, 1, 1);  // the scales of the chain above a joint at rest
  for (std::size_t i = 0; i + 1 < count; ++i) {
    Joint& joint = joints_.emplace_back();
    joint.node = found[i];
    joint.limit = settings.links[i].limit;
    joint.rest = nodes[found[i]].rest.rotation;
    const Vec3 reflection = pose::reflection_of(above), signs = pose::signs_of(above);
    above = above.cwiseProduct(nodes[found[i]].rest.scale);
    const Vec3 bone =
        pose::signs_of(above).cwiseProduct(chains::seen_from(nodes, found[i], found[i + 1], rest)
                                               .pose.position.cwiseProduct(nodes[found[i]].rest.scale.cwiseAbs()));
    for (std::size_t k = nodes[found[i + 1]].parent; k != found[i]; k = nodes[k].parent)
      above = above.cwiseProduct(nodes[k].rest.scale);
    const double length = std::sqrt(bone.squaredNorm());
    joint.has_bone = length > 0;
    if (joint.has_bone) joint.bone = bone / length;
    if (auto* hinge = std::get_if<HingeLimit>(&joint.limit))
      hinge->axis = reflection.cwiseProduct(hinge->axis / hinge->axis.norm());
    auto* cone = std::get_if<ConeLimit>(&joint.limit);
    if (cone && signs.prod() < 0) cone->twist_low = -std::exchange(cone->twist_high, -cone->twist_low);
    problems.at({"joints", std::to_string(i)})
        .require(joint.has_bone || !std::holds_alternative<ConeLimit>(joint.limit),
                 "joint " + std::to_string(i + 1) + " (" + chains::called(nodes, told[i]) +
                     ") has a cone and, at rest, no bone that could swing in it");
    limited_ = limited_ || !std::holds_alternative<std::monostate>(joint.limit);
  }
  problems.report();
}

}  // namespace tweenfall
