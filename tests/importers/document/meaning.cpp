#include "importers/document/document_files.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/strategies.h>

#include <numbers>
#include <string>
#include <utility>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("each integrator has its word") {
  const std::pair<const char*, Integrator> words[] = {{"exact-quadratic", Integrator::exact_quadratic},
                                                      {"semi-implicit-euler", Integrator::semi_implicit_euler},
                                                      {"explicit-euler", Integrator::explicit_euler},
                                                      {"midpoint", Integrator::midpoint},
                                                      {"trapezoid", Integrator::trapezoid},
                                                      {"rk4", Integrator::rk4},
                                                      {"verlet", Integrator::verlet},
                                                      {"backward-euler", Integrator::backward_euler},
                                                      {"implicit-trapezoid", Integrator::implicit_trapezoid}};
  for (const auto& word : words) {
    const std::string text = R"({"tweenfall": 1, "world": {"integrator": ")" + std::string(word.first) + R"("}})";
    CAPTURE(text);
    CHECK(Document::parse(text, "words.json", {}).stage().world.integrator == word.second);
  }
}

TEST_CASE("each of a world's strategies has its word") {
  const auto means = [](const std::string& field, const std::string& word, const auto& part, auto meant) {
    const std::string text = R"({"tweenfall": 1, "world": {")" + field + R"(": ")" + word + R"("}})";
    CAPTURE(text);
    const Document document = Document::parse(text, "words.json", {});
    CHECK(document.stage().world.*part == meant);
    // Defaults are left out, and the rest is written as it was read.
    const bool usual = meant == decltype(meant){};
    CHECK((document.text().find(word) == std::string::npos) == usual);
  };
  means("solver", "iterative", &WorldSettings::solver, ContactSolver::iterative);
  means("solver", "sequential", &WorldSettings::solver, ContactSolver::sequential);
  means("solver", "shock", &WorldSettings::solver, ContactSolver::shock);
  means("solver", "lcp", &WorldSettings::solver, ContactSolver::lcp);
  means("separation", "soft", &WorldSettings::separation, Parting::soft);
  means("separation", "half", &WorldSettings::separation, Parting::half);
  means("separation", "by-mass", &WorldSettings::separation, Parting::by_mass);
  means("separation", "positional-impulse", &WorldSettings::separation, Parting::positional_impulse);
  means("separation", "closest-point", &WorldSettings::separation, Parting::closest_point);
  means("collision", "ahead", &WorldSettings::collision, Detection::ahead);
  means("collision", "discrete", &WorldSettings::collision, Detection::discrete);
  means("collision", "time-of-impact", &WorldSettings::collision, Detection::time_of_impact);
  means("broad_phase", "tree", &WorldSettings::broad_phase, PairSearch::tree);
  means("broad_phase", "all-pairs", &WorldSettings::broad_phase, PairSearch::all_pairs);
  means("broad_phase", "sweep", &WorldSettings::broad_phase, PairSearch::sweep);
  means("broad_phase", "grid", &WorldSettings::broad_phase, PairSearch::grid);
  means("broad_phase", "quadtree", &WorldSettings::broad_phase, PairSearch::quadtree);
  means("broad_phase", "octree", &WorldSettings::broad_phase, PairSearch::octree);
  means("broad_phase", "kd-tree", &WorldSettings::broad_phase, PairSearch::kd_tree);
  means("broad_phase", "bvh", &WorldSettings::broad_phase, PairSearch::bvh);
}

