#include <tweenfall/physics/stage/recording.h>

#include "physics/handoff/scenes.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Rule on_contact(const std::string& body, const when::ContactHit& hit, const Drive& to = Drive::free()) {
  Rule rule;
  rule.bodies = {body};
  rule.when.triggers = {hit};
  rule.to = to;
  return rule;
}

Curve<Vec3> moving(const Vec3& start, const Vec3& velocity) {
  return Curve<Vec3>(
      [=](double t, Side) {
        return Sample<Vec3>{start + t * velocity, velocity, Vec3(0, 0, 0)};
      },
      -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
}

StageDescription played(StageDescription stage, const std::string& node, const std::string& property,
                        const decltype(Track::curve)& curve) {
  Clip clip;
  clip.name = "c";
  clip.duration = std::numeric_limits<double>::infinity();
  clip.tracks = {{node, property, curve}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

double greatest_contact(const Stage& stage) {
  double most = 0;
  for (const StageEvent& event : stage.events()) most = std::max(most, event.impulse);
  return most;
}

}  // namespace

TEST_CASE("a blow without rebound frees what it strikes at the impact, wherever in a step it falls") {
  const double whole = 0.7 * 3 / 3.7 * 6.3;
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    for (int i = 0; i < 40; ++i) {
      CAPTURE(step);
      CAPTURE(i);
      const double start = -2 - 0.0071 * i;
      StageDescription stage;
      stage.step = step;
      stage.world.gravity = {0, 0, 0};
      stage.nodes = {
          {.name = "s", .body = BodyDescription{.shape = {Sphere{0.3}}, .mass = 3.0, .drive = Drive::keyed()}},
          {.name = "ball",
           .rest = {.position = {start, 0, 0}},
           .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 0.7, .twist = {{5, 0, 0}, {0, 0, 0}}}}};
      stage.rules = {on_contact("s", {.impulse = 3.5})};
      Stage run(played(stage, "s", "position", moving({0, 0, 0}, {-1.3, 0, 0})));
      run.advance_to(1);
      REQUIRE(run.handoffs().size() == 1);
      CHECK(std::abs(run.handoffs()[0].time - (-start - 0.4) / 6.3) < 1e-6);
      CHECK(run.handoffs()[0].after.twist.linear.x() == doctest::Approx(-1.3).epsilon(1e-9));
      const double common = (0.7 * 5 - 3 * 1.3) / 3.7;
      CHECK(std::abs(run.twist(0).linear.x() - common) < 1e-6);
      CHECK(std::abs(run.twist(1).linear.x() - common) < 1e-6);
      CHECK(std::abs(greatest_contact(run) - whole) < 1e-6 * whole);
      // A threshold slightly above the blow does not fire.
      stage.rules = {on_contact("s", {.impulse = 1.001 * whole})};
      Stage kept(played(stage, "s", "position", moving({0, 0, 0}, {-1.3, 0, 0})));
      kept.advance_to(1);
      CHECK(kept.handoffs().empty());
    }
  }
}

TEST_CASE("a reported blow is the whole blow, wherever in a step it falls") {
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    StageDescription stage;
    stage.step = 1.0 / 60;
    stage.world.gravity = {0, 0, 0};
    stage.nodes = {{.name = "wall",
                    .rest = {.position = {1, 0, 0}},
                    .body = BodyDescription{.shape = {Box{{0.5, 1, 1}}}, .fixed = true}},
                   {.name = "ball",
                    .rest = {.position = {-1 - 0.0037 * i, 0, 0}},
                    .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 2.0, .twist = {{4, 0, 0}, {0, 0, 0}}}}};
    Stage run(stage);
    run.advance_to(1);
    REQUIRE(!run.events().empty());
    CHECK(run.events()[0].impulse == doctest::Approx(8).epsilon(1e-6));
  }
}

