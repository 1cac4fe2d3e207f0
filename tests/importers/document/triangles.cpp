#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <cmath>

using namespace tweenfall;

TEST_CASE("meshes, height fields and hulls of imported meshes are what the document says") {
  const StageDescription stage = Document::read(test::data_folder() / "documents/good/triangles.json").stage();
  const auto solid = [&](const std::string& name) -> const Solid& {
    for (const NodeDescription& node : stage.nodes)
      if (node.name == name) return node.body->shape.solid;
    throw std::logic_error("no node " + name);
  };
  const auto& plate = std::get<TriangleMesh>(solid("plate"));
  CHECK(plate.triangles().size() == 6);
  CHECK(plate.vertices()[2] == Vec3(1, 0, 1));
  const auto& field = std::get<HeightField>(solid("field"));
  CHECK(field.columns() == 3);
  CHECK(field.rows() == 2);
  CHECK(field.heights()[4] == 1);
  CHECK(field.spacing_x() == 0.5);
  CHECK(field.spacing_z() == 2);
  CHECK(std::get<HeightField>(solid("even")).spacing_z() == 3);
  // The rock's node is half as large as its mesh: in the file's space it is scaled, and in its own it is not.
  const auto width = [](const Solid& of) {
    const Bounds box = bounds({of}, {});
    return box.high.x() - box.low.x();
  };
  CHECK(test::near(width(solid("bare")), 1, 1e-6));
  CHECK(test::near(width(solid("whole")), 0.5, 1e-6));
  CHECK(test::near(width(solid("stone/rock")), 1, 1e-6));
  CHECK(test::near(width(solid("pebble")), 0.5, 1e-6));
  CHECK(std::get<Hull>(solid("pebble")).convex.vertices().size() == 8);
  CHECK(test::near(volume(solid("pebble")), volume(solid("stone/rock")) / 8, 1e-9));
}

TEST_CASE("boxes and capsules fitted to an imported mesh lie where it does, and move with their offsets") {
  const StageDescription stage = Document::read(test::data_folder() / "documents/good/fitted.json").stage();
  const auto shape = [&](const std::string& name) -> const Shape& {
    for (const NodeDescription& node : stage.nodes)
      if (node.name == name) return node.body->shape;
    throw std::logic_error("no node " + name);
  };
  // The mesh is a board of 0.2 by 1.4 by 0.4 m, turned by (2 -1 2, 2 2 -1, -1 2 2) / 3 and moved to its middle.
  const Vec3 middle(0.5, 0.25, -0.3), length = Vec3(-1, 2, 2) / 3;
  const auto is_board = [&](const Shape& board, const Vec3& at, const Vec3& along) {
    Vec3 sizes = 2 * std::get<Box>(board.solid).half_extents;
    int longest = 0;
    sizes.maxCoeff(&longest);
    CHECK(std::abs((board.offset.rotation * Vec3::Unit(longest)).dot(along)) > 1 - 1e-6);
    std::sort(sizes.data(), sizes.data() + 3);
    CHECK(test::near(sizes, Vec3(0.2, 0.4, 1.4), 1e-5));
    CHECK(test::near(board.offset.position, at, 1e-5));
  };
  is_board(shape("wood/plank"), middle, length);
  // A quarter turn about y takes x to -z and z to x.
  const Vec3 turned(middle.z(), middle.y() + 2, -middle.x());
  is_board(shape("moved"), turned, Vec3(length.z(), length.y(), -length.x()));
  const Shape& round = shape("round");
  const auto& capsule = std::get<Capsule>(round.solid);
  CHECK(test::near(round.offset.position, middle, 1e-5));
  CHECK(std::abs((round.offset.rotation * Vec3::UnitY()).dot(length)) > 1 - 1e-6);
  CHECK(capsule.radius > 0.19);
  CHECK(capsule.radius < 0.23);
  const auto parts = std::get<Compound>(shape("pair").solid).parts();
  REQUIRE(parts.size() == 3);
  is_board(parts[0], middle, length);
  CHECK(test::near(parts[1].offset.position, middle + Vec3(0, 1, 0), 1e-5));
  CHECK(parts[2].offset.position == Vec3(0, 3, 0));
  CHECK(std::get<Capsule>(parts[2].solid).half_height == 0.1);
}

TEST_CASE("what falls on the terrain sample comes to rest on it") {
  const auto file = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/terrain.json";
  Stage stage(Document::read(file).stage());
  for (int i = 0; i < 720; ++i) stage.advance(1.0 / 60);
  for (const char* name : {"stone/rock", "ball", "drum"}) {
    CAPTURE(std::string(name));
    const Pose pose = stage.world(stage.node(name)).motion.pose;
    CHECK(pose.position.y() > 0);
    CHECK(pose.position.cwiseAbs().maxCoeff() < 3.5);
    CHECK(stage.twist(stage.node(name)).linear.norm() < 0.05);
  }
}
