#include <tweenfall/anim/crowd_skin.h>

#include <stdexcept>

#include "crowd/skin_kernels.h"
#include "curves/counted_allocations.h"
#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

struct Skinned {
  std::shared_ptr<const Hierarchy> nodes;
  Mesh mesh;
  Skin skin;
  std::vector<Motion> local;

  Skinned(std::uint64_t seed, std::size_t vertices, std::size_t influences, bool unequal_scales)
      : nodes(random_figure(seed, 12)), local(12) {
    Random random(seed);
    for (std::size_t i = 0; i < 12; ++i) {
      local[i].pose = {random.vector(0.3), random.rotation(), Vec3(1, 1, 1)};
      if (unequal_scales) local[i].pose.scale = Vec3(1, 1, 1) + random.vector(0.3);
    }
    for (const std::size_t joint : {11, 0, 3, 5, 7, 2, 9}) {
      skin.joints.push_back(joint);
      skin.inverse_binds.push_back({random.rotation().toRotationMatrix(), random.vector(0.5)});
    }
    for (std::size_t i = 0; i < vertices; ++i) {
      mesh.positions.push_back(random.vector(1));
      mesh.normals.push_back((random.rotation() * Vec3(0, 0, 1)).normalized());
      std::vector<Influence> of_vertex;
      // Not of all the same number, where there can be more than one.
      const std::size_t count = influences - (influences > 1 ? i % 2 : 0);
      for (std::size_t k = 0; k < count; ++k)
        of_vertex.push_back({static_cast<std::uint32_t>(random.unit() * 7), 1.0 / static_cast<double>(count)});
      mesh.influences.add(of_vertex);
    }
  }

  std::vector<WorldMotion> world() const {
    std::vector<WorldMotion> motions(12);
    nodes->world_motions(local, motions);
    return motions;
  }

  // By the exact path's world, rounded to float.
  std::vector<CrowdMatrix> palette() const {
    std::vector<CrowdMatrix> matrices(12), out(skin.joints.size());
    const std::vector<WorldMotion> motions = world();
    for (std::size_t i = 0; i < 12; ++i)
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) matrices[i].row[r][c] = static_cast<float>(motions[i].linear(r, c));
        matrices[i].row[r][3] = static_cast<float>(motions[i].motion.pose.position[r]);
      }
    CrowdSkin(skin).palette(matrices, out);
    return out;
  }

  // The definition: the inverse transpose of the blended matrix.
  Vec3 normal(std::size_t vertex) const {
    const std::vector<WorldMotion> motions = world();
    Mat3 blended = Mat3::Zero();
    for (const Influence& influence : mesh.influences[vertex])
      blended +=
          influence.weight * motions[skin.joints[influence.joint]].linear * skin.inverse_binds[influence.joint].linear;
    const Vec3 turned = blended.determinant() * blended.inverse().transpose() * mesh.normals[vertex];
    return turned.normalized();
  }
};

Vec3 vec3(const CrowdPoint& point) {
  return {point.x, point.y, point.z};
}

}  // namespace

TEST_CASE("a crowd's vertices are where the exact path has them, and its normals are at right angles to the surface") {
  for (const std::size_t influences : {1, 2, 4, 5, 8, 11})
    for (const std::size_t vertices : {1, 7, 8, 9, 100, 2050}) {
      const Skinned figure(influences, vertices, influences, influences % 2 == 0);
      const CrowdMesh mesh(figure.mesh, figure.skin.joints.size());
      std::vector<CrowdPoint> positions(vertices + 1), normals(vertices + 1);
      positions[vertices] = normals[vertices] = {7, 8, 9};
      mesh.skin(figure.palette(), std::span(positions).first(vertices), std::span(normals).first(vertices));
      CHECK(positions[vertices].x == 7);  // nothing is written behind the last
      CHECK(normals[vertices].x == 7);
      std::vector<Vec3> wanted(vertices);
      deform(figure.mesh, {}, &figure.skin, 0, figure.world(), wanted);
      for (std::size_t i = 0; i<vertices; i += vertices> 200 ? 41 : 1) {
        CHECK(near(vec3(positions[i]), wanted[i], 1e-5));
        const Vec3 normal = figure.normal(i);
        CHECK((vec3(normals[i]) - normal).norm() < 1e-3);  // opposite turns may all but cancel
        CHECK(near(vec3(normals[i]).norm(), 1.0, 1e-5));
      }
      std::vector<CrowdPoint> alone(vertices);
      mesh.skin(figure.palette(), alone);
      CHECK(std::ranges::equal(std::as_bytes(std::span(alone)), std::as_bytes(std::span(positions).first(vertices))));
    }
}

TEST_CASE("a mesh is skinned to the same bits whole and in parts, by the wide and the plain kernels, without memory") {
  for (const std::size_t influences : {4, 6}) {
    const std::size_t vertices = 2500;
    const Skinned figure(3, vertices, influences, true);
    const CrowdMesh mesh(figure.mesh, figure.skin.joints.size());
    const std::vector<CrowdMatrix> palette = figure.palette();
    std::vector<CrowdPoint> whole(vertices), whole_normals(vertices), parts(vertices), part_normals(vertices);
    const std::size_t before = allocations();
    mesh.skin(palette, whole, whole_normals);
    REQUIRE(mesh.parts() == 3);
    for (const std::size_t part : {2, 0, 1}) mesh.skin_part(part, palette, parts, part_normals);
    CHECK(allocations() == before);
    const auto same = [](const std::vector<CrowdPoint>& a, const std::vector<CrowdPoint>& b) {
      return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
    };
    CHECK(same(whole, parts));
    CHECK(same(whole_normals, part_normals));
    for (const crowd::SkinKernels* kernels : crowd::possible_skin_kernels()) {
      mesh.skin_with(*kernels, palette, parts, part_normals);
      CHECK(same(whole, parts));
      CHECK(same(whole_normals, part_normals));
    }
  }
}

TEST_CASE("a mesh that a crowd cannot skin is refused, with all that is wrong") {
  Skinned figure(3, 3, 2, false);
  figure.mesh.normals.pop_back();
  figure.mesh.positions[1].x() = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(CrowdMesh(figure.mesh, 2), doctest::Contains("normals of 2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(CrowdMesh(figure.mesh, 2), doctest::Contains("the position of vertex 1 is not finite"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(CrowdMesh(figure.mesh, 1), doctest::Contains("follows joint"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(CrowdMesh(figure.mesh, 0), doctest::Contains("there are no joints"), std::invalid_argument);
  figure.skin.joints.pop_back();
  CHECK_THROWS_WITH_AS(CrowdSkin(figure.skin), doctest::Contains("6 joints and 7 inverse binds"),
                       std::invalid_argument);
  const CrowdMesh nothing(Mesh{}, 0);
  CHECK(nothing.vertices() == 0);
  nothing.skin({}, {});
}
