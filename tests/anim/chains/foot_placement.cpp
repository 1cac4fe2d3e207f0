#include "anim/chains/chain_support.h"

#include <tweenfall/anim/foot_placement.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> placed{1, 0, 0}, zero_floor{0, 0, 0};

/// Two legs of two bones of 0.45 m, bent a little, with ankles 0.1 m above 0.
Hierarchy walker() {
  Hierarchy nodes({{.name = "root", .rest = {{0, 0, 0}}}, {.name = "pelvis", .parent = 0, .rest = {{0, 0.96, 0}}}});
  for (const double side : {0.1, -0.1}) {
    const std::string name = side > 0 ? ".L" : ".R";
    const std::size_t thigh =
        nodes.add({.name = "thigh" + name, .parent = 1, .rest = {{side, 0, 0}, exp_map({-0.2, 0, 0})}});
    const std::size_t shin =
        nodes.add({.name = "shin" + name, .parent = thigh, .rest = {{0, -0.45, 0}, exp_map({0.4, 0, 0})}});
    nodes.add({.name = "foot" + name, .parent = shin, .rest = {{0, -0.45, 0}, exp_map({-0.2, 0, 0})}});
  }
  return nodes;
}

FootPlacementSettings both_feet() {
  return {.pelvis = "pelvis",
          .feet = {{.leg = {"thigh.L", "shin.L", "foot.L"}, .ankle_height = 0.08},
                   {.leg = {"thigh.R", "shin.R", "foot.R"}, .ankle_height = 0.08}}};
}

WorldMotion node(const Hierarchy& nodes, const char* name, std::span<const Motion> pose) {
  return world_of_node(nodes, nodes.find(name).value(), pose);
}

/// Legs whose bones are rigid and bend only about their axes, with everything else in motion.
struct Walking {
  SwingingPose swing;

  Walking(Random& random, const Hierarchy& nodes) : swing(random, nodes, 0.02, 0.15) {
    for (std::size_t i = 2; i < swing.nodes.size(); ++i) {
      const Vec3& place = nodes[i].rest.position;
      swing.nodes[i].position = {{place.x()}, {place.y()}, {place.z()}};
      swing.nodes[i].turn.y = swing.nodes[i].turn.z = Swing{};
    }
  }
};

}  // namespace

TEST_CASE("on a flat floor the feet stay where the script has them") {
  Random random(1);
  const Hierarchy nodes = walker();
  const FootPlacement placement(nodes, both_feet());
  const Walking walking(random, nodes);
  for (double t = 0; t < 5; t += 0.3) {
    std::vector<Motion> pose = walking.swing.at(t);
    const std::vector<Motion> before = pose;
    place_feet(
        placement, [](const Sample<Vec3>&) { return Ground{.height = 0.7}; }, {0.7, 0, 0}, placed, {}, pose);
    CHECK(difference_of(before, pose) < 1e-12);
  }
}

TEST_CASE("on a slope ankles stand above the ground as above the floor, soles lie along it, and the pelvis goes down") {
  const Hierarchy nodes = walker();
  const FootPlacement placement(nodes, both_feet());
  const Vec3 normal = Vec3(0.3, 1, -0.1).normalized();
  const GroundAt ground = [&](const Sample<Vec3>& place) {
    // The plane through the origin perpendicular to the normal.
    const double height = -(normal.x() * place.value.x() + normal.z() * place.value.z()) / normal.y();
    return Ground{.height = height, .normal = 3 * normal};
  };
  const std::vector<Motion> before = rest_pose(nodes);
  std::vector<Motion> pose = before;
  place_feet(placement, ground, zero_floor, placed, {}, pose);
  double lowest = 0;
  for (const char* name : {"foot.L", "foot.R"}) {
    const Pose was = node(nodes, name, before).motion.pose, is = node(nodes, name, pose).motion.pose;
    const double height = ground({was.position, {0, 0, 0}, {0, 0, 0}})->height;
    lowest = std::min(lowest, height);
    const Quat tilt = Quat::FromTwoVectors(Vec3(0, 1, 0), normal);
    const Vec3 expected = was.position + Vec3(0, height - 0.08, 0) + 0.08 * normal;
    CHECK(near(is.position, expected, 1e-12));
    CHECK(near(is.rotation, tilt * was.rotation, 1e-12));
  }
  CHECK(lowest < -0.02);
  CHECK(node(nodes, "pelvis", pose).motion.pose.position.y() == doctest::Approx(0.96 + lowest));
}