TEST_CASE("what lands on several of its parts gives one blow, the whole of it") {
  std::vector<Shape> legs;
  for (const double x : {-0.3, 0.3})
    for (const double z : {-0.3, 0.3}) legs.push_back({Box{{0.05, 0.2, 0.05}}, {.position = Vec3(x, 0.2, z)}});
  for (const double restitution : {0.0, 0.5, 1.0})
    for (const double step : {1.0 / 60, 1.0 / 240}) {
      CAPTURE(restitution);
      CAPTURE(step);
      StageDescription stage;
      stage.step = step;
      stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                     {.name = "stool",
                      .rest = {.position = {0, 1.27, 0}},
                      .body = BodyDescription{.shape = {Compound(legs)}, .mass = 2.0, .restitution = restitution}}};
      const double whole = 2 * (1 + restitution) * std::sqrt(2 * 9.81 * 1.27);
      Stage run(stage);
      run.advance_to(0.6);
      REQUIRE(run.events().size() == 1);
      CHECK(run.events()[0].impulse == doctest::Approx(whole).epsilon(2e-4));
      CHECK(run.events()[0].time == doctest::Approx(std::sqrt(2 * 1.27 / 9.81)).epsilon(1e-6));
      // No leg takes as much alone.
      for (const double share : {0.99, 1.05}) {
        CAPTURE(share);
        stage.rules = {on_contact("stool", {.impulse = share * whole}, Drive::keyed())};
        Stage ruled(stage);
        ruled.advance_to(0.6);
        CHECK(ruled.handoffs().size() == (share < 1 ? 1 : 0));
      }
    }
}

TEST_CASE("a reported blow is none of the weight that presses on, wherever in a step it falls and on what") {
  for (const bool on_box : {false, true})
    for (const double step : {1.0 / 30, 1.0 / 240})
      for (int i = 0; i < 20; ++i) {
        CAPTURE(on_box);
        CAPTURE(step);
        CAPTURE(i);
        const double fall = 0.3 + 0.0137 * i, floor = on_box ? 0.5 : 0;
        StageDescription stage;
        stage.step = step;
        stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                       {.name = "falling",
                        .rest = {.position = {0, floor + 0.1 + fall, 0}},
                        .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 2.0}}};
        if (on_box)
          stage.nodes.push_back({.name = "box",
                                 .rest = {.position = {0, 0.25, 0}},
                                 .body = BodyDescription{.shape = {Box{{0.5, 0.25, 0.5}}}, .mass = 50.0}});
        Stage run(stage);
        run.advance_to(1);
        double blow = 0;
        for (const StageEvent& event : run.events())
          if (event.name == "contact" && event.time > 0.2 && blow == 0) blow = event.impulse;
        const double whole = 2 * std::sqrt(2 * 9.81 * fall);
        // What falls on a body that could itself fall meets it at the speed of the step's start.
        const double within = 5e-3 * whole + (on_box ? 2 * 9.81 * step : 0);
        CHECK(std::abs(blow - whole) < within);
      }
}

TEST_CASE("what rests from the start strikes nothing, whatever its shape; what falls a hair does") {
  for (const double gap : {0.0, 1e-8, 1e-4})
    for (const Solid& solid : {Solid{Box{Vec3(0.5, 0.5, 0.5)}}, Solid{Sphere{0.5}}, Solid{Cylinder{0.5, 0.5}}}) {
      CAPTURE(gap);
      CAPTURE(solid.index());
      StageDescription stage;
      stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
      for (const double x : {0.0, 3.0})
        stage.nodes.push_back({.name = "at" + std::to_string(static_cast<int>(x)),
                               .rest = {.position = {x, 0.5 + gap, 0}},
                               .body = BodyDescription{.shape = {solid}, .mass = 1.0}});
      // Another on top: weight that is passed on.
      stage.nodes.push_back({.name = "top",
                             .rest = {.position = {3, 1.5 + gap, 0}},
                             .body = BodyDescription{.shape = {solid}, .mass = 1.0}});
      Stage run(stage);
      run.seek(0.2);
      if (gap == 0)
        CHECK(run.events().empty());
      else
        CHECK(greatest_contact(run) >= 0.99 * std::sqrt(2 * 9.81 * gap));
    }
}

