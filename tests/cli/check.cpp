#include "command.h"

using namespace tweenfall::test;
using nlohmann::json;

namespace {

/// Lines of a text.
std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) found.push_back(line);
  return found;
}

}  // namespace

TEST_CASE("a key out of order is told with its place, its line and a caret below the number") {
  const Folder folder;
  folder.write("drop.json", faulty_document);
  const Ran ran = folder.run("check drop.json");
  CHECK(ran.code == 1);
  CHECK(ran.out.empty());
  const std::vector<std::string> said = lines(ran.err);
  REQUIRE(said.size() == 4);
  CHECK(said[0] ==
        "drop.json:6:11: error: key times must increase; 0.5 s is not after the key before it, 0.8 s "
        "(at /clips/drop/tracks/ball.position/2/t)");
  CHECK(said[1] == " 6 |     {\"t\": 0.5, \"v\": [0, 3, 0]}");
  CHECK(said[2] == "   |           ^");
  CHECK(said[3] == "1 problem");
}

TEST_CASE("two files are checked at once, the good one is said to be valid, and the problems of both are counted") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  folder.write("drop.json", faulty_document);
  folder.write("other.json", R"({"tweenfall": 1, "clps": {}})");
  const Ran ran = folder.run("check drop.json ball.json other.json");
  CHECK(ran.code == 1);
  CHECK(ran.out.starts_with("ball.json: valid; 2 nodes, 1 clip, 4 tracks"));
  CHECK(ran.err.find("drop.json:6:11: error:") != std::string::npos);
  CHECK(ran.err.find("other.json:1:") != std::string::npos);
  CHECK(ran.err.find("clips") != std::string::npos);
  CHECK(ran.err.ends_with("\n2 problems\n"));
}

TEST_CASE("a valid document ends with 0 and nothing on stderr, from a file and through a pipe") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const Ran file = folder.run("check ball.json");
  CHECK(file.code == 0);
  CHECK(file.err.empty());
  const Ran piped = folder.run("check -", ball_document);
  CHECK(piped.code == 0);
  CHECK(piped.err.empty());
  CHECK(folder.run("check -", faulty_document).code == 1);
}

TEST_CASE("check --json lists every problem of every file with line, column and pointer") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  folder.write("drop.json", faulty_document);
  const Ran ran = folder.run("check --json ball.json drop.json none.json");
  CHECK(ran.code == 1);
  CHECK(ran.err.empty());
  const json found = json::parse(ran.out);
  REQUIRE(found["files"].size() == 3);
  CHECK(found["problems"] == 2);
  CHECK(found["files"][0] == json{{"file", "ball.json"}, {"valid", true}, {"problems", json::array()}});
  const json problem = found["files"][1]["problems"][0];
  CHECK(problem["severity"] == "error");
  CHECK(problem["file"] == "drop.json");
  CHECK(problem["line"] == 6);
  CHECK(problem["column"] == 11);
  CHECK(problem["pointer"] == "/clips/drop/tracks/ball.position/2/t");
  CHECK(found["files"][2]["valid"] == false);
}

TEST_CASE("notes have places, are printed by every verb, and leave a document valid") {
  const Folder folder;
  folder.write("near.json",
               "{\"tweenfall\": 1, \"nodes\": {\"ball\": {}}, \"clips\": {\"c\": {\"tracks\": {\n"
               "  \"ball.translation\": [[0, 1], [1, 2]]}}}}\n");
  const Ran ran = folder.run("check near.json");
  CHECK(ran.code == 0);
  CHECK(
      ran.err.starts_with("near.json:2:3: note: \"ball.translation\" is a property of your own, which moves nothing; "
                          "did you mean \"ball.position\"?"));
  CHECK(folder.run("run near.json --until 0.1").err.find("near.json:2:3: note: ") != std::string::npos);
  const Ran tool = folder.run("check --json near.json");
  CHECK(tool.code == 0);
  CHECK(tool.err.empty());
  const json found = json::parse(tool.out);
  CHECK(found["problems"] == 0);
  CHECK(found["files"][0]["valid"] == true);
  REQUIRE(found["files"][0]["problems"].size() == 1);
  CHECK(found["files"][0]["problems"][0]["severity"] == "note");
  CHECK(found["files"][0]["problems"][0]["line"] == 2);
}

