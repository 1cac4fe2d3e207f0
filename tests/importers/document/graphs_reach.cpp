// Operations of graphs that reach, look, stand, mirror and take over, in documents: what they mean, and their faults.

#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

template <class Operation>
const Operation& operation_of(const GraphDescription& graph, const std::string& name) {
  for (const GraphPose& pose : graph.poses)
    if (pose.name == name) return std::get<Operation>(pose.operation);
  throw std::invalid_argument("there is no pose " + name);
}

std::string reach_faults(const std::string& pose) {
  return faults_of(
      "{\"tweenfall\": 1, \"nodes\": {\"a\": {}, \"b\": {\"parent\": \"a\", \"position\": [0, 1, 0]}, "
      "\"c\": {\"parent\": \"b\", \"position\": [0, 1, 0.1]}, \"d\": {}},\n\"graphs\": {\"g\": {\"poses\": {\"p\": " +
          pose + "}}}}",
      "g.json", {});
}

bool tells(const std::string& pose, const std::string& words) {
  const std::string told = reach_faults(pose);
  CAPTURE(told);
  return told.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("faults of chains, legs and masks are told at the member that is wrong") {
  const auto at = [](const std::string& place) { return " (at /graphs/g/poses/p/" + place + ")"; };
  const std::string reach = "{\"reach\": {\"target\": \"d\", \"joints\": [";
  CHECK(tells(reach + "\"a\", {\"node\": \"d\"}, \"c\"]}}", at("reach/joints/1")));
  CHECK(tells(reach + "\"a\", \"d\"]}}", at("reach/joints/1")));
  CHECK(tells(reach + "\"a\"]}}", at("reach/joints")));
  CHECK(tells(reach + "\"a\", {\"node\": \"b\", \"hinge\": {\"axis\": [0, 0, 0]}}, \"c\"]}}",
              at("reach/joints/1/hinge/axis")));
  CHECK(tells(reach + "\"a\", {\"node\": \"b\", \"hinge\": {}}]}}", at("reach/joints/1")));
  const std::string bones = "{\"two_bone\": {\"target\": \"d\", \"start\": \"a\", \"middle\": ";
  CHECK(tells(bones + "\"d\", \"end\": \"c\"}}", at("two_bone/middle")));
  CHECK(tells(bones + "\"b\", \"end\": \"a\"}}", at("two_bone/end")));
  CHECK(tells(bones + "\"b\", \"end\": \"c\", \"axis\": [0, 1, 0]}}", at("two_bone/axis")));
  CHECK(tells("{\"look_at\": {\"target\": \"d\", \"joints\": [\"b\", \"a\"]}}", at("look_at/joints/1")));
  CHECK(tells("{\"look_at\": {\"target\": \"d\", \"joints\": [\"a\"], \"up\": [0, 0, 1], \"forward\": [0, 0, 2]}}",
              at("look_at/up")));
  CHECK(tells("{\"jiggle\": {\"joints\": [\"a\", \"d\"]}}", at("jiggle/joints/1")));
  const auto standing = [](const std::string& pelvis, const std::string& middle) {
    return faults_of(
        R"({"tweenfall": 1, "nodes": {"p": {}, "o": {}, "a": {"parent": "p", "position": [0, 2, 0]},
      "b": {"parent": "a", "position": [0, -1, 0.1]}, "c": {"parent": "b", "position": [0, -1, 0]},
      "hill": {"body": {"static": true, "shape": {"height_field": {"spacing": 1, "heights": [[0, 0], [0, 1]]}}}}},
      "graphs": {"g": {"poses": {"p": {"feet": {"ground": "hill", "pelvis": ")" +
            pelvis + R"(", "legs": [{"start": "a", "middle": ")" + middle + R"(", "end": "c"}]}}}}}})",
        "g.json", {});
  };
  CHECK(standing("p", "b").empty());
  CHECK(standing("o", "b").find(at("feet/legs/0/start")) != std::string::npos);
  CHECK(standing("p", "o").find(at("feet/legs/0/middle")) != std::string::npos);
  const auto masked = [](const std::string& mask) {
    return "{\"layers\": [{\"over\": \"q\", \"mask\": " + mask + "}]}, \"q\": {\"rest\": true}";
  };
  CHECK(reach_faults(masked("[\"a\", {\"joints\": \"b\"}]")).empty());
  CHECK(tells(masked("[\"a\", \"x\", {\"joints\": \"c*\"}]"), at("layers/0/mask/1")));
  CHECK(tells(masked("[\"a\", \"b\", {\"joints\": \"x*\", \"weight\": 0.5}]"), at("layers/0/mask/2")));
  CHECK(tells(masked("\"x\""), at("layers/0/mask")));
  CHECK(tells(masked("{\"joints\": \"x\"}"), at("layers/0/mask")));
}

