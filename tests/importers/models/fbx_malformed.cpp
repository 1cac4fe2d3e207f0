// FBX files that lie or break off: refused with the place, before memory is taken.

#include "importers/models/fbx_files.h"
#include "processor_time.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::string error_of(const ScratchFolder& folder, const std::string& bytes) {
  try {
    static_cast<void>(load_model(folder.file("bad.fbx", bytes)));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

template <class T>
std::string raw(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A binary file of one record with one array, of 32-bit headers or, from version 7500 on, 64-bit ones.
std::string binary(std::uint32_t version, char type, std::uint32_t count, std::uint32_t encoding,
                   const std::string& stored) {
  const auto number = [&](std::size_t value) {
    return version >= 7500 ? raw<std::uint64_t>(value) : raw(static_cast<std::uint32_t>(value));
  };
  const std::string head = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + raw(version);
  const std::string value = type + raw(count) + raw(encoding) + raw(static_cast<std::uint32_t>(stored.size())) + stored;
  const std::string name = "Vertices";
  const std::size_t header = (version >= 7500 ? 25 : 13) + name.size();
  return head + number(head.size() + header + value.size()) + number(1) + number(value.size()) +
         std::string(1, static_cast<char>(name.size())) + name + value + std::string(25, '\0');
}

}  // namespace

TEST_CASE("an FBX array that states more than its bytes can hold is refused at its byte, at once") {
  const ScratchFolder folder("fbx-lies");
  const std::string packed(24000, 'x');
  for (const std::uint32_t version : {7400u, 7500u})
    for (const auto& stated : std::initializer_list<std::pair<std::uint32_t, char>>{
             {0x20000000u, 'd'}, {0xFFFFFFFFu, 'd'}, {0xFFFFFFFFu, 'l'}, {0x40000000u, 'i'}, {0x10000000u, 'b'}}) {
      const auto count = stated.first;
      const auto type = stated.second;
      CAPTURE(version);
      CAPTURE(count);
      const double begin = test::processor_seconds();
      const std::string error = error_of(folder, binary(version, type, count, 1, packed));
      CHECK_MESSAGE(error.find("bad.fbx: byte " + std::to_string(version >= 7500 ? 60 : 48)) != std::string::npos,
                    error);
      CHECK_MESSAGE(error.find(std::to_string(count) + " elements") != std::string::npos, error);
      CHECK(test::processor_seconds() - begin < 2);
    }
  // Not packed, and cut off.
  CHECK(error_of(folder, binary(7400, 'd', 0x20000000u, 0, packed)).find("byte ") != std::string::npos);
  // Packed bytes that are no stream, and a plausible count that they do not fill.
  CHECK(error_of(folder, binary(7400, 'i', 10, 1, "not zlib")).find("damaged") != std::string::npos);
}

TEST_CASE("a record that reaches out of its file or of the one around it is refused at its byte") {
  const ScratchFolder folder("fbx-reach");
  std::string bytes = binary(7400, 'i', 0, 0, "");
  bytes.replace(27, 4, raw<std::uint32_t>(0x7FFFFFFF));
  CHECK(error_of(folder, bytes).find("byte 27: error: a record says that it ends at byte 2147483647") !=
        std::string::npos);
  bytes = binary(7400, 'i', 0, 0, "");
  bytes.replace(35, 4, raw<std::uint32_t>(0x7FFFFFFF));
  CHECK(error_of(folder, bytes).find("byte 27: error: the values of a record") != std::string::npos);
}

TEST_CASE("a broken FBX text names the line: braces, quotes, words for numbers, nesting without end") {
  const ScratchFolder folder("fbx-text");
  const auto says = [&](const std::string& text, const std::string& what) {
    const std::string error = error_of(folder, text);
    CHECK_MESSAGE(error.find(what) != std::string::npos, error);
  };
  const std::string head = "FBXHeaderExtension: {\n FBXVersion: 7500\n}\n";
  says(head + "Objects: {\n", ":4:1: error: the brace of \"Objects\" is not closed");
  says(head + "}\n", ":4:1: error: a brace is closed that was not opened");
  says(head + "Objects: { A: \"b\n}", ":4:15: error: the quotation mark is not closed");
  says(head + "Objects: {\n V: *3 {\n  a: 1,2,three\n }\n}", ":6:10: error: expected a number, found \"three\"");
  says("Objects: {\n}\n", "is not an FBX file");
  std::string deep = head;
  for (int i = 0; i < 100000; ++i) deep += "A: {";
  says(deep, "more than 64 deep");
  says("FBXHeaderExtension: {\n FBXVersion: 6100\n}\n", "FBX 6.1 cannot be read");
}

TEST_CASE("an FBX mesh, skin or shape that points past its lists is refused") {
  const ScratchFolder folder("fbx-indices");
  const auto outcome = [&](const std::string& points, const std::string& corners) {
    FbxText file;
    const int node = file.model("n", "");
    file.object("Geometry", "Geometry::g", "Mesh",
                "Vertices: *9 { a: " + points + " }\nPolygonVertexIndex: *3 { a: " + corners + " }", node);
    return error_of(folder, file.text());
  };
  CHECK(outcome("0,0,0,1,0,0,0,1,0", "0,1,-3") == "");
  CHECK(outcome("0,0,0,1,0,0,0,1,0", "0,1,-4").find("corner 2 of the mesh \"g\" points past its 3 points") !=
        std::string::npos);
  CHECK(outcome("0,0,0,1,0,0,0,1,nan", "0,1,-3").find("is not finite") != std::string::npos);
  CHECK(outcome("0,0,0,1,0,0,0,1", "0,1,-3").find("not three per point") != std::string::npos);
}

TEST_CASE("FBX nodes that are parents of each other are put below the scene, with a note") {
  const ScratchFolder folder("fbx-cycle");
  FbxText file;
  const int a = file.object("Model", "Model::a", "Null", "");
  const int b = file.object("Model", "Model::b", "Null", "", a);
  file.connect(a, b);
  const Model model = load_model(folder.file("cycle.fbx", file.text()));
  CHECK(model.nodes.size() == 2);
  REQUIRE(model.repairs.size() == 1);
  CHECK(model.repairs[0].find("parents of each other") != std::string::npos);
}

TEST_CASE("FBX names that are not UTF-8 are taken for Latin-1") {
  const ScratchFolder folder("fbx-names");
  FbxText file;
  file.model(
      "Kn\xf6"
      "chel",
      "");
  CHECK(load_model(folder.file("names.fbx", file.text())).nodes.at(0).name ==
        "Kn\xc3\xb6"
        "chel");
}

TEST_CASE(
    "of FBX cameras those that became nodes are noted, and how many of the authoring program's own are left out") {
  const ScratchFolder folder("fbx-cameras");
  FbxText file;
  file.object("NodeAttribute", "NodeAttribute::eye", "Camera", "", file.model("eye", ""));
  for (const std::string name : {"Producer Front", "Producer Top"})
    file.object("NodeAttribute", "NodeAttribute::" + name, "Camera", "", file.model(name, ""));
  const Model model = load_model(folder.file("cameras.fbx", file.text()));
  CHECK(model.nodes.size() == 1);
  REQUIRE(model.repairs.size() == 2);
  CHECK(model.repairs[0].find("1 camera is read as a plain node") != std::string::npos);
  CHECK(model.repairs[1].find("2 views of the program that wrote it") != std::string::npos);
}

TEST_CASE("an FBX text in which much is told of takes a time that grows with it alone") {
  const ScratchFolder folder("fbx-much-told");
  FbxText file;
  const int node = file.model("n", "");
  const int layer = file.layer(file.stack(1));
  for (int i = 0; i < 10000; ++i) file.curve(layer, node, "Lcl Translation", "d|X", {{1, 1}, {0, 2}}, 0x4);
  const auto path = folder.file("told.fbx", file.text());
  const double begin = test::processor_seconds();
  const Model model = load_model(path);
  CHECK(test::processor_seconds() - begin < 10);
  REQUIRE(model.repairs.size() == 41);
  // The line is the one where the curve begins.
  const std::string text = file.text();
  const auto lines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("AnimationCurve: ")), '\n');
  CHECK(
      model.repairs[0].starts_with("line " + std::to_string(lines + 1) + ": an animation curve has keys out of order"));
}
