// Root motion that accumulates in a graph, checked against closed forms: screws, straight paths, integrals of weights.

#include "graph_support.h"

#include <cmath>
#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// exp(t (turn, way)): a figure that moves along a screw.
Pose screw(const Vec3& turn, const Vec3& way, double t) {
  Pose pose;
  pose.rotation = exp_map(t * turn);
  pose.position = right_jacobian(-t * turn) * Vec3(t * way);
  return pose;
}

/// The root moves along a screw from rest, and the upper limb swings.
Clip walker(const std::string& name, const Vec3& turn, const Vec3& way, double duration) {
  Clip clip{.name = name, .duration = duration, .loop = {.mode = LoopMode::repeat}};
  const Vec3 rest(0, 1, 0);
  clip.tracks.push_back({"root", "position",
                         Curve<Vec3>(
                             [=](double t, Side) {
                               const Pose at = screw(turn, way, t);
                               const Vec3 rate = at.rotation * way, spin = turn;
                               const Vec3 lever = at.rotation * rest;
                               return Sample<Vec3>{at.position + lever, rate + spin.cross(lever), {0, 0, 0}};
                             },
                             0, duration)});
  clip.tracks.push_back({"root", "rotation",
                         Curve<Quat>(
                             [=](double t, Side) {
                               return Sample<Quat>{exp_map(t * turn), turn, {0, 0, 0}};
                             },
                             0, duration)});
  clip.tracks.push_back({"upper", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = {0.3, 0, 0}},
                                            {.time = duration / 2, .value = {0.4, 0.1, 0}},
                                            {.time = duration, .value = {0.3, 0, 0}}})});
  return clip;
}

const Vec3 ahead(0, 0, 1.4), running(0, 0, 3), around(0, 0.7, 0);

std::shared_ptr<const std::vector<Clip>> walkers() {
  return std::make_shared<const std::vector<Clip>>(
      std::vector<Clip>{walker("walk", {0, 0, 0}, ahead, 1), walker("run", {0, 0, 0}, running, 0.7),
                        walker("arc", around, ahead, 1), walker("quick", {0, 0, 0}, ahead, 0.1),
                        walker("quicker", 2 * around, running, 0.1), walker("buzz", {0, 0, 0}, 1e-3 * ahead, 1e-9),
                        walker("stroll", {0, 0, 0}, 0.5 * ahead, 1), moving("wave", 7, LoopMode::repeat)});
}

RootMotionPose travelling(std::string base, std::string onto = {}) {
  return {.base = std::move(base), .node = "root", .onto = std::move(onto), .accumulates = true};
}

GraphPlayer travel_of(std::vector<GraphPose> poses, std::vector<GraphParameter> parameters = {},
                      std::vector<GraphInput> inputs = {}) {
  std::string last = poses.back().name;
  poses.push_back({"way", travelling(last)});
  return GraphPlayer(graph_of(
      {.parameters = std::move(parameters), .poses = std::move(poses), .inputs = std::move(inputs)}, walkers()));
}

/// Where the root's rest place has been carried.
Pose carried(GraphPlayer& player, double time, Side side = Side::out) {
  Pose root = pose_at(player, time, side)[0].pose;
  root.position -= root.rotation * Vec3(0, 1, 0);
  return root;
}

}  // namespace

