#include "command.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/recording.h>

using namespace tweenfall;
using namespace tweenfall::test;
using nlohmann::json;

TEST_CASE("a thrown ball is keyed, then free with the clip's own velocity, and falls as a projectile") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("run thrown.json --until 0.9 --fps 10 --json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  const json found = json::parse(ran.out);
  REQUIRE(found["times"].size() == 10);
  const json& ball = found["nodes"]["ball"];
  CHECK(ball["owner"][0] == "keyed");
  CHECK(ball["owner"][9] == "free");
  const double fallen = found["times"][9].get<double>() - 0.5;
  CHECK(near(vec(ball["position"][9]), Vec3(1.5 + 3 * fallen, 2 - 9.81 / 2 * fallen * fallen, 0), 1e-9));
  CHECK(near(vec(ball["velocity"][9]), Vec3(3, -9.81 * fallen, 0), 1e-9));
  REQUIRE(found["handoffs"].size() == 1);
  const json& handoff = found["handoffs"][0];
  CHECK(handoff["time"] == 0.5);
  CHECK(handoff["body"] == "ball");
  CHECK(handoff["from"] == "keyed");
  CHECK(handoff["to"] == "free");
  CHECK(handoff["cause"] == "at");
  CHECK(near(vec(handoff["after"]["linear"]), Vec3(3, 0, 0), 1e-9));
  CHECK(found["events"].is_array());
}

TEST_CASE("what run prints is the library's recording, bit for bit, also through a pipe") {
  const Folder folder;
  const Ran ran = folder.run("run - --until 2 --fps 30 --json", thrown_document);
  REQUIRE(ran.code == 0);
  const json found = json::parse(ran.out);
  Stage stage(Document::parse(thrown_document, "thrown.json", folder.path()).stage());
  const Recording expected = record(stage, 2, 30);
  CHECK(found["times"] == json(expected.times));
  for (const NodeRecord& node : expected.nodes)
    for (std::size_t i = 0; i < expected.times.size(); ++i) {
      CHECK(vec(found["nodes"][node.name]["position"][i]) == node.world[i].motion.pose.position);
      CHECK(vec(found["nodes"][node.name]["velocity"][i]) == node.twist[i].linear);
    }
}

TEST_CASE("each ending gives a file of its kind and one line that says what it shows") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  struct Kind {
    std::string name, begins;
  };
  for (const Kind& kind : std::initializer_list<Kind>{
           {"out.json", "{"}, {"out.svg", "<"}, {"out.html", "<!"}, {"out.glb", "glTF"}, {"out.csv", ""}}) {
    CAPTURE(kind.name);
    const Ran ran = folder.run("run thrown.json --until 1 --fps 20 -o " + kind.name);
    CHECK_MESSAGE(ran.code == 0, ran.err);
    CHECK(ran.out.starts_with("wrote " + kind.name + ": 2 nodes over 1 s"));
    CHECK(std::count(ran.out.begin(), ran.out.end(), '\n') == 1);
    CHECK(folder.read(kind.name).size() > 100);
    CHECK(folder.read(kind.name).starts_with(kind.begins));
  }
  CHECK(folder.names().size() == 6);
}

TEST_CASE("without a file to write, run tells of the hand-off and of the contact with the floor") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("run thrown.json --until 2");
  CHECK(ran.code == 0);
  CHECK(ran.err.empty());
  for (const std::string part : {"thrown:", "hand-offs", "keyed", "free", "contact", "floor, ball"})
    CHECK_MESSAGE(ran.out.find(part) != std::string::npos, part << " in " << ran.out);
}

TEST_CASE("run tells the residual of complementarity where the solver is lcp, in its summary and in JSON") {
  const Folder folder;
  const std::string stacking = TWEENFALL_SOURCE_DIR "/samples/documents/lectures/stacking/";
  const std::string stack = stacking + "lcp.json", other = stacking + "shock.json";
  const Ran summary = folder.run("run " + stack + " --until 1");
  CHECK(summary.code == 0);
  const std::string words = "complementarity of contacts: residual of at most ";
  const std::size_t told = summary.out.find(words);
  REQUIRE(told != std::string::npos);
  const double residual = std::stod(summary.out.substr(told + words.size()));
  CHECK(residual > 0);
  CHECK(residual < 1e-9);
  const json found = json::parse(folder.run("run " + stack + " --until 1 --fps 10 --json").out);
  REQUIRE(found["complementarity"].size() == 11);
  CHECK(found["complementarity"][10] == residual);
  CHECK(folder.run("run " + other + " --until 0.1").out.find("complementarity") == std::string::npos);
}