TEST_CASE("a body struck on a curved path leaves it where it is struck, with the curve's own velocity") {
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    for (int i = 0; i < 40; ++i) {
      CAPTURE(step);
      CAPTURE(i);
      const double angle = 0.5 + 0.013 * i;
      StageDescription stage;
      stage.step = step;
      stage.world.gravity = {0, 0, 0};
      const BodyDescription ball{.shape = {Sphere{0.1}}, .mass = 1.0, .restitution = 0.5};
      stage.nodes = {{.name = "p"},
                     {.name = "s", .parent = 0, .rest = {.position = {1, 0, 0}}, .body = ball},
                     {.name = "b", .rest = {.position = {std::cos(angle), std::sin(angle), 0}}, .body = ball}};
      stage.rules = {on_contact("s", {})};
      const Curve<double> turning(
          [](double t, Side) {
            return Sample<double>{4 * t, 4, 0};
          },
          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
      Stage run(played(stage, "p", "rotation", axis_curve({0, 0, 1}, turning)));
      run.advance_to(0.6);
      REQUIRE(run.handoffs().size() == 1);
      const double time = (angle - 2 * std::asin(0.1)) / 4;
      CHECK(std::abs(run.handoffs()[0].time - time) < 1e-6);
      const Vec3 velocity(-4 * std::sin(4 * time), 4 * std::cos(4 * time), 0);
      CHECK(near(run.handoffs()[0].after.twist.linear, velocity, 1e-5));
      CHECK(near(run.twist(1).linear + run.twist(2).linear, velocity, 1e-5));
    }
  }
}

TEST_CASE("a keyed body that runs into the floor or into another keyed one is freed there") {
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    for (int i = 0; i < 40; ++i) {
      for (const bool other_is_keyed : {false, true}) {
        CAPTURE(step);
        CAPTURE(i);
        const double height = 1 + 0.0091 * i;
        StageDescription stage;
        stage.step = step;
        stage.nodes = {
            {.name = "floor",
             .rest = {.position = {0, -0.5, 0}},
             .body = BodyDescription{.shape = {Box{{5, 0.5, 5}}}, .fixed = !other_is_keyed, .drive = Drive::keyed()}},
            {.name = "cup", .body = BodyDescription{.shape = {Box{{0.1, 0.1, 0.1}}}, .mass = 0.4}}};
        stage.rules = {on_contact("cup", {.speed = 0.1})};
        Stage run(played(stage, "cup", "position", moving({0, height, 0}, {0, -2, 0})));
        run.advance_to(1.5);
        REQUIRE(run.handoffs().size() == 1);
        CHECK(std::abs(run.handoffs()[0].time - (height - 0.1) / 2) < 1e-6);
        CHECK(run.handoffs()[0].after.twist.linear.y() == doctest::Approx(-2).epsilon(1e-9));
        CHECK(std::abs(run.world(1).motion.pose.position.y() - 0.1) < 2e-3);
        // The weight for the rest of the step comes on top.
        CHECK(greatest_contact(run) >= 0.8 * (1 - 1e-6));
        CHECK(greatest_contact(run) <= 0.8 + 0.4 * standard_gravity * step + 1e-6);
      }
    }
  }
}

TEST_CASE("two keyed bodies that touch are told of, though neither is freed") {
  StageDescription stage;
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                 {.name = "cup", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 0.4}}};
  stage.rules = {on_contact("cup", {.impulse = 100})};
  Stage run(played(stage, "cup", "position", moving({0, 1, 0}, {0, -2, 0})));
  run.advance_to(1);
  CHECK(run.handoffs().empty());
  REQUIRE(run.events().size() == 1);
  CHECK(run.events()[0].name == "contact");
  CHECK(run.events()[0].impulse == doctest::Approx(0.8).epsilon(0.02));
}

TEST_CASE("a contact is told with the time at which the two met, wherever in a step that is") {
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double restitution : {0.0, 0.7})
      for (int i = 0; i < 20; ++i) {
        CAPTURE(step);
        CAPTURE(restitution);
        CAPTURE(i);
        const double height = 0.5 + 0.0137 * i, speed = 0.3 * i;
        StageDescription stage;
        stage.step = step;
        stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                       {.name = "ball",
                        .rest = {.position = {0, 0.1 + height, 0}},
                        .body = BodyDescription{.shape = {Sphere{0.1}},
                                                .mass = 0.4,
                                                .restitution = restitution,
                                                .twist = {{0, -speed, 0}, {0, 0, 0}}}}};
        Stage run(stage);
        run.advance_to(0.6);
        REQUIRE(!run.events().empty());
        const double impact = (std::sqrt(speed * speed + 2 * standard_gravity * height) - speed) / standard_gravity;
        CHECK(std::abs(run.events()[0].time - impact) < 1e-6);
      }
}

