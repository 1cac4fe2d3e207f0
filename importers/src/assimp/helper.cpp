#include "assimp/helper.h"

#include "assimp/model_stream.h"
#include "assimp/process.h"
#include "assimp/reader.h"
#include "model/model_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>

namespace tweenfall::assimp {

namespace {

constexpr std::string_view program_name = "tweenfall-import-helper";
constexpr unsigned processor_seconds = 30;
constexpr double seconds = 120;

/// Memory allowed for a file: many times its size, since text becomes numbers and numbers become vertices.
std::size_t memory_for(std::size_t file_bytes) {
  constexpr std::uint64_t base = std::uint64_t{512} << 20, most = std::uint64_t{8} << 30;
  constexpr std::uint64_t addressable = std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(
      std::min({base + 256 * std::min(std::uint64_t{file_bytes}, most), most, addressable}));
}

/// Places to look for the helper, in order: the path in the environment, beside the running program or where it is
/// installed with that, and where it was built or installed with this library.
std::vector<std::filesystem::path> places() {
  std::vector<std::filesystem::path> all;
  // The environment variable is for people who moved it.
  if (const char* own = std::getenv("TWEENFALL_IMPORT_HELPER"); own && *own) return {own};
  const std::filesystem::path beside = this_program().parent_path();
  if (!beside.empty()) {
    all.push_back(beside / program_name);
    all.push_back(beside.parent_path() / "libexec" / program_name);
  }
  all.emplace_back(TWEENFALL_IMPORT_HELPER_BUILT);
  all.emplace_back(TWEENFALL_IMPORT_HELPER_INSTALLED);
  return all;
}

std::filesystem::path helper_program(const std::filesystem::path& file) {
  std::error_code ignored;
  std::string looked;
  for (const std::filesystem::path& place : places()) {
    if (std::filesystem::is_regular_file(place, ignored)) return place;
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw ModelError(file.string() + ": error: Collada and OBJ are read by the program " + std::string(program_name) +
                   ", which is not there (looked for " + looked + "); set TWEENFALL_IMPORT_HELPER to where it is");
}

std::string outcome(const Heard& heard) {
  if (heard.too_much) return "becomes too large to be read";
  if (!heard.in_time || heard.how_it_ended == "out of time") return "assimp takes too long over it";
  if (heard.said.starts_with('-')) return heard.said.substr(1);
  return "assimp crashes on it (" + (heard.how_it_ended.empty() ? "no answer" : heard.how_it_ended) +
         "); the file is malformed";
}

void say(char letter, const std::string& text) {
  std::fputc(letter, stdout);
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

Model read_in_helper(const std::string& bytes, const std::filesystem::path& file, models::ModelProblems& problems) {
  if (!can_start_programs()) {
    problems.repair("", "was read by assimp within this program, since no other can be started here");
    return read(bytes, file, problems);
  }
  const std::vector<std::string> words{file.string()};
  const Heard heard = hear(helper_program(file), words, seconds, memory_for(bytes.size()));
  std::optional<Model> model;
  if (heard.said.starts_with('+')) model = model_of(std::string_view(heard.said).substr(1));
  if (!model) {
    const std::string what = outcome(heard);
    // An error in the file itself states its place already.
    throw ModelError(what.find(": error: ") != std::string::npos ? what : file.string() + ": error: " + what);
  }
  for (const std::string& repair : model->repairs) problems.repair("", repair);
  model->repairs.clear();
  return *std::move(model);
}

int help(int count, char** words) {
  close_inherited();
  if (count != 2) {
    std::fputs("usage: tweenfall-import-helper FILE\nReads a Collada or OBJ file for tweenfall.\n", stderr);
    return 2;
  }
  const std::filesystem::path file = words[1];
  try {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    limit_this_process(memory_for(failed ? 0 : static_cast<std::size_t>(size)), processor_seconds);
    std::string reason;
    const auto bytes = models::model_bytes(file, reason);
    if (!bytes) throw ModelError(file.string() + ": error: " + reason);
    models::ModelProblems problems;
    Model model = read(*bytes, file, problems);
    model.repairs = problems.repairs();
    say('+', bytes_of(model));
  } catch (const std::bad_alloc&) {
    say('-', "needs more memory than a file of its size may take");
  } catch (const std::exception& error) {
    const std::string what = error.what();
    say('-', what.find("bad_alloc") == std::string::npos ? what : "needs more memory than a file of its size may take");
  }
  return 0;
}

}  // namespace tweenfall::assimp
