#include "physics/handoff/scenes.h"

#include <algorithm>
#include <ctime>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

NodeDescription ball(const std::string& name, const Vec3& place, std::size_t parent = no_node) {
  return {.name = name,
          .parent = parent,
          .rest = {.position = place},
          .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}};
}

/// A cart that a clip moves along x at 1 m/s, and a floor far below it.
StageDescription cart() {
  StageDescription description;
  description.nodes = {{.name = "cart"},
                       {.name = "floor",
                        .rest = {.position = {0, -5, 0}},
                        .body = BodyDescription{.shape = {Plane{}}, .restitution = 0.5, .fixed = true}}};
  Clip clip{.name = "ride", .duration = 10};
  clip.tracks = {{"cart", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::linear()},
                                     {.time = 10, .value = Vec3(10, 0, 0)}})}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  return description;
}

/// Processor time of adding this many nodes one by one, reading each, and removing each.
double seconds_of(std::size_t count, bool bodies) {
  StageDescription description;
  description.world.gravity = Vec3(0, 0, 0);
  for (int i = 0; i < 10; ++i) description.nodes.push_back({.name = "parent" + std::to_string(i)});
  Stage stage(description);
  const std::clock_t start = std::clock();
  std::vector<NodeId> added;
  added.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    NodeDescription node = ball("node" + std::to_string(i), Vec3(static_cast<double>(i), 0, 0), i % 10);
    if (!bodies) node.body.reset();
    added.push_back(stage.add(node));
  }
  stage.advance(1.5 * stage.step());
  double sum = 0;
  for (const NodeId node : added) sum += stage.world(node).motion.pose.position.x();
  CHECK(sum == doctest::Approx(0.5 * static_cast<double>(count) * static_cast<double>(count - 1)));
  for (const NodeId node : added) stage.remove(node);
  CHECK_FALSE(stage.contains(added.back()));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("nodes that come and go one by one take a time that grows with their number, not with its square") {
  for (const bool bodies : {false, true}) {
    CAPTURE(bodies);
    double few = 1e300, many = 1e300;
    for (int attempt = 0; attempt < 3; ++attempt) {
      few = std::min(few, seconds_of(500, bodies));
      many = std::min(many, seconds_of(8000, bodies));
    }
    MESSAGE("8,000 nodes " << std::string(bodies ? "with" : "without") << " bodies: " << 1e3 * many << " ms");
    CHECK(many < 80 * few);  // quadratic time would be 256 times
  }
}

TEST_CASE("a node that takes the name of one that left has the tracks of that name, and what is below it rides along") {
  Stage stage(cart());
  const Path before = stage.path(stage.node("cart"));
  stage.advance_to(1);
  stage.remove(stage.node("cart"));
  stage.advance_to(1.5);
  CHECK_THROWS_AS((void)stage.node("cart"), std::invalid_argument);
  const NodeId cart = stage.add({.name = "cart", .rest = {.position = {0, 7, 0}}});
  CHECK(stage.node("cart") == cart);
  BodyDescription box{.shape = {Box{{0.1, 0.1, 0.1}}}, .mass = 1.0};
  const NodeId rider = stage.add({.name = "rider", .parent = cart, .rest = {.position = {0, 1, 0}}, .body = box});
  const NodeId hat = stage.add({.name = "hat", .parent = rider, .rest = {.position = {0, 0.2, 0}}});
  CHECK(stage.owner(rider) == Owner::keyed);
  stage.advance_to(2);
  CHECK(near(stage.world(cart).motion.pose.position, Vec3(2, 0, 0), 1e-12));
  CHECK(near(stage.world(rider).motion.pose.position, Vec3(2, 1, 0), 1e-12));
  CHECK(near(stage.world(hat).motion.pose.position, Vec3(2, 1.2, 0), 1e-12));
  CHECK(near(stage.twist(rider).linear, Vec3(1, 0, 0), 1e-12));
  CHECK(near(before.at(2).pose.position, Vec3(2, 0, 0), 1e-12));
  // When taken back, what hangs below a node that was added later settles with it.
  stage.release(rider);
  stage.advance_to(2.2);
  const Vec3 shown = stage.world(hat).motion.pose.position;
  stage.recover(rider);
  CHECK(near(stage.world(hat).motion.pose.position, shown, 1e-9));
  stage.advance_to(4);
  CHECK(near(stage.world(hat).motion.pose.position, Vec3(4, 1.2, 0), 1e-9));
  stage.remove(cart);
  for (const NodeId gone : {cart, rider, hat}) CHECK_FALSE(stage.contains(gone));
}

