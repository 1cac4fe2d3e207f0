#include "physics/handoff/scenes.h"

#include <stdexcept>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A ball of 1 kg on a path that swings along x and stands still in y.
StageDescription swinging(const Drive& drive, double step = 1.0 / 240) {
  StageDescription stage;
  stage.step = step;
  stage.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .drive = drive}}};
  Clip clip{.name = "swing", .duration = infinite};
  clip.tracks = {{"ball", "position",
                  parametric(oscillator({.amplitude = 0.5, .hz = 0.4}), Curve<double>(1.0), Curve<double>(0.0))}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

Rule ramp_at(double time, const Drive& to, double seconds) {
  Rule rule = release_at(time, "ball");
  rule.to = to;
  rule.ramp = seconds;
  return rule;
}

Vec3 place(const Stage& stage) {
  return stage.world(0).motion.pose.position;
}

}  // namespace

TEST_CASE("along a ramp the frequency of a drive is even in its logarithm, and its limits and damping are even") {
  StageDescription description = swinging({.hz = 1, .zeta = 0.5, .max_force = 400, .max_torque = 8});
  description.rules = {ramp_at(0.3, {.hz = 81, .zeta = 1.5, .max_force = 200, .max_torque = infinite}, 2)};
  Stage stage(description);
  stage.advance_to(0.29);
  CHECK(stage.drive(0) == *description.nodes[0].body->drive);
  for (const auto& [share, hz] : {std::pair{0.25, 3.0}, {0.5, 9.0}, {0.75, 27.0}}) {
    stage.advance_to(0.3 + 2 * share);
    const Drive drive = stage.drive(0);
    CHECK(drive.hz == doctest::Approx(hz).epsilon(1e-12));
    CHECK(drive.zeta == doctest::Approx(0.5 + share).epsilon(1e-12));
    CHECK(drive.max_force == doctest::Approx(400 - 200 * share).epsilon(1e-12));
    CHECK(drive.max_torque == infinite);  // between a limit and no limit there is no limit
  }
  stage.advance_to(2.31);
  CHECK(stage.drive(0) == description.rules[0].to);
  CHECK(stage.handoffs().size() == 1);  // its owner has not changed
}

TEST_CASE(
    "a body that is let go along a ramp is driven at its instant, free at the ramp's end, and falls as it then is") {
  StageDescription description = swinging(Drive::keyed());
  description.rules = {ramp_at(0.4937, Drive::free(), 0.7)};
  Stage stage(description);
  stage.advance_to(0.4937 + 0.35);
  CHECK(stage.owner(0) == Owner::driven);
  CHECK(stage.drive(0).hz == doctest::Approx(std::sqrt(0.01 * 1000)).epsilon(1e-9));
  stage.advance_to(3);
  REQUIRE(stage.handoffs().size() == 2);
  const HandOff &first = stage.handoffs()[0], &last = stage.handoffs()[1];
  CHECK(first.time == 0.4937);
  CHECK((first.from == Owner::keyed && first.to == Owner::driven && first.cause == Cause::at));
  const double w = 2 * pi * 0.4;
  CHECK(near(first.after.twist.linear, Vec3(-0.5 * w * std::sin(w * 0.4937), 0, 0), 1e-12));
  CHECK(last.time == doctest::Approx(0.4937 + 0.7).epsilon(1e-15));
  CHECK((last.from == Owner::driven && last.to == Owner::free && last.cause == Cause::ramp));
  CHECK(near(last.before.pose.position, last.after.pose.position, 1e-12));
  CHECK(near(last.before.twist.linear, last.after.twist.linear, 1e-9));
  const double fallen = 3 - last.time;
  const Vec3 expected =
      last.after.pose.position + fallen * last.after.twist.linear + Vec3(0, -standard_gravity * fallen * fallen / 2, 0);
  CHECK(near(place(stage), expected, 1e-9));
}

TEST_CASE(
    "a free body that is taken back along a ramp is keyed at its end, without a jump, and settles onto its path") {
  StageDescription description = swinging(Drive::free());
  Rule rule = ramp_at(0.2, Drive::keyed(), 0.5);
  rule.hand_back.settle.seconds = 0.25;
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(0.45);
  CHECK(stage.drive(0).hz == doctest::Approx(std::sqrt(0.01 * 1000)).epsilon(1e-9));
  stage.advance_to(0.95 + 1e-6);
  REQUIRE(stage.handoffs().size() == 2);
  CHECK(stage.handoffs()[0].to == Owner::driven);
  const HandOff& last = stage.handoffs()[1];
  CHECK((last.to == Owner::keyed && last.time == doctest::Approx(0.7).epsilon(1e-15)));
  CHECK(near(last.before.pose.position, last.after.pose.position, 1e-12));
  CHECK(near(last.before.twist.linear, last.after.twist.linear, 1e-9));
  CHECK(near(place(stage), Vec3(0.5 * std::cos(2 * pi * 0.4 * stage.time()), 1, 0), 1e-12));
}

