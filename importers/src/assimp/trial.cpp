#include "assimp/trial.h"

#include "assimp/memory_files.h"

#include <tweenfall/importers/model.h>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace tweenfall {

namespace {

/// What the child says: a letter and, when assimp refused, its reason.
void say(int pipe, char letter, const std::string& text) {
  const std::string all = letter + text.substr(0, 2000);
  for (std::size_t done = 0; done < all.size();) {
    const ssize_t written = ::write(pipe, all.data() + done, all.size() - done);
    if (written <= 0) return;
    done += static_cast<std::size_t>(written);
  }
}

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  static_cast<void>(::setrlimit(static_cast<__rlimit_resource_t>(resource), &both));
}

[[noreturn]] void import_as_child(int pipe, const std::string& bytes, const std::filesystem::path& file) {
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGALRM}) ::signal(number, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, 30);
  ::alarm(120);
  // Failed assertions would print.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  try {
    Assimp::Importer importer;
    static_cast<void>(import_scene(importer, bytes, file, ColladaNames::names));
    importer.FreeScene();
    say(pipe, '+', "");
  } catch (const std::exception& error) {
    say(pipe, '-', error.what());
  }
  ::_exit(0);
}

std::string hear(int pipe) {
  std::string all;
  char part[512];
  while (true) {
    const ssize_t count = ::read(pipe, part, sizeof part);
    if (count > 0)
      all.append(part, static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return all;
  }
}

std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return "assimp cannot read it";
  const int number = WTERMSIG(status);
  if (number == SIGXCPU || number == SIGALRM || number == SIGKILL) return "assimp takes too long over it";
  return std::string("assimp breaks down over it (") + ::strsignal(number) + "); the file is malformed";
}

}  // namespace

const aiScene& import_scene(Assimp::Importer& importer, const std::string& bytes, const std::filesystem::path& file,
                            ColladaNames names) {
  importer.SetIOHandler(memory_files(bytes, file).release());
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, names == ColladaNames::names);
  const unsigned steps =
      aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs | aiProcess_ValidateDataStructure;
  const aiScene* scene = importer.ReadFile(file.string(), steps);
  if (!scene || !scene->mRootNode) throw ModelError(file.string() + ": error: " + importer.GetErrorString());
  return *scene;
}

void try_import(const std::string& bytes, const std::filesystem::path& file) {
  int ends[2];
  if (::pipe(ends) != 0) throw ModelError(file.string() + ": error: cannot start reading: " + std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw ModelError(file.string() + ": error: cannot start reading: " + std::strerror(errno));
  }
  if (child == 0) {
    ::close(ends[0]);
    import_as_child(ends[1], bytes, file);
  }
  ::close(ends[1]);
  const std::string said = hear(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (said.starts_with('-')) throw ModelError(said.substr(1));
  if (!said.starts_with('+') || !WIFEXITED(status))
    throw ModelError(file.string() + ": error: " + how_it_ended(status));
}

}  // namespace tweenfall