TEST_CASE("a body that came while the clip ran jumps with it, and strikes nothing on the way") {
  StageDescription description = cart();
  description.world.gravity = Vec3(0, 0, 0);
  description.clips[0].tracks[0].curve = keyed_curve<Vec3>(
      {{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::hold()}, {.time = 1.001, .value = Vec3(0.3, 0, 0)}});
  Stage stage(description);
  stage.advance_to(0.3);
  const NodeId rider = stage.add(ball("rider", {0, 1, 0}, 0));
  const NodeId between = stage.add(ball("between", {0.21, 1, 0}));
  stage.advance_to(1.0005);
  CHECK(near(stage.world(rider).motion.pose.position, Vec3(0, 1, 0), 1e-12));
  stage.advance_to(1.002);
  CHECK(near(stage.world(rider).motion.pose.position, Vec3(0.3, 1, 0), 1e-12));
  CHECK(near(stage.twist(rider).linear, Vec3(0, 0, 0), 1e-12));
  stage.advance_to(1.1);
  // Pushed out of the rider to the side on which it now is, and not carried along.
  CHECK(stage.world(between).motion.pose.position.x() <= 0.21);
}

TEST_CASE("rules of a body that left do not act on the one that takes its place, in any number of rounds") {
  Stage stage(cart());
  std::vector<NodeId> seen;
  for (int round = 0; round < 200; ++round) {
    const std::string name = round % 3 == 0 ? "shot" : "shot" + std::to_string(round);
    const NodeId shot = stage.add(ball(name, Vec3(0, 1, 0)));
    CHECK(std::ranges::find(seen, shot) == seen.end());
    seen.push_back(shot);
    CHECK(stage.node(name) == shot);
    if (round % 2 == 0) {
      stage.arm({.bodies = {name}, .when = {{when::At{1.0 + 0.001 * round}}}, .to = Drive::keyed()});
      CHECK(stage.unfired_rules().size() == 1);
    } else {
      CHECK(stage.unfired_rules().empty());
    }
    if (round % 5 == 0) stage.advance(stage.step());
    if (round < 199) stage.remove(shot);
  }
  stage.advance_to(2);
  CHECK(stage.handoffs().empty());
  CHECK(stage.owner(seen.back()) == Owner::free);
  CHECK(stage.nodes().size() == 202);
}

TEST_CASE("what comes and goes at random is found again, bit by bit, when the stage is sought back") {
  Stage stage(cart());
  Random random(11);
  std::vector<NodeId> here;
  for (int i = 0; i < 300; ++i) {
    const auto draw = [&](std::size_t count) {
      return std::min(count - 1, static_cast<std::size_t>(random.between(0, static_cast<double>(count))));
    };
    const double kind = random.between(0, 1);
    if (here.empty() || kind < 0.5) {
      const bool hangs = !here.empty() && kind < 0.1;
      const Vec3 place(random.between(-2, 2), random.between(-4.5, 0), random.between(-2, 2));
      here.push_back(stage.add(ball("ball" + std::to_string(i), place, hangs ? here[draw(here.size())] : no_node)));
    } else if (kind < 0.7) {
      stage.remove(here[draw(here.size())]);
      std::erase_if(here, [&](NodeId node) { return !stage.contains(node); });
    } else {
      stage.advance(random.between(0, 0.03));
    }
  }
  CHECK(stage.events().size() > 10);
  stage.advance(0.1);
  const double end = stage.time();
  const std::uint64_t hash = stage.state_hash();
  const std::size_t events = stage.events().size();
  for (const double time : {0.0, 0.4 * end, end, 0.1, 0.9 * end}) {
    stage.seek(time);
    stage.seek(end);
    CHECK(stage.state_hash() == hash);
    CHECK(stage.events().size() == events);
    for (const NodeId node : here) CHECK(stage.contains(node));
  }
}

TEST_CASE("what came below a body rides along when that is handed back to a clip of its own clock") {
  StageDescription description = cart();
  description.nodes[0].body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0};
  Stage stage(description);
  stage.advance(0.1);
  std::vector<NodeId> riders;
  for (int i = 0; i < 50; ++i)
    riders.push_back(
        stage.add({.name = "rider" + std::to_string(i), .parent = 0, .rest = {.position = {0, 0.1 * i, 0}}}));
  stage.release(0);
  stage.advance(0.1);
  stage.recover(0, {.clip = "ride", .clock = HandBack::Clock::restart});
  for (int frame = 0; frame < 40; ++frame) {
    stage.advance(0.01);
    const Motion cart = stage.world(0).motion;
    for (std::size_t i = 0; i < riders.size(); ++i)
      CHECK(near(stage.world(riders[i]).motion.pose.position,
                 Vec3(cart.pose.position + cart.pose.rotation * Vec3(0, 0.1 * static_cast<double>(i), 0)), 1e-12));
  }
}
