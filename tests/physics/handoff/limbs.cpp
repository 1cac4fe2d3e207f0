// A figure whose bodies are joined settles as one: its bones keep their lengths on the way back to its clip.

#include "physics/handoff/scenes.h"
#include "physics/saved_bytes.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double leaves = 0.5, returns = 1.2, bone = 0.5;
constexpr std::array<const char*, 4> limbs = {"hips", "thigh", "shin", "foot"};
constexpr std::array kinds = {Settle{Settle::Kind::quintic, 0.6}, Settle{Settle::Kind::half_life, 0.1},
                              Settle{Settle::Kind::dead_blend, 0.6}};
constexpr std::array anchors = {HandBack::Anchor::keep, HandBack::Anchor::here, HandBack::Anchor::ground};

/// Four limbs, each half a meter from the one above, kick; they are let go with a push.
StageDescription kicking() {
  StageDescription description;
  Clip clip{.name = "kick", .duration = 4};
  clip.tracks = {
      {"hips", "position", keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = 4, .value = {1, 2, 0.5}}})}};
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    description.nodes.push_back({.name = limbs[i],
                                 .parent = i == 0 ? no_node : i - 1,
                                 .rest = {.position = {i == 0 ? 0 : bone, 0, 0}},
                                 .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .collides_with = 0}});
    if (i > 0)
      description.joints.push_back({.name = limbs[i], .a = i - 1, .b = i, .frame_a = {.position = {bone, 0, 0}}});
    const double side = i % 2 == 0 ? -0.5 : 0.7;
    clip.tracks.push_back(
        {limbs[i], "rotation",
         keyed_curve<Quat>({{.time = 0, .value = Quat(1, 0, 0, 0)}, {.time = 4, .value = exp_map({side, 0.2, 1})}})});
    description.rules.push_back(release_at(leaves, limbs[i], {.add = {{0.2, 0, 0.3}, {0.4, 0.9, -2.3}}}));
  }
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  return description;
}

StageDescription kicking(const HandBack& back, const std::vector<std::size_t>& who = {0, 1, 2, 3}) {
  StageDescription description = kicking();
  for (const std::size_t i : who) description.rules.push_back(recover_at(returns, limbs[i], back));
  return description;
}

double length(const Stage& stage, NodeId limb) {
  return (stage.world(limb).motion.pose.position - stage.world(limb - 1).motion.pose.position).norm();
}

std::vector<double> shown(const Stage& stage) {
  std::vector<double> numbers;
  for (NodeId limb = 0; limb < limbs.size(); ++limb) {
    const Motion motion = stage.world(limb).motion;
    for (const Vec3& vector :
         {motion.pose.position, Vec3(motion.pose.rotation.vec()), motion.twist.linear, motion.twist.angular})
      numbers.insert(numbers.end(), vector.begin(), vector.end());
  }
  return numbers;
}

/// The five-point stencil of a path.
Twist differenced(const Path& path, double time, double h) {
  const auto way = [&](double by) -> Vec3 {
    return path.at(time + by).pose.position - path.at(time - by).pose.position;
  };
  const auto turn = [&](double by) {
    return log_map(path.at(time + by).pose.rotation * path.at(time - by).pose.rotation.conjugate());
  };
  return {(8 * way(h) - way(2 * h)) / (12 * h), (8 * turn(h) - turn(2 * h)) / (12 * h)};
}

}  // namespace

TEST_CASE("the bones of a figure keep their lengths while it settles, and it ends on its path") {
  for (const Settle& settle : kinds)
    for (const HandBack::Anchor anchor : anchors) {
      CAPTURE(static_cast<int>(settle.kind));
      CAPTURE(static_cast<int>(anchor));
      Stage stage(kicking({.anchor = anchor, .settle = settle}));
      const std::vector<Path> authored = {stage.path(0), stage.path(1), stage.path(2), stage.path(3)};
      stage.advance_to(returns);
      REQUIRE(stage.handoffs().size() == 8);
      for (std::size_t i = 4; i < 8; ++i) {
        const auto& [before, after] = std::pair(stage.handoffs()[i].before, stage.handoffs()[i].after);
        CHECK(near(after.pose.position, before.pose.position, 1e-12));
        CHECK(near(after.pose.rotation, before.pose.rotation, 1e-12));
        CHECK(near(after.twist.linear, before.twist.linear, 1e-9));
        CHECK(near(after.twist.angular, before.twist.angular, 1e-9));
      }
      const Pose fallen = stage.world(3).motion.pose, wanted = authored[3].at(returns).pose;
      CHECK((fallen.rotation * wanted.rotation.conjugate()).vec().norm() > 0.3);
      double worst = 0;
      for (int frame = 0; frame <= 240; ++frame) {
        stage.advance_to(returns + frame / 120.0);
        for (const NodeId limb : {1, 2, 3}) worst = std::max(worst, std::abs(length(stage, limb) - bone));
      }
      CHECK(worst < 1e-3);
      if (anchor != HandBack::Anchor::keep) continue;
      const bool endless = settle.kind == Settle::Kind::half_life;
      for (const NodeId limb : {0, 1, 2, 3})
        CHECK(near(stage.world(limb).motion.pose.position, authored[limb].at(stage.time()).pose.position,
                   endless ? 1e-3 : 1e-14));
    }
}

