#include <tweenfall/physics/stage/stage.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

TEST_CASE("a stage of thousands of bodies takes a few kilobytes for each, with the states that it goes back to") {
  StageDescription described;
  constexpr std::size_t count = 4000;
  for (std::size_t i = 0; i < count; ++i) {
    NodeDescription node{.name = "ball" + std::to_string(i)};
    node.rest.position = Vec3(3 * static_cast<double>(i), 1000, 0);
    node.body = BodyDescription{.shape = {Sphere{0.5}}};
    described.nodes.push_back(node);
  }
  const std::size_t before = test::bytes_held();
  const Stage stage(std::move(described));
  // Two thirds are three states: at the start, before and after now. 6,200 while each held room for all that may
  // settle.
  CHECK(test::bytes_held() - before < 3700 * count);
}