TEST_CASE("a body on a ramp moves as the equation of its drive says, the nearer the shorter the step") {
  // x'' = w(t)^2 (x_t - x) + 2 z w(t) (x_t' - x') + g, by the classical Runge-Kutta method in small steps.
  constexpr double start = 0.25, seconds = 1.5, end = 1.5, zeta = 0.4;
  const double w0 = 2 * pi * 0.4;
  const auto path = [&](double t) { return Vec3(0.5 * std::cos(w0 * t), 1, 0); };
  const auto path_rate = [&](double t) { return Vec3(-0.5 * w0 * std::sin(w0 * t), 0, 0); };
  const auto pull = [&](double t, const Vec3& x, const Vec3& v) {
    const double w = 2 * pi * 6 * std::pow(0.5 / 6, (t - start) / seconds);
    return Vec3(w * w * (path(t) - x) + 2 * zeta * w * (path_rate(t) - v) + Vec3(0, -standard_gravity, 0));
  };
  Vec3 x = path(start), v = path_rate(start);
  constexpr int count = 20000;
  const double h = (end - start) / count;
  for (int i = 0; i < count; ++i) {
    const double t = start + i * h;
    const Vec3 v1 = v, a1 = pull(t, x, v1), v2 = v + h / 2 * a1, a2 = pull(t + h / 2, x + h / 2 * v1, v2);
    const Vec3 v3 = v + h / 2 * a2, a3 = pull(t + h / 2, x + h / 2 * v2, v3), v4 = v + h * a3;
    const Vec3 a4 = pull(t + h, x + h * v3, v4);
    x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  std::vector<double> errors;
  for (const double step : {1.0 / 240, 1.0 / 480, 1.0 / 960, 1.0 / 1920}) {
    StageDescription description = swinging(Drive::keyed(), step);
    Rule soften = ramp_at(start, {.hz = 0.5, .zeta = zeta}, seconds);
    description.nodes[0].body->drive = Drive{.hz = 6, .zeta = zeta};
    // Until then it is on its path: keyed; and from that very instant driven at the ramp's first frequency.
    description.nodes[0].body->drive = Drive::keyed();
    Rule loosen = release_at(start, "ball");
    loosen.to = {.hz = 6, .zeta = zeta};
    description.rules = {loosen, soften};
    Stage stage(description);
    stage.advance_to(end);
    errors.push_back((place(stage) - x).norm());
  }
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i - 1] / errors[i] == doctest::Approx(2).epsilon(0.15));
  CHECK(errors.back() < 2e-3);
}

TEST_CASE("what a saturated drive gives along a ramp of its force is the sum of that force") {
  StageDescription description = swinging({.hz = 50, .max_force = 2});
  description.world.gravity = {0, 0, 0};
  description.clips[0].tracks = {{"ball", "position",
                                  keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::hold()},
                                                     {.time = 0.1, .value = {1000, 0, 0}}})}};
  description.rules = {ramp_at(0.5, {.hz = 50, .max_force = 10}, 1)};
  Stage stage(description);
  stage.advance_to(0.5);
  const double before = stage.twist(0).linear.x();
  CHECK(before == doctest::Approx(0.4 * 2).epsilon(0.02));
  stage.advance_to(1.5);
  // The force of a step is that at its start: the mean of 2 to 10 N, minus half a step's worth.
  CHECK(stage.twist(0).linear.x() - before == doctest::Approx(6 - 8.0 / 240 / 2).epsilon(1e-9));
}

