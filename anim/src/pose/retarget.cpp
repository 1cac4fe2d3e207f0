#include <tweenfall/anim/retarget.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "chains/problems.h"
#include "pose/joint_names.h"
#include "pose/name_patterns.h"
#include "pose/rest.h"

namespace tweenfall {

namespace pose {
namespace {

/// The source joint of each target joint, the pair that says so, and whether it moves.
struct RetargetMap {
  std::vector<std::size_t> source_of, target_of, by_pair;
  std::vector<char> moves;
  std::vector<chains::Problem> problems;

  RetargetMap(const Hierarchy& source, const Hierarchy& target, std::span<const RetargetPair> pairs)
      : source_of(target.size(), no_node),
        target_of(source.size(), no_node),
        by_pair(target.size()),
        moves(target.size()) {
    if (pairs.empty()) problems.push_back({{"pairs"}, "no joints are mapped"});
    for (const RetargetPair& pair : pairs) {
      if (stars_in(pair.source) != stars_in(pair.target))
        fault("\"" + pair.source + "\" and \"" + pair.target + "\" must have the same number of *");
      else if (stars_in(pair.source) == 0)
        join_named(source, target, pair);
      else
        join_matching(source, target, pair);
      ++number_;
    }
  }

  void fault_at(std::size_t pair, std::string text) {
    problems.push_back({{"pairs", std::to_string(pair)}, std::move(text)});
  }

 private:
  void fault(std::string text) { fault_at(number_, std::move(text)); }
  void join_named(const Hierarchy& source, const Hierarchy& target, const RetargetPair& pair) {
    const auto from = source.find(pair.source), to = target.find(pair.target);
    if (!from) fault("in the source " + no_joint_named(source, pair.source));
    if (!to) fault("in the target " + no_joint_named(target, pair.target));
    if (from && to) join(source, target, *from, *to, pair.moves);
  }
  void join_matching(const Hierarchy& source, const Hierarchy& target, const RetargetPair& pair) {
    bool matched = false, joined = false;
    for (std::size_t i = 0; i < source.size(); ++i) {
      const auto name = renamed(source[i].name, pair.source, pair.target);
      if (!name) continue;
      matched = true;
      const auto to = target.find(*name);
      if (!to) continue;
      joined = true;
      join(source, target, i, *to, pair.moves);
    }
    if (!matched)
      fault("in the source " + no_joint_named(source, pair.source));
    else if (!joined)
      fault("in the target no joint is named by \"" + pair.target + "\" as those of the source by \"" + pair.source +
            "\"");
  }
  void join(const Hierarchy& source, const Hierarchy& target, std::size_t from, std::size_t to, bool moving) {
    const auto twice = [&](const std::string& name, const std::string& first, const std::string& second) {
      fault("\"" + name + "\" is mapped twice, " +
            (first == second ? "both times to \"" + first + "\"" : "to \"" + first + "\" and to \"" + second + "\""));
    };
    if (source_of[to] != no_node) {
      twice(target[to].name, source[source_of[to]].name, source[from].name);
    } else if (target_of[from] != no_node) {
      twice(source[from].name, target[target_of[from]].name, target[to].name);
    } else {
      source_of[to] = from;
      target_of[from] = to;
      by_pair[to] = number_;
      moves[to] = moving ? 1 : 0;
    }
  }

  std::size_t number_ = 0;  // of the pair that is joined
};

}  // namespace
}  // namespace pose

class Retarget::Maker {
 public:
  Maker(const Hierarchy& source, const Hierarchy& target, std::span<const RetargetPair> pairs,
        const RetargetSettings& settings)
      : source_(source), target_(target), settings_(settings), map_(source, target, pairs) {}

  void make(Retarget& result) {
    std::vector<chains::Problem>& problems = map_.problems;
    const auto stance = [&](std::span<const Pose> poses, const Hierarchy& nodes, const char* name) {
      if (poses.empty() || poses.size() == nodes.size()) return poses;
      problems.push_back({{},
                          std::string("the stance of the ") + name + " needs a pose for each of its " +
                              std::to_string(nodes.size()) + " joints; it has " + std::to_string(poses.size())});
      return poses.first(0);
    };
    source_stance_ = pose::figure_poses(source_, stance(settings_.source_stance, source_, "source"));
    target_stance_ = pose::figure_poses(target_, stance(settings_.target_stance, target_, "target"));
    if (!(settings_.turn.squaredNorm() > 0) || !std::isfinite(settings_.turn.squaredNorm()))
      problems.push_back({{"turn"}, "the turn between the figures must be a rotation"});
    else
      turn_ = normalized(settings_.turn);

    result.joints_.resize(target_.size());
    parents_.assign(target_.size(), no_node);
    for (std::size_t i = 0; i < target_.size(); ++i) place(result, i);
    if (problems.empty()) result.scale_ = scale();
    if (!problems.empty())
      throw chains::Unfit("poses cannot be transferred to the other skeleton:", std::move(problems));
    for (std::size_t i = 0; i < target_.size(); ++i) result.joints_[i].way *= result.scale_;
  }

 private:
  // Places a joint: a mapped one in its stance, others in their rest pose below it.
  void stand(std::size_t i) {
    const std::size_t parent = target_[i].parent;
    Pose rest = target_[i].rest;
    rest.rotation = normalized(rest.rotation);
    const bool mapped = map_.source_of[i] != no_node;
    standing_.push_back(mapped ? target_stance_[i] : parent == no_node ? rest : compose(standing_[parent], rest));
  }

