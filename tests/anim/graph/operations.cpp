// Operations of a graph against the functions that they call: each shows the same bits.

#include "figure_support.h"

#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/look_at.h>

#include <functional>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const std::vector<double> shown_instants = {0, 0.1, 0.37, 0.74, 1.13, 1.6, 1.91, 2.4, 5.03};

/// What the functions themselves make of a pose at a time.
using ByHand = std::function<void(std::span<Motion> pose, GraphPlayer& player, const Sample<double>& weight)>;
using WithWeight = std::function<PoseOperation(GraphNumber weight)>;

void check_same(const WithWeight& described, const ByHand& by_hand) {
  GraphPlayer walking(figure_graph({.poses = {{"walk", ClipPose{"walk"}}}}));
  const Curve<double> keys = keyed_curve<double>({{.time = 0, .value = 0.2}, {.time = 6, .value = 0.9}});
  const GraphNumber weights[] = {0., 1., 0.35, keys, ByParameter{"weight"}};
  for (const GraphNumber& weight : weights) {
    CAPTURE(weight.index());
    GraphPlayer player(figure_graph(graph_with(described(weight))));
    for (const double time : shown_instants) {
      CAPTURE(time);
      player.seek(time);
      Sample<double> now{1, 0, 0};
      if (const double* constant = std::get_if<double>(&weight)) now.value = *constant;
      if (std::holds_alternative<Curve<double>>(weight)) now = keys.sample(time);
      if (std::holds_alternative<ByParameter>(weight)) now = player.parameter("weight");
      std::vector<Motion> expected = shown(walking, time);
      if (now.value != 0 || now.rate != 0) by_hand(expected, player, now);
      CHECK(same_bits(shown(player, time), expected));
    }
  }
}

Sample<Vec3> at_node(const char* name, std::span<const Motion> pose, const Sample<Vec3>& at) {
  const auto& nodes = figures();
  const WorldMotion world = world_of_node(*nodes, *nodes->find(name), pose);
  return {world.point(at.value), world.point_velocity(at.value) + world.linear * at.rate, {0, 0, 0}};
}

std::string faults_of(const PoseOperation& operation) {
  std::string text;
  for (const GraphFault& fault : inspect(graph_with(operation), *figures(), *figure_clips())) {
    for (const std::string& part : fault.place) text += "/" + part;
    text += ": " + fault.message + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("two bones in a graph bend as the chain alone does, target and pole being nodes and parameters") {
  const TwoBoneChain chain(*figures(), {"thigh.L", "shin.L", "foot.L"});
  check_same([](const GraphNumber& weight) { return grip(weight); },
             [&](std::span<Motion> pose, GraphPlayer& player, const Sample<double>& weight) {
               const Sample<double> z = player.parameter("reach");
               const Motion start = world_of_node(*figures(), 1, pose).motion;
               const Sample<Vec3> pole = at_node("ball", pose, still({0, 0, 1}));
               const Sample<Vec3> target = at_node("tail 1", pose, moving({0.1, -0.55, z.value}, {0, 0, z.rate}));
               reach(chain,
                     {.target = target,
                      .pole = moving(pole.value - start.pose.position, pole.rate - start.twist.linear),
                      .softness = 0.3},
                     weight, pose);
             });
}

TEST_CASE("two bones without a pole reach a fixed place as the chain alone does") {
  const TwoBoneChain chain(*figures(), {"thigh.L", "shin.L", "foot.L"});
  check_same(
      [](const GraphNumber& weight) {
        TwoBonePose pose = grip(weight);
        pose.pole.reset();
        pose.target = place_of(0.2, 0.3, 0.3);
        pose.softness = 0;
        return pose;
      },
      [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
        reach(chain, {.target = still({0.2, 0.3, 0.3})}, weight, pose);
        if (weight.value == 1)
          CHECK((world_of_node(*figures(), 3, pose).motion.pose.position - Vec3(0.2, 0.3, 0.3)).norm() < 1e-12);
      });
}

TEST_CASE("joints in a graph look at a node as the chain alone does") {
  const LookAtChain chain(*figures(), {.joints = {{"spine", 0.3}, {"head"}}, .eye = {0, 0.1, 0.1}, .limit = 1.4});
  check_same(
      [](const GraphNumber& weight) { return look(weight); },
      [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
        look_at(chain, {.target = at_node("ball", pose, still({0, 0, 0})), .up = still({0, 1, 0})}, weight, pose);
      });
}

TEST_CASE("a chain in a graph reaches as the chain alone does, by both methods") {
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd}) {
    const JointChain chain(
        *figures(),
        {.links = {{"tail 1"}, {"tail 2", ConeLimit{.swing = 1.3}}, {"tail 3"}, {"tail 4"}}, .method = method});
    check_same([&](const GraphNumber& weight) { return curl(weight, method); },
               [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
                 reach(chain, still({0.25, 1.2, -0.3}), weight, pose);
               });
  }
}