TEST_CASE("what is to come after a change comes at its exact times, one after the other") {
  StageDescription description = swinging(Drive::keyed());
  Rule rule = release_at(0.1234, "ball");
  rule.then = {{.after = 0.25, .change = {.to = {.hz = 4}}},
               {.after = 0.4, .change = {.to = Drive::keyed(), .hand_back = {.settle = {.seconds = 0.2}}}},
               {.after = 0.3, .change = {.to = Drive::free(), .take_over = {.velocity = TakeOver::Velocity::zero}}}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(0.5);
  REQUIRE(stage.unfired_rules().size() == 1);
  CHECK(stage.unfired_rules()[0].reason ==
        "its next change is due at 0.7734 s, which lies beyond the end of the run, 0.5 s");
  stage.advance_to(2);
  REQUIRE(stage.handoffs().size() == 4);
  const double times[] = {0.1234, 0.3734, 0.7734, 1.0734};
  const Owner owners[] = {Owner::free, Owner::driven, Owner::keyed, Owner::free};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(stage.handoffs()[i].time == doctest::Approx(times[i]).epsilon(1e-14));
    CHECK(stage.handoffs()[i].to == owners[i]);
    CHECK(stage.handoffs()[i].cause == (i == 0 ? Cause::at : Cause::then));
  }
  CHECK(stage.handoffs()[3].after.twist.linear.isZero(0));
  CHECK(stage.unfired_rules().empty());
}

TEST_CASE("a body that its drive lets go starts with what the rule says of its own velocity") {
  for (const TakeOver& take_over : {TakeOver{}, TakeOver{.velocity = TakeOver::Velocity::zero},
                                    TakeOver{.scale = 0.5, .add = {.linear = {0, 1, 0}, .angular = {0, 0, 2}}}}) {
    StageDescription description = swinging({.hz = 3});
    Rule rule = release_at(0.6, "ball");
    rule.take_over = take_over;
    description.rules = {rule};
    Stage stage(description);
    stage.advance_to(0.8);
    REQUIRE(stage.handoffs().size() == 1);
    const Motion &before = stage.handoffs()[0].before, &after = stage.handoffs()[0].after;
    CHECK(before.twist.linear.norm() > 0.5);
    const double kept = take_over.velocity == TakeOver::Velocity::zero ? 0 : take_over.scale;
    CHECK(near(after.twist.linear, kept * before.twist.linear + take_over.add.linear, 1e-12));
    CHECK(near(stage.twist(0).linear, after.twist.linear - Vec3(0, standard_gravity * 0.2, 0), 1e-9));
    CHECK(near(stage.twist(0).angular, after.twist.angular, 1e-9));
  }
}

TEST_CASE("what was to come does not when the body changes hands in another way before") {
  StageDescription description = swinging(Drive::keyed());
  Rule rule = release_at(0.1, "ball");
  rule.then = {{.after = 0.5, .change = {.to = {.hz = 4}}}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(0.3);
  stage.recover(0);
  stage.advance_to(2);
  CHECK(stage.owner(0) == Owner::keyed);
  CHECK(stage.handoffs().size() == 2);
}

TEST_CASE("a rule that fires again starts its changes again") {
  StageDescription description = swinging(Drive::keyed());
  description.clips[0].duration = 0.5;
  description.clips[0].loop = {.mode = LoopMode::repeat};
  description.clips[0].events = {{.from = 0.1, .to = 0.1, .name = "go"}};
  Rule rule = release_at(0, "ball");
  rule.when.triggers = {when::Event{"go"}};
  rule.once = false;
  rule.then = {{.after = 0.2, .change = {.to = Drive::keyed()}}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(1.95);
  REQUIRE(stage.handoffs().size() == 8);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(stage.handoffs()[i].time ==
          doctest::Approx(0.1 + 0.5 * static_cast<double>(i / 2) + (i % 2 == 1 ? 0.2 : 0)).epsilon(1e-12));
}

TEST_CASE("a change to come that overlap vetoes is tried until the body may leave its path") {
  StageDescription description = swinging(Drive::keyed());
  description.clips[0].tracks = {
      {"ball", "position",
       keyed_curve<Vec3>({{.time = 0, .value = {0, 0.05, 0}, .ease = Ease::hold()}, {.time = 1, .value = {0, 2, 0}}})}};
  description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{{0, 1, 0}}}, .fixed = true}});
  Rule rule = release_at(0.1, "ball");
  rule.to = {.hz = 1000};
  rule.then = {{.after = 0.1, .change = {.to = Drive::keyed()}},
               {.after = 0.1, .change = {.to = Drive::free(), .take_over = {.overlap = TakeOver::Overlap::veto}}}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(1.5);
  REQUIRE(stage.handoffs().size() == 3);
  CHECK(stage.handoffs()[2].time == doctest::Approx(1).epsilon(0.02));
  CHECK(stage.owner(0) == Owner::free);
}

