#include "processor_time.h"
#include "support.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/stage.h>

#include <malloc.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// Balls far from each other, each thrown by a track of its own.
StageDescription thrown(std::size_t count) {
  StageDescription description;
  description.world.gravity = Vec3(0, 0, 0);
  Clip clip{.name = "throw", .duration = 10};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "ball" + std::to_string(i);
    description.nodes.push_back({.name = name, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}});
    const double x = 3.0 * static_cast<double>(i);
    clip.tracks.push_back(
        {name, "position",
         keyed_curve<Vec3>({{.time = 0, .value = Vec3(x, 0, 0)}, {.time = 10, .value = Vec3(x, 5, 0)}})});
  }
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  return description;
}

}  // namespace

TEST_CASE("two thousand bodies are handed back to a clip within 20 ms and 20 MB") {
  constexpr std::size_t count = 2000;
  const StageDescription description = thrown(count);
  const auto animation = std::make_shared<const Animation>(
      [&] {
        std::vector<Node> nodes;
        for (const NodeDescription& node : description.nodes) nodes.push_back({node.name});
        return std::make_shared<const Hierarchy>(std::move(nodes));
      }(),
      description.clips, description.plays);
  HandBack back;
  back.clip = "throw";
  back.clock = HandBack::Clock::hold;
  double least_seconds = 1e300, least_bytes = 1e300;
  for (int attempt = 0; attempt < 3; ++attempt) {
    std::vector<Path> paths;
    paths.reserve(count);
    const std::size_t before = mallinfo2().uordblks;
    const double start = processor_seconds();
    for (std::size_t node = 0; node < count; ++node) {
      const Path path(animation, node);
      paths.push_back(path.recovered(1.0, back, path.at(0.5), 0.4));
    }
    least_seconds = std::min(least_seconds, processor_seconds() - start);
    least_bytes = std::min(least_bytes, static_cast<double>(mallinfo2().uordblks) - static_cast<double>(before));
    CHECK(near(paths[7].at(1.0).pose.position, Path(animation, 7).at(0.5).pose.position, 1e-12));
  }
  MESSAGE("2,000 hand-backs: " << 1e3 * least_seconds << " ms, " << least_bytes / 1e6 << " MB beside the paths");
  CHECK(least_bytes < 20e6);
  CHECK(least_seconds < 0.02);
}

TEST_CASE("a stage hands two thousand bodies back at once, and each goes on where its clock was held") {
  constexpr std::size_t count = 2000;
  StageDescription description = thrown(count);
  HandBack back;
  back.clock = HandBack::Clock::hold;
  back.settle.seconds = 0.1;
  description.rules = {{.bodies = {"ball*"}, .when = {{when::At{0.02}}}},
                       {.bodies = {"ball*"}, .when = {{when::At{0.05}}}, .to = Drive::keyed(), .hand_back = back}};
  Stage stage(description);
  stage.advance_to(0.05 - 1.5 * stage.step());
  const std::size_t before = mallinfo2().uordblks;
  const double start = processor_seconds();
  stage.advance(stage.step());
  const double seconds = processor_seconds() - start;
  const double bytes = static_cast<double>(mallinfo2().uordblks) - static_cast<double>(before);
  MESSAGE("the step in which 2,000 bodies come back: " << 1e3 * seconds << " ms, " << bytes / 1e6 << " MB");
  CHECK(bytes < 20e6);
  stage.advance_to(0.25);
  REQUIRE(stage.handoffs().size() == 2 * count);
  const Animation authored(
      [&] {
        std::vector<Node> nodes;
        for (const NodeDescription& node : description.nodes) nodes.push_back({node.name});
        return std::make_shared<const Hierarchy>(std::move(nodes));
      }(),
      description.clips, description.plays);
  for (const std::size_t node : {std::size_t{0}, std::size_t{999}, std::size_t{1999}})
    CHECK(near(stage.world(node).motion.pose.position, authored.world(node, 0.22).motion.pose.position, 1e-12));
}

TEST_CASE("a hand-back that holds the clock in a cross-fade holds the weights too") {
  StageDescription description = thrown(1);
  Clip high{.name = "high", .duration = 10};
  high.tracks = {{"ball0", "position", Curve<Vec3>(Vec3(0, 0, 2))}};
  description.clips.push_back(high);
  const auto fade = keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::linear()}, {.time = 4, .value = 1.0}});
  description.plays.push_back({.clip = 1, .weight = fade});
  HandBack back;
  back.clock = HandBack::Clock::hold;
  back.settle.seconds = 0.1;
  description.rules = {{.bodies = {"ball0"}, .when = {{when::At{1}}}},
                       {.bodies = {"ball0"}, .when = {{when::At{2}}}, .to = Drive::keyed(), .hand_back = back}};
  Stage stage(description);
  const Path authored = stage.path(stage.node("ball0"));
  stage.advance_to(2.5);
  CHECK(near(stage.world(0).motion.pose.position, authored.at(1.5).pose.position, 1e-12));
  CHECK(near(stage.twist(0).linear, authored.at(1.5).twist.linear, 1e-12));
}
