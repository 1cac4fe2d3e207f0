#include "document/report/foreign_words.h"

#include <algorithm>
#include <array>
#include <utility>

#include "json/json_tree.h"

namespace tweenfall::document {

namespace {

// Names of our properties in other programs and formats, in lower case without separators; used where our name is
// valid.
constexpr std::pair<std::string_view, std::string_view> words_of_others[] = {
    {"translation", "position"},
    {"translate", "position"},
    {"location", "position"},
    {"pos", "position"},
    {"rot", "rotation"},
    {"rotate", "rotation"},
    {"orientation", "rotation"},
    {"quaternion", "rotation"},
    {"euler", "rotation"},
    {"rotationeuler", "rotation"},
    {"rotationquaternion", "rotation"},
    {"scl", "scale"},
    {"scaling", "scale"},
    {"colour", "color"},
    {"col", "color"},
    {"tint", "color"},
    {"morph", "weights"},
    {"morphs", "weights"},
    {"blendshapes", "weights"},
    {"opacity", "color"},
    {"alpha", "color"},
    {"kinematic", "keyed"},
    {"animated", "keyed"},
    {"scripted", "keyed"},
    {"dynamic", "free"},
    {"physics", "free"},
    {"simulated", "free"},
    {"halfextents", "size"},
    {"extents", "size"},
    {"dimensions", "size"},
    {"size", "half_extents"},
    {"length", "height"},
    {"halfheight", "height"},
    {"k", "stiffness"},
    {"min", "low"},
    {"lower", "low"},
    {"max", "high"},
    {"upper", "high"},
    {"bodies", "between"},
    {"node", "body"},
    {"object", "body"},
    {"other", "with"},
    {"delay", "at"},
    {"starttime", "at"},
    {"start", "at"},
    {"first", "start"},
    {"last", "end"},
    {"keyframes", "keys"},
    {"timescale", "speed"},
    {"playbackrate", "speed"},
    {"repeat", "loop"},
    {"iterations", "count"},
    {"hit", "contact"},
    {"impact", "contact"},
    {"condition", "when"},
    {"trigger", "when"},
    {"lifetime", "life"},
    {"initial", "start"},
    {"initialstate", "start"},
    {"default", "start"},
    {"duration", "fade"},
    {"width", "size"},
    {"depth", "size"},
    {"height", "size"},
    {"stiffness", "hz"},
    {"frequency", "hz"},
    {"damping", "zeta"},
    {"dampingratio", "zeta"},
    {"layer", "groups"},
    {"layers", "groups"},
    {"collisiongroup", "groups"},
    {"collisionlayer", "groups"},
    {"iterationcount", "count"},
    {"repeatcount", "count"},
    {"iterationcount", "loop"},
    {"repeatcount", "loop"},
    {"yoyo", "loop"},
    {"alternate", "loop"},
    {"direction", "loop"},
    {"timingfunction", "ease"},
    {"scene", "nodes"},
    {"joint", "joints"},
    {"constraints", "joints"},
    {"fixeddeltatime", "step"},
    {"loop", "repeat"},
    {"cycle", "repeat"},
    {"infinite", "repeat"},
    {"infinity", "repeat"},
    {"forever", "repeat"},
    {"yoyo", "pingpong"},
    {"mirror", "pingpong"},
    {"alternate", "pingpong"},
    {"pgs", "iterative"},
    {"heun", "trapezoid"},
    {"leapfrog", "verlet"},
    {"symplecticeuler", "semi-implicit-euler"},
    {"impliciteuler", "backward-euler"},
    {"sap", "sweep"},
    {"loc", "position"},
    {"coordinates", "position"},
    {"coords", "position"},
    {"xyz", "position"},
    {"move", "position"},
    {"place", "position"},
    {"origin", "position"},
    {"trans", "position"},
    {"quat", "rotation"},
    {"eulers", "rotation"},
    {"angles", "rotation"},
    {"yaw", "rotation"},
    {"pitch", "rotation"},
    {"roll", "rotation"},
    {"heading", "rotation"},
    {"attitude", "rotation"},
    {"basis", "rotation"},
    {"zoom", "scale"},
    {"stretch", "scale"},
    {"size", "scale"},
    {"dimensions", "scale"},
    {"rgb", "color"},
    {"rgba", "color"},
    {"diffuse", "color"},
    {"albedo", "color"},
    {"emission", "color"},
    {"emissive", "color"},
    {"modulate", "color"},
    {"material", "color"},
    {"fill", "color"},
    {"background", "color"},
    {"transparency", "color"},
    {"weight", "weights"},
    {"morphtarget", "weights"},
    {"morphtargets", "weights"},
    {"morphtargetinfluences", "weights"},
    {"morphweights", "weights"},
    {"blendshape", "weights"},
    {"blendshapeweights", "weights"},
    {"shapekey", "weights"},
    {"shapekeys", "weights"},
    {"keyblocks", "weights"},
    {"influences", "weights"},
};

// Names of single numbers of a property.
constexpr std::pair<std::string_view, std::string_view> parts_of_others[] = {
    {"opacity", "color.a"}, {"alpha", "color.a"},      {"transparency", "color.a"},
    {"left", "position.x"}, {"top", "position.y"},     {"pitch", "rotation.x"},
    {"yaw", "rotation.y"},  {"heading", "rotation.y"}, {"roll", "rotation.z"},
};

// Words before or after such a name that do not change its meaning: Unity's m_LocalScale, Blender's hide_viewport.
constexpr std::array<std::string_view, 21> beside_words = {
    "m",     "local",    "global", "world",   "lcl",      "lossy",      "delta",
    "is",    "self",     "base",   "anchor",  "anchored", "euler",      "axis",
    "angle", "viewport", "render", "degrees", "diffuse",  "background", "material"};

constexpr std::array<std::string_view, 10> words_of_sight = {"visible", "visibility", "hide",    "hidden",    "show",
                                                             "shown",   "display",    "enabled", "invisible", "active"};

constexpr std::size_t longest_word = 64;  // longer names are not misspelled words

bool is_among(std::string_view word, std::span<const std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// "m_LocalScale.x" as "m", "local", "scale", "x"
std::vector<std::string> words_in(std::string_view name) {
  std::vector<std::string> words;
  bool begins = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (std::string_view("-_ .[]").find(c) != std::string_view::npos) {
      begins = true;
      continue;
    }
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital && i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z') begins = true;
    if (begins) words.emplace_back();
    begins = false;
    words.back() += small_letters(std::string_view(&c, 1));
  }
  return words;
}

std::string joined(std::span<const std::string> words) {
  std::string out;
  for (const std::string& word : words) out += word;
  return out;
}

// The words of a name without those that do not change its meaning; all of them if there are no others.
std::vector<std::string> core_of(std::string_view name) {
  std::vector<std::string> words = words_in(name), core;
  for (const std::string& word : words)
    if (!is_among(word, beside_words)) core.push_back(word);
  return core.empty() ? words : core;
}

std::string listed_word(std::string_view plain, std::span<const std::string> names) {
  for (const auto& [foreign, ours] : words_of_others)
    if (plain == foreign && std::find(names.begin(), names.end(), ours) != names.end()) return std::string(ours);
  constexpr std::size_t most_compared = 5000;  // bounds the cost of a hostile file
  for (const std::string& name : names.first(std::min(names.size(), most_compared)))
    if (joined(words_in(name)) == plain) return name;
  return {};
}

// Removes and returns the single letter at the end of "rotateX" and "position[y]"; or empty.
std::string part_of(std::vector<std::string>& core) {
  if (core.size() < 2 || core.back().size() != 1) return {};
  std::string part = core.back();
  core.pop_back();
  return part;
}

}  // namespace

std::string small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

std::string word_of_ours(std::string_view foreign, std::span<const std::string> names) {
  if (foreign.empty() || foreign.size() > longest_word) return {};
  std::string ours = listed_word(joined(words_in(foreign)), names);
  std::vector<std::string> core = core_of(foreign);
  if (ours.empty()) ours = listed_word(joined(core), names);
  if (ours.empty() && !part_of(core).empty()) ours = listed_word(joined(core), names);
  return ours;
}

std::string property_of_ours(std::string_view foreign) {
  static const std::vector<std::string> ours{"position", "rotation", "scale", "color", "weights"};
  if (foreign.empty() || foreign.size() > longest_word) return {};
  std::vector<std::string> core = core_of(foreign);
  for (const auto& [word, number] : parts_of_others)
    if (joined(core) == word) return std::string(number);
  const std::string part = part_of(core);
  const std::string property = part.empty() ? word_of_ours(foreign, ours) : listed_word(joined(core), ours);
  if (part.empty() || property.empty()) return property;
  const std::string_view parts = property == "weights" ? "" : property == "color" ? "rgba" : "xyz";
  return parts.find(part) == std::string_view::npos ? std::string() : property + "." + part;
}

std::string said_of_property(std::string_view foreign, std::string_view node) {
  if (foreign.empty() || foreign.size() > longest_word) return {};
  const auto track = [&](std::string_view property) {
    return json::in_quotes(std::string(node) + "." + std::string(property));
  };
  const std::string word = joined(core_of(foreign));
  if (is_among(word, words_of_sight)) return "nodes are always shown, and " + track("color.a") + " at 0 hides one";
  if (word == "transform" || word == "matrix" || word == "pose")
    return track("position") + ", " + track("rotation") + " and " + track("scale") + " are tracks of their own";
  if (word == "rotationorder") return "a rotation says its \"order\" beside its \"keys\"";
  if (word == "velocity" || word == "linearvelocity" || word == "angularvelocity" || word == "acceleration")
    return "velocities follow from " + track("position") + " and " + track("rotation");
  return {};
}

std::string said_of_field_of_node(std::string_view foreign) {
  if (foreign.empty() || foreign.size() > longest_word) return {};
  const std::string word = joined(core_of(foreign));
  if (is_among(word, words_of_sight)) return "; nodes are always shown, and a \"color\" of \"#fff0\" hides one";
  if (word == "transform" || word == "matrix" || word == "pose" || word == "trs")
    return "; a node has \"position\", \"rotation\" and \"scale\"";
  if (word == "children" || word == "child") return "; each child is a node that names its \"parent\"";
  if (word == "mesh" || word == "geometry" || word == "model" || word == "skin" || word == "file")
    return "; meshes come with models, \"import\": {\"NAME\": \"FILE\"}";
  if (property_of_ours(foreign) == "weights") return "; weights of morphs are a track, \"NODE.weights\"";
  if (word == "name" || word == "id") return "; a node is called as its member of \"nodes\" is";
  return {};
}

std::string said_of_field_of_body(std::string_view foreign) {
  if (foreign.empty() || foreign.size() > longest_word) return {};
  const std::string word = joined(words_in(foreign));
  if (word.find("gravity") != std::string::npos)
    return "; \"gravity\" in \"world\" is that of all bodies, and a \"drive\" may bear a body's weight";
  if (word == "ccd" || word.find("continuous") != std::string::npos || word == "bullet" || word == "isbullet")
    return "; all that is fast is caught on its way";
  if (word.starts_with("lock") || word.starts_with("freeze") || word == "constraints" || word == "fixedrotation")
    return "; what a body cannot do, \"joints\" in \"world\" say: a \"slider\" holds its angles";
  if (word.find("kinematic") != std::string::npos || word == "type" || word == "bodytype")
    return "; a body is moved by its clip, or stands still with \"static\": true, until a \"handoff\" lets it go";
  if (word == "material" || word == "physicsmaterial" || word == "physicmaterial")
    return "; \"friction\" and \"restitution\" are fields of the body itself";
  return {};
}

std::string said_of_field_of_track(std::string_view foreign) {
  constexpr std::array<std::string_view, 7> parts = {"x", "y", "z", "r", "g", "b", "a"};
  constexpr std::array<std::string_view, 6> lists = {"times", "values", "input", "output", "t", "v"};
  constexpr std::array<std::string_view, 6> eases = {"interpolation",  "ease",   "easing",
                                                     "timingfunction", "interp", "curve"};
  if (foreign.empty() || foreign.size() > longest_word) return {};
  const std::string word = joined(words_in(foreign));
  if (is_among(foreign, parts))
    return "; one number alone is a track by its name, as \"NODE.position.x\" or \"NODE.color.a\" are";
  if (is_among(word, lists)) return "; each key has its time and its value, [[time, value], ...]";
  if (is_among(word, eases)) return "; each key says its own ease, [time, value, ease]";
  return {};
}

}  // namespace tweenfall::document
