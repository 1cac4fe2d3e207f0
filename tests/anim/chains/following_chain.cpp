// Chains that remember where they were: what no function of the target alone can do, and what they share with `reach`.

#include "anim/chains/chain_support.h"

#include <tweenfall/anim/following_chain.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> shown_in_full{1, 0, 0};
constexpr double frame_time = 1.0 / 60;

Vec3 end_of_chain(const JointChain& chain, std::span<const Motion> pose) {
  return world_of_node(chain.nodes(), chain.end(), pose).motion.pose.position;
}

/// Two bones of 1 m in a plane: a shoulder that turns by 40 degrees to either side, an elbow that bends from -30 to
/// 150.
JointChain flat_arm(bool leaps) {
  Hierarchy nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    if (i > 0) node.rest.position = {1, 0, 0};
    nodes.add(node);
  }
  const double degree = pi / 180;
  return JointChain(nodes, {.links = {{std::size_t{0}, HingeLimit{{0, 0, 1}, -40 * degree, 40 * degree}},
                                      {std::size_t{1}, HingeLimit{{0, 0, 1}, -30 * degree, 150 * degree}},
                                      {std::size_t{2}}},
                            .leaps = leaps});
}

double elbow_of(std::span<const Motion> pose) {
  return log_map(pose[1].pose.rotation).z();
}

/// A chain with random hinges (a share of them) and cones, and a smooth path of its end from one of its poses to
/// another: every place on it can be reached.
struct RandomPath {
  Hierarchy nodes;
  JointChainSettings settings;
  std::vector<Vec3> from, to;  // of each joint: the swing or turn, and the twist, by which it is turned

  RandomPath(Random& random, std::size_t count, double hinges) {
    for (std::size_t i = 0; i < count; ++i) {
      Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
      node.rest.rotation = exp_map(random.vector(0.4));
      if (i > 0) node.rest.position = random.rotation() * Vec3(random.between(0.3, 1), 0, 0);
      nodes.add(node);
      settings.links.push_back({i});
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const Vec3 axis = random.vector(1);
      const double low = random.between(-2, 0), high = random.between(0, 2), swing = random.between(0.3, 1.5);
      if (random.unit() < hinges)
        settings.links[i].limit = HingeLimit{axis, low, high};
      else
        settings.links[i].limit = ConeLimit{swing, low, high};
      for (std::vector<Vec3>* ends : {&from, &to}) {
        const double x = random.unit(), y = random.unit(), z = random.unit();
        ends->emplace_back(x, y, z);
      }
    }
  }
  [[nodiscard]] double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) sum += nodes[i].rest.position.norm();
    return sum;
  }
  [[nodiscard]] Vec3 at(const JointChain& chain, double share) const {
    std::vector<Motion> pose = test::rest_pose(nodes);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const JointChain::Joint& joint = chain.joints()[i];
      const Vec3 part = from[i] + share * (to[i] - from[i]);
      Quat turn;
      if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
        turn = exp_map((hinge->low + part.x() * (hinge->high - hinge->low)) * hinge->axis);
      } else {
        const auto& cone = std::get<ConeLimit>(joint.limit);
        const Vec3 across =
            joint.bone.cross(std::abs(joint.bone.x()) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
        const Vec3 lean = 0.7 * ((2 * part.x() - 1) * across + (2 * part.y() - 1) * joint.bone.cross(across));
        turn = exp_map(cone.swing * lean) *
               exp_map((cone.twist_low + part.z() * (cone.twist_high - cone.twist_low)) * joint.bone);
      }
      pose[joint.node].pose.rotation = joint.rest * turn;
    }
    return end_of_chain(chain, pose);
  }
};

}  // namespace

TEST_CASE(
    "an arm that follows reaches both sides and changes its elbow only where it must, which is elsewhere on the way "
    "back") {
  // With the elbow bent by 20 degrees either way the hand is as far away, 10 degrees to that side of the upper arm: one
  // way it gets from -50 to 30 degrees, the other from -30 to 50.
  const JointChain chain = flat_arm(true);
  const double bend = 20 * pi / 180, far = 2 * std::cos(bend / 2);
  ChainMemory memory;
  int flips = 0;
  double last = -bend;
  const auto go = [&](int from, int to) {
    const int way = to > from ? 1 : -1;
    for (int tenth = from; tenth != to + way; tenth += way) {
      CAPTURE(tenth);
      const double angle = 0.1 * tenth * pi / 180;
      const Vec3 target = far * Vec3(std::cos(angle), std::sin(angle), 0);
      std::vector<Motion> pose = test::rest_pose(chain.nodes());
      pose[1].pose.rotation = exp_map(Vec3(0, 0, -bend));
      follow(chain, still(target), frame_time, shown_in_full, memory, pose);
      CHECK((end_of_chain(chain, pose) - target).norm() < 1e-9);
      CHECK(std::abs(elbow_of(pose)) == doctest::Approx(bend).epsilon(1e-6));
      if (elbow_of(pose) * last > 0) continue;
      ++flips;
      last = elbow_of(pose);
      // Behind the last place that the other bend reaches.
      CHECK(tenth == (way > 0 ? 301 : -301));
    }
  };
  go(-500, 500);
  CHECK(flips == 1);
  go(500, -500);
  CHECK(flips == 2);
}

