// Small files written out here, so that every format is tested in a bare clone too.

#include "importers/models/model_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("a BVH's channels turn in their order and its frames lie on exact multiples of the frame time") {
  const ScratchFolder folder("bvh");
  const Model model = load_model(folder.file("two.bvh", R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Knee
  {
    OFFSET 0 -2 0
    CHANNELS 1 Xrotation
    End Site
    {
      OFFSET 0 -3 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.1
0 0 0  0 0 0  0
1 2 3  90 90 0  90
1 2 3  90 90 90  0
)"));
  REQUIRE(model.nodes.size() == 3);
  CHECK(model.nodes[2].name == "EndSite_Knee");
  CHECK(model.clips.at(0).duration == 0.2);
  Posed posed(model);
  CHECK(near(posed.world(2).motion.pose.position, Vec3(0, -5, 0), 1e-15));
  posed.play(0);
  posed.at(0.1);
  // Z by 90 takes -y to x; X by 90, about the turned axes, takes -y to -z first.
  CHECK(near(posed.world(1).motion.pose.position, Vec3(1, 2, 1), 1e-12));
  // The knee bends by another 90: two quarter turns about x take -y to y, and z takes that to -x.
  CHECK(near(posed.world(2).motion.pose.position, Vec3(-2, 2, 1), 1e-12));
}

TEST_CASE("an OBJ gives triangles in its own units") {
  const ScratchFolder folder("obj");
  const Model model = load_model(folder.file("quad.obj", "v 0 0 0\nv 100 0 0\nv 100 50 0\nv 0 50 0\nf 1 2 3 4\n"));
  REQUIRE(model.instances.size() == 1);
  const Mesh& mesh = model.meshes[model.instances[0].mesh];
  CHECK(mesh.positions.size() == 4);
  CHECK(mesh.triangles.size() == 6);
  double widest = 0;
  for (const Vec3& point : mesh.positions) widest = std::max(widest, point[0]);
  CHECK(widest == 100);
}

TEST_CASE("unnamed and doubly named nodes and animations get names of their own") {
  const ScratchFolder folder("names");
  const Model model = load_model(folder.file("names.gltf", R"({"asset": {"version": "2.0"},
    "nodes": [{"name": "arm"}, {"children": [3]}, {"name": "arm"}, {"name": "arm"}], "animations": [
    {"channels": [], "samplers": []}, {"name": "go", "channels": [], "samplers": []}, {"name": "go", "channels": [], "samplers": []}]})"));
  std::vector<std::string> names;
  for (const Node& node : model.nodes) names.push_back(node.name);
  CHECK(names == std::vector<std::string>{"arm", "node_1", "arm#2", "arm#3"});
  CHECK(model.nodes[3].parent == 1);
  CHECK(model.clips[0].name == "animation_0");
  CHECK(model.clips[2].name == "go#2");
}

TEST_CASE("a sparse accessor of normalized bytes is read as fractions") {
  // Three positions of zeros without a buffer view; the sparse values put (127, -127, 0) / 127 at index 2.
  const ScratchFolder folder("sparse");
  const Model model = load_model(folder.file("sparse.gltf", R"({"asset": {"version": "2.0"},
    "buffers": [{"byteLength": 8, "uri": "data:application/octet-stream;base64,AgAAAH+BAAA="}],
    "bufferViews": [{"buffer": 0, "byteLength": 1}, {"buffer": 0, "byteOffset": 4, "byteLength": 4}],
    "accessors": [{"componentType": 5120, "normalized": true, "count": 3, "type": "VEC3", "sparse": {"count": 1,
      "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]})"));
  REQUIRE(model.meshes.size() == 1);
  CHECK(model.meshes[0].positions[1] == Vec3(0, 0, 0));
  CHECK(model.meshes[0].positions[2] == Vec3(1, -1, 0));
  CHECK(model.meshes[0].triangles == std::vector<std::uint32_t>{0, 1, 2});
}