TEST_CASE("the path of a limb that settles along with others has the twist that stencils find") {
  for (const Settle& settle : kinds) {
    CAPTURE(static_cast<int>(settle.kind));
    Stage stage(kicking({.anchor = HandBack::Anchor::ground, .settle = settle}));
    stage.advance_to(returns);
    for (const NodeId limb : {1, 2, 3}) {
      const Path path = stage.path(limb);
      REQUIRE(path.above());
      CHECK(path.above()->node() == limb - 1);
      for (const double since : {0.01, 0.1, 0.33, 0.59, 0.7}) {
        const Motion motion = path.at(returns + since);
        const Twist stencil = differenced(path, returns + since, 1e-4);
        CHECK(near(motion.twist.linear, stencil.linear, 1e-6));
        CHECK(near(motion.twist.angular, stencil.angular, 1e-6));
        CHECK(motion.pose.rotation.norm() == doctest::Approx(1).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("a figure that is let go while it settles leaves with the velocities that were shown") {
  StageDescription description = kicking({.settle = {Settle::Kind::quintic, 0.6}});
  const double again = returns + 0.2137;
  for (const char* const limb : limbs) description.rules.push_back(release_at(again, limb));
  description.rules.push_back(recover_at(2.0, "*"));
  Stage stage(description);
  stage.advance_to(again - 0.01);
  std::vector<Path> paths;
  for (const NodeId limb : {0, 1, 2, 3}) paths.push_back(stage.path(limb));
  stage.advance_to(again);
  REQUIRE(stage.handoffs().size() == 12);
  for (std::size_t i = 8; i < 12; ++i) {
    const HandOff& handoff = stage.handoffs()[i];
    CHECK(handoff.to == Owner::free);
    const Twist stencil = differenced(paths[handoff.node], again, 1e-4);
    CHECK(near(handoff.after.twist.linear, stencil.linear, 1e-6));
    CHECK(near(handoff.after.twist.angular, stencil.angular, 1e-6));
    CHECK(handoff.after.twist.angular.norm() > 0.1);
  }
  for (int frame = 1; frame < 200; ++frame) {
    stage.advance_to(again + 0.01 * frame);
    for (const NodeId limb : {1, 2, 3}) CHECK(length(stage, limb) == doctest::Approx(bone).epsilon(2e-3));
  }
}

TEST_CASE("a figure that settles is the same sought back and forth, and saved and loaded on its way") {
  for (const Settle& settle : kinds) {
    const StageDescription description = kicking({.anchor = HandBack::Anchor::here, .settle = settle});
    const double between = 1.4321, end = 1.6543;
    Stage stage(description);
    stage.advance_to(between);
    const std::vector<double> halfway = shown(stage);
    const std::vector<std::byte> saved = stage.save();
    stage.advance_to(end);
    const std::vector<double> late = shown(stage);
    stage.seek(between);
    CHECK(shown(stage) == halfway);
    stage.seek(0.2);
    stage.seek(end);
    CHECK(shown(stage) == late);
    Stage other(description);
    other.load(saved);
    CHECK(shown(other) == halfway);
    CHECK(other.save() == saved);
    other.advance_to(end);
    CHECK(shown(other) == late);
    CHECK(other.state_hash() == stage.state_hash());
    other.seek(between);
    CHECK(shown(other) == halfway);
  }
}

TEST_CASE("saved bytes that lie about a figure that settles are refused, or make a stage that runs on") {
  Stage stage(kicking({.settle = {Settle::Kind::quintic, 0.6}}));
  stage.advance_to(1.4321);
  const std::vector<std::byte> saved = stage.save();
  Random random(11);
  int refused = 0, not_above = 0, taken = 0;
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::byte> bytes = saved;
    const auto inside = static_cast<double>(bytes.size() - header - 9);
    const std::size_t place = header + static_cast<std::size_t>(random.unit() * inside);
    if (n % 2 == 0)
      bytes[place] ^= static_cast<std::byte>(1 + static_cast<int>(random.unit() * 3));
    else
      put(bytes, place, n % 4 == 1 ? ~0ULL : 3);
    seal(bytes);
    try {
      stage.load(bytes);
    } catch (const std::invalid_argument& fault) {
      ++refused;
      not_above += std::string(fault.what()).find("not above it") != std::string::npos ? 1 : 0;
      continue;
    }
    ++taken;
    try {
      stage.advance(0.05);
      static_cast<void>(shown(stage));
      stage.seek(0.2);
    } catch (const NotFinite&) {
    } catch (const std::invalid_argument&) {
    }
  }
  MESSAGE(refused << " refused, " << not_above << " for a path along one not above, " << taken << " taken");
  CHECK(not_above > 0);
  CHECK(taken > 50);
}

TEST_CASE("a limb below one that stays free settles by itself, and those below it along with it") {
  const Settle settle{Settle::Kind::quintic, 0.6};
  Stage stage(kicking({.settle = settle}, {1, 2}));
  const Path authored = stage.path(1);
  stage.advance_to(returns);
  REQUIRE(stage.handoffs().size() == 6);
  const Path thigh = stage.path(1), shin = stage.path(2);
  CHECK(!thigh.above());
  REQUIRE(shin.above());
  CHECK(shin.above()->node() == 1);
  const Motion& body = stage.handoffs()[4].before;  // its center of mass is at its origin
  const SettleOffset alone(settle, returns, authored.at(returns), body);
  for (const double time : {1.2, 1.35, 1.6, 1.9}) {
    CHECK(near(thigh.at(time).pose.position, alone.apply(time, authored.at(time)).pose.position, 1e-12));
    CHECK(near(thigh.at(time).twist.angular, alone.apply(time, authored.at(time)).twist.angular, 1e-9));
    stage.advance_to(time);
    CHECK(stage.owner(0) == Owner::free);
    CHECK(std::abs(length(stage, 2) - bone) < 1e-3);
  }
}

TEST_CASE("limbs that come back to others that never left settle along with them") {
  StageDescription description = kicking({.settle = {Settle::Kind::quintic, 0.6}}, {2, 3});
  std::erase_if(description.rules,
                [](const Rule& rule) { return rule.bodies[0] == "hips" || rule.bodies[0] == "thigh"; });
  Stage stage(description);
  const Path authored = stage.path(3);
  stage.advance_to(returns);
  REQUIRE(stage.handoffs().size() == 4);
  CHECK((stage.world(3).motion.pose.rotation * authored.at(returns).pose.rotation.conjugate()).vec().norm() > 0.3);
  while (stage.time() < 2) {
    stage.advance(0.01);
    for (const NodeId limb : {1, 2, 3}) CHECK(std::abs(length(stage, limb) - bone) < 1e-3);
  }
  CHECK(near(stage.world(3).motion.pose.position, authored.at(stage.time()).pose.position, 1e-14));
}

TEST_CASE("a caller may take limbs back in any order") {
  std::vector<double> top_first;
  for (const std::array<NodeId, 4>& order : {std::array<NodeId, 4>{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}}) {
    Stage stage(kicking());
    stage.advance_to(returns);
    for (const NodeId limb : order) stage.recover(limb, {.settle = {Settle::Kind::quintic, 0.6}});
    double worst = 0;
    for (int frame = 1; frame <= 30; ++frame) {
      stage.advance_to(returns + 0.01 * frame);
      for (const NodeId limb : {1, 2, 3}) worst = std::max(worst, std::abs(length(stage, limb) - bone));
    }
    CHECK(worst < 1e-3);
    const std::vector<double> now = shown(stage);
    if (top_first.empty()) top_first = now;
    for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] == doctest::Approx(top_first[i]).epsilon(1e-9));
  }
}

TEST_CASE("a path settles along none but those of nodes above its own") {
  const Stage stage(kicking());
  const Path thigh = stage.path(1), shin = stage.path(2);
  CHECK_NOTHROW(static_cast<void>(shin.along(thigh)));
  CHECK_THROWS_WITH_AS(static_cast<void>(thigh.along(shin)),
                       "a path can settle only as seen from that of a node above its own", std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(thigh.recovered(1, {}, {}, 0, nullptr, &thigh)), std::invalid_argument);
}