TEST_CASE("ten thousand loops of an arc end on the circle, where the screw has them") {
  GraphPlayer player = travel_of({{"walk", ClipPose{.clip = "arc"}}});
  for (const double time : {0.4, 1., 1.6, 37.25, 10'000., 10'000.37}) {
    const Pose reached = carried(player, time), exact = screw(around, ahead, time);
    CAPTURE(time);
    CHECK(near(reached.position, exact.position, 1e-9));
    CHECK(near(reached.rotation, exact.rotation, 1e-9));
  }
  CHECK(rate_error(player, 9'999.6) < 1e-5);  // at 1e4 s a stencil has 1e-12 / 1e-4 of noise
}

TEST_CASE("a blend of walkers goes by the mean of their ways, over ten thousand loops") {
  GraphPlayer straight = travel_of({{"both", BlendPose{{{"walk", 1.0}, {"run", 3.0}}}}});
  CHECK(carried(straight, 100).position.z() == doctest::Approx(100 * (0.25 * 1.4 + 0.75 * 3)).epsilon(1e-12));

  GraphPlayer turning = travel_of({{"both", BlendPose{{{"quick", 0.5}, {"quicker", 0.5}}}}});
  for (const double time : {1.2345, 300.}) {
    const Pose reached = carried(turning, time), exact = screw(around, 0.5 * (ahead + running), time);
    CHECK(near(reached.position, exact.position, 2e-6));
    CHECK(near(reached.rotation, exact.rotation, 1e-9));
  }
}

TEST_CASE("a way through fades, keyed weights and parameters goes on without a jump, at its rate") {
  using Kind = GraphCondition::Kind;
  const Curve<double> share = keyed_curve<double>({{.time = 0, .value = 0}, {.time = 3, .value = 1}});
  GraphPlayer player = travel_of(
      {{"gaits",
        SpacePose{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"run", {1, 0}}}, .sync = std::string()}},
       {"stand", RestPose{}},
       {"legs",
        MachinePose{.start = "stand",
                    .states = {{"stand", "stand"}, {"go", "gaits"}},
                    .transitions = {{.to = "go", .when = {{Kind::event, "go"}}, .change = {.seconds = 0.6}},
                                    {{"go"}, "stand", {{Kind::event, "halt"}}, {GraphChange::Kind::quintic, 0.5}}}}},
       {"mixed", BlendPose{{{"legs", 1.0}, {"arc", share}}}},
       {"all",
        LayersPose{.base = "mixed", .layers = {{.pose = "wave", .mask = {{.joints = "upper", .below = true}}}}}}},
      {{.name = "speed", .half_life = 0.2}}, {{0.3, "go"}, {1.1, "speed", 0.9}, {2.4, "halt"}});
  for (const double time : {0.3, 1.0, 1.1, 2.0, 2.4, 2.9, 3.0}) {
    CAPTURE(time);
    const Apart seam = apart({pose_at(player, time, Side::in)[0]}, {pose_at(player, time)[0]});
    CHECK(seam.value < 1e-12);
  }
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const double time = random.between(0.01, 4);
    CAPTURE(time);
    const double h = 1e-4;
    const Vec3 slope = (carried(player, time + h).position - carried(player, time - h).position) / (2 * h);
    const Motion root = pose_at(player, time)[0];
    const Vec3 own = root.twist.linear - root.twist.angular.cross(Vec3(root.pose.rotation * Vec3(0, 1, 0)));
    CHECK(near(own, slope, 5e-5));
  }
}

TEST_CASE(
    "where weights kink, and from step to step, a way goes on at the velocity it had, its rate that of its value") {
  using Kind = GraphCondition::Kind;
  const auto line = [](double a, double b, double c) {
    return keyed_curve<double>({{.time = 0, .value = a, .ease = Ease::linear()},
                                {.time = 0.3007, .value = b, .ease = Ease::linear()},
                                {.time = 0.9, .value = c}});
  };
  GraphPlayer player = travel_of(
      {{"gaits",
        SpacePose{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"arc", {0.5, 0}}, {"run", {1, 0}}}}},
       {"legs", MachinePose{.start = "go",
                            .states = {{"go", "gaits"}, {"turn", "quicker"}},
                            .transitions = {{.to = "turn",
                                             .when = {{Kind::time_in_state, {}, 0.4507}},
                                             .change = {.seconds = 0.2003, .ease = Ease::linear()}}}}},
       {"mixed", BlendPose{{{"legs", 1.0}, {"arc", line(0.2, 1.5, -1)}}}}},
      {{.name = "speed", .curve = line(-0.2, 1.3, 0.1)}});
  for (int i = 1; i < 2000; ++i) {
    const double time = 0.8 * i / 2000, h = 1e-9;
    // Fades begin with a visible kink of their own; where they end, there is none.
    const Motion before = pose_at(player, time - h)[0], behind = pose_at(player, time + h)[0];
    CAPTURE(time);
    REQUIRE((behind.twist.linear - before.twist.linear).norm() < 1e-6);
    REQUIRE((behind.twist.angular - before.twist.angular).norm() < 1e-6);
  }
  for (int i = 1; i < 300; ++i) CHECK(rate_error(player, 0.0026 * i, 1e-5) < 1e-7);
}

