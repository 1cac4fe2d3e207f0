// Broken and hostile files: an error that names the file, or a model; never anything else.

#include "importers/models/model_support.h"

#include <tweenfall/importers/shown_text.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Loads, and tells an error from anything worse. @returns the error's text, empty when the file loaded
std::string outcome(const std::filesystem::path& file) {
  try {
    const Model model = load_model(file);
    // A file that loads must also be fit for use.
    for (const MeshInstance& instance : model.instances) {
      CHECK(instance.node < model.nodes.size());
      CHECK(instance.mesh < model.meshes.size());
    }
    if (model.nodes.size() < 1000) {
      Posed posed(model);
      for (std::size_t clip = 0; clip < model.clips.size(); ++clip) {
        posed.play(clip);
        posed.at(model.clips[clip].duration / 3);
        for (std::size_t node = 0; node < model.nodes.size(); ++node) CHECK(posed.world(node).linear.allFinite());
      }
      for (const MeshInstance& instance : model.instances)
        for (const Vec3& point : posed.vertices(instance)) CHECK(point.allFinite());
    }
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("odd but valid files load, and malformed ones give an error that names the file") {
  for (const auto& file : files_in(models_folder() / "malformed", {})) {
    const std::string name = file.filename().string();
    CAPTURE(name);
    const std::string error = outcome(file);
    if (name.find("VALID") != std::string::npos) {
      CHECK(error == "");
    } else {
      CAPTURE(error);
      CHECK(error.find(name) != std::string::npos);
      CHECK(error.size() > name.size() + 20);
    }
  }
}

TEST_CASE("a hierarchy of 20,000 nodes in one chain loads") {
  const std::size_t depth = 20000;
  std::string text = R"({"asset": {"version": "2.0"}, "nodes": [)";
  for (std::size_t i = 0; i < depth; ++i) {
    text += i ? "," : "";
    text += R"({"translation": [0, 1, 0])";
    if (i + 1 < depth) text += R"(, "children": [)" + std::to_string(i + 1) + "]";
    text += "}";
  }
  text += R"(], "scenes": [{"nodes": [0]}]})";
  const ScratchFolder folder("deep");
  const Model model = load_model(folder.file("deep.gltf", text));
  REQUIRE(model.nodes.size() == depth);
  CHECK(model.nodes.back().parent == depth - 2);
}

TEST_CASE("all faults of a file are listed at once, each with its place") {
  const ScratchFolder folder("faults");
  const auto file = folder.file("faults.gltf", R"({"asset": {"version": "2.0"},
    "nodes": [{"children": [1, 9]}, {"children": [0]}, {"mesh": 4}, {"rotation": [0, 0, 0, 0]}, {"scale": [1, 2]}],
    "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 7}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "animations": [{"channels": [{"sampler": 3, "target": {"node": 0, "path": "rotation"}}], "samplers": []}]})");
  const std::string error = outcome(file);
  for (const char* place : {"/nodes/0/children/1: ", "/nodes/2/mesh: ", "/nodes/3/rotation: ", "/nodes/4/scale: ",
                            "/accessors/0/bufferView: ", "/animations/0/channels/0/sampler: ", "is its own ancestor"})
    CHECK_MESSAGE(error.find(place) != std::string::npos, place, " is not in:\n", error);
}

TEST_CASE("a fault of a text file is told with the line and column of what is wrong, also when it is no JSON") {
  const ScratchFolder folder("lines");
  struct Case {
    const char *text, *says;
  };
  for (const Case& each : std::initializer_list<Case>{
           {"{\"asset\": {\"version\": \"2.0\"},\n  \"nodes\": [{},\n    {\"mesh\": 4}]}",
            ":3:14: error: /nodes/1/mesh: index 4 points past the end; there are 0"},
           {"{\"asset\": {\"version\": \"2.0\"},\n  \"accessors\": [{\"count\": 1}], \"nodes\": 7}",
            ":2:41: error: /nodes: must be a list, not a number"},
           {"{\"asset\": {}}", ":1:11: error: /asset/version: is missing; glTF 2.0 can be read"},
           {"{\"asset\": {\"version\": \"2.0\"}\n \"nodes\": []}",
            ":2:2: error: is not valid JSON: expected ',' or '}' after the value, found '\"'"},
           {"{\"asset\": // none\n {}}", ":1:11: error: is not valid JSON: expected a value, found '/'"}}) {
    const auto file = folder.file("lines.gltf", each.text);
    const std::string error = outcome(file);
    CHECK_MESSAGE(error.find(file.string() + each.says) != std::string::npos, error);
  }
}

TEST_CASE("JSON that other readers take is taken: a name given twice, zeros after the end, any extras") {
  const ScratchFolder folder("lenient");
  const auto name_of = [&](const std::string& text) {
    return load_model(folder.file("lenient.gltf", text)).nodes.at(0).name;
  };
  CHECK(name_of(R"({"asset": {"version": "2.0"}, "nodes": [{"name": "first", "name": "second"}]})") == "second");
  CHECK(name_of(R"({"asset": {"version": "2.0"}, "nodes": [{"name": "a"}]})" + std::string(3, '\0')) == "a");
  CHECK(name_of(R"({"asset": {"version": "2.0"}, "nodes": [{"name": "a"}], "meshes": [{"extras": 3}]})") == "a");
}

TEST_CASE("what is no glTF at all is told so, and a text named .glb is read") {
  const ScratchFolder folder("no-glb");
  const std::string error = outcome(folder.file("no.glb", "\x89PNG\r\n"));
  CHECK(error.find("is no binary glTF, which begins with the letters \"glTF\"") != std::string::npos);
  CHECK(outcome(folder.file("text.glb", " {\"asset\": {\"version\": \"2.0\"}}")) == "");
}

TEST_CASE("bytes of a file that are no text are spelled out where an error or a repair quotes them") {
  const ScratchFolder folder("bytes");
  for (const auto& file : std::initializer_list<std::pair<std::string, std::string>>{
           {"a.bvh", "HIERARCHY\nROOT hip\n{\n OFFSET 0 0 0\n CHANNELS 1 X\xff\xfeposition\n}\n"},
           {"b.bvh", "HIERARCHY\nROOT hip\n{\n OFFSET \xff 0 0\n"},
           {"c.fbx", "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n FBXVersion: 7\xff\n}\nObjects: \xff {\n"},
           {"d.dae", "<?xml version=\"1.0\"?>\n<COLLADA\xff version=\"1.4.1\"><\xe9></COLLADA>"},
           {"e.gltf", "{\"asset\": {\"version\": \"2.\xff\"}}"},
           {"f.obj", "v 1 2 \xff\nf 1 1 9\n"}}) {
    const std::string& name = file.first;
    CAPTURE(name);
    const std::string error = outcome(folder.file(name, file.second));
    CHECK(error.find(name) != std::string::npos);
    CHECK(utf8_text(error) == error);
  }
  const std::string told =
      outcome(folder.file("g.bvh", "HIERARCHY\nROOT hip\n{\n OFFSET 0 0 0\n CHANNELS 1 X\xff\n}\n"));
  CHECK_MESSAGE(told.find("x\\xff") != std::string::npos, told);
}

TEST_CASE("a matrix whose numbers no placement can hold is refused with its place") {
  const ScratchFolder folder("matrix");
  for (const char* number : {"1e200", "-1e300", "1.7e308"}) {
    const std::string error =
        outcome(folder.file("huge.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"matrix": [1,0,0,0, 0,)" +
                                             std::string(number) + R"(,0,0, 0,0,1,0, 0,0,0,1]}]})"));
    CHECK_MESSAGE(error.find("/nodes/0/matrix: holds numbers too large for a placement") != std::string::npos, error);
  }
}

TEST_CASE("files that are missing, folders, or of an unknown kind are errors") {
  const ScratchFolder folder("kinds");
  CHECK(outcome(folder / "nothing.glb").find("no such file") != std::string::npos);
  CHECK(outcome(folder.path()).find("not a plain file") != std::string::npos);
  CHECK(outcome("/dev/zero").find("not a plain file") != std::string::npos);
  CHECK(outcome(folder.file("model.xyz", "?")).find(".glb, .gltf, .fbx, .bvh, .dae and .obj") != std::string::npos);
}

TEST_CASE("a model cannot make the reader open files outside its folder") {
  const ScratchFolder folder("outside");
  for (const char* uri : {"../outside.bin", "/etc/passwd", "http://example.org/a.bin", "a/%2e%2e/../../b.bin"}) {
    const auto file =
        folder.file("reach.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": ")" +
                                      std::string(uri) + R"("}]})");
    CHECK(outcome(file).find("own folder") != std::string::npos);
  }
}