TEST_CASE("what a recording tells of is in order of time") {
  StageDescription stage;
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
  for (int i = 0; i < 10; ++i)
    stage.nodes.push_back({.name = "ball" + std::to_string(i),
                           .rest = {.position = {static_cast<double>(i), 0.2 + 0.003 * (i * 7 % 10), 0}},
                           .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 0.4, .restitution = 0.5}});
  Clip clip{.name = "ticks", .duration = 1};
  for (int i = 0; i < 900; ++i) clip.events.push_back({i / 900.0, i / 900.0, "tick", {}});
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  Stage run(stage);
  const Recording recording = record(run, 1, 60);
  CHECK(std::ranges::count(recording.events, "contact", &StageEvent::name) >= 20);
  CHECK(std::ranges::is_sorted(recording.events, {}, &StageEvent::time));
}

TEST_CASE("a blow by what swings in fast is told once, however far it turns in a step") {
  for (const double degrees : {20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 170.0})
    for (const double place : {33.0, 87.0, 156.5}) {
      CAPTURE(degrees);
      CAPTURE(place);
      const double rate = degrees * 60 * pi / 180, angle = place * pi / 180;
      StageDescription stage;
      stage.step = 1.0 / 60;
      stage.world.gravity = {0, 0, 0};
      stage.nodes = {
          {.name = "bar",
           .body = BodyDescription{.shape = {Box{Vec3(2, 0.05, 0.05)}}, .mass = 1.0, .drive = Drive::keyed()}},
          {.name = "ball",
           .rest = {.position = 1.7 * Vec3(std::cos(angle), std::sin(angle), 0)},
           .body = BodyDescription{.shape = {Sphere{0.05}}, .mass = 0.3}}};
      const Curve<Quat> spin(
          [rate](double t, Side) {
            return Sample<Quat>{Quat(Eigen::AngleAxisd(rate * t, Vec3(0, 0, 1))), Vec3(0, 0, rate), Vec3(0, 0, 0)};
          },
          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
      Stage run(played(stage, "bar", "rotation", spin));
      run.advance_to(0.5);
      CHECK(run.twist(1).linear.norm() > 0.5 * rate * 1.7);
      REQUIRE(run.events().size() == 1);
      CHECK(run.events()[0].impulse > 0.2 * 0.3 * rate * 1.7);
    }
}

TEST_CASE("what a caller does between two blows of one instant is found between them by whoever goes back") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  for (const double z : {-2.0, 2.0}) {
    const std::string side = z < 0 ? "left" : "right";
    description.nodes.push_back(
        {.name = side,
         .rest = {.position = {0, 0, z}},
         .body = BodyDescription{.shape = {Sphere{0.3}}, .mass = 3.0, .drive = Drive::keyed()}});
    description.nodes.push_back(
        {.name = side + " ball",
         .rest = {.position = {-2, 0, z}},
         .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 0.7, .twist = {{5, 0, 0}, {0, 0, 0}}}});
    description.rules.push_back(on_contact(side, {.impulse = 0.1}));
  }
  Stage stage(description);
  std::vector<double> told;
  // The second is still keyed when the first is struck, and free a moment later at the same time.
  stage.on_handoff([&](const HandOff& handoff) {
    told.push_back(stage.time());
    stage.apply_impulse(handoff.node, Vec3(0, 2, 0), stage.world(handoff.node).motion.pose.position);
  });
  stage.advance_to(0.4);
  REQUIRE(told.size() == 2);
  REQUIRE(told[0] == told[1]);
  const std::uint64_t hash = stage.state_hash();
  for (const std::size_t node : {0, 2}) CHECK(stage.twist(node).linear.y() > 0.6);
  for (const double time : {0.0, told[0]}) {
    stage.seek(time);
    Stage loaded(description);
    loaded.load(stage.save());
    for (Stage* const each : {&stage, &loaded}) {
      each->seek(0.4);
      CHECK(each->state_hash() == hash);
    }
  }
  const std::vector<TimedInput> inputs = stage.inputs();
  REQUIRE(inputs.size() == 2);
  CHECK(inputs[0].time == inputs[1].time);
  CHECK(inputs[0].after_blows == 0);
  CHECK(inputs[1].after_blows == 1);
  for (const double frame : {0.4, 0.01, told[0]}) {
    Stage replayed(description);
    std::span<const TimedInput> to_come = inputs;
    for (int i = 1; replayed.time() < 0.4; ++i) to_come = advance_with(replayed, to_come, std::min(0.4, i * frame));
    CHECK(replayed.state_hash() == hash);
  }
}

