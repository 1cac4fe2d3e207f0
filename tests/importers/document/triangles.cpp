#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

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
  // The rock's node is half as large as its mesh: in the file's space it is, and in its own it is not.
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