TEST_CASE("a valid file cut short or with bits flipped loads or gives an error, whatever the place") {
  const auto files = files_in(models_folder() / "gltf", {".glb"});
  const ScratchFolder folder("fuzz");
  Random random(20260101);
  std::size_t refused = 0, total = 0;
  for (const auto& file : files) {
    const std::string valid = text_of(file);
    if (valid.size() > 25000) continue;
    for (int i = 0; i < 60; ++i) {
      std::string bytes = valid;
      if (i % 3 == 0) bytes.resize(static_cast<std::size_t>(random.unit() * static_cast<double>(bytes.size())));
      for (int flips = 1 + i % 4; flips > 0 && !bytes.empty(); --flips) {
        // Half of the flips go to the JSON, where the structure is.
        const double reach = i % 2 ? 1.0 : 0.3;
        const auto at = static_cast<std::size_t>(random.unit() * reach * static_cast<double>(bytes.size()));
        bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 << (random.bits() % 8)));
      }
      refused += !outcome(folder.file("fuzz.glb", bytes)).empty();
      ++total;
    }
  }
  if (total) CHECK(refused > 0);
  MESSAGE(refused << " of " << total << " damaged files refused, the others loaded");
}

TEST_CASE("damaged BVH, FBX and Collada files load or give an error") {
  const ScratchFolder folder("fuzz-text");
  Random random(20260102);
  for (const auto& file : files_in(models_folder(), {".bvh", ".fbx", ".dae"})) {
    const std::string valid = text_of(file), ending = file.extension().string();
    if (valid.size() > 60000) continue;
    for (int i = 0; i < (ending == ".bvh" ? 40 : 4); ++i) {
      std::string bytes = valid;
      if (i % 2 == 0) bytes.resize(static_cast<std::size_t>(random.unit() * static_cast<double>(bytes.size())));
      for (int flips = 1 + i % 4; flips > 0 && !bytes.empty(); --flips) {
        const auto at = static_cast<std::size_t>(random.unit() * static_cast<double>(bytes.size()));
        bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 << (random.bits() % 8)));
      }
      static_cast<void>(outcome(folder.file("fuzz" + ending, bytes)));
    }
  }
}
