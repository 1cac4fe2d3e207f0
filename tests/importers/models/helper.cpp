// Collada and OBJ, which assimp reads in a program of its own; names and places that hostile files choose.

#include "importers/models/model_support.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string error_of(const std::filesystem::path& file) {
  try {
    static_cast<void>(load_model(file));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

/// Another program in the helper's place, as long as this lives.
class OtherHelper {
 public:
  explicit OtherHelper(const std::filesystem::path& program) {
    std::error_code ignored;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all, ignored);
    ::setenv("TWEENFALL_IMPORT_HELPER", program.c_str(), 1);
  }
  ~OtherHelper() { ::unsetenv("TWEENFALL_IMPORT_HELPER"); }
  OtherHelper(const OtherHelper&) = delete;
  OtherHelper& operator=(const OtherHelper&) = delete;
};

}  // namespace

TEST_CASE("an OBJ loads while standard input and error are closed") {
  const ScratchFolder folder("closed");
  const auto file = folder.file("a.obj", triangle);
  const int in = ::dup(0), error = ::dup(2);
  ::close(0);
  ::close(2);
  std::size_t meshes = 0;
  std::string what;
  try {
    meshes = load_model(file).meshes.size();
  } catch (const ModelError& refused) {
    what = refused.what();
  }
  ::dup2(in, 0);
  ::dup2(error, 2);
  ::close(in);
  ::close(error);
  CHECK_MESSAGE(meshes == 1, what);
}

TEST_CASE("loading leaves the host's own children and their signals alone") {
  const ScratchFolder folder("children");
  const auto file = folder.file("a.obj", triangle);
  const pid_t own = ::fork();
  if (own == 0) ::_exit(7);
  CHECK(load_model(file).meshes.size() == 1);
  int status = 0;
  CHECK(::waitpid(own, &status, 0) == own);
  CHECK(WEXITSTATUS(status) == 7);
  // A host whose children are waited for by the system.
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  CHECK(load_model(file).meshes.size() == 1);
  std::signal(SIGCHLD, before);
}

TEST_CASE("a helper that is missing, says nothing, or says what is no model is an error that names the file") {
  const ScratchFolder folder("helpers");
  const auto file = folder.file("a.obj", triangle);
  {
    const OtherHelper none(folder / "nowhere");
    const std::string error = error_of(file);
    CHECK_MESSAGE(error.find("set TWEENFALL_IMPORT_HELPER") != std::string::npos, error);
    CHECK(error.starts_with(file.string()));
  }
  for (const char* script : {"#!/bin/sh\n", "#!/bin/sh\nprintf '+tweenfall model 1\\n\\377\\377\\377\\377'\n",
                             "#!/bin/sh\nkill -SEGV $$\n", "#!/bin/sh\nyes | head -c 900000000\n"}) {
    const OtherHelper broken(folder.file("helper", script));
    const std::string error = error_of(file);
    CHECK_MESSAGE((error.find("crashes") != std::string::npos || error.find("too large") != std::string::npos), error);
  }
}

TEST_CASE("an OBJ whose materials are not there, or not beside it, is read and says so") {
  const ScratchFolder folder("materials");
  const auto repairs_of = [&](const std::string& materials) {
    return load_model(folder.file("a.obj", "mtllib " + materials + "\nusemtl red\n" + triangle)).repairs;
  };
  static_cast<void>(folder.file("own.mtl", "newmtl red\nKd 1 0 0\n"));
  CHECK(repairs_of("own.mtl").empty());
  for (const std::string elsewhere : {"none.mtl", "../own.mtl", "/etc/passwd"}) {
    const std::vector<std::string> told = repairs_of(elsewhere);
    REQUIRE(told.size() == 1);
    CHECK_MESSAGE(told[0].find("\"" + elsewhere + "\" that it names is not in its folder") != std::string::npos,
                  told[0]);
  }
}

TEST_CASE("a Collada file whose count is huge is refused at its line, at once") {
  const ScratchFolder folder("counts");
  const auto begin = std::chrono::steady_clock::now();
  for (const char* count : {"4000000000", "99999999999999999999999"}) {
    const auto file = folder.file("a.dae", "<?xml version=\"1.0\"?>\n<COLLADA>\n <float_array count=\"" +
                                               std::string(count) + "\"/>\n</COLLADA>\n");
    const std::string error = error_of(file);
    CHECK_MESSAGE(error.find("a.dae:3:15: error: a count of " + std::string(count)) != std::string::npos, error);
  }
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
}

TEST_CASE("names of OBJ and BVH files that are not UTF-8 are taken for Latin-1") {
  const ScratchFolder folder("latin");
  const Model obj = load_model(folder.file("a.obj",
                                           "o Kn\xf6"
                                           "chel\n" +
                                               triangle));
  bool found = false;
  for (const Node& node : obj.nodes)
    found = found || node.name ==
                         "Kn\xc3\xb6"
                         "chel";
  CHECK(found);
  const Model bvh = load_model(folder.file("a.bvh",
                                           "HIERARCHY\nROOT H\xfc"
                                           "fte\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\n"
                                           "OFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0\n"));
  CHECK(bvh.nodes.at(0).name ==
        "H\xc3\xbc"
        "fte");
}

TEST_CASE("a glTF file with bytes that are not UTF-8 is refused at their place") {
  const ScratchFolder folder("latin-gltf");
  const std::string error = error_of(folder.file("a.gltf",
                                                 "{\"asset\": {\"version\": \"2.0\"},\n \"nodes\": [{\"name\": \"H\xfc"
                                                 "fte\"}]}"));
  CHECK_MESSAGE(error.find("a.gltf:2:23: error: ") != std::string::npos, error);
}

TEST_CASE("a glTF buffer follows no link out of its folder, and an escaped zero cuts no name") {
  const ScratchFolder folder("links"), secret("links-outside");
  static_cast<void>(secret.file("secret.bin", "0123456789abcdef"));
  static_cast<void>(folder.file("inside.bin", "0123456789abcdef"));
  std::filesystem::create_symlink(secret / "secret.bin", folder / "link.bin");
  std::filesystem::create_directory_symlink(secret.path(), folder / "way");
  std::filesystem::create_symlink(folder / "inside.bin", folder / "alias.bin");
  const auto outcome = [&](const std::string& uri) {
    return error_of(folder.file(
        "a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 16, "uri": ")" + uri + R"("}]})"));
  };
  CHECK(outcome("inside.bin") == "");
  CHECK(outcome("alias.bin") == "");
  CHECK(outcome("link.bin").find("own folder") != std::string::npos);
  CHECK(outcome("way/secret.bin").find("own folder") != std::string::npos);
  CHECK(outcome("inside.bin%00.png").find("zero byte") != std::string::npos);
}