TEST_CASE("a way keeps its velocity where a gliding parameter is set, wherever in a step a weight kinks") {
  Random random(5);
  std::vector<GraphInput> inputs;
  for (int i = 1; i <= 600; ++i) inputs.push_back({0.0037 * i, "speed", random.between(-1, 2)});
  const GraphDescription description{
      .parameters = {{.name = "speed", .half_life = 0.05}},
      .poses = {{"gaits", SpacePose{.by = {ByParameter{"speed"}},
                                    .entries = {{"walk", {0, 0}}, {"arc", {0.5, 0}}, {"run", {1, 0}}}}},
                {"way", travelling("gaits")}},
      .inputs = inputs};
  GraphPlayer player(graph_of(description, walkers()));
  Apart most;
  for (const GraphInput& input : inputs) {
    const Apart here = apart(pose_at(player, input.time, Side::in), pose_at(player, input.time, Side::out));
    most.value = std::max(most.value, here.value);
    most.rate = std::max(most.rate, here.rate);
  }
  CHECK(most.value < 1e-12);
  CHECK(most.rate < 1e-12);
  double error = 0;
  for (std::size_t i = 20; i < 600; i += 29)
    for (const double part : {0.1, 0.3, 0.7, 0.9})
      error = std::max(error, rate_error(player, inputs[i].time + 0.0037 * part, 2e-6));
  MESSAGE("jumps of rates up to " << most.rate << ", rates within " << error);
  CHECK(error < 1e-7);
}

TEST_CASE("a way whose weights glide goes as far as their integral, and from their arrival on lap by lap") {
  const double half_life = 0.3, set = 1.1, goal = 0.6, y = 2 * std::numbers::ln2 / half_life;
  for (const bool synced : {false, true}) {
    SpacePose gaits{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"stroll", {1, 0}}}};
    if (synced) gaits.sync = std::string();
    GraphPlayer player =
        travel_of({{"gaits", gaits}}, {{.name = "speed", .half_life = half_life}}, {{set, "speed", goal}});
    // A million seconds of 480 steps each would take hours.
    for (const double time : {0.7, 2.3, 9.0, 12.0, 1e6}) {
      CAPTURE(time);
      const double since = std::max(0.0, time - set);
      const double weight = goal * (since - 2 / y + (2 / y + since) * std::exp(-y * since));
      const double way = 1.4 * time + (0.7 - 1.4) * weight;
      CHECK(near(carried(player, time).position, Vec3(0, 0, way), time < 100 ? 1e-7 : 1e-6));
      CHECK(rate_error(player, time + 0.01) < (time < 100 ? 1e-6 : 1e-2));
    }
  }
}

TEST_CASE("a way that fades in goes as far as the integral of its weight") {
  using Kind = GraphCondition::Kind;
  GraphPlayer player = travel_of(
      {{"stand", RestPose{}},
       {"legs",
        MachinePose{
            .start = "stand",
            .states = {{"stand", "stand"}, {"walk", "walk"}},
            .transitions = {{.to = "walk", .when = {{Kind::time_in_state, {}, 0.5}}, .change = {.seconds = 0.6}}}}}});
  CHECK(carried(player, 0.5).position.norm() == 0);
  // Of u^2 (3 - 2 u) over 0.6 s one half is over; otherwise a straight path at 1.4 m/s.
  CHECK(carried(player, 2.1).position.z() == doctest::Approx(1.4 * (0.3 + 1.0)).epsilon(1e-6));
}

