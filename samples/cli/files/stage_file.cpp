#include "files/stage_file.h"

#include "line/arguments.h"
#include "report/did_you_mean.h"
#include "report/faults.h"
#include "report/terminal.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/whole_file.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

namespace tweenfall::cli {

namespace {

StageDescription stage_of(Model model) {
  StageDescription stage;
  stage.name = std::move(model.name);
  for (Node& node : model.nodes)
    stage.nodes.push_back({.name = std::move(node.name), .parent = node.parent, .rest = node.rest});
  stage.clips = std::move(model.clips);
  stage.meshes = std::move(model.meshes);
  stage.skins = std::move(model.skins);
  stage.mesh_instances = std::move(model.instances);
  return stage;
}

std::vector<std::string> clip_names(const StageDescription& stage) {
  std::vector<std::string> names;
  for (const Clip& clip : stage.clips) names.push_back(clip.name);
  return names;
}

std::size_t clip_called(const StageDescription& stage, const std::string& name, const std::string& file) {
  const std::vector<std::string> names = clip_names(stage);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  if (names.empty()) throw Faults({file + ": error: there is no clip in it"});
  throw UsageError("there is no clip \"" + name + "\" in " + file + did_you_mean(name, names) + "\n  it has " +
                   listed(names));
}

void take(StageFile& read, const Document& document) {
  read.stage = document.stage();
  read.notes = document.notes();
  read.document = document;
}

StageFile unjudged_file(const std::string& file) {
  StageFile read;
  if (file == "-") {
    const std::optional<std::string> text = read_within(std::cin, largest_document);
    if (!text) throw Faults({"<stdin>: error: is larger than " + std::to_string(largest_document >> 20) + " MiB"});
    take(read, Document::parse(*text, "<stdin>", "."));
    read.name = "stdin";
    return read;
  }
  read.name = std::filesystem::path(file).stem().string();
  read.is_model = is_model_name(file);
  if (read.is_model) {
    Model model = load_model(file);
    for (const std::string& repair : model.repairs)
      read.notes.push_back({.severity = Severity::note, .file = file, .message = repair});
    read.stage = stage_of(std::move(model));
  } else {
    take(read, Document::read(file));
  }
  return read;
}

}  // namespace

bool is_model_name(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::vector<std::string> endings{".glb", ".gltf", ".fbx", ".bvh", ".dae", ".obj"};
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

StageFile read_stage_file(const std::string& file) {
  StageFile read = judged_stage_file(file);
  for (const Problem& note : read.notes) say(note.text());
  return read;
}

StageFile judged_stage_file(const std::string& file) {
  StageFile read = unjudged_file(file);
  if (read.stage.name.empty()) read.stage.name = read.name;
  // Only now it shows whether the parts make a stage that can be stepped and shown.
  Stage stage = make_stage(read.stage, file);
  try {
    check_drawable(record(stage, 0, 1), read.stage);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const RecordingFault& error) {
    if (!read.document || error.node == no_node) throw Faults(faults_of(error, file));
    throw DocumentError({read.document->problem_of_node(error.node, error.reason)}, read.notes);
  } catch (const std::exception& error) {
    throw Faults(faults_of(error, file));
  }
  return read;
}

Stage make_stage(const StageDescription& description, const std::string& file) {
  try {
    return Stage(description);
  } catch (const std::invalid_argument& error) {
    throw Faults(faults_of(error, file));
  }
}

std::size_t choose_clip(const StageDescription& stage, const std::optional<std::string>& name,
                        const std::string& file) {
  if (name) return clip_called(stage, *name, file);
  if (stage.clips.empty()) throw Faults({file + ": error: there is no clip in it"});
  if (stage.clips.size() > 1)
    throw UsageError(file + " has several clips; say which with --clip: " + one_of(clip_names(stage)));
  return 0;
}

void choose_play(StageFile& read, const std::optional<std::string>& name, const std::string& file) {
  StageDescription& stage = read.stage;
  if (name) {
    stage.plays = {Play{.clip = clip_called(stage, *name, file)}};
    stage.graphs.clear();
  } else if (stage.plays.empty() && !stage.clips.empty() && stage.graphs.empty()) {
    if (read.is_model) stage.plays = {Play{.clip = 0}};
    if (stage.clips.size() == 1) return;
    const std::string names = one_of(clip_names(stage));
    say(file +
        ": note: " + (read.is_model ? "\"" + stage.clips[0].name + "\" plays; " : std::string("no clip plays; ")) +
        "choose with --clip: " + names);
  }
}

}  // namespace tweenfall::cli
