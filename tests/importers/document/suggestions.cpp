// What errors suggest: where a field belongs, what our field is called, what to write instead.

#include "importers/document/document_files.h"

#include <tweenfall/importers/inputs.h>

#include <nlohmann/json.hpp>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The suggestion for the first problem's field, after "unknown field".
std::string hint(const std::string& text) {
  const std::string said = faults_of(text, "n.json", {});
  const std::string mark = "unknown field ";
  const std::size_t from = said.find(mark);
  REQUIRE_MESSAGE(from != std::string::npos, said);
  const std::size_t to = said.find(" (at ", from);
  return said.substr(from + mark.size(), to - from - mark.size());
}

std::string at_top(const std::string& field) {
  return hint("{\"tweenfall\": 1, \"" + field + "\": 1}");
}

std::string in_node(const std::string& members) {
  return hint("{\"tweenfall\": 1, \"nodes\": {\"a\": {" + members + "}}}");
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("each field of the world that stands at the top of a document is told to belong in the world") {
  const nlohmann::json schema = nlohmann::json::parse(document_schema());
  const auto& fields = schema.at("definitions").at("world").at("properties");
  REQUIRE(fields.size() >= 12);
  for (const auto& item : fields.items()) {
    const std::string& field = item.key();
    const bool of_systems = field == "integrator" || field == "step";
    CHECK(at_top(field) ==
          "\"" + field + "\"; it belongs in " + (of_systems ? "a system of \"systems\" or in " : "") + "\"world\"");
  }
}

TEST_CASE("each field of a document that stands in the world is told to belong at the top") {
  const nlohmann::json schema = nlohmann::json::parse(document_schema());
  for (const auto& item : schema.at("properties").items()) {
    const std::string& field = item.key();
    if (field == "name") continue;  // of an event, too
    CHECK(hint("{\"tweenfall\": 1, \"world\": {\"" + field + "\": 1}}") ==
          "\"" + field + "\"; it belongs at the top of the document");
  }
}

TEST_CASE("fields of a body in its node and of a node in its body are sent to each other") {
  CHECK(in_node("\"mass\": 2") == "\"mass\"; it belongs in \"body\"");
  CHECK(in_node("\"shape\": {\"sphere\": {\"radius\": 1}}") == "\"shape\"; it belongs in \"body\"");
  const std::string body = "\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}, ";
  CHECK(in_node(body + "\"color\": \"#fff\"}") == "\"color\"; it belongs in a node of \"nodes\"");
  // What is inside is suggested with what is outside.
  CHECK(in_node(body + "\"position\": [0, 1, 0]}") ==
        "\"position\"; it belongs in a node of \"nodes\" or in \"offset\"");
  CHECK(in_node("\"body\": {\"shape\": {\"sphere\": {\"radius\": 1, \"friction\": 1}}}") ==
        "\"friction\"; it belongs in \"body\"");
}

TEST_CASE("words of other programs for what a node does otherwise are told how") {
  for (const char* word : {"visible", "hide", "isVisible", "hide_render"})
    CHECK(in_node("\"" + std::string(word) + "\": true") ==
          "\"" + std::string(word) + "\"; nodes are always shown, and a \"color\" of \"#fff0\" hides one");
  CHECK(in_node("\"localPosition\": [0, 0, 0]") == "\"localPosition\"; did you mean \"position\"?");
  CHECK(in_node("\"rotateX\": 0") == "\"rotateX\"; did you mean \"rotation\"?");
  CHECK(in_node("\"opacity\": 0") == "\"opacity\"; did you mean \"color\"?");
  CHECK(in_node("\"transform\": {}") == "\"transform\"; a node has \"position\", \"rotation\" and \"scale\"");
  CHECK(in_node("\"children\": []") == "\"children\"; each child is a node that names its \"parent\"");
  CHECK(says(in_node("\"mesh\": \"a.glb\""), "meshes come with models"));
  CHECK(says(in_node("\"shape_keys\": [0]"), "weights of morphs are a track, \"NODE.weights\""));
}

TEST_CASE("what is at home in few things of the document is told with the whole way there") {
  const std::string of_tracks = "\"tracks\"; it belongs in a clip of \"clips\" or in a system of \"systems\"";
  CHECK(at_top("tracks") == of_tracks);
  CHECK(at_top("mass") ==
        "\"mass\"; it belongs in \"body\" of a node of \"nodes\" or in a ragdoll of \"ragdolls\" of \"world\" or in a "
        "kind of \"particles\" of \"world\"");
  CHECK(in_node("\"sphere\": {\"radius\": 1}") ==
        "\"sphere\"; it belongs in \"shape\" of \"body\" of a node of \"nodes\"");
  CHECK(hint("{\"tweenfall\": 1, \"play\": [{\"clip\": \"c\", \"tracks\": 1}]}") == of_tracks);
}

TEST_CASE("misspelled fields are still told by the nearest, in the object itself before those inside of it") {
  CHECK(at_top("wrold") == "\"wrold\"; did you mean \"world\"?");
  CHECK(at_top("rules") == "\"rules\"; did you mean \"handoff\"?");
  CHECK(at_top("joint") == "\"joint\"; did you mean \"joints\" in \"world\"?");
  CHECK(at_top("timestep") == "\"timestep\"; did you mean \"step\" in \"world\"?");
  CHECK(at_top("zzzzzz").starts_with("\"zzzzzz\"; available: "));
}

TEST_CASE("fields of a joint's kind beside it are told the kinds that have them") {
  const std::string said = hint(
      "{\"tweenfall\": 1, \"world\": {\"joints\": {\"j\": {\"ball\": {}, \"between\": [\"a\", \"b\"], \"limits\": [0, "
      "1]}}}}");
  CHECK(said.find("it belongs in \"hinge\" or in \"slider\"") != std::string::npos);
}

TEST_CASE("words of other programs for fields are answered with ours") {
  const std::string said = faults_of(
      "{\"tweenfall\": 1, \"world\": {\"dt\": 0.01}, \"nodes\": {\"a\": {\"translation\": [0, 0, 0], \"body\": "
      "{\"shape\": "
      "{\"sphere\": {\"radius\": 1}}, \"fixed\": true, \"Bounciness\": 1}}}}",
      "n.json", {});
  CHECK(says(said, "unknown field \"dt\"; did you mean \"step\"?"));
  CHECK(says(said, "unknown field \"translation\"; did you mean \"position\"?"));
  CHECK(says(said, "unknown field \"fixed\"; did you mean \"static\"?"));
  CHECK(says(said, "unknown field \"Bounciness\"; did you mean \"restitution\"?"));
}

TEST_CASE("errors say what to write where other words are used") {
  const auto said = [](const std::string& rest) { return faults_of("{\"tweenfall\": 1, " + rest + "}", "n.json", {}); };
  CHECK(says(said("\"import\": \"Fox.glb\""), "say {\"model\": \"Fox.glb\"}, and its nodes are \"model/...\""));
  CHECK(says(said("\"nodes\": {\"a\": {\"parent\": \"fox/Head\"}}"),
             "names that begin with \"fox/\" come in with \"import\": {\"fox\": \"FILE\"}"));
  CHECK(
      says(said("\"clips\": {\"c\": {}}, \"play\": [{\"clip\": \"fox/walk\"}]"), "come in with \"import\": {\"fox\""));
  CHECK(says(said("\"clips\": {\"c\": {\"tracks\": {\"hinge.rot\": {\"axis\": \"z\", \"keys\": [[0, 0], [1, 90]]}}}}"),
             "did you mean \"hinge.rotation\"?"));
  CHECK(says(said("\"clips\": {\"c\": {\"tracks\": {\"a.b\": {\"keyframes\": [[0, 0], [1, 90]]}}}}"),
             "unknown field \"keyframes\"; did you mean \"keys\"?"));
  const std::string keys = said("\"clips\": {\"c\": {\"tracks\": {\"a.b\": [{\"time\": 0, \"value\": 1}]}}}");
  CHECK(says(keys, "unknown field \"time\"; did you mean \"t\"?"));
  CHECK(says(keys, "unknown field \"value\"; did you mean \"v\"?"));
  CHECK_FALSE(says(keys, "is missing"));
  const std::string nodes =
      "\"nodes\": {\"a\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}}, \"handoff\": [{\"body\": "
      "\"a\", \"to\": \"free\", \"when\": ";
  CHECK(says(said(nodes + "\"let go\"}]"), "say {\"marker\": \"let go\"} for"));
  CHECK(says(said(nodes + "\"let go\"}]"), "or {\"event\": \"let go\"}"));
  CHECK(says(said(nodes + "\"contact\"}]"), "; say {\"contact\": {}}"));
  CHECK(says(said(nodes + "0.5}]"), "say {\"at\": 0.5}"));
  CHECK(says(said("\"nodes\": {\"a\": {"), "1:"));
}

TEST_CASE(
    "an import of this folder that is not there is missing, not outside, and nodes of imports have their whole name") {
  const auto said = [](const std::string& rest) { return faults_of("{\"tweenfall\": 1, " + rest + "}", "n.json", {}); };
  const std::string missing = said("\"import\": {\"fox\": \"Fox.glb\"}");
  CHECK(says(missing, "there is no file \"Fox.glb\""));
  CHECK_FALSE(says(missing, "outside"));
  CHECK(says(said("\"import\": {\"fox\": \"../Fox.glb\"}"), "lies outside the document's folder"));
  CHECK(says(said("\"import\": {\"fox\": {\"file\": \"Fox.glb\"}}"), "expected the path of a file"));

  const std::filesystem::path folder = data_folder() / "documents/good";
  const std::string inside = faults_of("{\"tweenfall\": 1, \"import\": {\"parts\": \"parts\"}}", "n.json", folder);
  CHECK(says(inside, "\"parts\" is not a plain file"));
  CHECK_FALSE(says(inside, "did you mean"));
  const auto beside = [&](const std::string& rest) {
    return faults_of("{\"tweenfall\": 1, \"import\": {\"start\": \"pendulum.json\"}, " + rest + "}", "n.json", folder);
  };
  const StageDescription all = Document::read(folder / "pendulum.json").stage();
  REQUIRE(!all.nodes.empty());
  const std::string& node = all.nodes.front().name;
  CHECK(says(beside("\"nodes\": {\"a\": {\"parent\": \"" + node + "\"}}"), "did you mean \"start/" + node + "\"?"));
}

TEST_CASE("eases by the names of other programs are answered with ours, and those of CSS are taken") {
  const auto ease = [](const std::string& word) {
    return faults_of(
        "{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {\"a.b\": [[0, 0, \"" + word + "\"], [1, 1]]}}}}", "n.json",
        {});
  };
  CHECK(ease("ease-in-out").empty());
  CHECK(says(ease("easeInOutQuad"), "quad-in-out"));
  CHECK(says(ease("easeOutBounce"), "bounce-out"));
  CHECK(says(ease("cubic-in-out(3)"), "\"cubic-in-out\" takes no values"));
}

TEST_CASE("two triggers beside each other, and the words and, or, are answered with all and any") {
  const auto said = [](const std::string& when) {
    return faults_of(
        "{\"tweenfall\": 1, \"nodes\": {\"a\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}}, \"handoff\": "
        "[{\"body\": \"a\", \"to\": \"free\", \"when\": " +
            when + "}]}",
        "n.json", {});
  };
  CHECK(says(said(R"({"at": 1, "asleep": 2})"),
             "\"asleep\" beside \"at\"; give one of them, or a list: {\"all\": [...]} for this and that, {\"any\": "
             "[...]} for this or that"));
  CHECK(says(said(R"({"and": [{"at": 1}, {"asleep": 2}]})"), "unknown field \"and\"; did you mean \"all\"?"));
  CHECK(says(said(R"({"or": [{"at": 1}, {"asleep": 2}]})"), "unknown field \"or\"; did you mean \"any\"?"));
  CHECK(said(R"({"any": [{"at": 1}, {"asleep": 2}]})").empty());
}

TEST_CASE("a rotation of bare numbers is answered with the spelling that so many numbers have") {
  const auto said = [](const std::string& numbers) {
    return faults_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {\"rotation\": " + numbers + "}}}", "n.json", {});
  };
  CHECK(says(said("[0, 90, 0]"), "found a list of 3; say {\"euler\": [0, 90, 0]} (at /nodes/a/rotation)"));
  CHECK(says(said("[0, 0, 1, 0]"), "found a list of 4; say {\"quat\": [0, 0, 1, 0]} (at"));
  CHECK(says(said("[0, 0]"), "found a list of 2 (at"));
}

TEST_CASE("what others call things, or write in another form, is answered by ours") {
  const std::string head = "{\"tweenfall\": 1, ", body = "\"nodes\": {\"a\": {\"body\": {\"shape\": ";
  const auto said = [&](const std::string& text) { return faults_of(head + text, "others.json", {}); };
  const auto answers = [&](const std::string& text, const std::string& words) {
    CAPTURE(text);
    const std::string faults = said(text);
    CHECK_MESSAGE(faults.find(words) != std::string::npos, faults);
  };
  answers(body + "{\"cube\": {\"size\": [1, 1, 1]}}}}}}", "did you mean \"box\"?");
  answers(body + "{\"box\": {\"half_extents\": [1, 1, 1]}}}}}}", "did you mean \"size\"?");
  answers(body + "{\"convex\": {}}}}}}", "did you mean \"hull\"?");
  answers(body + "{\"sphere\": {\"radius\": 1}}, \"spin\": [0, 0, 1]}}}}", "did you mean \"angular_velocity\"?");
  answers(body + "{\"sphere\": {\"radius\": 1}}, \"isTrigger\": true}}}}", "did you mean \"sensor\"?");
  answers("\"handoff\": [{\"node\": \"a\", \"when\": {\"collision\": {}}, \"to\": \"dynamic\"}]}",
          "did you mean \"body\"?");
  answers("\"handoff\": [{\"body\": \"a\", \"when\": {\"at\": 1}, \"to\": \"dynamic\"}]}", "did you mean \"free\"?");
  answers("\"handoff\": {\"body\": \"a\", \"when\": {\"at\": 1}, \"to\": \"free\"}}", "write it in a list, [...]");
  answers("\"play\": \"c\"}", "say {\"clip\": \"c\"}, in a list");
  answers("\"world\": {\"plane\": true}}", "available: \"none\", \"xy\", \"xz\", \"yz\"");
  answers("\"clips\": {\"c\": {\"loop\": true}}}", "found true; say \"repeat\"");
  // Names that have nothing in common are not suggested.
  const std::string keyed = said("\"clips\": {\"c\": {\"tracks\": {\"a.b\": {\"0\": 1}}}}}");
  CHECK_MESSAGE(keyed.find("did you mean") == std::string::npos, keyed);
}

TEST_CASE("a bare value in the place of an object is answered with the field that holds it") {
  const auto said = [](const std::string& text) { return faults_of("{\"tweenfall\": 1, " + text + "}", "n.json", {}); };
  const auto body = [&](const std::string& shape) {
    return said("\"nodes\": {\"a\": {\"body\": {\"shape\": " + shape + "}}}");
  };
  CHECK(says(body("{\"sphere\": 0.2}"), "found 0.2; say {\"radius\": 0.2}"));
  CHECK(says(body("{\"box\": [1, 2, 3]}"), "found a list of 3; say {\"size\": [1, 2, 3]}"));
  CHECK(says(body("{\"box\": {\"size\": 2}}"), "found 2; say [2, 2, 2]"));
  const auto rule = [&](const std::string& members) {
    return said(
        "\"nodes\": {\"a\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}}, \"clips\": {\"c\": {\"tracks\": "
        "{\"a.position\": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}}}, \"handoff\": [{\"body\": \"a\", " +
        members + "}]");
  };
  CHECK(says(rule("\"when\": {\"contact\": 3}, \"to\": \"free\""), "found 3; say {\"impulse\": 3}"));
  CHECK(
      says(rule("\"when\": {\"contact\": \"floor\"}, \"to\": \"free\""), "found \"floor\"; say {\"with\": \"floor\"}"));
  CHECK(says(rule("\"when\": {\"at\": 1}, \"to\": \"free\", \"settle\": 0.4"), "found 0.4; say {\"quintic\": 0.4}"));
  CHECK(says(rule("\"when\": {\"at\": 1}, \"to\": 5"), "found 5; say {\"hz\": 5}"));
  CHECK(says(rule("\"when\": [{\"at\": 1}, {\"clip_end\": true}], \"to\": \"free\""),
             "say {\"all\": [...]} for this and that, {\"any\": [...]} for this or that"));
  CHECK(says(said("\"world\": {\"gravity\": -9.81}"), "found -9.81; say [0, -9.81, 0]"));
  CHECK(says(said("\"world\": {\"gravity\": 9.81}"), "found 9.81; say [0, -9.81, 0]"));
  CHECK(says(said("\"world\": {\"forces\": [{\"wind\": [1, 0, 0]}]}"),
             "found a list of 3; say {\"velocity\": [1, 0, 0]}"));
  // If none fits, nothing is suggested; if many do, none is meant.
  CHECK(!says(body("{\"sphere\": -1}"), "say"));
  CHECK(!says(said("\"world\": 9.81"), "say"));
  CHECK(!says(said("\"nodes\": {\"a\": {\"body\": 3}}"), "say"));
}

TEST_CASE("a condition in the words of a program is answered with its parameter and number") {
  const auto when = [](const std::string& condition) {
    return faults_of(
        "{\"tweenfall\": 1, \"graphs\": {\"g\": {\"poses\": {\"i\": {\"rest\": true}, \"m\": {\"machine\": {\"start\": "
        "\"a\", "
        "\"states\": {\"a\": \"i\", \"b\": \"i\"}, \"transitions\": [{\"from\": \"a\", \"to\": \"b\", \"when\": " +
            condition + "}]}}}}}}",
        "n.json", {});
  };
  CHECK(says(when("\"speed > 0.1\""), "say {\"parameter\": \"speed\", \"above\": 0.1}"));
  CHECK(says(when("\"speed<=2\""), "say {\"parameter\": \"speed\", \"below\": 2}"));
  CHECK(says(when("\"the gear == 3\""), "say {\"parameter\": \"the gear\", \"equals\": 3}"));
  CHECK(says(when("\"halt\""), "say {\"event\": \"halt\"}"));
  CHECK(says(when("0.5"), "say {\"time_in_state\": 0.5}"));
  for (const char* odd : {"\">\"", "\"> 1\"", "\"a >\"", "\"a > b\"", "\"=\"", "\"\""})
    CHECK(!says(when(odd), "parameter\": \"\""));
}

TEST_CASE("ways to loop are told for true, numbers and words of other programs") {
  const auto loop = [](const std::string& value) {
    return faults_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"duration\": 1, \"loop\": " + value + "}}}", "n.json",
                     {});
  };
  CHECK(says(loop("true"), "found true; say \"repeat\""));
  CHECK(says(loop("-1"), "found -1; say \"repeat\""));
  CHECK(says(loop("3"), "found 3; say {\"mode\": \"repeat\", \"count\": 3}"));
  CHECK(says(loop("\"infinite\""), "did you mean \"repeat\"?"));
  CHECK(says(loop("\"yoyo\""), "did you mean \"pingpong\"?"));
}

