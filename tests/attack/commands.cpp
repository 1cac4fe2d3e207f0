// Changed documents given to the command itself: its verbs agree on what is valid, and everything they print is text.

#include "attack/cases.h"
#include "attack/mutation.h"
#include "attack/written.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace tweenfall::attack {

namespace {

namespace fs = std::filesystem;

class Commands final : public Attack {
 public:
  explicit Commands(std::uint64_t seed) : documents_(seed), folder_(folder_of_process(getpid())) {
    for (const char* folder : {"samples/documents", "tests/data/documents/good", "../shared/faults"}) {
      const fs::path from = fs::path(TWEENFALL_SOURCE_DIR) / folder;
      if (!fs::exists(from)) continue;
      const fs::path to = twin_of(from);
      fs::create_directories(to);
      fs::copy(from, to, fs::copy_options::recursive);
    }
  }
  ~Commands() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::string show(std::uint64_t number) override { return documents_.make(number).text; }

  std::string run(std::uint64_t number) override {
    const ChangedDocument made = documents_.make(number);
    place_ = twin_of(made.folder);
    {
      std::ofstream out(place_ / "case.json", std::ios::binary);
      out << made.text;
    }
    const Ran check = ask("check case.json");
    if (check.code != 0 && check.code != 1) return "check ends with " + std::to_string(check.code) + ": " + check.said;
    taken_ += check.code == 0;
    const char* others[] = {"run case.json --until 0.1", "sample case.json", "plot case.json -o case.svg",
                            "view case.json --until 0.1 -o case.html"};
    for (const char* other : others) {
      const Ran ran = ask(other);
      if (!is_utf8(ran.said)) return std::string(other) + " says what is not UTF-8";
      if (ran.code != 0 && ran.code != 1 && ran.code != 2)
        return std::string(other) + " ends with " + std::to_string(ran.code);
      if (check.code == 1 && ran.code == 0) return std::string(other) + " takes what check refuses: " + check.said;
      if (check.code == 0 && ran.code != 0 && !is_about_the_request(ran.said))
        return std::string(other) + " refuses what check takes: " + ran.said;
    }
    return is_utf8(check.said) ? "" : "check says what is not UTF-8";
  }

 private:
  struct Ran {
    int code = 0;
    std::string said;
  };

  /// Reasons for which a valid document may still be refused: it has nothing of what was asked for, or too much of it,
  /// or the run itself ended.
  static bool is_about_the_request(const std::string& said) {
    for (const char* words : {"is no longer finite at", "are allowed", "there is no clip", "there is no track",
                              "several clips", "--until", "--limit", "--fps", "--clip"}) {
      if (said.find(words) != std::string::npos) return true;
    }
    return false;
  }

  /// Where a folder of the source, or beside it, has its copy.
  fs::path twin_of(const fs::path& folder) const {
    return (folder_ / "source" / fs::relative(folder, TWEENFALL_SOURCE_DIR)).lexically_normal();
  }

  Ran ask(const std::string& words) const {
    const std::string line =
        "cd '" + place_.string() + "' && '" TWEENFALL_COMMAND "' " + words + " > /dev/null 2> said.txt";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), bytes_of(place_ / "said.txt")};
  }

  ChangedDocuments documents_;
  fs::path folder_, place_;
};

}  // namespace

std::unique_ptr<Attack> attack_commands(std::uint64_t seed) {
  return std::make_unique<Commands>(seed);
}

}  // namespace tweenfall::attack