TEST_CASE("faults of pairs are told at the pair") {
  const auto at = [](const std::string& place) { return " (at /graphs/g/poses/p/" + place + ")"; };
  const auto mirrored = [](const std::string& pairs) { return "{\"mirror\": {\"pairs\": [" + pairs + "]}}"; };
  CHECK(tells(mirrored(R"(["b", "c"], ["*.L", "*.R"])"), R"(no joint matches "*.L" or "*.R")" + at("mirror/pairs/1")));
  CHECK(tells(mirrored(R"(["b", "c*"], ["a", "d"])"), at("mirror/pairs/0")));
  CHECK(tells(mirrored(R"(["a", "d"], ["a", "b"])"), "\"a\" has two partners, \"d\" and \"b\"" + at("mirror/pairs/1")));
  CHECK(tells(mirrored(R"(["a", "d"], ["c", "b"])"), "which are not partners" + at("mirror/pairs/1")));
  CHECK(tells(mirrored(R"(["a", "d"])").insert(12, "\"normal\": [0, 0, 0], "), at("mirror/normal")));
  const auto mapped = [](const std::string& pairs, const std::string& more = "") {
    return "{\"retarget\": {\"source\": \"a\", \"target\": \"d\", " + more + "\"pairs\": [" + pairs + "]}}";
  };
  CHECK(tells(mapped(R"(["a", "d"], ["x", "d"])"), "no joint is named \"x\"" + at("retarget/pairs/1")));
  CHECK(tells(mapped(R"(["a", "d"], {"source": "b", "target": "y"})"), at("retarget/pairs/1")));
  CHECK(tells(mapped(R"(["a", "d"], ["b", "d"])"), at("retarget/pairs/1")));
  CHECK(tells(mapped(R"(["b*", "d"])"), at("retarget/pairs/0")));
  CHECK(tells(mapped(R"(["a", "d"])"), "a scale must be given" + at("retarget")));
}