TEST_CASE("the lamp of the contract means what is said") {
  const Document document = good_document("lamp");
  const StageDescription& stage = document.stage();
  REQUIRE(stage.clips.size() == 1);
  const Clip& clip = stage.clips[0];
  CHECK(clip.name == "lamp");
  CHECK(clip.duration == 2);  // the 48th of 24 frames per second
  CHECK(clip.loop.mode == LoopMode::repeat);
  CHECK(clip.loop.count == 3);
  REQUIRE(stage.plays.size() == 1);  // the only clip plays from 0
  CHECK(stage.plays[0].at == 0);
  REQUIRE(stage.nodes.size() == 2);  // names are free, and the nodes follow from them
  CHECK(stage.nodes[0].name == "lamp");
  CHECK(stage.nodes[1].name == "arm");

  const Curve<Vec3>& position = curve_of<Vec3>(clip, "lamp.position");
  CHECK(near(position.value(0.8), Vec3(0, 3.4, 0), 1e-15));
  CHECK(near(position.value(1.1), Vec3(0, 3.4 - 3.2 * 0.25, 0), 1e-14));  // half of 0.6 s, squared
  CHECK(near(position.value(1.9), Vec3(0, 0.2, 0), 1e-15));

  const Curve<Color>& color = curve_of<Color>(clip, "lamp.color");
  CHECK(color.end() == 1.4);
  CHECK(near(color.value(0).rgba[0], 1.0, 1e-12));
  CHECK(near(color.value(0).rgba[1], 0.644479681971, 1e-9));  // ((0xd2/255 + 0.055)/1.055)^2.4

  const Curve<Quat>& rotation = curve_of<Quat>(clip, "arm.rotation");
  CHECK(near(rotation.rate(1.0), Vec3(0, 0, 720 * degree * 1.5), 1e-9));  // cubic-in-out: slope 3 half way, over 2 s
  CHECK(near(rotation.value(0.5), Quat(std::cos(22.5 * degree), 0, 0, std::sin(22.5 * degree)), 1e-12));  // 720/16

  const Curve<Vec3>& scale = curve_of<Vec3>(clip, "arm.scale");
  CHECK(near(scale.value(1), Vec3(1, 1.2, 1), 1e-15));
  CHECK(near(scale.rate(1), Vec3(0, -0.6, 0), 1e-12));
  CHECK(scale.end() == 2);

  REQUIRE(clip.events.size() == 2);
  CHECK(clip.events[0].name == "loud");
  CHECK(clip.events[0].from == 0.5);
  CHECK(clip.events[0].to == 1.5);
  CHECK(clip.events[1].name == "let go");
  CHECK_FALSE(clip.events[1].is_interval());
}

TEST_CASE("the pendulum of the contract means what is said") {
  const Document document = good_document("pendulum");
  const StageDescription& stage = document.stage();
  CHECK(stage.name == "pendulum let go");
  REQUIRE(stage.nodes.size() == 3);
  CHECK(std::holds_alternative<Plane>(stage.nodes[0].body->shape.solid));
  CHECK(stage.nodes[0].body->fixed);
  const NodeDescription& bob = stage.nodes[2];
  CHECK(bob.name == "bob");
  CHECK(bob.parent == 1);
  CHECK(near(bob.rest.position, Vec3(0, -1, 0), 0));
  CHECK(std::get<Sphere>(bob.body->shape.solid).radius == 0.05);
  CHECK(bob.body->mass == 0.5);
  CHECK(bob.body->restitution == 0.3);
  CHECK(bob.body->friction == 0.5);
  CHECK(bob.body->rolling_friction == 0.02);
  CHECK_FALSE(bob.body->drive);

  REQUIRE(stage.clips.size() == 1);
  CHECK(std::isinf(stage.clips[0].duration));
  REQUIRE(stage.plays.size() == 1);
  // One radian of amplitude at time 0, at rest; g = 9.81 over 1 m.
  const Curve<Quat>& swing = curve_of<Quat>(stage.clips[0], "pivot.rotation");
  CHECK(near(turn_about_z(swing.value(0)), 1.0, 1e-12));
  const double w = std::sqrt(9.81);
  CHECK(near(swing.rate(0.4937), Vec3(0, 0, -w * std::sin(w * 0.4937)), 1e-9));

  CHECK(stage.step == 1.0 / 240);
  REQUIRE(stage.rules.size() == 2);
  CHECK(std::get<when::At>(stage.rules[0].when.triggers.at(0)).time == 0.4937);
  CHECK(stage.rules[0].to == Drive::free());
  CHECK(std::get<when::Asleep>(stage.rules[1].when.triggers.at(0)).seconds == 0.5);
  CHECK(stage.rules[1].to == Drive::keyed());
  CHECK(stage.rules[1].hand_back.clip == "swing");
  CHECK(stage.rules[1].hand_back.clock == HandBack::Clock::restart);
  CHECK(stage.rules[1].hand_back.settle.seconds == 0.4);
}