  void place(Retarget& result, std::size_t i) {
    const std::size_t parent = target_[i].parent;
    if (parent != no_node) parents_[i] = map_.source_of[parent] != no_node ? parent : parents_[parent];
    stand(i);
    Joint& joint = result.joints_[i];
    joint.rest.pose = target_[i].rest;
    joint.source = map_.source_of[i];
    if (joint.source == no_node) return;

    const std::size_t top = parents_[i], source_top = top == no_node ? no_node : map_.source_of[top];
    std::vector<std::size_t> chain;
    std::size_t node = joint.source;
    for (; node != source_top && node != no_node; node = source_[node].parent) chain.push_back(node);
    if (node != source_top) {
      map_.fault_at(map_.by_pair[i], "\"" + target_[i].name + "\" is below \"" + target_[top].name +
                                         "\", but its source \"" + source_[joint.source].name + "\" is not below \"" +
                                         source_[source_top].name + "\"");
      return;
    }
    std::ranges::reverse(chain);
    joint.chain = result.chains_.size();
    result.chains_.insert(result.chains_.end(), chain.begin(), chain.end());
    joint.chain_end = result.chains_.size();

    // The turn of a source joint from its stance is D = R B^-1. The target's rotation must be T D T^-1 Bt, and its
    // parent's T Dv T^-1 Bp, where v is the top of the source's chain: with Q = Rv^-1 R for the chain, the local
    // rotation is (Bp^-1 T Bv) Q (B^-1 T^-1 Bt).
    const Pose none;
    const Pose &above = parent == no_node ? none : standing_[parent],
               &source_above = source_top == no_node ? none : source_stance_[source_top];
    // Below scales that mirror, Q is Fv Qc Fv with the chain's own rotations Qc and the signs Fv of the scale of its
    // top, and the local rotation is F (...) F with the signs F of the parent's.
    const Quat before = pose::tidied(Quat(above.rotation.conjugate() * turn_ * source_above.rotation));
    const Quat after = pose::tidied(
        Quat(source_stance_[joint.source].rotation.conjugate() * turn_.conjugate() * standing_[i].rotation));
    const Vec3 own = pose::reflection_of(above.scale);
    joint.before = pose::reflected_by(own, before);
    joint.after = pose::reflected_by(own, after);
    joint.reflection = own.cwiseProduct(pose::reflection_of(source_above.scale));
    if (!map_.moves[i] && top != no_node) return;
    movers_.push_back(i);
    Motion stance, base;
    stance.pose = source_stance_[joint.source];
    base.pose = source_above;
    joint.chain_place = relative_to(base, stance).pose.position;
    if (!settings_.target_stance.empty() && settings_.target_stance.size() == target_.size())
      joint.rest.pose.position = settings_.target_stance[i].position;
    joint.way = before.toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      joint.way.col(k) *= source_above.scale[k];
      if (above.scale[k] != 0) joint.way.row(k) /= above.scale[k];
    }
  }

  double scale() {
    if (settings_.scale > 0 && std::isfinite(settings_.scale)) return settings_.scale;
    if (settings_.scale != 0) {
      map_.problems.push_back(
          {{"scale"}, "the scale of displacements must be above 0; it is " + number_text(settings_.scale)});
      return 1;
    }
    const double length = std::sqrt(settings_.up.squaredNorm());
    const Vec3 up = settings_.up / (length > 0 ? length : 1), target_up = turn_ * up;
    double height = 0, target_height = 0;
    std::size_t hips = no_node;
    for (const std::size_t i : movers_) {
      const double own = up.dot(source_stance_[map_.source_of[i]].position);
      if (hips != no_node && !(own > height)) continue;
      hips = i;
      height = own;
      target_height = target_up.dot(standing_[i].position);
    }
    if (height > 0 && target_height > 0 && std::isfinite(target_height / height)) return target_height / height;
    map_.problems.push_back({{},
                             "the hips \"" + target_[hips].name + "\" stand " + number_text(target_height) +
                                 " above the ground, and those of the source " + number_text(height) +
                                 "; unless both are above it, a scale must be given"});
    return 1;
  }

  const Hierarchy &source_, &target_;
  const RetargetSettings& settings_;
  pose::RetargetMap map_;
  Quat turn_{1, 0, 0, 0};
  std::vector<Pose> source_stance_, target_stance_;
  std::vector<Pose> standing_;        // poses of the target while the source is in its stance
  std::vector<std::size_t> parents_;  // for each target joint the next mapped one above
  std::vector<std::size_t> movers_;
};

Retarget::Retarget(const Hierarchy& source, const Hierarchy& target, std::span<const RetargetPair> pairs,
                   const RetargetSettings& settings) {
  Maker(source, target, pairs, settings).make(*this);
}

void Retarget::apply(std::span<const Motion> source, std::span<Motion> out) const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    Motion& result = out[i];
    result = joint.rest;
    if (joint.source == no_node) continue;
    Motion chain = source[chains_[joint.chain]];
    for (std::size_t k = joint.chain + 1; k < joint.chain_end; ++k) chain = compose(chain, source[chains_[k]]);
    result.pose.rotation = joint.before * pose::reflected_by(joint.reflection, chain.pose.rotation) * joint.after;
    result.twist.angular = joint.before * joint.reflection.cwiseProduct(chain.twist.angular);
    result.pose.position += joint.way * Vec3(chain.pose.position - joint.chain_place);
    result.twist.linear = joint.way * chain.twist.linear;
  }
}

}  // namespace tweenfall