TEST_CASE("a way is the same bits whatever the frames and whoever asks, under springs too") {
  const std::vector<GraphPose> poses = {
      {"gaits", SpacePose{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"arc", {1, 0}}}}},
      {"way", travelling("gaits")},
      {"hat", SpringPose{.base = "way", .node = "upper", .position = SpringSettings{.hz = 2}}}};
  const GraphDescription description{.parameters = {{.name = "speed", .half_life = 0.3}},
                                     .poses = poses,
                                     .inputs = {{0.37, "speed", 1}, {1.9, "speed", 0.25}}};
  const auto graph = graph_of(description, walkers());
  GraphPlayer fine(graph), coarse(graph), back(graph);
  std::vector<std::vector<Motion>> seen;
  for (int i = 0; i <= 60; ++i) seen.push_back(pose_at(fine, 0.05 * i));
  for (int i = 0; i <= 60; i += 12) CHECK(same_bits(pose_at(coarse, 0.05 * i), seen[static_cast<std::size_t>(i)]));
  for (int i = 60; i >= 0; i -= 7) CHECK(same_bits(pose_at(back, 0.05 * i), seen[static_cast<std::size_t>(i)]));
  // Inputs take effect from then on.
  GraphPlayer told(graph), knowing(graph);
  told.seek(3);
  told.seek(2.5);
  told.set("speed", 0);
  knowing.seek(2.5);
  knowing.set("speed", 0);
  CHECK(same_bits(pose_at(told, 2.9), pose_at(knowing, 2.9)));
  CHECK(same_bits(pose_at(told, 0.05 * 48), seen[48]));
}

TEST_CASE(
    "the way may carry a node above, and a clip once, backwards or forwards and back goes no further than it does") {
  GraphPlayer onto(graph_of(
      {.poses = {{"way", RootMotionPose{.base = "walk", .node = "upper", .onto = "root", .accumulates = true}}}},
      walkers()));
  CHECK(std::isfinite(pose_at(onto, 5)[0].pose.position.sum()));
  GraphPlayer once = travel_of({{"walk", ClipPose{.clip = "arc", .loop = Loop{.mode = LoopMode::once}}}});
  CHECK(near(carried(once, 7).position, screw(around, ahead, 1).position, 1e-12));
  GraphPlayer pingpong = travel_of({{"walk", ClipPose{.clip = "arc", .loop = Loop{.mode = LoopMode::pingpong}}}});
  CHECK(near(carried(pingpong, 6.25).position, screw(around, ahead, 0.25).position, 1e-12));
  GraphPlayer backwards = travel_of({{"walk", ClipPose{.clip = "arc", .speed = -1}}});
  const Pose expected = compose(screw(around, ahead, 1), undone(screw(around, ahead, 5.5)));
  CHECK(near(carried(backwards, 5.5).position, expected.position, 1e-9));
}

TEST_CASE("the seam of a loop over which its way goes on is no instant; where anything else jumps is one") {
  CHECK(travel_of({{"walk", ClipPose{.clip = "arc"}}}).first_instant(0, 5.5) == std::nullopt);
  CHECK(travel_of({{"walk", ClipPose{.clip = "walk"}}}).first_instant(9998.5, 10001) == std::nullopt);
  // However many seams a step has: millions here.
  CHECK(travel_of({{"walk", ClipPose{.clip = "buzz"}}}).first_instant(0.5, 0.5 + 1.0 / 240) == std::nullopt);
  CHECK(GraphPlayer(graph_of({.poses = {{"walk", ClipPose{.clip = "arc"}}}}, walkers())).first_instant(0, 5.5) == 1.0);
  GraphPlayer mixed = travel_of({{"walk", ClipPose{.clip = "walk"}},
                                 {"run", ClipPose{.clip = "run"}},
                                 {"both", BlendPose{.parts = {{"walk", 0.25}, {"run", 0.75}}}}});
  CHECK(mixed.first_instant(0, 5.5) == std::nullopt);
  std::vector<Clip> clips = *walkers();
  clips[0].tracks[2] = {"upper", "position",
                        keyed_curve<Vec3>({{.time = 0, .value = {0.3, 0, 0}, .ease = Ease::linear()},
                                           {.time = 1, .value = {0.4, 0.1, 0}}})};
  GraphPlayer limping(graph_of({.poses = {{"walk", ClipPose{.clip = "walk"}}, {"way", travelling("walk")}}},
                               std::make_shared<const std::vector<Clip>>(clips)));
  CHECK(limping.first_instant(0.5, 3) == 1.0);
  CHECK(limping.first_instant(1, 3) == 2.0);
}

