#include "physics/soft/soft_scene.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("the energy of a cantilevered volume of constraints never grows, however stiff or damped it is") {
  const VolumeMaterial materials[] = {{},
                                      {.stiffness = 2e3, .bulk = 1e7},
                                      {.stiffness = 2e3, .bulk = 1e12},
                                      {.stiffness = 1e6, .bulk = 1e9},
                                      {.stiffness = 1e8, .bulk = 1e3},
                                      {.stiffness = 1e12, .bulk = 1e12},
                                      {.damping = 2e3},
                                      {.stiffness = 1e8, .damping = 1e8}};
  for (const VolumeMaterial& material : materials) {
    CAPTURE(material.stiffness);
    CAPTURE(material.bulk);
    CAPTURE(material.damping);
    SoftSettings bar = soft_box({.half_extents = {0.5, 0.1, 0.1}, .cells = {8, 2, 2}, .material = material});
    for (std::uint32_t i = 0; i < bar.positions.size(); ++i)
      if (bar.positions[i].x() < -0.499) bar.pins.push_back({.node = i, .in_place = true});
    World world;
    const SoftId id = add_soft(world, bar);
    double before = energy_of(world, id), lowest = 0;
    for (int n = 0; n < 240; ++n) {
      world.step(1.0 / 240);
      const double now = energy_of(world, id);
      REQUIRE(now <= before + 1e-12);
      before = now;
      lowest = std::min(lowest, center_of(world, id).y());
    }
    CHECK(lowest < -1e-3);
    CHECK(all_finite(world, id));
  }
}

TEST_CASE("a cantilevered volume gains no energy by a pass or two either, whatever its shape") {
  const VolumeMaterial materials[] = {{.stiffness = 1e12, .bulk = 1e12}, {.stiffness = 1e8, .damping = 1e8}};
  const SoftBoxSettings boxes[] = {{.half_extents = {0.5, 0.1, 0.1}, .cells = {8, 2, 2}},
                                   {.half_extents = {0.5, 0.2, 0.2}, .cells = {6, 3, 3}},
                                   {.half_extents = {0.6, 0.05, 0.2}, .cells = {10, 1, 3}}};
  for (const VolumeMaterial& material : materials)
    for (int run = 0; run < 6; ++run) {
      SoftBoxSettings box = boxes[run / 2];
      CAPTURE(material.stiffness);
      CAPTURE(box.cells[0]);
      box.material = material;
      SoftSettings bar = soft_box(box);
      bar.iterations = 1 + run % 2;
      for (std::uint32_t i = 0; i < bar.positions.size(); ++i)
        if (bar.positions[i].x() < 1e-3 - box.half_extents.x()) bar.pins.push_back({.node = i, .in_place = true});
      World world;
      const SoftId id = add_soft(world, bar);
      double before = energy_of(world, id);
      for (int n = 0; n < 120; ++n) {
        world.step(1.0 / 240);
        const double now = energy_of(world, id);
        REQUIRE(now <= before + 1e-12);
        before = now;
      }
      CHECK(center_of(world, id).y() < -1e-4);
    }
}

TEST_CASE("a balloon that is squeezed and let go gains no energy, however stiff its air is") {
  for (const double bulk : {1e3, 1e6, 1e12}) {
    CAPTURE(bulk);
    const SurfaceMesh box{
        .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
        .triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}};
    SoftSettings made = balloon(box, {.skin = {.stretching = 500}, .bulk = bulk});
    for (SoftEdge& edge : made.edges) edge.length = (made.positions[edge.a] - made.positions[edge.b]).norm();
    for (Vec3& place : made.positions) place.y() *= 0.8;
    World world({.gravity = {0, 0, 0}});
    const SoftId id = add_soft(world, made);
    world.step(1.0 / 240);
    double before = energy_of(world, id);
    for (int n = 0; n < 240; ++n) {
      world.step(1.0 / 240);
      const double now = energy_of(world, id);
      REQUIRE(now <= before + 1e-9 * before);
      before = now;
    }
    const auto x = soft_positions(world, id);
    const std::vector<Vec3> there(x.begin(), x.end());
    double volume = 0;
    for (const auto& triangle : made.triangles)
      volume += there[triangle[0]].dot(there[triangle[1]].cross(there[triangle[2]])) / 6;
    CHECK(volume == doctest::Approx(1).epsilon(0.01));
  }
}
