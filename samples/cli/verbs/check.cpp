// tweenfall check: every problem of every file, with its place.

#include "files/stage_file.h"
#include "report/counted.h"
#include "report/faults.h"
#include "report/json_text.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/document.h>

#include <charconv>

namespace tweenfall::cli {

namespace {

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
};

/// What was found in one file.
struct Finding {
  std::string summary;             ///< for a file without problems
  std::vector<std::string> texts;  ///< one problem or note each, as people read it
  std::vector<std::string> jsons;  ///< the same, as JSON objects
  std::size_t problems = 0;        ///< faults, listed or not
};

std::string problem_json(const Problem& problem) {
  return "{\"severity\": " + json_string(problem.severity == Severity::note ? "note" : "error") +
         ", \"file\": " + json_string(problem.file) + ", \"line\": " + std::to_string(problem.line) +
         ", \"column\": " + std::to_string(problem.column) + ", \"length\": " + std::to_string(problem.length) +
         ", \"pointer\": " + json_string(problem.pointer) + ", \"message\": " + json_string(problem.message) + "}";
}

std::string contents_of(const StageDescription& stage) {
  std::size_t tracks = 0, bodies = 0;
  for (const Clip& clip : stage.clips) tracks += clip.tracks.size();
  for (const NodeDescription& node : stage.nodes) bodies += node.body ? 1 : 0;
  std::string text = counted(stage.nodes.size(), "node") + ", " + counted(stage.clips.size(), "clip") + ", " +
                     counted(tracks, "track");
  if (bodies > 0) text += ", " + counted(bodies, "body", "bodies");
  if (!stage.rules.empty()) text += ", " + counted(stage.rules.size(), "hand-off rule");
  return text;
}

/// Splits a line "FILE: error: ..." or "FILE:LINE:COLUMN: error: ..."; any other line is only a message.
Problem problem_of(const std::string& text, const std::string& file) {
  Problem problem;
  problem.file = file;
  problem.message = text;
  const std::string mark = ": error: ";
  const std::size_t at = text.find(mark, file.size());
  if (!text.starts_with(file) || at == std::string::npos) return problem;
  const char* const end = text.data() + at;
  std::size_t line = 0, column = 0;
  if (at > file.size()) {
    if (text[file.size()] != ':') return problem;
    const auto first = std::from_chars(text.data() + file.size() + 1, end, line);
    if (first.ptr == end || *first.ptr != ':' || std::from_chars(first.ptr + 1, end, column).ptr != end) return problem;
  }
  problem.line = line;
  problem.column = column;
  problem.message = text.substr(at + mark.size());
  return problem;
}

Finding check_file(const std::string& file) {
  Finding finding;
  try {
    const StageFile read = judged_stage_file(file);
    finding.summary = contents_of(read.stage);
    for (const Problem& note : read.notes) {
      finding.texts.push_back(note.text());
      finding.jsons.push_back(problem_json(note));
    }
    return finding;
  } catch (const DocumentError& error) {
    finding.texts = faults_of(error, file);
    for (const Problem& problem : error.problems()) finding.jsons.push_back(problem_json(problem));
    for (const Problem& note : error.notes()) finding.jsons.push_back(problem_json(note));
    finding.problems = fault_count(error, file);
  } catch (const std::exception& error) {
    finding.texts = faults_of(error, file);
    for (const std::string& text : finding.texts) finding.jsons.push_back(problem_json(problem_of(text, file)));
    finding.problems = finding.texts.size();
  }
  return finding;
}

int check_files(const CheckOptions& options) {
  std::size_t problems = 0;
  std::vector<std::string> files;
  for (const std::string& file : options.files) {
    const Finding finding = check_file(file);
    problems += finding.problems;
    files.push_back("{\"file\": " + json_string(file) + ", \"valid\": " + (finding.problems == 0 ? "true" : "false") +
                    ", \"problems\": " + json_array(finding.jsons) + "}");
    if (options.json) continue;
    if (finding.problems == 0) tell(file + ": valid; " + finding.summary);
    for (const std::string& text : finding.texts) say(text);
  }
  if (options.json)
    print("{\"files\": " + json_array(files) + ", \"problems\": " + std::to_string(problems) + "}\n");
  else if (problems > 0)
    say(counted(problems, "problem"));
  return problems == 0 ? 0 : 1;
}

Run declare_check(Arguments& arguments) {
  auto options = std::make_shared<CheckOptions>();
  arguments.files("FILE", options->files, "documents and models; - is a document on standard input");
  arguments.flag("--json", options->json, "one JSON object for tools, on standard output");
  return [options] { return check_files(*options); };
}

}  // namespace

const Verb check_verb{"check", "validate documents and models; print every problem with its place",
                      "tweenfall check swing.json", declare_check};

}  // namespace tweenfall::cli
