#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/whole_file.h>

#include "document/content.h"
#include "document/fields/things.h"
#include "document/grammar/grammar.h"
#include "document/graphs/graphs.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/report/check.h"
#include "document/systems/systems.h"

#include <fstream>
#include <optional>
#include <utility>

namespace tweenfall::document {

namespace {

// The meaning of another version is not guessed: then this is the only problem reported.
bool is_other_version(const json::Value& root, Problems& problems) {
  const json::Value version = root.find("tweenfall");
  if (!version || !version.is(json::Value::Kind::number) || version.number() == document_version) return false;
  problems.add(version, "this is version " + number_text(version.number()) + "; this reader reads version " +
                            number_text(document_version));
  return true;
}

}  // namespace

ReadDocument read_document(std::string text, const std::string& name, const std::filesystem::path& folder,
                           Reading& reading) {
  std::vector<json::Fault> faults;
  ReadDocument out;
  out.name = name;
  out.tree = json::Tree::parse(std::move(text), faults, {.largest = largest_document});
  const json::Value root = out.tree.root();
  Problems problems;
  for (const json::Fault& fault : faults) problems.add(fault);
  if (!root.is(json::Value::Kind::faulty) && !is_other_version(root, problems)) {
    check(document_form(), out.tree, problems);
    Building building{root, folder, reading, problems};
    if (const json::Value title = usable(root, "name")) building.stage.name = title.text();
    if (const json::Value fps = usable(root, "fps")) building.fps = fps.number();
    building.names_are_free = !root.find("nodes") && !root.find("import");
    read_imports(building);
    read_nodes(building);
    read_clips(building);
    systems::read(usable(root, "systems"), building);
    read_plays(building);
    graphs::read(usable(root, "graphs"), building);
    fields::read_world(usable(root, "world"), building);
    fields::check_groups(building);
    read_rules(building);
    judge(building);
    out.stage = std::move(building.stage);
    out.systems = std::move(building.systems);
    out.names_are_free = building.names_are_free;
  }
  out.notes = problems.located(Severity::note, name, out.tree);
  if (!problems.empty()) throw DocumentError(problems.located(Severity::error, name, out.tree), std::move(out.notes));
  return out;
}

ReadDocument read_document_file(const std::filesystem::path& file, Reading& reading) {
  const std::string name = file.generic_string();
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) throw DocumentError({file_problem(name, "this is a folder")});
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw DocumentError({file_problem(
        name, std::filesystem::exists(file, fault) ? "cannot be opened; may it be read?" : "there is no such file")});
  std::optional<std::string> read = read_within(stream, largest_document);
  if (!read)
    throw DocumentError({file_problem(name, "is larger than " + std::to_string(largest_document >> 20) + " MiB")});
  if (stream.bad()) throw DocumentError({file_problem(name, "cannot be read to its end")});
  reading.open.push_back(std::filesystem::weakly_canonical(file, fault));
  struct Leave {
    std::vector<std::filesystem::path>& open;
    ~Leave() { open.pop_back(); }
  } leave{reading.open};
  return read_document(std::move(*read), name, file.parent_path(), reading);
}

}  // namespace tweenfall::document