TEST_CASE("rotations, tracks and events in the shape of other programs are told in ours") {
  const auto node = [](const std::string& rotation) {
    return faults_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {\"rotation\": " + rotation + "}}}", "n.json", {});
  };
  CHECK(says(node("{\"x\": 0, \"y\": 45, \"z\": 0}"), "say {\"euler\": [0, 45, 0]}"));
  CHECK(says(node("{\"y\": 30}"), "say {\"euler\": [0, 30, 0]}"));
  CHECK(says(node("{\"x\": 0, \"y\": 0, \"z\": 0, \"w\": 1}"), "say {\"quat\": [0, 0, 0, 1]}"));
  CHECK(says(node("\"90deg\""), "say {\"axis\": \"z\", \"angle\": 90}"));
  CHECK(says(node("{\"quaternion\": [0, 0, 0, 1]}"), "did you mean \"quat\"?"));
  CHECK(says(node("{\"axis\": \"y\", \"degrees\": 20}"), "did you mean \"angle\"?"));
  const auto track = [](const std::string& value) {
    return faults_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {\"a.position\": " + value + "}}}}", "n.json",
                     {});
  };
  CHECK(says(track("{\"x\": [[0, 0], [1, 1]]}"),
             "unknown field \"x\"; one number alone is a track by its name, as \"NODE.position.x\""));
  CHECK(says(track("{\"times\": [0, 1], \"values\": [[0, 0, 0], [1, 1, 1]]}"),
             "unknown field \"times\"; each key has its time and its value, [[time, value], ...]"));
  CHECK(says(track("{\"keys\": [[0, [0, 0, 0]]], \"interpolation\": \"LINEAR\"}"),
             "each key says its own ease, [time, value, ease]"));
  const auto clip = [](const std::string& members) {
    return faults_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"duration\": 2, " + members + "}}}", "n.json", {});
  };
  CHECK(
      says(clip("\"events\": [{\"t\": 1, \"event\": \"bang\"}]"), "an event at one time is a list; say [1, \"bang\"]"));
  CHECK(says(clip("\"markers\": [[1, \"bang\"]]"), "unknown field \"markers\"; did you mean \"events\"?"));
}