TEST_CASE("feet in a graph stand on its ground as the function alone places them") {
  const FootPlacement placement(
      *figures(), {.pelvis = "hips",
                   .feet = {{.leg = {"thigh.L", "shin.L", "foot.L"}}, {.leg = {"thigh.R", "shin.R", "foot.R"}}},
                   .evenness = 0.05,
                   .softness = 0.3});
  const HeightGrid ground = bumpy_ground();
  check_same([](const GraphNumber& weight) { return stand(weight); },
             [&](std::span<Motion> pose, GraphPlayer& player, const Sample<double>& weight) {
               const std::vector<Sample<double>> feet = {{1, 0, 0}, player.parameter("reach")};
               place_feet(
                   placement, [&](const Sample<Vec3>& place) { return std::optional(ground.at(place)); }, {0.02, 0, 0},
                   weight, feet, pose);
             });
}

TEST_CASE("a mirror in a graph does to its figure what the mirror alone does, and nothing to others") {
  std::vector<Node> own(figures()->nodes().begin(), figures()->nodes().begin() + 13);
  const Hierarchy nodes{own};
  const Mirror mirror(nodes, std::vector<MirrorPair>{{"*.L", "*.R"}});
  check_same([](const GraphNumber& weight) { return mirrored(weight); },
             [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
               const std::span<Motion> figure = pose.first(13);
               std::vector<Motion> other(13);
               mirror.apply(figure, other);
               cross_fade(figure, other, weight, figure);
             });
}

TEST_CASE("a figure in a graph takes over what another one does, as between two skeletons") {
  const std::span<const Node> all = figures()->nodes();
  std::vector<Node> target(all.begin() + 14, all.end());
  for (Node& node : target) node.parent = node.parent == no_node ? no_node : node.parent - 14;
  const Retarget map(
      Hierarchy(std::vector<Node>(all.begin(), all.begin() + 13)), Hierarchy(target),
      std::vector<RetargetPair>{{"hips", "other/hips", true}, {"spine", "other/spine"}, {"head", "other/head"}});
  check_same([](const GraphNumber& weight) { return taken_over(weight); },
             [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
               std::vector<Motion> out(3);
               map.apply(pose.first(13), out);
               cross_fade(pose.subspan(14), out, weight, pose.subspan(14));
             });
}

TEST_CASE("root motion is taken out in a graph as by itself, and what it is put onto carries the figure the same way") {
  const RootMotion root(*figures(), "spine");
  check_same([](const GraphNumber& weight) { return on_the_spot(weight); },
             [&](std::span<Motion> pose, GraphPlayer&, const Sample<double>& weight) {
               std::vector<Motion> changed(pose.begin(), pose.end());
               root.take_out(changed);
               cross_fade(pose, changed, weight, pose);
             });
  GraphPlayer walking(figure_graph({.poses = {{"walk", ClipPose{"walk"}}}})),
      carried(figure_graph(graph_with(on_the_spot(1., "hips"))));
  for (const double time : shown_instants) {
    const std::vector<Motion> before = shown(walking, time), after = shown(carried, time);
    const WorldMotion a = world_of_node(*figures(), 8, before), b = world_of_node(*figures(), 8, after);
    CHECK((a.motion.pose.position - b.motion.pose.position).norm() < 1e-12);
    CHECK((a.motion.twist.linear - b.motion.twist.linear).norm() < 1e-12);
    CHECK((before[0].pose.position - after[0].pose.position).norm() > 1e-4);
  }
}

