// tweenfall import: a model's nodes and clips as a document.

#include "files/output_file.h"
#include "files/stage_file.h"
#include "report/counted.h"
#include "report/did_you_mean.h"
#include "report/faults.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>

#include <algorithm>
#include <filesystem>

namespace tweenfall::cli {

namespace {

struct ImportOptions {
  std::string file, output = "-";
};

int import_file(const ImportOptions& options) {
  require_output(options.output, options.file, std::vector<std::string>{".json"});
  if (!is_model_name(options.file))
    throw UsageError("\"" + options.file + "\" is not a model; models end in .glb, .gltf, .fbx, .bvh, .dae or .obj");
  const Model model = load_model(options.file);
  for (const std::string& repair : model.repairs) say(options.file + ": note: " + repair);
  write_output(options.output, Document::from_model(model).text());
  const bool drawn = !model.instances.empty() || !model.meshes.empty();
  if (drawn || !model.bodies.empty())
    say(options.file + ": note: " + (drawn ? "meshes, their skins and colors" : "") +
        (drawn && !model.bodies.empty() ? ", " : "") + (model.bodies.empty() ? "" : "bodies and joints") +
        " stay behind; a document with \"import\": {\"" + model.name + "\": \"" +
        std::filesystem::path(options.file).filename().string() + "\"} beside the model has them too");
  std::vector<std::string> names;
  for (const Clip& clip : model.clips) names.push_back(clip.name);
  std::string shows = counted(model.nodes.size(), "node") + " and " + counted(names.size(), "clip");
  if (!names.empty()) shows += " (" + listed(names) + ")";
  say_written(options.output, shows + " of " + options.file);
  return 0;
}

Run declare_import(Arguments& arguments) {
  auto options = std::make_shared<ImportOptions>();
  arguments.file("MODEL", options->file, "a .glb, .gltf, .fbx, .bvh, .dae or .obj file");
  arguments.output(options->output, "OUT.json", "where to write; standard output without it");
  return [options] { return import_file(*options); };
}

}  // namespace

const Verb import_verb{"import", "turn a model's nodes and clips into a document",
                       "tweenfall import Fox.glb -o fox.json", declare_import};

}  // namespace tweenfall::cli
