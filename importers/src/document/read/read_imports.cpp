#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/importers/model.h>

#include "document/content.h"
#include "document/form.h"
#include "document/read/values.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 1000;
// Files that import others several times grow exponentially.
constexpr std::size_t most_parts = 100'000, most_vertices = 50'000'000;

std::size_t parts_of(const StageDescription& stage) {
  std::size_t parts = stage.nodes.size() + stage.clips.size();
  for (const Clip& clip : stage.clips) parts += clip.tracks.size();
  return parts;
}

std::size_t vertices_of(const StageDescription& stage) {
  std::size_t vertices = 0;
  for (const Mesh& mesh : stage.meshes) vertices += mesh.positions.size();
  return vertices;
}

Brought from_model(Model model) {
  Brought out;
  out.is_model = true;
  for (Node& node : model.nodes) {
    NodeDescription description;
    description.name = std::move(node.name);
    description.parent = node.parent;
    description.rest = node.rest;
    out.stage.nodes.push_back(std::move(description));
  }
  for (ModelBody& body : model.bodies) out.stage.nodes[body.node].body = std::move(body.body);
  out.stage.joints = std::move(model.joints);
  out.stage.clips = std::move(model.clips);
  out.stage.meshes = std::move(model.meshes);
  out.stage.skins = std::move(model.skins);
  out.stage.mesh_instances = std::move(model.instances);
  return out;
}

// Adds nodes, clips and meshes under the import's name, and the joints of a model; rules, plays and the world of a
// document are not imported.
void take(Building& building, const std::string& alias, const Brought& brought) {
  StageDescription& stage = building.stage;
  const std::size_t first_node = stage.nodes.size(), first_mesh = stage.meshes.size(), first_skin = stage.skins.size();
  const auto shift = [](std::size_t index, std::size_t by) { return index == no_node ? no_node : index + by; };
  for (NodeDescription node : brought.names_are_free ? std::vector<NodeDescription>() : brought.stage.nodes) {
    node.name = alias + "/" + node.name;
    node.parent = shift(node.parent, first_node);
    if (!node.group.empty()) node.group = alias + "/" + node.group;
    building.nodes.emplace(node.name, stage.nodes.size());
    stage.nodes.push_back(std::move(node));
  }
  for (Clip clip : brought.stage.clips) {
    clip.name = alias + "/" + clip.name;
    if (brought.names_are_free)
      building.clips_of_others.push_back(clip.name);
    else
      for (Track& track : clip.tracks) track.node = alias + "/" + track.node;
    building.clips.emplace(clip.name, stage.clips.size());
    stage.clips.push_back(std::move(clip));
  }
  for (JointDescription joint : brought.is_model ? brought.stage.joints : std::vector<JointDescription>()) {
    joint.name = alias + "/" + joint.name;
    joint.a = shift(joint.a, first_node);
    joint.b = shift(joint.b, first_node);
    stage.joints.push_back(std::move(joint));
  }
  for (const Mesh& mesh : brought.stage.meshes) stage.meshes.push_back(mesh);
  for (Skin skin : brought.stage.skins) {
    for (std::size_t& joint : skin.joints) joint += first_node;
    stage.skins.push_back(std::move(skin));
  }
  for (MeshInstance instance : brought.stage.mesh_instances) {
    instance.node += first_node;
    instance.mesh += first_mesh;
    instance.skin = shift(instance.skin, first_skin);
    stage.mesh_instances.push_back(instance);
  }
}

// Whether `file` lies below `folder`, following links.
bool is_below(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  // A folder's path may end with an empty part.
  return end == folder.end() || (std::next(end) == folder.end() && end->empty());
}

class Importer {
 public:
  explicit Importer(Building& building) : building_(building) {}