TEST_CASE("a ground goes through its heights, is smooth between them and goes straight on beyond") {
  const HeightGrid ground = bumpy_ground();
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      const Vec3 place(3 * static_cast<double>(column) - 4.5, 7, 3 * static_cast<double>(row) - 4.5);
      CHECK(near(ground.at(still(place)).height, ground.heights[row * 4 + column], 1e-15));
    }
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 place = random.vector(6), velocity = random.vector(2);
    const auto at = [&](double t) { return ground.at(moving(place + t * velocity, velocity)); };
    const auto clear = [](double x) { return std::abs(x / 3 + 1.5 - std::round(x / 3 + 1.5)) > 0.02; };
    if (!clear(place.x()) || !clear(place.z())) continue;
    const double slope = difference([&](double t) { return at(t).height; }, 0);
    const Ground here = at(0);
    CHECK(near(slope, -(here.normal.x() * velocity.x() + here.normal.z() * velocity.z()), 1e-10));
    CHECK(near(here.normal_rate, difference([&](double t) { return at(t).normal; }, 0), 1e-10));
  }
  for (int i = 0; i < 100; ++i) {  // across the lines between heights neither height nor normal jumps
    const double z = random.between(-6, 6), x = random.between(-5, 5), e = 1e-9;
    const double line = std::clamp(std::round(x / 3 + 1.5), 0.0, 3.0) * 3 - 4.5;
    const Ground before = ground.at(still({line - e, 0, z})), after = ground.at(still({line + e, 0, z}));
    CHECK(near(before.height, after.height, 1e-8));
    CHECK(near(before.normal, after.normal, 1e-8));
  }
  const Ground border = ground.at(still({4.5, 0, 1})), far = ground.at(still({14.5, 0, 1}));
  CHECK(near(far.normal.x(), border.normal.x(), 1e-14));
  CHECK(near(far.height, border.height - 10 * border.normal.x(), 1e-13));
  const HeightGrid slope{.columns = 2, .heights = {0, 1, 2, 3}, .spacing_x = 2, .middle = {1, 5, 1}};
  const Ground plane = slope.at(still({1.5, 0, 1.25}));
  CHECK(near(plane.height, 5 + 0.75 + 1.5, 1e-14));
  CHECK(near(plane.normal, Vec3(-0.5, 1, -2), 1e-14));
}

