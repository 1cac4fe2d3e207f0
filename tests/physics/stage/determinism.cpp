#include "physics/handoff/scenes.h"

#include <array>
#include <cstdint>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A body on a tumbling path is let go above a floor on which three boxes, a sphere and a capsule lie, and is
/// taken back: every solid, contact, friction, bounce, and both hand-offs.
StageDescription small_stage() {
  StageDescription stage = tumbler(1.0 / 240);
  stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  const auto lay = [&](const std::string& name, const Shape& shape, const Vec3& place) {
    stage.nodes.push_back(
        {.name = name,
         .rest = {.position = place, .rotation = Quat(0.8, 0.36, -0.48, 0)},
         .body = BodyDescription{
             .shape = shape, .density = 300, .friction = 0.6, .restitution = 0.3, .rolling_friction = 0.01}});
  };
  lay("box one", {Box{{0.25, 0.2, 0.3}}}, {0, 0.6, 0});
  lay("box two", {Box{{0.3, 0.3, 0.3}}}, {0.1, 1.4, 0.1});
  lay("box three", {Box{{0.15, 0.4, 0.2}}}, {0.5, 0.9, -0.4});
  lay("ball", {Sphere{0.25}}, {-0.4, 0.9, 0.3});
  lay("rod", {Capsule{0.1, 0.3}}, {-0.3, 1.7, -0.2});
  stage.forces = {ForceDescription{}};
  HandBack back;
  back.settle = {Settle::Kind::quintic, 0.3};
  stage.rules = {release_at(0.3137, "body"), recover_at(2.0071, "body", back)};
  return stage;
}

}  // namespace

TEST_CASE("the bits of a small stage are the same with every compiler and at every level of optimization") {
  Stage stage(small_stage());
  CHECK(stage.step() == 1.0 / 240);
  // Before the first contact, in the heap, just before the body is taken back, after its settling: 600 steps.
  const std::array<std::uint64_t, 4> pinned = {5841027904463276120u, 4330569503117813335u, 11451673247155685023u,
                                               18022966620689108249u};
  std::size_t i = 0;
  for (const int steps_done : {20, 240, 480, 600}) {
    CAPTURE(steps_done);
    stage.advance_to(steps_done / 240.0);
    CHECK(stage.state_hash() == pinned[i++]);
  }
  CHECK(stage.handoffs().size() == 2);
  CHECK(stage.events().size() > 8);
}
