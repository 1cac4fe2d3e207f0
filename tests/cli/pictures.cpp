#include "command.h"

#include <tweenfall/importers/document.h>

using namespace tweenfall;
using namespace tweenfall::test;
using nlohmann::json;

TEST_CASE("plot writes a picture of the chosen tracks and says so in one line") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const Ran ran = folder.run("plot ball.json --track ball.position -o ball.svg");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.starts_with("wrote ball.svg: 1 track of roll"));
  CHECK(std::count(ran.out.begin(), ran.out.end(), '\n') == 1);
  CHECK(folder.read("ball.svg").find("ball.position") != std::string::npos);
  CHECK(folder.read("ball.svg").find("pivot.rotation") == std::string::npos);
}

TEST_CASE("plot without a file is SVG on stdout, with the line about it on stderr") {
  const Folder folder;
  const Ran ran = folder.run("plot -", ball_document);
  CHECK(ran.code == 0);
  CHECK(ran.out.find("<svg") != std::string::npos);
  CHECK(ran.out.find("wrote") == std::string::npos);
  CHECK(ran.err.find("wrote") != std::string::npos);
}

TEST_CASE("plot in columns without rates says so, and of columns that cannot be says what can") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const Ran ran = folder.run("plot ball.json --columns 2 --no-rates -o ball.svg");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.find("rates") == std::string::npos);
  CHECK(folder.read("ball.svg").find(">rate<") == std::string::npos);
  const Ran wrong = folder.run("plot ball.json --columns 0 -o other.svg");
  CHECK(wrong.code == 2);
  CHECK(wrong.err.find("--columns takes a whole number from 1 to 6, not 0") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"ball.json", "ball.svg"});
}

TEST_CASE("plot of a thrown ball tells of the hand-off") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("plot thrown.json -o thrown.svg");
  CHECK(ran.code == 0);
  CHECK(ran.out.find("1 hand-off") != std::string::npos);
}

TEST_CASE("view says at the terminal that a page carries fewer frames than were recorded, and only then") {
  const Folder folder;
  json document = {{"tweenfall", 1}};
  for (int i = 0; i < 300; ++i) {
    const std::string name = "n" + std::to_string(i);
    document["nodes"][name] = json::object();
    document["clips"]["rise"]["tracks"][name + ".position"] = {{0, {i, 0, 0}}, {15, {i, 1, 0}}};
  }
  folder.write("rise.json", document.dump());
  const Ran ran = folder.run("view rise.json");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  // 250,000 places of 300 nodes that move.
  CHECK_MESSAGE(ran.err.find("of 901 frames it carries 833, with smooth motion between them") != std::string::npos,
                ran.err);
  CHECK(folder.run("view rise.json --until 13").err.find("it carries") == std::string::npos);
  CHECK(folder.read("rise.html").find("<title>rise</title>") != std::string::npos);
}

TEST_CASE("view writes one page named like the document, that asks for nothing from a network") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("view thrown.json --until 1");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.starts_with("wrote thrown.html: 2 nodes over 1 s"));
  CHECK(folder.names() == std::vector<std::string>{"thrown.html", "thrown.json"});
  const std::string page = folder.read("thrown.html");
  CHECK(page.find("<script src") == std::string::npos);
  CHECK(page.find("<link rel=\"stylesheet\"") == std::string::npos);
}

TEST_CASE("a recording as glTF can be inspected, viewed and imported, and the import is a valid document") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  REQUIRE(folder.run("run ball.json -o ball.glb").code == 0);
  const Ran inspected = folder.run("inspect ball.glb");
  CHECK_MESSAGE(inspected.code == 0, inspected.err);
  CHECK(inspected.out.find("1 clip") != std::string::npos);
  CHECK(folder.run("view ball.glb --until 0.5 -o model.html").code == 0);
  const Ran imported = folder.run("import ball.glb -o imported.json");
  CHECK_MESSAGE(imported.code == 0, imported.err);
  CHECK(imported.out.starts_with("wrote imported.json: "));
  const Ran checked = folder.run("check imported.json");
  CHECK_MESSAGE(checked.code == 0, checked.err);
  const Ran piped = folder.run("import ball.glb -o -");
  CHECK(piped.out == folder.read("imported.json"));
}

TEST_CASE("new writes a document that is valid, once, and leaves what exists alone") {
  const Folder folder;
  const Ran made = folder.run("new first.json");
  CHECK(made.code == 0);
  CHECK(made.out.starts_with("wrote first.json: "));
  const Ran checked = folder.run("check first.json");
  CHECK_MESSAGE(checked.code == 0, checked.err);
  CHECK(folder.run("run first.json --json").code == 0);
  folder.write("first.json", "mine");
  CHECK(folder.run("new first.json").code == 1);
  CHECK(folder.read("first.json") == "mine");
  CHECK(folder.run("new").out == starting_document());
}

TEST_CASE("schema prints the library's draft-07 schema") {
  const Folder folder;
  const Ran ran = folder.run("schema");
  CHECK(ran.code == 0);
  CHECK(json::parse(ran.out)["$schema"].get<std::string>().find("draft-07") != std::string::npos);
  CHECK(ran.out == document_schema());
}

TEST_CASE("view of two documents is one page with both, side by side") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("view ball.json thrown.json");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.starts_with("wrote ball_thrown.html: "));
  CHECK(ran.out.find("; beside it ") != std::string::npos);
  const std::string page = folder.read("ball_thrown.html");
  CHECK(count(page, "<iframe") == 2);
  // Three.js is in it once.
  CHECK(page.size() < 1.6 * folder.run("view ball.json -o -").out.size());
  CHECK(folder.run("view - -", ball_document).code == 2);
  CHECK(folder.run("view ball.json gone.json").code == 1);
}

TEST_CASE("plot draws the phase portraits of systems, and says where there is none") {
  const Folder folder;
  folder.write("spring.json", R"({"tweenfall": 1, "systems": {"spring": {"state": {"x": 1, "v": 0},
    "rates": {"x": "v", "v": "-x"}, "energy": "x^2+v^2"}}})");
  folder.write("ball.json", ball_document);
  const Ran ran = folder.run("plot spring.json --portrait -o portrait.svg");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.starts_with("wrote portrait.svg: 1 portrait: spring"));
  CHECK(folder.read("portrait.svg").find("energy") != std::string::npos);
  CHECK(folder.run("plot spring.json -o tracks.svg").out.starts_with("wrote tracks.svg: 3 tracks of spring"));
  CHECK(folder.run("plot ball.json --portrait").code == 2);
}