TEST_CASE("every field reaches the stage's description") {
  const Document document = good_document("everything");
  const StageDescription& stage = document.stage();
  const auto node = [&](const std::string& name) -> const NodeDescription& {
    for (const NodeDescription& each : stage.nodes)
      if (each.name == name) return each;
    FAIL("no node " << name);
    return stage.nodes.front();
  };
  const double c = std::cos(45 * degree);

  SUBCASE("nodes and bodies") {
    const Plane plane = std::get<Plane>(node("floor").body->shape.solid);
    CHECK(near(plane.normal, Vec3(0, 1, 0), 1e-15));
    CHECK(plane.offset == -1);
    CHECK(node("floor").body->friction == 0.8);
    for (std::size_t i = 0; i < stage.nodes.size(); ++i)
      CHECK((stage.nodes[i].parent == no_node || stage.nodes[i].parent < i));
    CHECK(stage.nodes[node("late").parent].name == "base");
    const BodyDescription &belt = *node("floor").body, &probe = *node("ball").body;
    CHECK(belt.friction_combine == Combine::minimum);
    CHECK(belt.restitution_combine == Combine::usual);
    CHECK(near(belt.surface_velocity.linear, Vec3(1.5, 0, 0), 0));
    CHECK(near(belt.surface_velocity.angular, Vec3(0, std::numbers::pi / 2, 0), 1e-15));
    CHECK(belt.groups == 3);
    CHECK(belt.collides_with == ~std::uint64_t{0});
    CHECK(probe.groups == 1);
    CHECK(probe.collides_with == 3);
    CHECK(probe.restitution_combine == Combine::average);
    CHECK(probe.spinning_friction == 0.02);
    CHECK(probe.sensor);
    CHECK(belt.collision == Detection::time_of_impact);
    CHECK(!probe.collision);
    CHECK(near(node("late").rest.rotation, Quat(std::cos(15 * degree), 0, -std::sin(15 * degree), 0), 1e-14));
    CHECK(near(node("base").rest.rotation, Quat(c, 0, c, 0), 1e-14));
    CHECK(near(node("base").rest.scale, Vec3(1, 2, 3), 0));
    CHECK(near(node("base").color->rgba[1], 0.2462013267, 1e-9));  // ((0x88/255 + 0.055)/1.055)^2.4
    CHECK(near(node("ball").color->rgba[3], 0x44 / 255.0, 1e-15));
    const BodyDescription& box = *node("tower/1").body;
    CHECK(near(std::get<Box>(box.shape.solid).half_extents, Vec3(0.5, 1, 2), 0));
    CHECK(box.density == 500);
    CHECK(box.friction == 0.25);
    CHECK(box.linear_damping == 0.1);
    CHECK(box.angular_damping == 0.2);
    CHECK(near(box.twist.linear, Vec3(1, 0, 0), 0));
    CHECK(near(box.twist.angular, Vec3(0, std::numbers::pi, 0), 1e-15));
    CHECK(node("tower/1").group == "tower");
    CHECK(near(node("tower/1").rest.scale, Vec3(2, 2, 2), 0));
    const BodyDescription& capsule = *node("tower/2").body;
    CHECK(std::get<Capsule>(capsule.shape.solid).half_height == 0.5);
    CHECK(std::get<Capsule>(capsule.shape.solid).radius == 0.2);
    CHECK(capsule.mass == 3);
    CHECK(near(capsule.shape.offset.position, Vec3(0, 0.5, 0), 0));
    CHECK(near(capsule.shape.offset.rotation, Quat(1, 0, 0, 0), 1e-15));
    CHECK(*capsule.drive == Drive{.hz = 5, .zeta = 0.7, .max_force = 500, .max_torque = 20});
    CHECK(*node("ball").body->drive == Drive::keyed());
  }
  SUBCASE("clips") {
    const Clip& clip = stage.clips.at(0);
    CHECK(clip.duration == 2);
    CHECK(clip.loop.mode == LoopMode::pingpong);
    CHECK(clip.loop.count == 2.5);
    CHECK(track_of(clip, "ball.position").relative);
    const Curve<Vec3>& position = curve_of<Vec3>(clip, "ball.position");
    CHECK(position.before() == Outside::linear);
    CHECK(position.after() == Outside::repeat_offset);
    const std::vector<double> knots(position.knots().begin(), position.knots().end());
    CHECK(knots == std::vector<double>{0, 0.5, 1, 1.5, 1.75});
    CHECK(near(position.value(1, Side::in), Vec3(0, 3, 0), 1e-15));
    CHECK(near(position.value(1, Side::out), Vec3(0, 2, 0), 1e-15));
    CHECK(near(position.rate(1, Side::in), Vec3(0, 1, 0), 1e-12));
    CHECK(near(position.rate(1, Side::out), Vec3(0, -1, 0), 1e-9));
    // The first angle of ZXY turns about z, although its rate was asked for about x.
    CHECK(near(curve_of<Quat>(clip, "ball.rotation").value(1), Quat(c, 0, 0, c), 1e-14));
  }
  SUBCASE("plays") {
    REQUIRE(stage.plays.size() == 3);
    CHECK(stage.plays[0].clip == 1);
    CHECK(stage.plays[1].at == 0.5);
    CHECK(stage.plays[1].speed.at(0) == -0.5);
    CHECK(near(stage.plays[1].weight.value(0.25), 0.25, 1e-15));
    CHECK(stage.plays[1].mask == std::vector<std::string>{"ball", "tower/*"});
    CHECK(stage.plays[2].weight.value(7) == 0.25);
    CHECK(stage.plays[2].mask == std::vector<std::string>{"late"});
  }
  SUBCASE("world") {
    CHECK(near(stage.world.gravity, Vec3(0, -1.62, 0), 0));
    CHECK(stage.step == 0.01);
    CHECK(stage.world.integrator == Integrator::semi_implicit_euler);
    CHECK(stage.world.solver == ContactSolver::lcp);
    CHECK(stage.world.separation == Parting::by_mass);
    CHECK(stage.world.collision == Detection::time_of_impact);
    CHECK(stage.world.broad_phase == PairSearch::grid);
    CHECK(stage.world.iterations == 30);
    CHECK(stage.world.sleep_speed == 0.05);
    CHECK(std::isinf(stage.world.sleep_after));
    CHECK(stage.world.push_out_speed == 1);
    CHECK(stage.world.threads == 2);
    REQUIRE(stage.forces.size() == 3);
    CHECK(std::get<Drag>(stage.forces[0].force).quadratic == 0.2);
    CHECK(stage.nodes[stage.forces[1].a].name == "tower/1");
    CHECK(stage.nodes[stage.forces[1].b].name == "ball");
    const Spring& spring = std::get<Spring>(stage.forces[1].force);
    CHECK(spring.rest_length == 0.5);
    CHECK(spring.stiffness == 100);
    CHECK(spring.damping == 2);
    CHECK(stage.forces[2].b == no_node);
  }
  SUBCASE("hand-off") {
    REQUIRE(stage.rules.size() == 7);
    CHECK(std::get<when::At>(stage.rules[0].when.triggers.at(0)).time == 1.5);
    CHECK(stage.rules[0].take_over.velocity == TakeOver::Velocity::average);
    CHECK(stage.rules[0].take_over.average_over == 0.2);
    CHECK(stage.rules[0].take_over.scale == 0.5);
    CHECK(near(stage.rules[0].take_over.add.angular, Vec3(0, 0, std::numbers::pi), 1e-15));
    CHECK(stage.rules[1].when.triggers.size() == 3);
    CHECK_FALSE(stage.rules[1].when.all);
    CHECK(stage.rules[1].bodies == std::vector<std::string>{"tower/1", "tower/2"});
    CHECK(stage.rules[1].take_over.velocity == TakeOver::Velocity::zero);
    CHECK(stage.rules[2].when.all);
    CHECK_FALSE(stage.rules[2].once);
    CHECK(stage.rules[2].to.hz == 3);
    const when::ContactHit hit = std::get<when::ContactHit>(stage.rules[2].when.triggers.at(0));
    CHECK(hit.impulse == 4);
    CHECK(hit.speed == 1);
    CHECK(hit.with == "ball");
    CHECK(stage.rules[3].bodies == std::vector<std::string>{"tower/1", "tower/2"});
    CHECK(stage.rules[3].take_over.velocity == TakeOver::Velocity::step);
    CHECK(stage.rules[4].hand_back.clock == HandBack::Clock::hold);
    CHECK(stage.rules[4].hand_back.anchor == HandBack::Anchor::ground);
    CHECK(stage.rules[4].hand_back.settle.kind == Settle::Kind::half_life);
    CHECK(stage.rules[4].hand_back.settle.seconds == 0.2);
    const std::vector<Trigger>& last = stage.rules[5].when.triggers;
    REQUIRE(last.size() == 5);
    CHECK(std::get<when::Enter>(last[0]).region == "ball");
    CHECK(std::get<when::Enter>(last[0]).who.empty());
    CHECK(std::get<when::Leave>(last[1]).who == "tower/2");
    CHECK(std::get<when::Saturated>(last[2]).seconds == 0.1);
    CHECK(std::get<when::Error>(last[3]).distance == 0.3);
    CHECK(std::holds_alternative<when::SpeedPeak>(last[4]));
    CHECK(stage.rules[5].take_over.overlap == TakeOver::Overlap::veto);
    CHECK(stage.rules[6].to == Drive{.hz = 5, .frame = Drive::Frame::anchor});
    CHECK(stage.rules[6].ramp == 0.5);
    REQUIRE(stage.rules[6].then.size() == 2);
    const NextChange &loosened = stage.rules[6].then[0], &recovered = stage.rules[6].then[1];
    CHECK(loosened.after == 1);
    CHECK(loosened.change.to == Drive::free());
    CHECK(loosened.change.take_over.velocity == TakeOver::Velocity::zero);
    CHECK(recovered.after == 0.5);
    CHECK(recovered.change.to == Drive::keyed());
    CHECK(recovered.change.ramp == 0.25);
    CHECK(recovered.change.hand_back.clip == "idle");
    CHECK(recovered.change.hand_back.settle.seconds == 0.2);
  }
  SUBCASE("pairs that ignore each other") {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto& [a, b] : stage.ignored) pairs.emplace_back(stage.nodes[a].name, stage.nodes[b].name);
    CHECK(pairs == std::vector<std::pair<std::string, std::string>>{
                       {"tower/1", "tower/2"}, {"ball", "tower/1"}, {"ball", "tower/2"}});
  }
}