TEST_CASE("a way is not asked of a clip that does not fit its nodes; the clip is told") {
  std::vector<Clip> clips = *walkers();
  clips[0].tracks.push_back(clips[0].tracks[0]);
  const std::vector<GraphFault> faults =
      inspect({.poses = {{"walk", ClipPose{.clip = "walk"}}, {"way", travelling("walk")}}}, *limb(), clips);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].place == std::vector<std::string>{"poses", "walk", "clip"});
  CHECK(faults[0].message.starts_with("the clip does not fit its nodes:"));
}

TEST_CASE("a way is not asked of what lies below the graph, whose loops are not known there") {
  for (const RootMotionPose& described : {RootMotionPose{.node = "root", .accumulates = true},
                                          RootMotionPose{.base = "rest", .node = "root", .accumulates = true}}) {
    const std::vector<GraphFault> faults =
        inspect({.poses = {{"rest", RestPose{}}, {"way", described}}}, *limb(), *walkers());
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].place == std::vector<std::string>{"poses", "way", "root_motion", "accumulate"});
  }
}

TEST_CASE("blended walkers of any lengths drift no more in ten thousand laps than in one, asked for in any order") {
  const std::vector<GraphParameter> pace = {{.name = "speed", .start = 0.25}};
  const SpacePose space{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"run", {1, 0}}}};
  const auto in_phase = [&] {
    SpacePose synced = space;
    synced.sync = std::string();
    return synced;
  };
  // Laps of 7 s (7 walks, 10 runs), of the mean duration, and of 1 s.
  const double mean = 0.75 * 1 + 0.25 * 0.7;
  const struct {
    GraphPose pose;
    double lap;
  } cases[] = {
      {{"gaits", space}, 7}, {{"gaits", in_phase()}, mean}, {{"gaits", BlendPose{{{"walk", 0.75}, {"arc", 0.25}}}}, 1}};
  for (const auto& each : cases) {
    CAPTURE(each.lap);
    const auto made = [&](std::vector<GraphInput> inputs = {}) {
      return travel_of({{"walk", ClipPose{.clip = "walk"}},
                        {"run", ClipPose{.clip = "run"}},
                        {"arc", ClipPose{.clip = "arc"}},
                        each.pose},
                       pace, std::move(inputs));
    };
    GraphPlayer player = made();
    const Pose lap = carried(player, each.lap, Side::in);
    const double into = 0.45 * each.lap;
    const Pose part = carried(player, into);
    for (const double laps : {1., 2., 3., 137., 10'000.}) {
      CAPTURE(laps);
      const Pose exact = compose(repeated(lap, laps), part), reached = carried(player, laps * each.lap + into);
      CHECK(near(reached.position, exact.position, 1e-9));
      CHECK(near(reached.rotation, exact.rotation, 1e-11));
      const double seam = laps * each.lap;
      for (const double around : {-1e-9, 0., 1e-9})
        CHECK(apart({pose_at(player, seam + around, Side::in)[0]}, {pose_at(player, seam + around)[0]}).value < 1e-11);
      CHECK(rate_error(player, laps * each.lap + into) < 1e-5);
    }
    // Frame by frame, and with an input far on.
    const std::vector<GraphInput> inputs = {{31.2345, "speed", 0.5}, {90, "speed", 0.25}};
    GraphPlayer stepped = made(inputs), sought = made(inputs);
    const double far = 95.125;
    const std::vector<Motion> last = pose_at(sought, far);
    std::vector<Motion> pose(last.size());
    for (double t = 0; t < far; t += 1. / 30) {
      stepped.seek(t);
      stepped.pose(pose);
      if (std::abs(t - 31.2) < 0.1 || std::abs(t - 60) < 0.1) CHECK(same_bits(pose, pose_at(sought, t)));
    }
    CHECK(same_bits(pose_at(stepped, far), last));
    for (const GraphInput& input : inputs) {
      const Motion before = pose_at(sought, input.time, Side::in)[0], after = pose_at(sought, input.time)[0];
      CHECK(near(before.pose.position, after.pose.position, 1e-11));
      CHECK(near(before.pose.rotation, after.pose.rotation, 1e-11));
    }
    CHECK(rate_error(sought, 60.4) < 1e-6);
  }
}