TEST_CASE("fields of bodies in other programs are told what does the same, and none that is deep in something else") {
  const auto of = [](const std::string& member) {
    return in_node("\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}, " + member + "}");
  };
  CHECK(says(of("\"useGravity\": false"), "\"gravity\" in \"world\" is that of all bodies"));
  CHECK(says(of("\"ccd\": true"), "all that is fast is caught on its way"));
  CHECK(says(of("\"freezeRotation\": true"), "\"joints\" in \"world\""));
  CHECK(says(of("\"material\": {\"friction\": 1}"), "fields of the body itself"));
  CHECK(says(of("\"layer\": \"walls\""), "did you mean \"groups\"?"));
  CHECK(!says(of("\"radius\": 1"), "soft"));
}

TEST_CASE("what hangs on a faulty duration is not told to be at fault") {
  const std::string said = faults_of(
      "{\"tweenfall\": 1, \"clips\": {\"c\": {\"duration\": \"500ms\", \"loop\": \"repeat\", \"tracks\": "
      "{\"a.position\": [[\"0%\", "
      "[0, 0, 0]], [\"100%\", [1, 0, 0]]]}}}}",
      "n.json", {});
  CHECK(says(said, "found \"500ms\"; say 0.5"));
  CHECK(!says(said, "share of the duration"));
  CHECK(!says(said, "cannot loop"));
}