TEST_CASE("on stairs the pelvis goes with the lower foot, up and down within its limits") {
  const Hierarchy nodes = walker();
  FootPlacementSettings settings = both_feet();
  settings.lowest = 0.2;
  settings.highest = 0.1;
  const FootPlacement placement(nodes, settings);
  for (const auto& [left, right, pelvis] :
       {std::array{0.0, -0.15, -0.15}, {-0.1, 0.05, -0.1}, {0.1, 0.05, 0.05}, {-0.3, 0.0, -0.2}, {0.3, 0.4, 0.1}}) {
    const double heights[2] = {left, right}, expected = pelvis;
    std::vector<Motion> pose = rest_pose(nodes);
    place_feet(
        placement,
        [&](const Sample<Vec3>& place) { return Ground{.height = place.value.x() > 0 ? heights[0] : heights[1]}; },
        zero_floor, placed, {}, pose);
    CHECK(node(nodes, "pelvis", pose).motion.pose.position.y() == doctest::Approx(0.96 + expected));
    CHECK(finite(pose));
  }
}

TEST_CASE("an even pelvis turns smoothly from one foot to the other, and is at the floor on the floor") {
  const Hierarchy nodes = walker();
  FootPlacementSettings settings = both_feet();
  settings.evenness = 0.02;
  const FootPlacement placement(nodes, settings);
  const auto height_of = [&](double left) {
    std::vector<Motion> pose = rest_pose(nodes);
    place_feet(
        placement, [&](const Sample<Vec3>& place) { return Ground{.height = place.value.x() > 0 ? left : 0.0}; },
        zero_floor, placed, {}, pose);
    return node(nodes, "pelvis", pose).motion.pose.position.y() - 0.96;
  };
  CHECK(height_of(0) == 0);
  CHECK(height_of(0.1) == doctest::Approx(0.02 * std::log(2 / (1 + std::exp(-5)))));
  CHECK(height_of(-0.1) == doctest::Approx(-0.1 + 0.02 * std::log(2 / (1 + std::exp(-5)))));
  CHECK(std::abs(height_of(1e-4) + height_of(-1e-4)) < 1e-6);
}

TEST_CASE("the rates of placed feet are the derivatives of the pose, on hills that move") {
  Random random(2);
  const Hierarchy nodes = walker();
  FootPlacementSettings settings = both_feet();
  settings.evenness = 0.02;
  settings.tilt = 0.3;
  const FootPlacement placement(nodes, settings);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    Walking walking(random, nodes);
    walking.swing.nodes[0].position = swinging(random, {0, 0, 0}, 1);
    // height = a sin(x + t) + b cos(2 z)
    const double a = 0.05 + 0.2 * random.unit(), b = 0.04;
    const auto solved = [&](double t) {
      const GroundAt ground = [&](const Sample<Vec3>& place) {
        const double x = place.value.x() + t, z = 2 * place.value.z();
        Ground result{.height = a * std::sin(x) + b * std::cos(z)};
        result.normal = {-a * std::cos(x), 1, 2 * b * std::sin(z)};
        result.height_rate = a * std::cos(x);
        result.normal_rate = {a * std::sin(x) * (place.rate.x() + 1), 0, 4 * b * std::cos(z) * place.rate.z()};
        return result;
      };
      std::vector<Motion> pose = walking.swing.at(t);
      const std::vector<Sample<double>> weights{{0.6 + 0.2 * t, 0.2, 0}, {1, 0, 0}};
      place_feet(placement, ground, {0.1 * t - 0.1, 0.1, 0}, {0.9 - 0.2 * t * t, -0.4 * t, 0}, weights, pose);
      return pose;
    };
    // Fully stretched legs move infinitely fast.
    bool stretched = false;
    for (const double t : {0.49, 0.5, 0.51})
      for (const char* name : {"shin.L", "shin.R"})
        stretched = stretched || solved(t)[nodes.find(name).value()].pose.rotation.x() < 0.02;
    if (stretched) continue;
    const double error = worst_rate(solved, 0.5, 5e-4);
    CHECK(error < 1e-7);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("without weight placed feet leave the pose's bits; without ground, over walls and pits they leave numbers") {
  Random random(3);
  const Hierarchy nodes = walker();
  const FootPlacement placement(nodes, both_feet());
  const std::vector<Motion> before = Walking(random, nodes).swing.at(1);
  std::vector<Motion> pose = before;
  place_feet(
      placement, [](const Sample<Vec3>&) { return Ground{.height = -0.3}; }, zero_floor, {0, 0, 0}, {}, pose);
  CHECK(same_bits(before, pose));
  place_feet(
      placement, [](const Sample<Vec3>&) { return std::optional<Ground>(); }, zero_floor, placed, {}, pose);
  CHECK(difference_of(before, pose) < 1e-12);
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, -1, 0), Vec3(1, 0.2, 0)})
    for (const double height : {-1e6, 1e6, 0.0}) {
      pose = before;
      place_feet(
          placement, [&](const Sample<Vec3>&) { return Ground{.height = height, .normal = normal}; }, zero_floor,
          placed, {}, pose);
      CHECK(finite(pose));
    }
}