TEST_CASE("chains that follow and may leap reach all that can be reached, and hardly ever have to leap") {
  Random random(31);
  int flips[3] = {}, misses = 0;
  for (int line = 0; line < 90; ++line) {
    CAPTURE(line);
    const std::size_t kind = static_cast<std::size_t>(line) % 3;
    RandomPath path(random, 4 + static_cast<std::size_t>(line) % 5, 0.5 * static_cast<double>(kind));
    path.settings.method = line % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
    path.settings.leaps = true;
    const JointChain chain(path.nodes, path.settings);
    ChainMemory memory;
    std::vector<Motion> last;
    constexpr int frames = 150;
    for (int i = 0; i <= frames; ++i) {
      const Vec3 target = path.at(chain, static_cast<double>(i) / frames);
      std::vector<Motion> pose = test::rest_pose(path.nodes);
      const ChainMemory before = memory;
      follow(chain, still(target), frame_time, shown_in_full, memory, pose);
      if ((end_of_chain(chain, pose) - target).norm() > 1e-6 * path.length()) ++misses;
      // What moves much in a frame moves little in each part of it, unless it leaps.
      if (i > 0 && difference_of(last, pose) > 0.05) {
        ChainMemory finer = before;
        double most = 0;
        std::vector<Motion> from = last;
        for (int part = 1; part <= 64; ++part) {
          std::vector<Motion> to = test::rest_pose(path.nodes);
          follow(chain, still(path.at(chain, (i - 1 + part / 64.0) / frames)), frame_time / 64, shown_in_full, finer,
                 to);
          most = std::max(most, difference_of(from, to));
          from = std::move(to);
        }
        if (most > 0.1) ++flips[kind];
      }
      last = std::move(pose);
    }
  }
  MESSAGE("missed ", misses, ", flips of sockets ", flips[0], ", mixed ", flips[1], ", hinges ", flips[2]);
  CHECK(misses == 0);
  CHECK(flips[0] == 0);
  CHECK(flips[1] <= 2);
  CHECK(flips[2] <= 4);
}

TEST_CASE("a chain that follows comes to rest nearest to its script, whatever way it came") {
  Random random(33);
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    RandomPath path(random, 6, 0);
    const JointChain chain(path.nodes, path.settings);
    const std::vector<Motion> script = SwingingPose(random, path.nodes, 0, 0.3).at(1);
    const Vec3 target = path.at(chain, 0.5);
    std::vector<std::vector<Motion>> ended;
    for (const double start : {0.35, 0.65}) {
      ChainMemory memory;
      std::vector<Motion> pose;
      for (int step = 0; step < 400; ++step) {
        const double share = step < 100 ? start + (0.5 - start) * step / 100 : 0.5;
        pose = script;
        follow(chain, still(path.at(chain, share)), frame_time, shown_in_full, memory, pose);
      }
      CHECK((end_of_chain(chain, pose) - target).norm() < 1e-6 * path.length());
      ended.push_back(pose);
    }
    CHECK(difference_of(ended[0], ended[1]) < 1e-3);
  }
}

TEST_CASE("the rates of a chain that follows are the derivatives of what it returns") {
  Random random(35);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    RandomPath path(random, 4 + static_cast<std::size_t>(i) % 4, 0.3);
    path.settings.method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
    path.settings.leaps = false;
    const JointChain chain(path.nodes, path.settings);
    const SwingingPose swing(random, path.nodes, 0.02, 0.2);
    const SwingingVector target = swinging(random, path.at(chain, 0.5) * (i % 3 == 0 ? 2 : 1), 0.02);
    ChainMemory memory;
    std::vector<Motion> first = swing.at(0.98);
    follow(chain, target.at(0.98), 0, shown_in_full, memory, first);
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      ChainMemory mine = memory;
      follow(chain, target.at(t), t - 0.98, shown_in_full, mine, pose);
      return pose;
    };
    const double error = worst_rate(solved, 1, 2e-5);
    CHECK(error < 1e-5);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("a chain that follows begins as `reach`, is `reach` without limits, and by no weight moves on unseen") {
  Random random(37);
  RandomPath path(random, 5, 0.5);
  const JointChain chain(path.nodes, path.settings);
  const Sample<Vec3> target = moving(path.at(chain, 0.3), {1, 2, 3});
  ChainMemory memory;
  std::vector<Motion> followed = test::rest_pose(path.nodes), reached = followed;
  follow(chain, target, 0.1, shown_in_full, memory, followed);
  reach(chain, target, shown_in_full, reached);
  CHECK(difference_of(followed, reached) == 0);

  for (ChainLink& link : path.settings.links) link.limit = {};
  const JointChain free(path.nodes, path.settings);
  for (const double share : {0.1, 0.9}) {
    followed = reached = test::rest_pose(path.nodes);
    const Sample<Vec3> there = still(path.at(chain, share));
    follow(free, there, 0.1, shown_in_full, memory, followed);
    reach(free, there, shown_in_full, reached);
    CHECK(difference_of(followed, reached) == 0);
  }

  ChainMemory shown, hidden;
  for (const double share : {0.2, 0.25, 0.3}) {
    std::vector<Motion> pose = test::rest_pose(path.nodes), still_pose = pose;
    follow(chain, still(path.at(chain, share)), frame_time, shown_in_full, shown, pose);
    follow(chain, still(path.at(chain, share)), frame_time, {0, 0, 0}, hidden, still_pose);
    CHECK(difference_of(still_pose, test::rest_pose(path.nodes)) == 0);
    CHECK(shown == hidden);
  }
  CHECK(ChainMemory::from_bytes(shown.bytes()) == shown);
  std::vector<std::byte> bytes = shown.bytes();
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    CHECK_THROWS_AS((void)ChainMemory::from_bytes(std::span(bytes).first(cut)), std::invalid_argument);
  bytes[15] ^= std::byte{0x7f};  // the exponent of a number
  CHECK_THROWS_AS((void)ChainMemory::from_bytes(bytes), std::invalid_argument);
}