TEST_CASE("imports bring nodes and clips under their names") {
  const Document document = good_document("importer");
  const StageDescription& stage = document.stage();
  std::vector<std::string> names;
  for (const NodeDescription& node : stage.nodes) names.push_back(node.name);
  CHECK(names == std::vector<std::string>{"figure/body", "figure/head", "hips", "hat"});
  CHECK(stage.nodes[1].parent == 0);
  CHECK(near(stage.nodes[1].rest.position, Vec3(0, 1, 0), 0));
  CHECK(stage.nodes[1].body.has_value());  // added by the importing document
  CHECK(stage.nodes[1].color.has_value());
  CHECK(stage.nodes[1].group == "figure/skull");
  CHECK(stage.nodes[3].parent == 1);
  REQUIRE(stage.clips.size() == 2);
  CHECK(stage.clips[0].name == "figure/nod");
  CHECK(stage.clips[0].tracks.at(0).node == "figure/head");
  CHECK(stage.clips[1].name == "walk/walk");
  CHECK(stage.clips[1].tracks.at(0).node == "hips");  // a file without nodes drives this one's
  CHECK(stage.plays.at(1).clip == 1);
}

TEST_CASE("of several clips none plays by itself") {
  CHECK(parsed(R"({"tweenfall": 1, "clips": {"a": {}, "b": {}}})").stage().plays.empty());
  CHECK(parsed(R"({"tweenfall": 1, "clips": {"a": {}}})").stage().plays.size() == 1);
  CHECK(parsed(R"({"tweenfall": 1, "clips": {"a": {}}, "play": []})").stage().plays.empty());
}