TEST_CASE("numbers with units are suggested in the unit of their field, and not at all where that is not sure") {
  const auto body = [](const std::string& members) {
    return faults_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {\"body\": {" + members + "}}}}", "n.json", {});
  };
  const auto world = [](const std::string& members) {
    return faults_of("{\"tweenfall\": 1, \"world\": {" + members + "}}", "n.json", {});
  };
  const auto joint = [&](const std::string& members) {
    return world(
        "\"joints\": {\"j\": {\"hinge\": {\"axis\": \"z\", \"motor\": {\"speed\": \"180deg/s\"}}, \"between\": "
        "\"a\", " +
        members + "}}");
  };
  CHECK(says(body("\"shape\": {\"sphere\": {\"radius\": \"1ft\"}}"), "found \"1ft\"; say 0.3048"));
  CHECK(says(body("\"shape\": {\"sphere\": {\"radius\": \"5px\"}}"), "found \"5px\"; it is a number, in m"));
  CHECK(says(body("\"mass\": \"2lb\""), "found \"2lb\"; say 0.90718474"));
  CHECK(says(body("\"mass\": \"1g\""), "found \"1g\"; say 0.001"));
  CHECK(says(body("\"velocity\": [\"36km/h\", 0, 0]"), "found \"36km/h\"; say 10"));
  CHECK(!says(body("\"friction\": \"1ft\""), "; say"));
  CHECK(says(joint("\"break_force\": \"1kN\""), "found \"1kN\"; say 1000"));
  CHECK(says(joint("\"break_torque\": \"3 kg\""), "found \"3 kg\"; it is a number, in N m"));
  CHECK(says(joint("\"break_force\": 1"), "found \"180deg/s\"; say 180"));
  CHECK(says(world("\"gravity\": \"-1g\""), "found \"-1g\"; say [0, -9.80665, 0]"));
  CHECK(says(world("\"gravity\": [0, \"-1g\", 0]"), "found \"-1g\"; say -9.80665"));
  CHECK(says(world("\"gravity\": \"-9.81 m/s^2\""), "; say [0, -9.81, 0]"));
  CHECK(says(world("\"step\": \"4ms\""), "found \"4ms\"; say 0.004"));
  CHECK(says(world("\"step\": \"240hz\""), "found \"240hz\"; say \"1/240\""));
  CHECK(says(world("\"step\": \"1/240s\""), "found \"1/240s\"; say \"1/240\""));
}

