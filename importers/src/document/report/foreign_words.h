#pragma once

// Names of our fields and properties in other programs: Blender, Maya, Unity, Unreal, Godot, three.js, CSS, glTF, FBX.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// A to Z as a to z.
[[nodiscard]] std::string small_letters(std::string_view text);

// The one of `names` that such a word means: "position" for "location", "localPosition" or "Lcl Translation"; or
// empty.
[[nodiscard]] std::string word_of_ours(std::string_view foreign, std::span<const std::string> names);

// The property of a node, or one number of it, that such a word means: "rotation.x" for "rotateX", "color.a" for
// "opacity"; or empty.
[[nodiscard]] std::string property_of_ours(std::string_view foreign);

// What to use instead of such a word where we have no such property or field; or empty.
[[nodiscard]] std::string said_of_property(std::string_view foreign, std::string_view node);
[[nodiscard]] std::string said_of_field_of_node(std::string_view foreign);
[[nodiscard]] std::string said_of_field_of_body(std::string_view foreign);
[[nodiscard]] std::string said_of_field_of_track(std::string_view foreign);

}  // namespace tweenfall::document