TEST_CASE("a hand-off told of a step's beginning is taken back if a change keeps its blow from coming") {
  const auto ball = [](const char* name, double x, double speed) {
    return NodeDescription{
        .name = name,
        .rest = {.position = {x, 0, 0}},
        .body = BodyDescription{.shape = {Sphere{0.2}}, .mass = 1.0, .twist = {.linear = {speed, 0, 0}}}};
  };
  StageDescription row{.nodes = {ball("statue", 0, 0), ball("between", 0.4, 0), ball("thrown", 0.968, -6)},
                       .world = {.gravity = {0, 0, 0}},
                       .step = 1.0 / 60};
  row.nodes[0].body->drive = Drive::keyed();
  row.rules = {{.bodies = {"statue"}, .when = {{when::ContactHit{.impulse = 0.1}}}, .to = Drive::free()}};
  Stage stage(row);
  // The thrown ball comes at 0.028 s, within the second step, and strikes through the one between.
  stage.advance_to(0.02);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].time == 1.0 / 60);
  stage.remove(stage.node("thrown"));
  CHECK(stage.handoffs().empty());
  CHECK(stage.owner(0) == Owner::keyed);
  stage.advance_to(0.1);
  CHECK(stage.handoffs().empty());
  const std::uint64_t hash = stage.state_hash();
  stage.seek(0.01);
  stage.seek(0.1);
  CHECK(stage.handoffs().empty());
  CHECK(stage.state_hash() == hash);
}

TEST_CASE("in a plane a body is not let go with a velocity out of it, and stays as it was") {
  StageDescription flat{.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.2}}, .mass = 1.0}}},
                        .world = {.plane = WorldPlane::xy}};
  flat.nodes[0].body->drive = Drive::keyed();
  const TakeOver out{.add = {.linear = {0, 0, 1}}};
  Rule rule = on_contact("ball", {.impulse = 1});
  rule.take_over = out;
  Stage stage(flat);
  stage.advance_to(0.1);
  CHECK_THROWS_AS(stage.release(0, out), std::invalid_argument);
  CHECK_THROWS_AS(stage.arm(rule), std::invalid_argument);
  CHECK(stage.owner(0) == Owner::keyed);
  CHECK(stage.handoffs().empty());
}

TEST_CASE("whoever changes something when a body is freed at the beginning of a step is told of it once") {
  const auto ball = [](const char* name, const Vec3& place, double speed) {
    return NodeDescription{
        .name = name,
        .rest = {.position = place},
        .body = BodyDescription{.shape = {Sphere{0.2}}, .mass = 1.0, .twist = {.linear = {speed, 0, 0}}}};
  };
  StageDescription row{.nodes = {ball("statue", {0, 0, 0}, 0), ball("between", {0.4, 0, 0}, 0),
                                 ball("thrown", {0.968, 0, 0}, -6), ball("aside", {0, 5, 0}, 0)},
                       .world = {.gravity = {0, 0, 0}},
                       .step = 1.0 / 60};
  row.nodes[0].body->drive = Drive::keyed();
  row.rules = {{.bodies = {"statue"}, .when = {{when::ContactHit{.impulse = 0.1}}}, .to = Drive::free()}};
  for (const char* pushed : {"aside", "between"}) {
    CAPTURE(pushed);
    Stage stage(row);
    int told = 0;
    stage.on_handoff([&](const HandOff& handoff) {
      CHECK(handoff.time == 1.0 / 60);
      REQUIRE(++told < 10);
      stage.apply_impulse(stage.node(pushed), Vec3(0, 0.3, 0), stage.world(stage.node(pushed)).motion.pose.position);
      // Saved between the change and what comes of it.
      Stage loaded(row);
      int told_again = 0;
      loaded.load(stage.save());
      loaded.on_handoff([&](const HandOff&) { ++told_again; });
      loaded.advance_to(0.1);
      CHECK(told_again == 0);
      CHECK(loaded.handoffs().size() == 1);
    });
    stage.advance_to(0.1);
    CHECK(told == 1);
    REQUIRE(stage.handoffs().size() == 1);
    CHECK(stage.twist(stage.node(pushed)).linear.y() > 0.1);
    CHECK(stage.owner(0) == Owner::free);
    const std::uint64_t hash = stage.state_hash();
    Stage replayed(row);
    static_cast<void>(advance_with(replayed, stage.inputs(), 0.1));
    CHECK(replayed.state_hash() == hash);
    stage.seek(0.01);
    stage.seek(0.1);
    CHECK(stage.state_hash() == hash);
    CHECK(stage.handoffs().size() == 1);
  }
}