TEST_CASE("a failing run leaves what was there as it was, and writes nothing beside it") {
  const Folder folder;
  folder.write("bad.json", faulty_document);
  for (const std::string arguments :
       {"run bad.json -o out.html", "view bad.json -o out.html", "plot bad.json -o out.svg",
        "run missing.json -o out.json", "import missing.glb -o out.json"}) {
    CAPTURE(arguments);
    for (const char* name : {"out.html", "out.svg", "out.json"}) folder.write(name, "precious");
    CHECK(folder.run(arguments).code == 1);
    CHECK(folder.names() == std::vector<std::string>{"bad.json", "out.html", "out.json", "out.svg"});
    for (const char* name : {"out.html", "out.svg", "out.json"}) CHECK(folder.read(name) == "precious");
  }
}

TEST_CASE("a file that cannot be written is named, with exit code 1") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  for (const std::string arguments :
       {"run thrown.json --until 0.1 -o none/out.json", "plot thrown.json -o none/out.svg",
        "view thrown.json --until 0.1 -o none/out.html", "new none/out.json"}) {
    CAPTURE(arguments);
    const Ran ran = folder.run(arguments);
    CHECK(ran.code == 1);
    CHECK(ran.err.find("none/out.") != std::string::npos);
  }
  CHECK(folder.names() == std::vector<std::string>{"thrown.json"});
}

TEST_CASE("--limit counts the texts of user tracks") {
  const Folder folder;
  folder.write("words.json",
               "{\"tweenfall\": 1, \"nodes\": {\"b\": {}}, \"play\": [{\"clip\": \"c\"}],\n"
               " \"clips\": {\"c\": {\"duration\": 2, \"tracks\": {\"b.word\": [[0, \"" +
                   std::string(100'000, 'x') + "\"]]}}}}");
  // 61 frames: 6.1 MB of text.
  CHECK(folder.run("run words.json --until 1 --fps 60 --limit 7 --json").code == 0);
  const Ran ran = folder.run("run words.json --until 1 --fps 60 --limit 6 --json");
  CHECK(ran.code == 1);
  CHECK(ran.err.find("s a recording of the user tracks takes more memory than is allowed") != std::string::npos);
}

TEST_CASE("frames that nobody counted are fewer where the usual ones would not fit, and that is said") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("run thrown.json --until 100 --limit 0.1 --json");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.err.find("MB of recording, above 0.1; it is taken at") != std::string::npos);
  CHECK(ran.out.size() < 200'000);
  CHECK(json::parse(ran.out)["times"].back() == 100);
}

TEST_CASE("standard input without end is read no further than a document may be long") {
  const Folder folder;
  const Ran ran = folder.shell(command_word() + " check - < /dev/zero");
  CHECK(ran.code == 1);
  CHECK(ran.err.find("larger than 256 MiB") != std::string::npos);
  const Ran device = folder.run("check /dev/zero");
  CHECK(device.code == 1);
  CHECK(device.err.find("larger than 256 MiB") != std::string::npos);
}

TEST_CASE("a clip that is named plays alone") {
  const Folder folder;
  const std::string two = R"({"tweenfall": 1, "clips": {
    "up": {"tracks": {"a.position": [[0, [0, 0, 0], "linear"], [1, [0, 1, 0]]]}},
    "down": {"tracks": {"a.position": [[0, [0, 0, 0], "linear"], [1, [0, -1, 0]]]}}}})";
  const Ran ran = folder.run("run - --clip down --until 1 --fps 2 --json", two);
  REQUIRE(ran.code == 0);
  CHECK(near(vec(json::parse(ran.out)["nodes"]["a"]["position"][1]), Vec3(0, -0.5, 0), 1e-12));
}