TEST_CASE(
    "names of what is there but does not fit are told what to add, and patterns the nearest that names something") {
  const auto said = [](const std::string& when) {
    const std::string body = "{\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}";
    return faults_of("{\"tweenfall\": 1, \"nodes\": {\"box/1\": " + body + ", \"box/2\": " + body +
                         ", \"bare\": {}}, \"handoff\": [{\"body\": \"box/2\", \"to\": \"free\", \"when\": " + when +
                         "}]}",
                     "n.json", {});
  };
  CHECK(says(said("{\"enter\": {\"region\": \"box/1\"}}"),
             "the body of the node \"box/1\" is no sensor; add \"sensor\": true to its \"body\""));
  CHECK(says(said("{\"leave\": {\"region\": \"bare\"}}"),
             "\"bare\" has no body; give it a \"body\" with \"sensor\": true"));
  CHECK(says(said("{\"enter\": {\"region\": \"box/*\"}}"), "none of the nodes called \"box/*\" is a sensor"));
  CHECK(says(said("{\"enter\": {\"region\": \"bax/1\"}}"), "no node whose body is a \"sensor\" is called \"bax/1\""));
  CHECK(says(said("{\"contact\": {\"with\": \"boxes/*\"}}"), "is called \"boxes/*\"; did you mean \"box/*\"?"));
  CHECK(says(said("{\"contact\": {\"with\": \"tree/*\"}}"), "come in with \"import\": {\"tree\": \"FILE\"}"));
}