TEST_CASE("a track of one's own that is of another kind in another clip is told where it stands") {
  const Folder folder;
  folder.write("kinds.json",
               "{\"tweenfall\": 1, \"nodes\": {\"hips\": {}}, \"clips\": {\n"
               "  \"walk\": {\"tracks\": {\"hips.effort\": [[0, 1], [1, 2]], \"hips.glow\": [[0, \"#fff\"]]}},\n"
               "  \"run\": {\"tracks\": {\"hips.glow\": [[0, \"#000\"]],\n"
               "    \"hips.effort\": [[0, [1, 2, 3]]]}}}}\n");
  const Ran ran = folder.run("check kinds.json");
  CHECK(ran.code == 0);
  CHECK(ran.err.starts_with(
      "kinds.json:4:5: note: \"hips.effort\" is a vector of 3 here and a number in the clip \"walk\": "
      "where clips are mixed, this one counts as without it"));
  CHECK(ran.err.find("note", 20) == std::string::npos);
}

TEST_CASE("vectors of other sizes are other kinds") {
  const Folder folder;
  folder.write("sizes.json",
               "{\"tweenfall\": 1, \"nodes\": {\"hips\": {}}, \"clips\": {\n"
               "  \"walk\": {\"tracks\": {\"hips.wind\": [[0, [1, 2]]], \"hips.lean\": [[0, [1, 2, 3, 4]]]}},\n"
               "  \"run\": {\"tracks\": {\"hips.lean\": [[0, [1, 2, 3, 4]]],\n"
               "    \"hips.wind\": [[0, [1, 2, 3]]]}}}}\n");
  const Ran ran = folder.run("check sizes.json");
  CHECK(ran.code == 0);
  CHECK(
      ran.err.starts_with("sizes.json:4:5: note: \"hips.wind\" is a vector of 3 here and a vector of 2 in the clip "
                          "\"walk\": "));
  CHECK(ran.err.find("note", 20) == std::string::npos);
}

TEST_CASE("notes are told beside errors too, after them, and are not counted with them") {
  const Folder folder;
  folder.write("both.json",
               "{\"tweenfall\": 1, \"nodes\": {\"ball\": {}}, \"clips\": {\"c\": {\"tracks\": {\n"
               "  \"ball.translation\": [[0, 1], [1, 2]], \"ball.position\": [[1, [0, 0, 0]], [0, [0, 1, 0]]]}}}}\n");
  const Ran ran = folder.run("check both.json");
  CHECK(ran.code == 1);
  const std::size_t error = ran.err.find("both.json:2:76: error: "), note = ran.err.find("both.json:2:3: note: ");
  CHECK(error != std::string::npos);
  CHECK(note != std::string::npos);
  CHECK(error < note);
  CHECK(ran.err.ends_with("\n1 problem\n"));
  CHECK(folder.run("run both.json").err == ran.err);
  const json found = json::parse(folder.run("check --json both.json").out);
  CHECK(found["problems"] == 1);
  REQUIRE(found["files"][0]["problems"].size() == 2);
  CHECK(found["files"][0]["problems"][0]["severity"] == "error");
  CHECK(found["files"][0]["problems"][1]["severity"] == "note");
}

TEST_CASE("check --json gives the line and column of a fault in a model that is text") {
  const Folder folder;
  folder.write("bad.gltf", "{\"asset\": {\"version\": \"2.0\"},\n  \"nodes\": [{\"mesh\": 4}]}");
  const Ran ran = folder.run("check --json bad.gltf");
  CHECK(ran.code == 1);
  const json problem = json::parse(ran.out)["files"][0]["problems"][0];
  CHECK(problem["file"] == "bad.gltf");
  CHECK(problem["line"] == 2);
  CHECK(problem["column"] == 22);
  CHECK(problem["message"] == "/nodes/0/mesh: index 4 points past the end; there are 0");
}