TEST_CASE("a recording is the same to the byte with any number of threads, asked for by an option or by the document") {
  json pile = {{"tweenfall", 1},
               {"nodes", {{"floor", {{"body", {{"shape", {{"plane", json::object()}}}, {"static", true}}}}}}}};
  const json ball = {{"sphere", {{"radius", 0.2}}}}, box = {{"box", {{"size", {0.4, 0.4, 0.4}}}}};
  for (int i = 0; i < 200; ++i)
    pile["nodes"]["body " + std::to_string(i)] = {
        {"position", {0.39 * (i % 5) + 0.003 * (i % 7), 0.3 + 0.4 * (i / 25), 0.39 * (i / 5 % 5)}},
        {"body", {{"shape", i % 3 == 0 ? ball : box}, {"restitution", 0.1 * (i % 3)}}}};
  const Folder folder;
  folder.write("pile.json", pile.dump());
  const std::string one = folder.run("run pile.json --until 1 --json").out;
  CHECK(one.size() > 10000);
  for (const std::string threads : {"1", "2", "3", "8"}) {
    CAPTURE(threads);
    const Ran ran = folder.run("run pile.json --until 1 --json --threads " + threads);
    CHECK_MESSAGE(ran.code == 0, ran.err);
    CHECK(ran.out == one);
  }
  pile["world"]["threads"] = 3;
  folder.write("pile.json", pile.dump());
  CHECK(folder.run("run pile.json --until 1 --json").out == one);
}

TEST_CASE("inputs are given at their times, and their faults are told with their places") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  folder.write("inputs.json", R"({"tweenfall": 1, "inputs": [
  {"at": 0.25, "speed": {"play": "throw", "speed": 2}}]})");
  const Ran ran = folder.run("run thrown.json --inputs inputs.json --until 0.4 --fps 10 --json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  const json found = json::parse(ran.out);
  CHECK(near(vec(found["nodes"]["ball"]["position"][4]), Vec3(3 * (0.25 + 2 * 0.15), 2, 0), 1e-12));
  folder.write("wrong.json", R"({"tweenfall": 1, "inputs": [
  {"at": 0.25, "speed": {"play": "thorw", "speed": 2}}]})");
  const Ran wrong = folder.run("run thrown.json --inputs wrong.json");
  CHECK(wrong.code == 1);
  CHECK(wrong.err.find("wrong.json:2:34: error: there is no play \"thorw\"; did you mean \"throw\"?") !=
        std::string::npos);
  CHECK(folder.run("run thrown.json --inputs none.json").code == 1);
}

TEST_CASE(
    "the table of hand-offs names what made a body change hands, whatever it was, in the words of the recording") {
  const Folder folder;
  const auto cause = [&](const std::string& when, const std::string& inputs) {
    folder.write("swing.json", R"({"tweenfall": 1,
      "nodes": {"ball": {"body": {"shape": {"sphere": {"radius": 0.1}}}}},
      "clips": {"c": {"tracks": {"ball.position": {"oscillator": {"amplitude": [1, 0, 0], "hz": 1}}}}},
      "handoff": [{"body": "ball", "when": )" +
                                   when + R"(, "to": "free"}]})");
    folder.write("inputs.json", R"({"tweenfall": 1, "inputs": [)" + inputs + "]}");
    const std::string command = "run swing.json --inputs inputs.json --until 0.5";
    const Ran table = folder.run(command), recording = folder.run(command + " --json");
    REQUIRE_MESSAGE(recording.code == 0, recording.err);
    const std::string word = json::parse(recording.out)["handoffs"][0]["cause"];
    CAPTURE(table.out);
    CHECK(table.out.find("free  " + word) != std::string::npos);
    return word;
  };
  CHECK(cause(R"({"at": 0.3})", "") == "at");
  CHECK(cause(R"({"speed_peak": true})", "") == "speed-peak");
  CHECK(cause(R"({"at": 0.4})", R"({"at": 0.2, "release": {"body": "ball"}})") == "caller");
}
