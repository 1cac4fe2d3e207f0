// tweenfall new: a commented document to start from.

#include "files/output_file.h"
#include "report/faults.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/document.h>

#include <filesystem>

namespace tweenfall::cli {

namespace {

Run declare_new(Arguments& arguments) {
  auto file = std::make_shared<std::string>("-");
  arguments.optional_file("FILE", *file, "where to write; standard output without it; never overwrites a file");
  return [file] {
    require_output(*file, "", std::vector<std::string>{".json"});
    if (*file != "-" && std::filesystem::exists(*file))
      throw Faults({*file + ": error: exists already; choose another name, or delete it"});
    write_output(*file, starting_document());
    if (*file != "-") say_written(*file, "a commented document; tweenfall view " + *file + " shows it moving");
    return 0;
  };
}

}  // namespace

const Verb new_verb{"new", "write a commented starting document", "tweenfall new first.json", declare_new};

}  // namespace tweenfall::cli
