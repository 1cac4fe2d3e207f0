#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

#include <cmath>

// The scenarios of the hand-off that involve joints, each with the numbers that it states.

namespace tweenfall::joint_scenarios {

using namespace tweenfall::test;

namespace {

constexpr double g = 9.81, turn = 2 * 3.14159265358979323846;

Stage staged(const std::string& name, double step = 1.0 / 240) {
  StageDescription stage = Document::read(data_folder() / "documents/joints" / (name + ".json")).stage();
  stage.step = step;
  return Stage(stage);
}

Stage sample(const std::string& name) {
  const auto file = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents" / (name + ".json");
  const Document document = Document::read(file);
  CHECK(document.notes().empty());
  return Stage(document.stage());
}

Vec3 place(const Stage& stage, const std::string& node) {
  return stage.world(stage.node(node)).motion.pose.position;
}

/// The acceleration of a body that is held and turned like this: two links of constant rates.
Vec3 acceleration_on_arm(double first, double both) {
  const auto along = [](double angle) { return Vec3(std::cos(angle), std::sin(angle), 0); };
  return -1.2 * 1.2 * 0.5 * along(first) - 0.8 * 0.8 * 0.55 * along(both);
}

}  // namespace

TEST_CASE("scenario 4: a door let go half way comes to rest where a viscous hinge lets it") {
  Stage stage = staged("door");
  stage.advance_to(0.6);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(std::abs(stage.handoffs()[0].after.twist.angular.y() - turn / 4 * 1.875 / 1.2) < 1e-9);
  double gap = 0;
  while (stage.time() < 12.6) {
    stage.advance(1.0 / 240);
    gap = std::max(gap, stage.joint("pin")->gap);
  }
  CHECK(gap < 1e-6);
  const double final_angle = stage.joint("pin")->position[0] * 360 / turn;
  MESSAGE("final angle " << final_angle << " degrees, 80.1562 by the closed form; widest gap " << gap << " m");
  CHECK(std::abs(final_angle - 80.1562) < 0.05);
}

TEST_CASE("scenario 4: a driven door on its hinge stalls against a box with the torque that it has") {
  Stage stage = staged("driven_door");
  stage.advance_to(4);
  const Vec3 before = stage.reaction(stage.node("wall"));
  stage.advance_to(5);
  // The part of the box's weight that the wall's friction carries does not load the door.
  const Vec3 borne = stage.reaction(stage.node("wall")) - before;
  const double force = std::hypot(borne.x(), borne.z());
  const double angle = stage.joint("pin")->position[0];
  const double rate = stage.joint("pin")->rate[0];
  CHECK(angle < 0.6);
  CHECK(angle > 0.2);
  CHECK(std::abs(rate) < 1e-3);
  // Its end presses on the box's front, or its face on one of the front edges, with its whole torque.
  const Pose box = stage.world(stage.node("box")).motion.pose;
  double off = std::abs(force * (0.9 * std::cos(angle) - 0.02 * std::sin(angle)) - 5);
  for (const double side : {-0.1, 0.1}) {
    const Vec3 edge = box.position + box.rotation * Vec3(side, 0, 0.1);
    off = std::min(off, std::abs(force * std::hypot(edge.x(), edge.z()) - 5));
  }
  MESSAGE("stalls at " << angle * 360 / turn << " degrees and presses with " << force << " N");
  CHECK(off < 0.05);
  CHECK(stage.joint("pin")->gap < 1e-4);
}

TEST_CASE("scenario 6: the weld of a box on an arm bears m (a - g), and lets it go with the box's own velocity") {
  for (const double step : {1.0 / 60, 1.0 / 240}) {
    Stage stage = staged("arm", step);
    stage.advance_to(0.5 - 2 * step);
    const double time = stage.time() - 0.5 - step / 2;
    const std::optional<JointReading> grip = stage.joint("grip");
    REQUIRE(grip);
    const double first = 40 * degree + 1.2 * time, both = first + 30 * degree - 2 * time;
    const Vec3 expected = 3 * (acceleration_on_arm(first, both) + Vec3(0, g, 0));
    CHECK((grip->force - expected).norm() < 0.01 * expected.norm());
    stage.advance_to(0.5);
    CHECK_FALSE(stage.joint("grip"));
    const Twist free = stage.twist(stage.node("box"));
    const double late = (free.linear - Vec3(0.027792, 0.309138, 0)).norm();
    MESSAGE("steps of " << step << " s: force within " << (grip->force - expected).norm() / expected.norm()
                        << ", velocity within " << late << " m/s");
    // As exact as a held body can be: half a step's acceleration at worst.
    CHECK(late < 1.2 * step / 2);
    CHECK(std::abs(free.angular.z() + 0.8) < 1e-3);
  }
  // A box that belongs to the arm leaves with the exact derivative.
  Stage exact = staged("arm_of_one_piece");
  exact.advance_to(0.5);
  REQUIRE(exact.handoffs().size() == 1);
  const Twist& left = exact.handoffs()[0].after.twist;
  const double both = 70 * degree;
  const Vec3 expected(-1.2 * 0.5 * std::sin(40 * degree) + 0.8 * 0.55 * std::sin(both),
                      1.2 * 0.5 * std::cos(40 * degree) - 0.8 * 0.55 * std::cos(both), 0);
  CHECK((left.linear - expected).norm() < 1e-9);
  CHECK((left.linear - Vec3(0.027792, 0.309138, 0)).norm() < 1e-6);
  CHECK(std::abs(left.angular.z() + 0.8) < 1e-9);
}

TEST_CASE("scenario 8: a rope follows a scripted hand, and falls as one when it opens") {
  Stage stage = sample("rope");
  CHECK(std::abs(stage.joint("rope 1")->position[0] - 0.05) < 1e-12);
  const auto each_link = [&](const auto& call) {
    for (int i = 1; i <= 20; ++i) call(stage.node("link " + std::to_string(i)));
  };
  const auto center = [&] {
    Vec3 sum(0, 0, 0);
    each_link([&](NodeId link) { sum += stage.world(link).motion.pose.position / 20; });
    return sum;
  };
  const auto momentum = [&] {
    Vec3 sum(0, 0, 0);
    each_link([&](NodeId link) { sum += 0.05 * stage.twist(link).linear; });
    return sum;
  };
  double stretch = 0, off = 0;
  while (stage.time() < 1.99) {
    stage.advance(1.0 / 240);
    off = std::max(off, (place(stage, "hand") - Vec3(0.05 * std::sin(turn * stage.time()), 2, 0)).norm());
    Vec3 above = place(stage, "hand");
    each_link([&](NodeId link) {
      const Vec3 here = stage.world(link).motion.pose.position;
      stretch = std::max(stretch, std::abs((here - above).norm() - 0.05));
      above = here;
    });
  }
  CHECK(off < 1e-12);
  MESSAGE("a link is at most " << stretch << " m too long or too short");
  CHECK(stretch < 1e-4);
  stage.advance_to(2);
  CHECK_FALSE(stage.joint("rope 1"));
  const Vec3 from = center(), push = momentum();
  double away = 0, gained = 0;
  for (int i = 1; i <= 120; ++i) {
    const double t = i / 240.0;
    stage.advance_to(2 + t);
    const Vec3 expected = from + push * t + Vec3(0, -g / 2 * t * t, 0);
    away = std::max(away, (center() - expected).norm());
    gained = std::max(gained, (momentum() - push - Vec3(0, -g * t, 0)).norm());
  }
  CHECK(away < 1e-9);
  CHECK(gained < 1e-9);
}

TEST_CASE("scenario 8: a rope at rest pulls with its weight, and swings at its first mode's frequency") {
  StageDescription still =
      Document::read(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/rope.json").stage();
  still.plays.clear();
  still.nodes[0].body->drive = Drive::keyed();
  for (JointDescription& joint : still.joints) joint.until = {};
  {
    Stage stage(still);
    stage.advance_to(1);
    CHECK(stage.joint("rope 1")->force.norm() == doctest::Approx(g).epsilon(0.001));
    CHECK(stage.joint("rope 20")->force.norm() == doctest::Approx(g / 20).epsilon(0.001));
  }
  // A pluck of one degree in the shape of the first mode: from the bottom up the Laguerre polynomials at the smallest
  // zero of the twentieth.
  constexpr double x = 0.0705399;
  double shape[21] = {1, 1 - x};
  for (int k = 1; k < 20; ++k) shape[k + 1] = ((2 * k + 1 - x) * shape[k] - k * shape[k - 1]) / (k + 1);
  REQUIRE(std::abs(shape[20]) < 1e-5);
  Vec3 above(0, 2, 0);
  for (std::size_t i = 1; i <= 20; ++i) {
    const double aside = std::sin(1 * degree) * shape[20 - i];
    const double across = aside - above.x();
    above = Vec3(aside, above.y() - std::sqrt(0.05 * 0.05 - across * across), 0);
    still.nodes[i].rest.position = above;
  }
  Stage stage(still);
  const NodeId bottom = stage.node("link 20");
  double last = stage.world(bottom).motion.pose.position.x(), first = 0, latest = 0;
  int crossings = 0;
  while (stage.time() < 12) {
    stage.advance(1.0 / 240);
    const double aside = stage.world(bottom).motion.pose.position.x();
    if (last < 0 && aside >= 0) {
      latest = stage.time() - aside / (aside - last) / 240;
      if (crossings++ == 0) first = latest;
    }
    last = aside;
  }
  REQUIRE(crossings > 5);
  const double frequency = turn * (crossings - 1) / (latest - first);
  MESSAGE("first mode " << frequency << " rad/s; 3.72021 by theory");
  CHECK(frequency == doctest::Approx(3.72021).epsilon(0.005));
}

TEST_CASE(
    "scenario 20: the ball on a trolley's cable takes the trolley's work, and strikes a wall that slept till then") {
  Stage stage = sample("wrecking_ball");
  const NodeId ball = stage.node("ball"), trolley = stage.node("trolley");
  // A whole number of steps: in between, positions are interpolated, and forces are those of the whole step.
  stage.advance_to(237.0 / 240);
  const Vec3 start = place(stage, "ball");
  std::vector<Vec3> asleep;
  std::vector<NodeId> bricks;
  for (int i = 1; i <= 50; ++i) {
    bricks.push_back(stage.node("brick " + std::to_string(i)));
    asleep.push_back(stage.world(bricks.back()).motion.pose.position);
  }
  const auto struck = [&] {
    for (std::size_t i = 0; i < bricks.size(); ++i)
      if (stage.world(bricks[i]).motion.pose.position != asleep[i]) return true;
    return false;
  };
  double work = 0, longest = 0, shortest = 10, gained = 0, worst = 0, most = 0;
  double reached = 0;
  while (stage.time() < 5) {
    const Vec3 before = place(stage, "trolley");
    stage.advance(1.0 / 240);
    if (struck()) break;
    reached = place(stage, "ball").x() + 0.25;
    // Of the trolley on the cable, step by step.
    work += stage.joint("cable")->force.dot(place(stage, "trolley") - before);
    const double length = (place(stage, "ball") - place(stage, "trolley")).norm();
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
    gained = 25 * stage.twist(ball).linear.squaredNorm() + 50 * g * (place(stage, "ball") - start).y();
    most = std::max(most, gained);
    worst = std::max(worst, std::abs(gained - work));
  }
  REQUIRE(struck());
  // Not a bit of any brick changes until the ball is a step away from the wall.
  CHECK(reached > 0.8 - stage.twist(ball).linear.norm() / 100);
  CHECK(reached < 0.8);
  CHECK(stage.owner(trolley) == Owner::keyed);
  MESSAGE("struck at " << stage.time() << " s; energy up to " << most << " J, off by " << worst << " J; cable from "
                       << shortest << " to " << longest << " m");
  CHECK(most > 50);
  CHECK(worst < 0.005 * most);
  CHECK(longest < 3.001);
  CHECK(shortest > 2.999);
  stage.advance_to(stage.time() + 1.5);
  int fallen = 0;
  for (std::size_t i = 0; i < bricks.size(); ++i)
    fallen += (stage.world(bricks[i]).motion.pose.position - asleep[i]).norm() > 0.3;
  CHECK(fallen >= 3);
}

}  // namespace tweenfall::joint_scenarios