TEST_CASE("the starting document loads and shows keys, a body and a hand-off") {
  const Document document = Document::parse(starting_document(), "start.json", {});
  CHECK(document.stage().clips.at(0).tracks.size() >= 1);
  CHECK(document.stage().nodes.size() >= 2);
  CHECK(document.stage().rules.size() >= 1);
  CHECK(starting_document().find("//") != std::string::npos);
}

TEST_CASE("all that the starting document says happens in its natural length, to the end of the clip played again") {
  const StageDescription described = Document::parse(starting_document(), "start.json", {}).stage();
  Stage stage(described);
  const double length = natural_length(described);
  const Recording recording = record(stage, length, 60);
  CHECK(recording.unfired.empty());
  REQUIRE(recording.handoffs.size() == described.rules.size());
  CHECK(recording.handoffs.back().time + described.clips[0].duration <= length);
  CHECK(recording.handoffs.back().time + described.rules.back().hand_back.settle.seconds <= length);
}

TEST_CASE("cylinders, cones and tapered capsules are as long and as wide as they say") {
  const Document document = good_document("round");
  const auto solid = [&](std::size_t i) -> const Solid& { return document.stage().nodes.at(i).body->shape.solid; };
  CHECK(std::get<Cylinder>(solid(0)).radius == 0.25);
  CHECK(std::get<Cylinder>(solid(0)).half_height == 1);
  CHECK(std::get<Cone>(solid(1)).radius == 0.5);
  CHECK(std::get<Cone>(solid(1)).half_height == 0.75);
  CHECK(std::get<TaperedCapsule>(solid(2)).bottom_radius == 0.3);
  CHECK(std::get<TaperedCapsule>(solid(2)).top_radius == 0.1);
  CHECK(std::get<TaperedCapsule>(solid(2)).half_height == 0.5);
}

