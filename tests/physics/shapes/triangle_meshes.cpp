
#include "physics/grounds.h"
#include "processor_time.h"

namespace tweenfall::test::grounds {

TEST_CASE("a mesh or height field that cannot be is refused with words") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SurfaceMesh mesh;
  CHECK_THROWS_WITH(TriangleMesh{mesh}, "a triangle mesh needs at least one triangle");
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {0, 2, 3};
  CHECK_THROWS_WITH(TriangleMesh{mesh}, "a triangle mesh has a triangle, number 0, with vertex 3, but there are 3");
  mesh.triangles = {0, 2};
  CHECK_THROWS_WITH(TriangleMesh{mesh}, "a triangle mesh has 2 corners, which is not three per triangle");
  mesh.triangles = {0, 2, 2};
  CHECK_THROWS_WITH(TriangleMesh{mesh}, "a triangle mesh needs a triangle with an area; all of these 1 have none");
  mesh.triangles = {0, 2, 1, 0, 1, 1};
  CHECK(TriangleMesh(mesh).triangles().size() == 3);
  mesh.positions[1].y() = nan;
  CHECK_THROWS_WITH(TriangleMesh{mesh},
                    "a triangle mesh has vertex 1 at (1, nan, 0); vertices must be finite and at most 1e30 m away");
  const std::vector<double> heights = {0, 0, 0, nan, 0, 0};
  CHECK_THROWS_WITH(HeightField(1, heights, 1, 1), "a height field needs at least 2 columns, but has 1");
  CHECK_THROWS_WITH(HeightField(4, heights, 1, 1),
                    "a height field needs whole rows of 4 heights, but has 6 heights in all");
  CHECK_THROWS_WITH(HeightField(6, heights, 1, 1), "a height field needs at least 2 rows, but has 1");
  CHECK_THROWS_WITH(HeightField(3, heights, 1, 0),
                    "a height field needs a spacing along z from 1e-30 m to 1e22 m, but has 0");
  CHECK_THROWS_WITH(
      HeightField(3, heights, 1, 1),
      "a height field has a height of nan m in column 0 of row 1; heights must be finite and at most 1e30 m");
  World world;
  const Shape floor{TriangleMesh(flat_floor(1, 2))};
  CHECK_THROWS_WITH(world.add({.shape = floor}), "a body with a triangle mesh must be fixed or keyed: it has no mass");
  const BodyId keyed = world.add({.shape = floor, .drive = Drive::keyed()});
  CHECK_THROWS_WITH(world.set_drive(keyed, Drive::free()),
                    "a body with a triangle mesh must stay fixed or keyed: it has no mass");
  CHECK_THROWS_WITH((void)mass_properties(floor, 1),
                    "a triangle mesh has no mass: only fixed and keyed bodies can be of this shape");
  CHECK_THROWS_WITH(Compound({{TriangleMesh(flat_floor(1, 2)), {}}}),
                    "part 0 of a compound: a triangle mesh has no volume; give it to a fixed body of its own");
}

TEST_CASE("a million triangles are taken in within seconds, and asked in microseconds") {
  const double begin = test::processor_seconds();
  const TriangleMesh mesh(flat_floor(500, 708));
  CHECK(mesh.triangles().size() / 3 > 1'000'000);
  const double built = test::processor_seconds() - begin;
  CAPTURE(built);
  CHECK(built < 60);  // about 1 s
  const Shape shape{mesh};
  int hits = 0;
  for (int i = 0; i < 1000; ++i)
    hits += cast_ray(shape, {}, {0.4 * i - 200, 3, 0.1 * i}, {0.1, -1, 0.2}).has_value() ? 1 : 0;
  CHECK(hits == 1000);
  CHECK(test::processor_seconds() - begin - built < 2);
}

}  // namespace tweenfall::test::grounds