TEST_CASE("in one pose all faults are told at once, but not what only follows from another") {
  const auto standing = [](const std::string& members) {
    return faults_of(
        R"({"tweenfall": 1, "nodes": {"p": {}, "a": {"parent": "p", "position": [0, 2, 0]},
      "b": {"parent": "a", "position": [0, -1, 0.1]}, "c": {"parent": "b", "position": [0, -1, 0]},
      "hill": {"body": {"static": true, "shape": {"height_field": {"spacing": 1, "heights": [[0, 0], [0, 1]]}}}}},
      "graphs": {"g": {"poses": {"p": {"feet": {)" +
            members + "}}}}}}",
        "g.json", {});
  };
  const auto both = [&](const std::string& members, const std::string& first, const std::string& second) {
    const std::string told = standing(members);
    CAPTURE(told);
    CHECK(told.find("feet/" + first + ")") != std::string::npos);
    CHECK(told.find("feet/" + second + ")") != std::string::npos);
  };
  const std::string legs = R"(, "legs": [{"start": "a", "middle": "b", "end": "c"}])";
  CHECK(standing(R"("ground": "hill", "pelvis": "p")" + legs).empty());
  both(R"("ground": "a", "pelvis": "p", "legs": [{"start": "a", "middle": "b", "end": "x"}])", "ground", "legs/0/end");
  both(R"("ground": "a", "pelvis": "p", "legs": [{"start": "b", "middle": "a", "end": "c"}])", "ground",
       "legs/0/middle");
  both(R"("ground": "nowhere", "pelvis": "y")" + legs, "ground", "pelvis");
  both(R"("ground": "hill", "tilt": "steep", "pelvis": "c")" + legs, "tilt", "legs/0/start");
  both(R"("ground": "hill", "pelvis": 3, "legs": [{"start": "a", "middle": "b", "end": "x"}])", "pelvis", "legs/0/end");
  both(
      R"("ground": "hill", "pelvis": "p", "weight": {"parameter": "w"}, "legs": [{"start": "a", "middle": "x", "end": 1}])",
      "weight", "legs/0/middle");
  // A pelvis that was not read is not one that is missing.
  const std::string told = standing(R"("ground": "hill", "pelvis": 3)" + legs);
  CHECK(told.find("error:") == told.rfind("error:"));
}

TEST_CASE("operations of a document mean what the same operations mean in C++") {
  const Document document = Document::read(data_folder() / "documents/good/graph_reach.json");
  const GraphDescription& graph = document.stage().graphs.at(0);
  const auto& feet = operation_of<FeetPose>(graph, "on");
  CHECK(feet.base == "walk");
  CHECK(feet.feet.at(0).ankle_height == 0.05);
  CHECK(feet.feet.at(1).axis == Vec3(1, 0, 0));
  CHECK(std::get<ByParameter>(feet.feet.at(1).weight).name == "grip");
  CHECK(near(feet.tilt, 30 * degree, 1e-15));
  CHECK(std::get<double>(feet.floor) == 0.1);
  CHECK(feet.ground.columns == 3);
  CHECK(feet.ground.heights == std::vector<double>{0, 0.1, 0, 0.2, 0.1, 0});
  CHECK(feet.ground.spacing_z == 3);
  CHECK(feet.ground.middle == Vec3(0, -0.1, 0));
  const auto& kick = operation_of<TwoBonePose>(graph, "kick");
  CHECK(kick.target.node == "ball");
  CHECK(std::get<ByParameter>(kick.target.at[1]).name == "x");
  CHECK(std::get<double>(kick.target.at[2]) == -0.1);
  CHECK(kick.pole->node.empty());
  CHECK(std::get<double>(kick.pole->at[2]) == 5);
  CHECK(kick.axis == Vec3(-1, 0, 0));
  const auto& gaze = operation_of<LookAtPose>(graph, "gaze");
  CHECK(gaze.joints.at(0).share == 0.3);
  CHECK(gaze.joints.at(1).node == "head");
  CHECK(gaze.upright == Vec3(0, 1, 0));
  CHECK(near(gaze.limit, 80 * degree, 1e-15));
  CHECK(gaze.ease == 0.2);
  CHECK(std::get<Curve<double>>(gaze.weight).value(0.5) == 0.5);
  const auto& lean = operation_of<ReachPose>(graph, "lean");
  CHECK(near(std::get<HingeLimit>(lean.joints.at(1).limit).low, -20 * degree, 1e-15));
  CHECK(lean.method == ChainMethod::ccd);
  CHECK(lean.sweeps == 4);
  CHECK(lean.leaps);
  CHECK(lean.follows);
  CHECK(operation_of<ReachPose>(graph, "bend").leaps);
  CHECK_FALSE(operation_of<ReachPose>(graph, "bend").follows);
  CHECK(near(std::get<ConeLimit>(operation_of<ReachPose>(graph, "bend").joints.at(0).limit).swing, 40 * degree, 1e-15));
  CHECK(operation_of<MirrorPose>(graph, "flip").figure == "hips");
  CHECK(operation_of<MirrorPose>(graph, "sides").pairs.at(0).right == "*.R");
  const auto& twin = operation_of<RetargetPose>(graph, "twin");
  CHECK(twin.pairs.at(0).moves);
  CHECK(twin.pairs.at(1).target == "other/spine");
  CHECK(twin.scale == 0.5);
  CHECK(near(twin.turn, exp_map({0, pi / 2, 0}), 1e-15));
  CHECK(twin.stance.at(0).node == "other/spine");
  CHECK(twin.stance.at(0).position == Vec3(0, 0.4, 0.3));
  CHECK(near(twin.stance.at(0).rotation.value(), exp_map({pi / 6, 0, 0}), 1e-15));
  CHECK(twin.stance.at(1).position == Vec3(0, 0.31, 0));
  CHECK_FALSE(twin.stance.at(1).rotation);
  const auto& still = operation_of<RootMotionPose>(graph, "still");
  CHECK(still.parts.vertical);
  CHECK(still.parts.horizontal);
  CHECK(still.parts.turn == RootParts::Turn::all);
  const auto& bob = operation_of<SpringPose>(graph, "bob");
  CHECK(bob.base == "walk");
  CHECK(bob.position->gravity == Vec3(0, -2, 0));
  CHECK(bob.rotation->hz == 2);
  CHECK(bob.rotation->damping == 0.5);
  CHECK(bob.rotation->steps_per_second == 60);
  const auto& sway = operation_of<JigglePose>(graph, "sway");
  CHECK(sway.joints == std::vector<std::string>{"spine", "head"});
  CHECK(sway.tip == Vec3(0, 0.2, 0));
  CHECK(sway.spring.damping == 0.1);
  CHECK(near(sway.limit, 60 * degree, 1e-15));
  CHECK(fingerprint(Document::parse(document.text(), "again.json", {}).stage().graphs[0]) == fingerprint(graph));
}

TEST_CASE("on a stage a leg that reaches for a ball is there, and its joints count as animated") {
  Stage stage(parsed(R"({"tweenfall": 1,
    "nodes": {"thigh": {"position": [0, 1, 0]}, "shin": {"parent": "thigh", "position": [0, -0.5, 0.05]},
              "foot": {"parent": "shin", "position": [0, -0.5, -0.05]}, "ball": {"position": [0, 0.3, 0.4]},
              "sole": {"parent": "foot", "body": {"shape": {"sphere": {"radius": 0.05}}, "mass": 1}}},
    "clips": {"roll": {"tracks": {"ball.position": [[0, [0, 0.3, 0.4], "smooth"], [1, [0.2, 0.4, 0.5]]]}}},
    "graphs": {"g": {"poses": {"p": {"base": "roll", "two_bone": {"start": "thigh", "middle": "shin", "end": "foot", "target": "ball"}}}}}})")
                  .stage());
  CHECK(stage.owner(4) == Owner::keyed);
  for (const double time : {0.0, 0.4, 0.8}) {
    stage.seek(time);
    CHECK((stage.world(2).motion.pose.position - stage.world(3).motion.pose.position).norm() < 1e-12);
    CHECK((stage.world(2).motion.twist.linear - stage.world(3).motion.twist.linear).norm() < 1e-10);
  }
}

TEST_CASE("a figure that rests with its arms down, and looks another way, follows one that rests with its arms out") {
  // The robot's own axes are different too: its bones run along y, and it looks along x.
  const auto stage_of = [](const std::string& more) {
    return Stage(parsed(R"({"tweenfall": 1,
      "nodes": {"hips": {"position": [0, 1, 0]},
                "arm": {"parent": "hips", "position": [0.2, 0.5, 0]}, "hand": {"parent": "arm", "position": [0.6, 0, 0]},
                "robot": {"position": [0, 2, 0]},
                "robot/arm": {"parent": "robot", "position": [0, 1, -0.4], "rotation": {"axis": "x", "angle": 180}},
                "robot/hand": {"parent": "robot/arm", "position": [0, 0.9, 0]}},
      "clips": {"wave": {"tracks": {"arm.rotation": {"axis": "z", "keys": [[0, 0], [1, 70]]}}}},
      "graphs": {"g": {"poses": {"p": {"base": "wave", "retarget": {"source": "hips", "target": "robot",
        "pairs": [{"source": "hips", "target": "robot", "moves": true}, ["arm", "robot/arm"]])" +
                        more + "}}}}}}")
                     .stage());
  };
  const Quat turn = exp_map({0, pi / 2, 0});
  Stage stage = stage_of(
      R"(, "turn": {"axis": "y", "angle": 90}, "stance": {"robot/arm": {"rotation": {"axis": "x", "angle": -90}}})");
  Stage bare = stage_of("");
  for (const double time : {0.0, 0.3, 0.8}) {
    stage.seek(time);
    bare.seek(time);
    const auto arm = [](Stage& of, std::size_t from) {
      return Vec3((of.world(from + 1).motion.pose.position - of.world(from).motion.pose.position).normalized());
    };
    CHECK(near(arm(stage, 4), Vec3(turn * arm(stage, 1)), 1e-14));
    CHECK((arm(bare, 4) - arm(bare, 1)).norm() > 0.5);
  }
}

TEST_CASE("faults of operations are told with their places") {
  const std::string bones = "\"start\": \"a\", \"middle\": \"b\", \"end\": \"c\"";
  CHECK(reach_faults("{\"two_bone\": {" + bones + ", \"target\": \"d\"}}").empty());
  CHECK(tells("{\"two_bone\": {" + bones + ", \"target\": \"e\"}}", "(at /graphs/g/poses/p/two_bone/target)"));
  CHECK(tells("{\"two_bone\": {" + bones + ", \"target\": [1, 2]}}", "/two_bone/target"));
  CHECK(tells("{\"two_bone\": {" + bones + ", \"target\": [1, 2, {\"parameter\": \"z\"}]}}",
              "there is no parameter \"z\""));
  CHECK(tells("{\"two_bone\": {" + bones + "}}", "\"target\""));
  CHECK(tells("{\"two_bone\": {\"start\": \"a\", \"middle\": \"c\", \"end\": \"b\", \"target\": \"d\"}}", "below"));
  CHECK(tells("{\"two_bone\": {" + bones + ", \"target\": \"d\", \"softness\": 0.7}}", "a softness from 0 to 0.5"));
  CHECK(tells("{\"base\": \"q\", \"look_at\": {\"joints\": [\"a\"], \"target\": \"d\"}}", "no pose or clip \"q\""));
  CHECK(tells("{\"base\": \"q\", \"rest\": true}", "\"base\""));
  CHECK(tells("{\"base\": \"q\"}", "\"two_bone\""));
  CHECK(tells("{\"look_at\": {\"joints\": [\"a\"], \"target\": \"d\", \"wieght\": 1}}", "did you mean \"weight\""));
  CHECK(tells("{\"look_at\": {\"joints\": [], \"target\": \"d\"}}", "/look_at/joints"));
  CHECK(tells("{\"look_at\": {\"joints\": [\"a\"], \"target\": \"c\"}}", "carried by the joints that turn toward it"));
  CHECK(tells("{\"reach\": {\"joints\": [\"a\"], \"target\": \"d\"}}",
              "it has 1 joint; it needs at least one that turns and the end that it carries"));
  const auto reaching = [](const std::string& limit) {
    return "{\"reach\": {\"joints\": [\"a\", {\"node\": \"b\", " + limit + "}, \"c\"], \"target\": \"d\"}}";
  };
  CHECK(reach_faults(reaching("\"hinge\": {\"limits\": [-30, 30]}")).empty());
  CHECK(tells(reaching("\"hinge\": {\"limits\": [30, -30]}"),
              "the low one first; 30 is above -30 (at /graphs/g/poses/p/reach/joints/1/hinge/limits)"));
  CHECK(tells(reaching("\"socket\": {\"twist\": [10, -10]}"),
              "the low one first; 10 is above -10 (at /graphs/g/poses/p/reach/joints/1/socket/twist)"));
  CHECK(tells(reaching("\"hinge\": {}, \"socket\": {}"), "give one of them (at /graphs/g/poses/p/reach/joints/1"));
  CHECK(tells("{\"reach\": {\"joints\": [\"a\", \"b\", \"cc\"], \"target\": \"d\"}}",
              "(at /graphs/g/poses/p/reach/joints/2)"));
  CHECK(tells("{\"feet\": {\"pelvis\": \"a\", \"legs\": [{" + bones + "}], \"ground\": \"d\"}}",
              "feet are placed on a node whose body is a \"height_field\""));
  CHECK(tells("{\"feet\": {\"pelvis\": \"a\", \"legs\": [{" + bones + "}], \"ground\": \"dd\"}}",
              "there is no node \"dd\""));
  const auto standing = [](const std::string& hill, const std::string& more) {
    return faults_of(
        R"({"tweenfall": 1, "nodes": {"p": {}, "a": {"parent": "p", "position": [0, 2, 0]}, "b": {"parent": "a", "position": [0, -1, 0.1]},
      "c": {"parent": "b", "position": [0, -1, 0]}, "hill": {"body": {)" +
            hill +
            R"("shape": {"height_field": {"spacing": 1, "heights": [[0, 0], [0, 1]]}}}}},
      "clips": {"rise": {"tracks": {"hill.position.y": [[0, 0], [1, 1]]}}}, "play": [{"clip": "rise", "at": 5}],
      "graphs": {"g": {"poses": {"p": {"feet": {"pelvis": "p", )" +
            more + R"("ground": "hill",
        "legs": [{"start": "a", "middle": "b", "end": "c"}]}}}}}})",
        "g.json", {});
  };
  CHECK(standing("", "").find("\"hill\" does, where its body is \"static\" (at /graphs/g/poses/p/feet/ground)") !=
        std::string::npos);
  const std::string told = standing("\"static\": true, ", "\"tilt\": 90, ");
  CHECK(told.find("\"hill\" is static, but a playing clip moves it") != std::string::npos);
  CHECK(told.find("tilt") == std::string::npos);
  CHECK(tells("{\"mirror\": {\"pairs\": [[\"*.L\", \"*.R\"]]}}", "/graphs/g/poses/p/mirror"));
  CHECK(tells("{\"retarget\": {\"source\": \"a\", \"target\": \"d\", \"pairs\": [[\"x\", \"d\"]]}}",
              "no joint is named \"x\""));
  const std::string map =
      "{\"retarget\": {\"source\": \"b\", \"target\": \"d\", \"pairs\": [[\"b\", \"d\"]], \"scale\": 1, ";
  CHECK(reach_faults(map + "\"stance\": {\"c\": {\"rotation\": {\"axis\": \"x\", \"angle\": 10}}}}}").empty());
  CHECK(tells(map + "\"stance\": {\"c\": {\"position\": [0, 1, 0], \"scale\": 2}}}}", "\"scale\""));
  CHECK(tells(map + "\"stance\": {\"e\": {}}}}", "there is no node \"e\""));
  CHECK(tells(map + "\"stance\": {\"a\": {}}}}", "\"a\" belongs to neither figure, \"b\" or \"d\""));
  CHECK(tells("{\"spring\": {\"node\": \"b\"}}", "neither a position nor a rotation"));
  CHECK(tells("{\"spring\": {\"node\": \"b\", \"rotation\": {\"gravity\": [0, 1, 0]}}}", "\"gravity\""));
  CHECK(tells("{\"jiggle\": {\"joints\": [\"a\"]}}", "it has 1 joint; it needs two, or one and a tip"));
  CHECK(tells("{\"jiggle\": {\"joints\": [\"a\", \"d\"]}}", "must be below the joint before it"));
  CHECK(tells("{\"root_motion\": {\"node\": \"b\", \"onto\": \"d\"}}", "does not carry"));
}