TEST_CASE("the parts of a compound stand where they say") {
  const Document document = good_document("compound");
  const BodyDescription& body = *document.stage().nodes.at(0).body;
  const std::span<const Shape> parts = std::get<Compound>(body.shape.solid).parts();
  REQUIRE(parts.size() == 2);
  CHECK(std::get<Sphere>(parts[0].solid).radius == 0.3);
  CHECK(near(parts[1].offset.position, Vec3(0, 0.6, 0), 0));
  CHECK(near(parts[1].offset.rotation * Vec3(0, 1, 0), Vec3(-1, 0, 0), 1e-15));
}

TEST_CASE("hulls, turned and swept profiles are the convex solids that they describe") {
  const Document document = good_document("hulls");
  const auto hull = [&](std::size_t node) {
    return std::get<Hull>(document.stage().nodes.at(node).body->shape.solid).convex;
  };
  CHECK(hull(0).vertices().size() == 6);  // the seventh point is inside
  CHECK(hull(0).faces().size() == 5);
  CHECK(near(hull(0).measures().volume, 3, 1e-14));
  CHECK(hull(1).faces().size() == 49);
  CHECK(near(hull(1).measures().volume, 48 * 0.5 * 0.25 * std::sin(2 * std::numbers::pi / 48) * 2 / 3, 1e-12));
  CHECK(near(hull(1).measures().center, Vec3(0, 0.5, 0), 1e-12));
  CHECK(near(document.stage().nodes.at(1).body->shape.offset.position, Vec3(0, -0.5, 0), 0));
  CHECK(hull(2).vertices().size() == 48);
  CHECK(hull(3).faces().size() == 6);
  CHECK(near(hull(3).measures().volume, 0.24, 1e-12));
  const Bounds beam = bounds(document.stage().nodes.at(3).body->shape, {});
  CHECK(near(beam.low, Vec3(0, -0.1, -0.2), 1e-12));
  CHECK(near(beam.high, Vec3(3, 0.1, 0.2), 1e-12));
}