TEST_CASE("an operation that asks for what is not there is refused with its place") {
  TwoBonePose bones = grip(1.);
  bones.middle = "shim.L";
  CHECK(faults_of(bones) == "/poses/changed/two_bone/middle: there is no node \"shim.L\"; did you mean \"shin.L\"?\n");
  bones.middle = "thigh.R";
  CHECK(faults_of(bones).find("/poses/changed/two_bone/middle: two-bone chain: middle") == 0);
  bones = grip(2.);
  bones.base = "wlak";
  bones.target = {.node = "foot.L"};
  CHECK(faults_of(bones) ==
        "/poses/changed/base: there is no pose or clip \"wlak\"; did you mean \"walk\"?\n"
        "/poses/changed/two_bone/weight: a weight is 0 to 1; it is 2\n"
        "/poses/changed/two_bone/target: \"foot.L\" is carried by the joints that turn toward it\n");
  bones = grip(ByParameter{"wieght"});
  bones.softness = 1;
  CHECK(faults_of(bones) ==
        "/poses/changed/two_bone/weight: there is no parameter \"wieght\"; did you mean \"weight\"?\n"
        "/poses/changed/two_bone/softness: the softness of two bones is 0 to 0.5\n");
  ReachPose chain = curl(1., ChainMethod::ccd);
  chain.joints.resize(1);
  CHECK(faults_of(chain).find("/poses/changed/reach/joints: ") == 0);
  chain.joints = {{"tail 2"}, {"tail 1"}};
  CHECK(faults_of(chain) ==
        "/poses/changed/reach/joints/1: joint chain: joint 2 (\"tail 1\") must be below the joint before it (\"tail "
        "2\")\n");
  chain.joints = {{"tail 2"}, {"tial 3"}};
  CHECK(faults_of(chain) == "/poses/changed/reach/joints/1: there is no node \"tial 3\"; did you mean \"tail 3\"?\n");
  LookAtPose looking = look(1.);
  looking.joints.clear();
  looking.upright = Vec3(0, 0, 0);
  CHECK(faults_of(looking).find("/poses/changed/look_at/upright: a direction has a length, of 1e15 at most\n") == 0);
  FeetPose feet = stand(1.);
  feet.pelvis = "head";
  feet.ground.heights.pop_back();
  CHECK(faults_of(feet).find("/poses/changed/feet/ground: a ground has two heights") == 0);
  feet = stand(1.);
  feet.feet.resize(9, feet.feet[0]);
  CHECK(faults_of(feet).find("/poses/changed/feet/legs: at most 8 feet are placed") == 0);
  RetargetPose map = taken_over(1.);
  map.pairs[1].source = "spin";
  map.pairs[2].target = "other/haed";
  CHECK(faults_of(map) ==
        "/poses/changed/retarget/pairs/1: in the source no joint is named \"spin\"; did you mean \"spine\"?\n"
        "/poses/changed/retarget/pairs/2: in the target no joint is named \"other/haed\"; did you mean "
        "\"other/head\"?\n");
  map = taken_over(1.);
  map.target = "spine";
  CHECK(faults_of(map).find("/poses/changed/retarget/target: ") == 0);
  MirrorPose mirror = mirrored(1.);
  mirror.pairs = {{"*.l", "*.r"}};
  CHECK(faults_of(mirror).find("/poses/changed/mirror/pairs/0: ") == 0);
  mirror.pairs.clear();
  CHECK(faults_of(mirror).empty());  // by their usual names
  mirror.figure = "spine";
  CHECK(faults_of(mirror).find("do not tell sides") != std::string::npos);
  CHECK(faults_of(on_the_spot(1., "ball")) == "/poses/changed/root_motion/onto: \"ball\" does not carry \"spine\"\n");
  const GraphDescription circle = {
      .poses = {{"a", LookAtPose{.base = "b", .joints = {{"head"}}}}, {"b", MirrorPose{.base = "a"}}}};
  const std::vector<GraphFault> faults = inspect(circle, *figures(), *figure_clips());
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].message == "poses go around in a circle: \"a\" -> \"b\" -> \"a\"");
}