TEST_CASE("a joint is told how its kind is written, and what a ball lacks which kind has") {
  const auto said = [](const std::string& joint) {
    return faults_of("{\"tweenfall\": 1, \"world\": {\"joints\": {\"j\": {" + joint + "}}}}", "n.json", {});
  };
  CHECK(says(said("\"type\": \"hinge\", \"axis\": \"z\", \"between\": \"a\""),
             "say {\"hinge\": {\"axis\": \"z\"}, \"between\": \"a\"}"));
  CHECK(says(said("\"ball\": {\"limits\": [0, 1]}, \"between\": \"a\""),
             "unknown field \"limits\"; a ball turns freely, and a \"swing_twist\" has"));
}

TEST_CASE("owners, colors and inputs of graphs are told what they are") {
  const std::string owner = faults_of(
      "{\"tweenfall\": 1, \"nodes\": {\"a\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}}, \"handoff\": "
      "[{\"body\": \"a\", \"to\": \"dynamic\", \"when\": {\"at\": 1}}]}",
      "n.json", {});
  CHECK(says(owner, "expected an owner: \"free\", \"keyed\" or a drive, such as {\"hz\": 5}, found \"dynamic\""));
  const std::string color =
      faults_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {\"color\": \"oklch(0.7 0.2 140)\"}}}", "n.json", {});
  CHECK(says(color, "\"#rrggbb\" or \"#rrggbbaa\", found"));
  CHECK(says(color, "\"oklch\" is a \"space\" of a track, in which its colors are mixed"));
  const std::string input = faults_of(
      "{\"tweenfall\": 1, \"graphs\": {\"g\": {\"parameters\": {\"energy\": {\"start\": 0}}, \"inputs\": [[\"energy\", "
      "1]]}}}",
      "n.json", {});
  CHECK(says(input,
             "the time of an input comes first: [time, parameter, value] or [time, event]; found [\"energy\", 1]"));
  CHECK(!says(input, "no machine waits"));
}