  void read(const json::Member& member) {
    const json::Value& place = member.value;
    std::error_code fault;
    const fs::path given = building_.folder / fs::path(place.text());
    // For a missing file a relative path would stay relative, and not lie in any folder.
    const fs::path base = fs::weakly_canonical(fs::current_path() / building_.folder, fault);
    const fs::path file = fs::weakly_canonical(base / fs::path(place.text()), fault);
    if (fault) return tell(place, json::in_quotes(place.text()) + " is not a valid file path: " + fault.message());
    if (!building_.reading.options.allow_outside && !is_below(file, base))
      return tell(place, json::in_quotes(place.text()) + " lies outside the document's folder; move the file into it");
    if (fs::exists(file, fault) && !fs::is_regular_file(file, fault))
      return tell(place, json::in_quotes(place.text()) + " is not a plain file");
    if (!fs::is_regular_file(file, fault))
      return tell(place,
                  "there is no file " + json::in_quotes(place.text()) + in_folder(file, std::string(place.text())));
    if (std::find(building_.reading.open.begin(), building_.reading.open.end(), file) != building_.reading.open.end())
      return tell(place, json::in_quotes(place.text()) +
                             " imports this document, directly or through others; a file cannot contain itself");
    const std::shared_ptr<const Brought> brought = brought_by(file, given, place);
    if (!brought) return;
    const auto too_many = [&](const char* what, std::size_t most) {
      tell(place, "with " + json::in_quotes(place.text()) + " more than " + std::to_string(most) + " " + what +
                      " would be imported; a file that is imported twice brings all it has twice");
    };
    if (parts_of(building_.stage) + parts_of(brought->stage) > most_parts)
      return too_many("nodes and tracks", most_parts);
    if (vertices_of(building_.stage) + vertices_of(brought->stage) > most_vertices)
      return too_many("vertices", most_vertices);
    take(building_, std::string(member.name), *brought);
    building_.imports.emplace(member.name);
  }

 private:
  void tell(const json::Value& place, std::string message) { building_.problems.add(place, std::move(message)); }

  // The content of the file; null where it has problems, which are reported.
  std::shared_ptr<const Brought> brought_by(const fs::path& file, const fs::path& given, const json::Value& place) {
    std::map<fs::path, std::shared_ptr<const Brought>>& known = building_.reading.brought;
    if (const auto found = known.find(file); found != known.end()) {
      if (!found->second) tell(place, json::in_quotes(place.text()) + " has problems, told where it is imported first");
      return found->second;
    }
    if (known.size() >= most_files) {
      tell(place, "more than " + std::to_string(most_files) + " files are imported in all");
      return nullptr;
    }
    std::shared_ptr<const Brought> brought;
    try {
      brought = std::make_shared<const Brought>(read_file(file, given, place));
    } catch (const DocumentError& error) {
      const std::size_t count = error.problems().size();
      tell(place, json::in_quotes(place.text()) + " has " +
                      (count == 1 ? "a problem" : std::to_string(count) + " problems") + ", told below");
      building_.problems.add_foreign(error.problems());
      building_.problems.add_foreign(error.notes());
    } catch (const ModelError& error) {
      std::string what = error.what();
      std::replace(what.begin(), what.end(), '\n', ';');
      tell(place, what);
    }
    known.emplace(file, brought);
    return brought;
  }

  Brought read_file(const fs::path& file, const fs::path& given, const json::Value& place) {
    if (file.extension() == ".json") {
      ReadDocument document = read_document_file(given, building_.reading);
      building_.problems.add_foreign(document.notes);
      return {std::move(document.stage), document.names_are_free};
    }
    Model model = load_model(given);
    for (const std::string& repair : model.repairs)
      building_.problems.note(place, json::in_quotes(place.text()) + ": " + repair);
    return from_model(std::move(model));
  }

  // The file in that folder that was probably meant, if there is a similar name.
  static std::string in_folder(const fs::path& file, const std::string& written);

  Building& building_;
};

std::string Importer::in_folder(const fs::path& file, const std::string& written) {
  std::error_code fault;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(file.parent_path(), fault), end; !fault && entry != end; entry.increment(fault))
    names.push_back((fs::path(written).parent_path() / entry->path().filename()).generic_string());
  std::sort(names.begin(), names.end());
  const std::string nearest = nearest_name(written, names);
  return nearest.empty() ? std::string() : "; did you mean " + json::in_quotes(nearest) + "?";
}

}  // namespace

void read_imports(Building& building) {
  const json::Value imports = usable(building.root, "import");
  if (!imports) return;
  Importer importer(building);
  for (const json::Member& member : imports.members()) {
    if (is_free_name(member.name) || !member.value.is(json::Value::Kind::text)) continue;
    const std::size_t problems_before = building.problems.size();
    importer.read(member);
    if (building.problems.size() != problems_before) building.failed_imports.emplace(member.name);
  }
}

}  // namespace tweenfall::document
