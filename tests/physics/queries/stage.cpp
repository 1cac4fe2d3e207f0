#include "physics/handoff/scenes.h"
#include "physics/queries/solids.h"

#include <tweenfall/physics/stage/query.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A body on a path above a floor and balls that fall; the body is let go at 0.3137 s.
StageDescription asked_stage() {
  StageDescription stage = tumbler(1.0 / 60);
  stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  for (int i = 0; i < 6; ++i)
    stage.nodes.push_back({.name = "ball " + std::to_string(i),
                           .rest = {.position = Vec3(i - 3, 1 + 0.3 * i, 0.5)},
                           .body = BodyDescription{.shape = {Sphere{0.2 + 0.02 * i}}, .restitution = 0.5}});
  stage.nodes.push_back({.name = "mark", .rest = {.position = Vec3(0, 2, 0)}});
  stage.rules = {release_at(0.3137, "body")};
  return stage;
}

}  // namespace

TEST_CASE("at any instant a stage answers where its bodies are shown, between steps and after going back") {
  Stage stage(asked_stage());
  Random random(4);
  const auto check = [&] {
    CAPTURE(stage.time());
    for (int i = 0; i < 6; ++i) {
      const NodeId ball = stage.node("ball " + std::to_string(i));
      const Vec3 place = stage.world(ball).motion.pose.position;
      const NodeFilter only{.accept = [ball](NodeId node) { return node == ball; }};
      const std::optional<NodeRayHit> hit = cast_ray(stage, place + Vec3(0, 0, 5), Vec3(0, 0, -1), 9, only);
      REQUIRE(hit.has_value());
      CHECK(hit->node == ball);
      CHECK(hit->distance == doctest::Approx(5 - 0.2 - 0.02 * i).epsilon(1e-12));
      const std::vector<NodeId> here = overlapping(stage, {Sphere{0.01}}, {.position = place});
      CHECK(std::ranges::find(here, ball) != here.end());
      CHECK(nearest_body(stage, place, 0)->distance == 0);
      const Separation gap = distance(stage, ball, stage.node("floor"));
      CHECK(gap.distance == doctest::Approx(std::max(0.0, place.y() - 0.2 - 0.02 * i)).epsilon(1e-9));
    }
    const NodeId body = stage.node("body");
    const WorldMotion shown = stage.world(body);
    const Shape& shape = stage.description().nodes[body].body->shape;
    const NodeFilter only{.accept = [body](NodeId node) { return node == body; }};
    const Vec3 from = shown.motion.pose.position + random.vector(4), way = shown.motion.pose.position - from;
    const auto expected = cast_ray(shape, shown.motion.pose, from, way);
    const auto hit = cast_ray(stage, from, way, without_end, only);
    REQUIRE(hit.has_value() == expected.has_value());
    if (hit) CHECK(hit->distance == doctest::Approx(expected->distance).epsilon(1e-9));
  };
  check();
  for (const double time : {0.01, 0.1234, 0.3137, 0.32, 0.5, 0.7001, 1.5}) {
    stage.advance_to(time);
    check();
  }
  stage.seek(0.2);
  check();
  stage.release(stage.node("body"));
  check();
  stage.advance(0.05);
  check();
}

TEST_CASE("a stage's answers follow what comes and goes, also within a callback") {
  Stage stage(asked_stage());
  stage.advance(0.1);
  const NodeId wall = stage.add({.name = "wall",
                                 .rest = {.position = Vec3(0, 50, 0)},
                                 .body = BodyDescription{.shape = {Box{{1, 1, 1}}}, .fixed = true}});
  const auto down = [&](double height) { return cast_ray(stage, Vec3(0, height, 0), Vec3(0, -1, 0)); };
  CHECK(down(60)->node == wall);
  CHECK(down(60)->distance == 9);
  CHECK(cast_shape(stage, {Sphere{1}}, {.position = Vec3(0, 60, 0)}, Vec3(0, -10, 0))->fraction ==
        doctest::Approx(0.8).epsilon(1e-12));
  CHECK(cast_ray_through(stage, Vec3(0, 60, 0), Vec3(0, -1, 0)).front().node == wall);
  stage.remove(wall);
  CHECK(down(60)->node != wall);
  CHECK(!cast_ray(stage, Vec3(0, 60, 0), Vec3(0, -1, 0), 20).has_value());
  int told = 0;
  stage.on_contact([&](const StageEvent& event) {
    ++told;
    for (const NodeId node : event.nodes) {
      // The floor is infinite, and the origin of the body on the path lies outside of it.
      if (!stage.nodes()[node].name.starts_with("ball")) continue;
      const Vec3 place = stage.world(node).motion.pose.position;
      const std::vector<NodeId> here = overlapping(stage, {Sphere{1e-3}}, {.position = place});
      CHECK(std::ranges::find(here, node) != here.end());
    }
  });
  stage.advance(1.5);
  CHECK(told > 3);
  CHECK_THROWS_AS((void)distance(stage, stage.node("mark"), stage.node("floor")), std::invalid_argument);
  CHECK_THROWS_AS((void)distance(stage, 999, stage.node("floor")), std::invalid_argument);
}