TEST_CASE("what is wrong with a foot placement is told all at once") {
  const Hierarchy nodes = walker();
  CHECK_THROWS_WITH_AS(FootPlacement(nodes, {.pelvis = "pelvs", .feet = {}, .tilt = 2}),
                       "foot placement: pelvis is \"pelvs\", and there is no such node; did you mean \"pelvis\"?\n"
                       "foot placement: it has 0 feet; it needs from 1 to 8\n"
                       "foot placement: tilt is 2; it must be from 0 to 1.5707963267948966",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(FootPlacement(nodes, {.pelvis = "thigh.L",
                                             .feet = {{.leg = {"thigh.R", "shin.R", "foot.R"}},
                                                      {.leg = {"thigh.R", "shin.R", "foot.R"}},
                                                      {.leg = {"thigh.R", "shin.R", "toe"}}}}),
                       "foot placement: foot 1: its leg must be below the pelvis (\"thigh.L\")\n"
                       "foot placement: foot 2: its leg must be below the pelvis (\"thigh.L\")\n"
                       "foot placement: foot 2: its leg shares joints with one before\n"
                       "foot placement: foot 3: two-bone chain: end is \"toe\", and there is no such node",
                       std::invalid_argument);
}

TEST_CASE("feet that begin to be placed do not jump, however the script bends or stretches their legs") {
  Random random(31);
  const Hierarchy nodes = walker();
  FootPlacementSettings settings = both_feet();
  settings.softness = 0.2;
  const FootPlacement placement(nodes, settings);
  const GroundAt slope = [](const Sample<Vec3>& place) {
    return Ground{.height = 0.1 - place.value.dot(Vec3(0.2, 0, 0.1)), .normal = {0.2, 1, 0.1}};
  };
  for (int i = 0; i < 50; ++i) {
    CAPTURE(i);
    const SwingingPose script(random, nodes, 0.02, 0.7);
    const auto placed_by = [&](const Sample<double>& weight, double t) {
      std::vector<Motion> pose = script.at(t);
      place_feet(placement, slope, zero_floor, weight, {}, pose);
      return pose;
    };
    CHECK(difference_of(script.at(1), placed_by({1e-7, 0, 0}, 1)) < 1e-6);
    CHECK(difference_of(placed_by({0.1, 0, 0}, 1), placed_by({0.1 - 1e-7, 0, 0}, 1)) < 1e-6);
    const Swing weight{0.05, 0.03, 2, 0};
    CHECK(worst_rate([&](double t) { return placed_by(weight.at(t), t); }, 1, 1e-4) < 1e-6);
  }
}
