// Chains with limits against a search of their own poses that shares nothing with them: other coordinates, slopes by
// differences, hundreds of starts.

#include "anim/chains/chain_support.h"

#include <tweenfall/anim/joint_chain.h>

#include <Eigen/Cholesky>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> full_weight{1, 0, 0};

/// A chain by its joints' angles: of a hinge one; of a socket those of two swings, in a disc, and a twist.
class PoseSearch {
 public:
  using Angles = Eigen::VectorXd;

  explicit PoseSearch(const JointChain& chain) {
    for (std::size_t i = 0; i < chain.joints().size(); ++i) {
      const JointChain::Joint& joint = chain.joints()[i];
      const std::size_t next = i + 1 < chain.joints().size() ? chain.joints()[i + 1].node : chain.end();
      Part part{.rest = joint.rest, .bone = chain.nodes()[next].rest.position, .first = size_};
      if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
        part.axis = hinge->axis;
        part.low = hinge->low;
        part.high = hinge->high;
      } else {
        const auto& cone = std::get<ConeLimit>(joint.limit);
        part.axis = joint.bone;
        part.low = cone.twist_low;
        part.high = cone.twist_high;
        part.swing = cone.swing;
        part.is_socket = true;
      }
      part.across = part.axis.cross(std::abs(part.axis.x()) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
      size_ += part.is_socket ? 3 : 1;
      length_ += part.bone.norm();
      parts_.push_back(part);
    }
  }
  [[nodiscard]] double length() const { return length_; }

  [[nodiscard]] Vec3 end(const Angles& angles) const {
    Vec3 at(0, 0, 0);
    Quat own(1, 0, 0, 0);
    for (const Part& part : parts_) {
      own = own * part.rest;
      Eigen::Index k = part.first;
      if (part.is_socket) {
        own = own * exp_map(angles[k] * part.across + angles[k + 1] * part.axis.cross(part.across));
        k += 2;
      }
      own = own * exp_map(angles[k] * part.axis);
      at += own * part.bone;
    }
    return at;
  }
  [[nodiscard]] Angles drawn(Random& random) const {
    Angles angles(size_);
    for (const Part& part : parts_) {
      Eigen::Index k = part.first;
      if (part.is_socket) {
        const double around = random.between(0, 2 * pi), far = part.swing * std::sqrt(random.unit());
        angles[k++] = far * std::cos(around);
        angles[k++] = far * std::sin(around);
      }
      angles[k] = random.between(part.low, part.high);
    }
    return angles;
  }
  /// The least distance from the target, over ways down from as many drawn poses.
  [[nodiscard]] double nearest(const Vec3& target, int starts, Random& random) const {
    double least = INFINITY;
    for (int i = 0; i < starts && least > 1e-8 * length_; ++i) least = std::min(least, down(drawn(random), target));
    return least;
  }

 private:
  struct Part {
    Quat rest;
    Vec3 bone, axis{0, 0, 0}, across{0, 0, 0};
    double low = 0, high = 0, swing = 0;
    Eigen::Index first = 0;
    bool is_socket = false;
  };

  void keep(Angles& angles) const {
    for (const Part& part : parts_) {
      Eigen::Index k = part.first;
      if (part.is_socket) {
        const double far = std::hypot(angles[k], angles[k + 1]);
        if (far > part.swing) angles.segment(k, 2) *= part.swing / far;
        k += 2;
      }
      angles[k] = std::clamp(angles[k], part.low, part.high);
    }
  }
  /// Damped least squares within the limits: steps of all joints, of which what leaves the limits is cut.
  [[nodiscard]] double down(Angles angles, const Vec3& target) const {
    Vec3 miss = end(angles) - target;
    double damping = 0.1;
    for (int step = 0; step < 150 && miss.norm() > 1e-9 * length_; ++step) {
      Eigen::Matrix3Xd slopes(3, size_);
      for (Eigen::Index k = 0; k < size_; ++k) {
        Angles more = angles, less = angles;
        more[k] += 1e-6;
        less[k] -= 1e-6;
        slopes.col(k) = (end(more) - end(less)) / 2e-6;
      }
      bool better = false;
      for (; !better && damping < 1e6; damping *= 4) {
        Angles free = Angles::Ones(size_), next;
        for (int pass = 0; pass < 3; ++pass) {
          const Eigen::Matrix3Xd open = slopes * free.asDiagonal();
          const Mat3 square = open * open.transpose() + damping * length_ * length_ * Mat3::Identity();
          const Angles wanted = angles - open.transpose() * square.inverse() * miss;
          next = wanted;
          keep(next);
          for (Eigen::Index k = 0; k < size_; ++k)
            if (std::abs(next[k] - angles[k]) < 1e-12 && std::abs(wanted[k] - next[k]) > 1e-12) free[k] = 0;
        }
        const Vec3 now = end(next) - target;
        if (!(now.squaredNorm() < miss.squaredNorm())) continue;
        better = true;
        miss = now;
        angles = next;
        damping = std::max(1e-9, damping / 32);
      }
      if (!better) break;
    }
    return miss.norm();
  }