TEST_CASE("what no input can move is told at its place in the inputs") {
  const StageDescription stage = Document::parse(
                                     "{\"tweenfall\": 1, \"nodes\": {\"floor\": {\"body\": {\"shape\": {\"plane\": "
                                     "{}}, \"drive\": \"keyed\"}}, \"wall\": {\"body\": {\"shape\": "
                                     "{\"sphere\": {\"radius\": 1}}, \"static\": true}}}}",
                                     "n.json", {})
                                     .stage();
  const auto said = [&](const std::string& input) -> std::string {
    try {
      (void)parse_inputs("{\"tweenfall\": 1, \"inputs\": [\n{\"at\": 0, " + input + "}]}", "i.json", stage);
      return {};
    } catch (const DocumentError& error) {
      return error.what();
    }
  };
  CHECK(
      says(said("\"release\": {\"body\": \"floor\"}"), "i.json:2:31: error: \"floor\" is a plane, which has no mass"));
  CHECK(says(said("\"hand_over\": {\"body\": \"floor\", \"to\": \"free\"}"), "which has no mass"));
  CHECK(says(said("\"release\": {\"body\": \"wall\"}"), "i.json:2:31: error: \"wall\" is static"));
  CHECK(said("\"hand_over\": {\"body\": \"floor\", \"to\": \"keyed\"}").empty());
}