TEST_CASE("files that are missing, empty, folders or not JSON end with 1 and a message that names them") {
  const Folder folder;
  folder.write("empty.json", "");
  folder.write("noise.json", std::string("\0\xff{[\n", 5));
  folder.write("noise.glb", "glTF, not really");
  std::filesystem::create_directory(folder.path() / "folder.json");
  for (const std::string name :
       {"missing.json", "empty.json", "noise.json", "noise.glb", "missing.glb", "folder.json"}) {
    for (const std::string verb : {"check ", "inspect ", "run ", "sample --at 0 "}) {
      CAPTURE(verb);
      CAPTURE(name);
      const Ran ran = folder.run(verb + name);
      CHECK(ran.code == 1);
      CHECK(ran.out.empty());
      CHECK(ran.err.find(name) != std::string::npos);
    }
  }
}

TEST_CASE("hostile models end with 1 and a message, repaired ones with 0, and those called valid load") {
  const std::filesystem::path models = models_folder() / "malformed";
  if (!std::filesystem::is_directory(models)) {
    MESSAGE("SKIPPED: malformed models, no folder " << models.string());
    return;
  }
  const Folder folder;
  std::size_t tried = 0;
  for (const auto& entry : std::filesystem::directory_iterator(models)) {
    ++tried;
    const std::string name = entry.path().string();
    CAPTURE(name);
    const Ran ran = folder.run("check '" + name + "'");
    CHECK((ran.code == 0 || ran.code == 1));
    if (name.find("_VALID") != std::string::npos) CHECK(ran.code == 0);
    if (ran.code == 1) CHECK(ran.err.find(name) != std::string::npos);
  }
  CHECK(tried > 0);
}

TEST_CASE("of very many problems the first are listed and all are counted") {
  const Folder folder;
  std::string nodes;
  for (int i = 0; i < 9000; ++i) nodes += (i > 0 ? ", \"n" : "\"n") + std::to_string(i) + "\": {\"colr\": 1}";
  folder.write("many.json", "{\"tweenfall\": 1, \"nodes\": {" + nodes + "}}");
  for (const char* verb : {"check many.json", "run many.json --until 1"}) {
    const Ran ran = folder.run(verb);
    CHECK(ran.code == 1);
    CHECK(ran.err.find("many.json: error: 8600 more problems are not listed\n9000 problems\n") != std::string::npos);
  }
  const json told = json::parse(folder.run("check --json many.json").out);
  CHECK(told["problems"] == 9000);
  CHECK(told["files"][0]["problems"].size() == 401);
}

TEST_CASE("a node where no picture can show it is told at its place, with a body and without, by rest and by track") {
  const Folder folder;
  folder.write("far.json",
               "{\"tweenfall\": 1,\n \"nodes\": {\n  \"near\": {},\n  \"far\": {\"position\": [0, -1e39, 0]}}}");
  folder.write("moved.json",
               "{\"tweenfall\": 1,\n \"nodes\": {\"near\": {},\n  \"far\": {}},\n \"clips\": {\"c\": {\"tracks\": "
               "{\"far.position\": [[0, [1e39, 0, 0]]]}}}}");
  folder.write("free.json",
               "{\"tweenfall\": 1,\n \"clips\": {\"c\": {\"tracks\": {\"far.scale\": [[0, 1e39], [1, 1e39]]}}}}");
  const std::pair<const char*, const char*> places[] = {
      {"far", ":4:23: error: the rest pose of \"far\" needs numbers of at most 1e30"},
      {"moved", ":3:10: error: node \"far\" is 1e+39 m from the origin at 0 s"},
      {"free", ":2:11: error: node \"far\" is 1e+39 times its size at 0 s"}};
  for (const auto& [name, place] : places)
    for (const char* verb : {"check ", "run --until 1 ", "sample --at 0 ", "plot -o out.svg ", "view -o out.html "}) {
      const Ran ran = folder.run(verb + std::string(name) + ".json");
      CHECK(ran.code == 1);
      CHECK_MESSAGE(ran.err.starts_with(name + std::string(".json") + place), ran.err);
    }
  const json told = json::parse(folder.run("check --json far.json").out);
  CHECK(told["files"][0]["problems"][0]["pointer"] == "/nodes/far/position");
}