  std::vector<Part> parts_;
  Eigen::Index size_ = 0;
  double length_ = 0;
};

/// A chain of random bones, of whose joints a share are hinges, and the others sockets.
JointChain random_chain(Random& random, std::size_t joints, double hinges) {
  Hierarchy nodes;
  JointChainSettings settings{.links = {}, .method = joints % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd};
  for (std::size_t i = 0; i <= joints; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    node.rest.rotation = exp_map(random.vector(0.4));
    const double bone = random.between(0.3, 1);
    if (i > 0) node.rest.position = random.rotation() * Vec3(bone, 0, 0);
    nodes.add(node);
    settings.links.push_back({i});
    if (i == joints) break;
    const Vec3 axis = random.vector(1);
    const double low = random.between(-2, 0), high = random.between(0, 2), swing = random.between(0.3, 1.5);
    if (random.unit() < hinges)
      settings.links[i].limit = HingeLimit{axis, low, high};
    else
      settings.links[i].limit = ConeLimit{swing, low, high};
  }
  return JointChain(nodes, settings);
}

double distance_of(const JointChain& chain, std::span<const Motion> pose, const Vec3& target) {
  return (world_of_node(chain.nodes(), chain.end(), pose).motion.pose.position - target).norm();
}

}  // namespace

TEST_CASE("chains with limits reach all that a pose reaches") {
  Random random(41);
  double worst = 0;
  for (const double hinges : {0.0, 0.5, 1.0})
    for (int i = 0; i < 3000; ++i) {
      CAPTURE(hinges);
      CAPTURE(i);
      const JointChain chain = random_chain(random, 2 + static_cast<std::size_t>(i) % 11, hinges);
      const PoseSearch search(chain);
      const Vec3 target = search.end(search.drawn(random));
      std::vector<Motion> pose = rest_pose(chain.nodes());
      reach(chain, still(target), full_weight, pose);
      const double miss = distance_of(chain, pose, target) / search.length();
      CHECK(miss < 1e-6);
      worst = std::max(worst, miss);
    }
  MESSAGE("farthest from its target: ", worst, " of the length");
}

TEST_CASE("chains with limits come as near to what no pose reaches as any pose that a long search finds") {
  Random random(43);
  double worst = 0;
  int out_of_reach = 0;
  for (const double hinges : {0.0, 0.5, 1.0})
    for (int i = 0; i < 50; ++i) {
      CAPTURE(hinges);
      CAPTURE(i);
      const JointChain chain = random_chain(random, 2 + static_cast<std::size_t>(i) % 7, hinges);
      const PoseSearch search(chain);
      const Vec3 target = random.vector(1.3 * search.length());
      std::vector<Motion> pose = rest_pose(chain.nodes());
      reach(chain, still(target), full_weight, pose);
      const double miss = distance_of(chain, pose, target) / search.length();
      const double nearest = search.nearest(target, 40, random) / search.length();
      if (nearest > 1e-6) ++out_of_reach;
      CHECK(miss < nearest + 1e-6);
      worst = std::max(worst, miss - nearest);
    }
  MESSAGE(out_of_reach, " of 150 out of reach; at most ", worst, " of the length farther than the best pose found");
  CHECK(out_of_reach > 100);
}

TEST_CASE("joints that cannot turn, that turn all the way round, and bones without length leave numbers") {
  Random random(47);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    Hierarchy nodes;
    JointChainSettings settings;
    const std::size_t joints = 2 + static_cast<std::size_t>(i) % 9;
    for (std::size_t k = 0; k <= joints; ++k) {
      Node node{.name = std::to_string(k), .parent = k == 0 ? no_node : k - 1};
      if (k > 0) node.rest.position = random.rotation() * Vec3(0.5, 0, 0);
      nodes.add(node);
      settings.links.push_back({k});
    }
    const JointLimit limits[] = {
        HingeLimit{{1, 2, 3}, 0, 0}, HingeLimit{{3, 1, 2}}, ConeLimit{0, 0, 0}, ConeLimit{3.1}, JointLimit{},
        ConeLimit{0.5, -0.3, 0.3}};
    for (std::size_t k = 0; k < joints; ++k) settings.links[k].limit = limits[random.bits() % std::size(limits)];
    const JointChain chain(nodes, settings);
    std::vector<Motion> before = rest_pose(nodes);
    for (Motion& motion : before)
      if (random.unit() < 0.2) motion.pose.position = {0, 0, 0};
    const Vec3 aside = random.vector(2);
    for (const Vec3& target : {Vec3(0, 0, 0), aside, Vec3(4 * aside), Vec3(1e9, 0, 0), Vec3(1e-200, 0, 0)}) {
      std::vector<Motion> pose = before;
      reach(chain, moving(target, {1, 1, 1}), full_weight, pose);
      CHECK(finite(pose));
    }
  }
}