TEST_CASE("a stage's bodies are asked in the size of their nodes, awake and asleep, and answer where they lie") {
  const auto at = [](const Vec3& place, const Vec3& scale) { return Pose{.position = place, .scale = scale}; };
  const Compound dumbbell({Shape{Box{{0.5, 0.5, 0.5}}}, Shape{Sphere{0.5}, {.position = {1, 0, 0}}}});
  const TriangleMesh sheet(
      SurfaceMesh{.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, .triangles = {0, 2, 1, 0, 3, 2}});
  StageDescription described;
  described.nodes = {
      {.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
      {.name = "ball", .rest = at({0, 1, 0}, {2, 2, 2}), .body = BodyDescription{.shape = {Sphere{0.5}}}},
      {.name = "box", .rest = at({10, 1, 0}, {2, 1, 3}), .body = BodyDescription{.shape = {Box{{0.5, 1, 0.5}}}}},
      {.name = "dumbbell", .rest = at({20, 1, 0}, {2, 2, 2}), .body = BodyDescription{.shape = {dumbbell}}},
      {.name = "sheet", .rest = at({30, 2, 0}, {2, 3, 4}), .body = BodyDescription{.shape = {sheet}, .fixed = true}}};
  Stage stage(described);
  for (const double time : {0.0, 0.2, 4.0}) {
    CAPTURE(time);
    stage.advance_to(time);
    const auto down = [&](double x, double z) { return cast_ray(stage, {x, 9, z}, {0, -1, 0}); };
    const auto is = [&](double x, double z, const char* name, double distance) {
      const auto hit = down(x, z);
      REQUIRE(hit);
      CHECK(hit->node == stage.node(name));
      CHECK(hit->distance == doctest::Approx(distance).epsilon(1e-4));
    };
    is(0, 0, "ball", 7);
    is(0.6, 0, "ball", 9 - 1.8);
    is(1.05, 0, "floor", 9);
    is(10.95, 1.45, "box", 7);
    is(11.05, 0, "floor", 9);
    is(10, 1.55, "floor", 9);
    is(22.6, 0, "dumbbell", 9 - 1.8);
    is(31.95, 3.95, "sheet", 7);
    is(32.05, 0, "floor", 9);
    // A ball of half a meter from above, and along the floor.
    const auto cast = cast_shape(stage, {Sphere{0.5}}, {.position = {10, 8, 0}}, {0, -10, 0});
    REQUIRE(cast);
    CHECK(cast->node == stage.node("box"));
    CHECK(cast->fraction == doctest::Approx(0.55).epsilon(1e-4));
    const NodeFilter no_floor{.accept = [&](NodeId node) { return node != stage.node("floor"); }};
    const auto along = cast_shape(stage, {Sphere{0.5}}, {.position = {-5, 1, 0}}, {10, 0, 0}, no_floor);
    REQUIRE(along);
    CHECK(along->node == stage.node("ball"));
    CHECK(along->fraction == doctest::Approx(0.35).epsilon(1e-4));
    CHECK(overlapping(stage, {Sphere{0.1}}, {.position = {10.9, 1.9, 1.4}}) == std::vector{stage.node("box")});
    CHECK(overlapping(stage, {Box{{0.1, 0.1, 0.1}}}, {.position = {31.9, 2.05, 3.9}}) ==
          std::vector{stage.node("sheet")});
    CHECK(distance(stage, stage.node("ball"), stage.node("box")).distance == doctest::Approx(8).epsilon(1e-4));
    CHECK(distance(stage, stage.node("box"), stage.node("dumbbell")).distance == doctest::Approx(8).epsilon(1e-4));
    CHECK(distance(stage, stage.node("dumbbell"), stage.node("sheet")).distance ==
          doctest::Approx(std::hypot(6, 1) - 1).epsilon(1e-4));
    CHECK(nearest_body(stage, {14, 1, 0}, 9, no_floor)->node == stage.node("box"));
  }
}
