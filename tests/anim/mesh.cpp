#include "support.h"

#include <tweenfall/anim/mesh.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Mesh edge() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.morphs = {{"lift", {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, {}}, {"pull", {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {}}};
  mesh.rest_weights = {0.5, 0};
  return mesh;
}

WorldMotion placed(const Mat3& linear, const Vec3& position) {
  WorldMotion world;
  world.linear = linear;
  world.motion.pose.position = position;
  return world;
}

Mat3 quarter_turn_about_z() {
  Mat3 m;
  m << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return m;
}

}  // namespace

TEST_CASE("a mesh without skin follows its node, with its rest weights unless others are given") {
  const Mesh mesh = edge();
  const std::vector<WorldMotion> world{placed(Mat3::Identity(), {9, 9, 9}),
                                       placed(2 * quarter_turn_about_z(), {0, 0, 5})};
  std::vector<Vec3> out(3);
  deform(mesh, {}, nullptr, 1, world, out);
  CHECK(near(out[2], Vec3(-1, 4, 5), 1e-15));
  const std::vector<double> weights{0, 2};
  deform(mesh, weights, nullptr, 1, world, out);
  CHECK(near(out[0], Vec3(0, 0, 5), 1e-15));
  CHECK(near(out[2], Vec3(0, 8, 5), 1e-15));
}

TEST_CASE("a skinned vertex is the weighted mean of what its joints make of it") {
  Mesh mesh = edge();
  mesh.rest_weights = {0, 0};
  mesh.influences.add({{0, 1}});
  mesh.influences.add({{0, 0.75}, {1, 0.25}});
  mesh.influences.add({{1, 1}});
  Skin skin;
  skin.joints = {2, 0};
  skin.inverse_binds = {{Mat3::Identity(), {0, 0, 0}}, {Mat3::Identity(), {-1, 0, 0}}};
  const std::vector<WorldMotion> world{placed(quarter_turn_about_z(), {1, 0, 0}), placed(Mat3::Zero(), {7, 7, 7}),
                                       placed(Mat3::Identity(), {0, 0, 0})};
  std::vector<Vec3> out(3);
  deform(mesh, {}, &skin, 1, world, out);
  CHECK(near(out[0], Vec3(0, 0, 0), 1e-15));
  CHECK(near(out[1], Vec3(1, 0, 0), 1e-15));
  CHECK(near(out[2], Vec3(1, 1, 0), 1e-15));
}

TEST_CASE("a vertex follows each of its joints, however many there are") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  Skin skin;
  std::vector<WorldMotion> world;
  std::vector<Influence> pulls;
  for (std::uint32_t joint = 0; joint < 8; ++joint) {
    skin.joints.push_back(joint);
    skin.inverse_binds.push_back({});
    world.push_back(placed(Mat3::Identity(), {joint + 1.0, 0, 0}));
    pulls.push_back({joint, 0.125});
  }
  mesh.influences.add(pulls);
  CHECK(mesh.influences.most() == 8);
  std::vector<Vec3> out(1);
  deform(mesh, {}, &skin, 0, world, out);
  CHECK(near(out[0], Vec3(4.5, 0, 0), 1e-15));
}

TEST_CASE("joints in their bind poses leave a skinned mesh where it was") {
  Random random(3);
  Mesh mesh;
  Skin skin;
  std::vector<WorldMotion> world;
  constexpr std::size_t joints = 9;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const Mat3 linear = random.rotation().toRotationMatrix() * random.between(0.5, 2);
    const Vec3 position = random.vector(3);
    world.push_back(placed(linear, position));
    skin.joints.push_back(joint);
    skin.inverse_binds.push_back({linear.inverse(), -(linear.inverse() * position)});
  }
  for (int i = 0; i < 50; ++i) {
    mesh.positions.push_back(random.vector(2));
    std::vector<Influence> pulls;
    double sum = 0;
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
      pulls.push_back({joint, random.unit()});
      sum += pulls.back().weight;
    }
    for (Influence& pull : pulls) pull.weight /= sum;
    mesh.influences.add(pulls);
  }
  std::vector<Vec3> out(mesh.positions.size());
  deform(mesh, {}, &skin, 0, world, out);
  for (std::size_t i = 0; i < out.size(); ++i) CHECK(near(out[i], mesh.positions[i], 1e-13));
}

TEST_CASE("a swept surface becomes a mesh with all that it has") {
  const SurfaceMesh surface{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {{0, 0}, {1, 0}, {0, 1}}, {0, 1, 2}};
  const Mesh mesh = mesh_of(surface, "vase");
  CHECK(mesh.name == "vase");
  CHECK(mesh.positions == surface.positions);
  CHECK(mesh.normals == surface.normals);
  CHECK(mesh.texture_coordinates == surface.texture_coordinates);
  CHECK(mesh.triangles == surface.triangles);
  CHECK(mesh.influences.empty());
}