TEST_CASE("a stage on ramps and before changes to come is saved, loaded and found again with the same bits") {
  StageDescription description = swinging(Drive::keyed());
  Rule rule = ramp_at(0.2, {.hz = 2, .max_force = 30}, 0.3);
  rule.then = {{.after = 0.5, .change = {.to = Drive::free()}},
               {.after = 0.2, .change = {.to = Drive::keyed(), .ramp = 0.3}}};
  description.rules = {rule};
  Stage original(description);
  original.advance_to(2);
  const std::uint64_t hash = original.state_hash();
  const std::size_t handoffs = original.handoffs().size();
  CHECK(handoffs == 4);
  for (const double time : {0.1, 0.2, 0.35, 0.5, 0.6, 0.7, 0.75, 0.9, 1.0, 1.2, 1.21}) {
    CAPTURE(time);
    Stage stage(description), again(description);
    stage.advance_to(time);
    again.load(stage.save());
    CHECK(again.drive(0) == stage.drive(0));
    again.advance_to(2);
    CHECK(again.state_hash() == hash);
    CHECK(again.handoffs().size() == handoffs);
    original.seek(time);
    CHECK(original.state_hash() == stage.state_hash());
    original.seek(2);
    CHECK(original.state_hash() == hash);
  }
}

TEST_CASE("a caller hands a body over along a ramp, and the log of inputs does it again to the bit") {
  const StageDescription description = swinging(Drive::keyed());
  Stage stage(description);
  stage.advance_to(0.31);
  stage.hand_over(0, {.to = {.hz = 3, .max_force = 40, .frame = Drive::Frame::parent}, .ramp = 0.4});
  stage.advance_to(0.51);
  CHECK(stage.drive(0).hz == doctest::Approx(std::sqrt(3 * 1000.0)).epsilon(1e-9));
  stage.hand_over(0, {.to = Drive::free(), .ramp = 0.2});  // in place of the earlier ramp
  stage.advance_to(2);
  CHECK(stage.owner(0) == Owner::free);
  CHECK(stage.handoffs().back().time == doctest::Approx(0.71).epsilon(1e-12));
  const std::vector<TimedInput> inputs = stage.inputs();
  REQUIRE(inputs.size() == 2);
  Stage again(description);
  for (const TimedInput& input : inputs) {
    again.advance_to(input.time);
    again.give(input.what);
  }
  again.advance_to(2);
  CHECK(again.state_hash() == stage.state_hash());
}

TEST_CASE("changes that cannot be are refused with what is wrong") {
  const auto refuses = [](const auto& change, const char* why) {
    StageDescription description = swinging(Drive::keyed());
    Rule rule = release_at(0.1, "ball");
    rule.then = {{.after = 1}};
    change(rule);
    description.rules = {rule};
    CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains(why), std::invalid_argument);
  };
  refuses([](Rule& rule) { rule.ramp = -1; }, "ramp");
  refuses([](Rule& rule) { rule.then[0].after = infinite; }, "after the one before");
  refuses([](Rule& rule) { rule.then[0].change.ramp = infinite; }, "ramp");
  refuses([](Rule& rule) { rule.then[0].change.hand_back.clip = "none"; }, "there is no clip \"none\"");
  Stage stage(swinging(Drive::keyed()));
  CHECK_THROWS_AS(stage.hand_over(0, {.ramp = -1}), std::invalid_argument);
  CHECK_THROWS_AS(stage.hand_over(9, {}), std::invalid_argument);
  // A plane has no mass: it can be taken back at once, but not driven in between.
  StageDescription plane = swinging(Drive::keyed());
  plane.nodes[0].body->shape = {Plane{{0, 1, 0}}};
  plane.rules = {ramp_at(0.1, Drive::keyed(), 0.5)};
  CHECK_THROWS_WITH_AS(Stage{plane}, doctest::Contains("no mass"), std::invalid_argument);
}

TEST_CASE("a ramp that begins at the caller's word between two steps is found again, bit by bit") {
  // At a step's end, a moment beside it, and in between.
  for (const double time : {0.3, 0.3 + 4e-10, 0.3 - 4e-10, 0.3 + 1.0 / 700, 0.3 + 1.0 / 300})
    for (const Drive& to : {Drive{.hz = 5, .max_force = 30}, Drive::free()}) {
      CAPTURE(time);
      Stage stage(swinging(Drive::keyed()));
      stage.advance_to(time);
      stage.hand_over(0, {.to = to, .ramp = 0.2});
      const std::uint64_t hash = stage.state_hash();
      const Drive drive = stage.drive(0);
      stage.seek(0);
      stage.seek(time);
      CHECK(stage.state_hash() == hash);
      CHECK(stage.drive(0) == drive);
    }
}