TEST_CASE("blended walkers whose laps begin at any frame are asked for at any other") {
  // Sums of a beginning and a lap, both of frames, are rounded up and down.
  const SpacePose space{
      .by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"run", {1, 0}}}, .sync = std::string()};
  const double changed = 0.5, lap = 0.5 * 1 + 0.5 * 0.7;
  for (int begin = 1; begin < 90; begin += 3) {
    CAPTURE(begin);
    GraphPlayer player =
        travel_of({{"walk", ClipPose{.clip = "walk"}}, {"run", ClipPose{.clip = "run"}}, {"gaits", space}},
                  {{.name = "speed", .start = 0.25}}, {{begin / 60., "speed", changed}});
    double last = carried(player, begin / 60.).position.norm();
    for (int frame = begin; frame < begin + 300; ++frame) {
      const double far = carried(player, frame / 60.).position.norm();
      CHECK(std::abs(far - last) < 0.2);
      last = far;
    }
    for (const double from : {begin / 60., begin / 60. + 1. / 480, begin / 60. + 1. / 240})
      for (int laps = 1; laps < 12; ++laps) {
        const double seam = from + laps * lap;
        CHECK(near(carried(player, seam).position, carried(player, seam, Side::in).position, 1e-9));
      }
  }
}

TEST_CASE("a figure rides on what carries it and is not moved by its clips, on the spot, travelling, or put onto it") {
  const auto nodes = std::make_shared<const Hierarchy>(
      std::vector<Node>{{"world", no_node, {.position = {3, 0, 0}}},
                        {"platform", 0, {.position = {0, 0.5, 0}, .rotation = exp_map(Vec3(0, 0.3, 0))}},
                        {"root", 1, {.position = {0, 1, 0}}},
                        {"upper", 2, {.position = {0.3, 0, 0}}}});
  GraphGround ground;
  const auto rides = [](double time) {
    Motion motion;
    motion.pose.position = {2 * time, 0.5 + time, 0};
    motion.pose.rotation = exp_map(Vec3(0, 0.3 + 0.7 * time, 0));
    motion.twist = {{2, 1, 0}, {0, 0.7, 0}};
    return motion;
  };
  ground.pose = [&](double time, Side, std::span<Motion> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = {};
      out[i].pose = (*nodes)[i].rest;
    }
    out[1] = rides(time);
  };
  for (const bool accumulates : {false, true}) {
    for (const std::string onto : {"", "platform"}) {
      CAPTURE(accumulates);
      CAPTURE(onto);
      const auto made = [&](GraphGround below) {
        return GraphPlayer(std::make_shared<const Graph>(
                               nodes, walkers(),
                               GraphDescription{.poses = {{"walk", ClipPose{.clip = "arc"}},
                                                          {"way", RootMotionPose{.base = "walk",
                                                                                 .node = "root",
                                                                                 .onto = onto,
                                                                                 .accumulates = accumulates}}}}),
                           std::move(below));
      };
      GraphPlayer riding = made(ground), resting = made({});
      for (const double time : {0.25, 2.6}) {
        const std::vector<Motion> moves = pose_at(riding, time), stands = pose_at(resting, time);
        for (const std::size_t own : {2U, 3U}) CHECK(near(moves[own].pose.position, stands[own].pose.position, 1e-12));
        if (onto.empty()) {
          CHECK(same_bits({moves[1]}, {rides(time)}));
        } else {
          // It goes its own way, and the figure's on top of that.
          const Pose rest = (*nodes)[1].rest;
          const Quat turn = stands[1].pose.rotation * rest.rotation.conjugate();
          CHECK(near(moves[1].pose.rotation, turn * rides(time).pose.rotation, 1e-12));
        }
        CHECK(rate_error(riding, time) < 1e-9);
      }
    }
  }
}