TEST_CASE("whatever an operation is told is in the number of its graph") {
  const auto number = [](const PoseOperation& operation) { return fingerprint(graph_with(operation)); };
  std::vector<std::uint64_t> numbers;
  const auto with = [&](auto pose, const auto& change) {
    change(pose);
    numbers.push_back(number(pose));
  };
  const auto same = [](auto&) {};
  with(grip(1.), same);
  with(grip(1.), [](TwoBonePose& pose) { pose.pole->at[2] = 1.5; });
  with(grip(1.), [](TwoBonePose& pose) { pose.target.node = "ball"; });
  with(grip(1.), [](TwoBonePose& pose) { pose.axis = Vec3(1, 0, 0); });
  with(grip(0.5), same);
  with(curl(1., ChainMethod::ccd), same);
  with(curl(1., ChainMethod::ccd), [](ReachPose& pose) { std::get<ConeLimit>(pose.joints[1].limit).twist_low = -1; });
  with(curl(1., ChainMethod::fabrik), same);
  with(stand(1.), same);
  with(stand(1.), [](FeetPose& pose) { pose.ground.heights[7] = 0; });
  with(stand(1.), [](FeetPose& pose) { pose.feet[0].ankle_height = 0; });
  with(taken_over(1.), same);
  with(taken_over(1.), [](RetargetPose& pose) { pose.pairs[0].moves = false; });
  with(taken_over(1.), [](RetargetPose& pose) { pose.turn = exp_map({0, 1, 0}); });
  with(taken_over(1.), [](RetargetPose& pose) { pose.stance = {{"head", Vec3(0, 0.3, 0)}}; });
  with(taken_over(1.), [](RetargetPose& pose) { pose.stance = {{"head", {}, exp_map({0, 1, 0})}}; });
  with(on_the_spot(1.), same);
  with(on_the_spot(1.), [](RootMotionPose& pose) { pose.parts.turn = RootParts::Turn::all; });
  std::ranges::sort(numbers);
  CHECK(std::ranges::adjacent_find(numbers) == numbers.end());
}

TEST_CASE("numbers beyond all bounds are told, and what is too sharp to be seen has numbers for rates") {
  const auto told = [](const PoseOperation& operation) {
    const std::vector<GraphFault> faults = inspect(graph_with(operation), *figures(), *figure_clips());
    return faults.empty() ? std::string() : faults[0].message;
  };
  ReachPose chain = curl(1., ChainMethod::fabrik);
  chain.target.at[0] = 1e300;
  CHECK(told(chain) == "a number may be up to 1e15; this one is 1e+300");
  chain.target.at[0] = keyed_curve<double>({{.time = 0, .value = 0}, {.time = 1, .value = -1e16}});
  CHECK(told(chain) == "a number may be up to 1e15, at any of its keys too");
  LookAtPose looking = look(1.);
  looking.upright = Vec3(0, 1e300, 0);
  CHECK(told(looking) == "a direction has a length, of 1e15 at most");
  looking = look(1.);
  looking.eye = Vec3(0, 1e160, 0);
  CHECK(told(looking) == "look-at chain: eye has a number beyond 1e+15");

  FeetPose standing = stand(1.);
  standing.ground.spacing_x = 5e-324;
  standing.ground.heights[3] = 1e300;
  CHECK(told(standing).find("the heights of a ground are from 1e-9 to 1e15 m apart") == 0);

  std::vector<PoseOperation> sharp;
  for (const double least : {5e-324, 1e-300, 1e-10}) {
    looking = look(1.);
    looking.limit = least;
    sharp.emplace_back(looking);
    looking.limit = 1.4;
    looking.ease = least;
    sharp.emplace_back(looking);
    FeetPose feet = stand(1.);
    feet.evenness = feet.softness = least;
    sharp.emplace_back(feet);
    TwoBonePose bones = grip(1.);
    bones.softness = least;
    sharp.emplace_back(bones);
    sharp.emplace_back(JigglePose{.base = "walk", .joints = {"tail 1", "tail 2", "tail 3"}, .limit = least});
  }
  sharp.emplace_back(MachinePose{.start = "walk",
                                 .states = {{"walk", "walk"}, {"dance", "dance"}},
                                 .transitions = {{.from = {"walk"},
                                                  .to = "dance",
                                                  .when = {{GraphCondition::Kind::time_in_state, "", 0.1}},
                                                  .change = {GraphChange::Kind::quintic, 1e300}}}});
  for (const PoseOperation& operation : sharp) {
    CAPTURE(words_of(operation));
    GraphPlayer player(figure_graph(graph_with(operation)));
    for (const double time : {0.0, 0.1, 0.4, 1.7})
      for (const Motion& motion : shown(player, time))
        CHECK(std::isfinite(motion.pose.position.sum() + motion.pose.rotation.coeffs().sum() +
                            motion.twist.linear.sum() + motion.twist.angular.sum()));
  }
}
