#include "fbx/objects.h"

#include <tweenfall/importers/shown_text.h>

namespace tweenfall::fbx {

namespace {

/// "Model::arm" of a text, "arm\0\1Model" of a binary file: arm.
std::string shown_name(std::string_view given, bool text) {
  const std::size_t mark = given.find(text ? std::string_view("::") : std::string_view("\0\1", 2));
  if (mark != std::string_view::npos) given = text ? given.substr(mark + 2) : given.substr(0, mark);
  given = given.substr(0, given.find('\0'));
  return utf8_or_latin1(given);
}

/// The last record of a property that is listed twice, since each line sets it.
const Record* named_property(const Record* properties, std::string_view name) {
  const Record* found = nullptr;
  if (properties)
    for (const Record& each : properties->children)
      if (each.text(0) == name) found = &each;
  return found;
}

/// A property that is listed twice with different values; empty for none.
std::string_view twice_told(const Record* properties) {
  if (!properties) return {};
  std::unordered_map<std::string_view, const Record*> told;
  for (const Record& each : properties->children)
    if (const auto [before, is_new] = told.emplace(each.text(0), &each);
        !is_new && before->second->values != each.values)
      return each.text(0);
  return {};
}

/// The clock's ticks per second: 46186158000, or 141120000 from version 8 on and where the file says so.
/// Source: Autodesk, FBX SDK, FbxTime; the meaning of TCDefinition as found by ufbx.
double ticks_of(const File& file) {
  bool old = file.version < 8000;
  if (const Record* header = file.root.find("FBXHeaderExtension")) {
    const Record *version = header->find("FBXHeaderVersion"), *flags = header->find("OtherFlags");
    const Record* definition = flags ? flags->find("TCDefinition") : nullptr;
    if (version && version->whole(0, 0) >= 1004 && definition) old = definition->whole(0, 127) == 127;
  }
  return old ? 46186158000.0 : 141120000.0;
}

}  // namespace

Objects::Objects(const File& file, const Source& source, models::ModelProblems& problems)
    : source_(source), version_(file.version), ticks_(ticks_of(file)) {
  if (file.version < 7000)
    source.fail(0, "FBX " + std::to_string(file.version / 1000) + "." + std::to_string(file.version / 100 % 10) +
                       " cannot be read; 7.0 (2011) and later can");
  read_objects(file, problems);
  read_connections(file);
}

void Objects::read_objects(const File& file, models::ModelProblems& problems) {
  std::unordered_map<std::string_view, const Record*> templates;
  if (const Record* definitions = file.root.find("Definitions"))
    for (const Record& type : definitions->children)
      if (const Record* first = type.name == "ObjectType" ? type.find("PropertyTemplate") : nullptr)
        templates.emplace(type.text(0), first->find("Properties70"));
  // Objects attached to nothing else are attached to object 0, the scene.
  objects_.push_back({0, "Scene", "", "", &file.root, nullptr, nullptr});
  by_id_[0] = 0;
  for (const Record& list : file.root.children) {
    if (list.name != "Objects") continue;
    for (const Record& record : list.children) {
      Object object{
          record.whole(0, 0),          record.name, record.text(2), shown_name(record.text(1), source_.text()), &record,
          record.find("Properties70"), nullptr};
      if (object.id == 0) continue;
      const auto defaults = templates.find(object.kind);
      if (defaults != templates.end()) object.defaults = defaults->second;
      if (const std::string_view twice = twice_told(object.properties); !twice.empty())
        problems.repair(source_.place(record.at), "the " + std::string(object.kind) + " \"" + object.name +
                                                      "\" lists \"" + utf8_or_latin1(twice) +
                                                      "\" more than once; the last is used");
      if (by_id_.emplace(object.id, objects_.size()).second)
        objects_.push_back(std::move(object));
      else
        problems.repair(source_.place(record.at), "the " + std::string(object.kind) + " \"" + object.name +
                                                      "\" has the number of another object and was not read");
    }
  }
}

void Objects::read_connections(const File& file) {
  to_.resize(objects_.size());
  from_.resize(objects_.size());
  for (const Record& list : file.root.children) {
    if (list.name != "Connections") continue;
    for (const Record& record : list.children) {
      const std::string_view kind = record.text(0);
      if (kind != "OO" && kind != "OP") continue;
      const auto from = by_id_.find(record.whole(1, -1)), to = by_id_.find(record.whole(2, -1));
      if (from == by_id_.end() || to == by_id_.end()) continue;
      const Connection connection{from->second, to->second, kind == "OP" ? record.text(3) : std::string_view()};
      to_[connection.to].push_back(connections_.size());
      from_[connection.from].push_back(connections_.size());
      connections_.push_back(connection);
    }
  }
}

std::vector<Connection> Objects::listed(const std::vector<std::vector<std::size_t>>& lists, std::size_t object) const {
  std::vector<Connection> found;
  for (const std::size_t index : lists[object]) found.push_back(connections_[index]);
  return found;
}

std::vector<std::size_t> Objects::below(std::size_t object, std::string_view kind, std::string_view form) const {
  std::vector<std::size_t> found;
  for (const std::size_t index : to_[object]) {
    const Connection& each = connections_[index];
    const Object& other = objects_[each.from];
    if (each.property.empty() && other.kind == kind && (form.empty() || other.form == form)) found.push_back(each.from);
  }
  return found;
}

std::vector<std::size_t> Objects::above(std::size_t object, std::string_view kind, std::string_view form) const {
  std::vector<std::size_t> found;
  for (const std::size_t index : from_[object]) {
    const Connection& each = connections_[index];
    const Object& other = objects_[each.to];
    if (each.property.empty() && other.kind == kind && (form.empty() || other.form == form)) found.push_back(each.to);
  }
  return found;
}

const Record* Objects::property(const Object& object, std::string_view name) const {
  const Record* own = named_property(object.properties, name);
  return own ? own : named_property(object.defaults, name);
}

// A property's values come after its name, type, label and flags.
Vec3 Objects::vector(const Object& object, std::string_view name, const Vec3& otherwise) const {
  const Record* p = property(object, name);
  return p ? Vec3(p->number(4, otherwise[0]), p->number(5, otherwise[1]), p->number(6, otherwise[2])) : otherwise;
}

double Objects::number(const Object& object, std::string_view name, double otherwise) const {
  const Record* p = property(object, name);
  return p ? p->number(4, otherwise) : otherwise;
}

std::int64_t Objects::whole(const Object& object, std::string_view name, std::int64_t otherwise) const {
  const Record* p = property(object, name);
  return p ? p->whole(4, otherwise) : otherwise;
}

}  // namespace tweenfall::fbx
