#pragma once

/// What the verbs read: a document, or a model by its file's ending; both become a stage's description.

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/stage.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::cli {

struct StageFile {
  std::string name;  ///< the file's, without folders and ending, for output beside it
  bool is_model = false;
  StageDescription stage;            ///< named as the file where it has no name of its own
  std::vector<Problem> notes;        ///< of the document, or what was lost of the model
  std::optional<Document> document;  ///< none of a model
};

/// Whether the ending is a model's: .glb, .gltf, .fbx, .bvh, .dae or .obj, in any case.
[[nodiscard]] bool is_model_name(const std::string& file);

/// Reads `file`, "-" being a document on stdin.
/// The one place where files are judged, so that all verbs agree on what is valid.
/// @throws DocumentError, ModelError; Faults when the parts do not make a stage that can be stepped and shown.
[[nodiscard]] StageFile judged_stage_file(const std::string& file);

/// The same with its notes said on stderr.
[[nodiscard]] StageFile read_stage_file(const std::string& file);

/// The stage, ready to run. @throws Faults with everything that does not fit, `file` before it.
[[nodiscard]] Stage make_stage(const StageDescription& description, const std::string& file);

/// The index of the clip called `name`; of the only clip when there is no name.
/// @throws UsageError with the names there are; Faults when there is no clip at all.
[[nodiscard]] std::size_t choose_clip(const StageDescription& stage, const std::optional<std::string>& name,
                                      const std::string& file);

/// Lets the clip called `name` play alone; without a name leaves the plays, but lets a model's first clip play.
void choose_play(StageFile& read, const std::optional<std::string>& name, const std::string& file);

}  // namespace tweenfall::cli
