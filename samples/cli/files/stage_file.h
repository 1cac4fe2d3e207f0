#pragma once

/// What the verbs read: a document, or a model (known by the file's ending); both become a stage's description.

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/stage.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::cli {

struct StageFile {
  std::string name;  ///< the file's name, without folders and ending, for output beside it
  bool is_model = false;
  StageDescription stage;            ///< named after the file if it has no name of its own
  std::vector<Problem> notes;        ///< of the document, or what was lost of the model
  std::optional<Document> document;  ///< empty for a model
};

/// Whether the ending is a model's: .glb, .gltf, .fbx, .bvh, .dae or .obj, in any case.
[[nodiscard]] bool is_model_name(const std::string& file);

/// Reads `file`; "-" is a document on stdin.
/// The only place where files are validated, so that all verbs agree on what is valid.
/// @throws DocumentError, ModelError; Faults if the parts do not make a stage that can be stepped and shown.
[[nodiscard]] StageFile judged_stage_file(const std::string& file);

/// The same, and prints its notes on stderr.
[[nodiscard]] StageFile read_stage_file(const std::string& file);

/// The stage, ready to run. @throws Faults with everything that does not fit, each preceded by `file`.
[[nodiscard]] Stage make_stage(const StageDescription& description, const std::string& file);

/// The index of the clip called `name`; without a name, that of the only clip.
/// @throws UsageError with the existing names; Faults if there is no clip at all.
[[nodiscard]] std::size_t choose_clip(const StageDescription& stage, const std::optional<std::string>& name,
                                      const std::string& file);

/// Makes the clip called `name` play alone; without a name keeps the plays, but lets a model's first clip play.
void choose_play(StageFile& read, const std::optional<std::string>& name, const std::string& file);

}  // namespace tweenfall::cli
