#pragma once

// The parts of messages about wrong names that suggest the right ones.

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// `"a", "b"`: up to 24 names, and how many more there are.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

// The one of `names` that was probably meant: by a word of other programs, or the nearest; or empty.
[[nodiscard]] std::string name_meant(std::string_view wrong, const std::vector<std::string>& names);

// "; did you mean X?", or which names there are, or empty when there are none.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

// The same with the name that was meant, or none, already known.
[[nodiscard]] std::string suggestion_of(const std::string& meant, const std::vector<std::string>& names);

// The same for nodes and clips, which may come from an import, written without its name, or from a missing import.
[[nodiscard]] std::string suggestion_or_import(std::string_view wrong, const std::vector<std::string>& names);

// "hinge.rotation" for "hinge.rot" or "hinge.rotate"; empty for a known track and for names similar to none.
[[nodiscard]] std::string property_meant(std::string_view track);

// The meaning of a track's name with an invalid component at its end, for use after "there is no node ...", or
// empty.
[[nodiscard]] std::string component_meant(std::string_view track);

}  // namespace tweenfall::document
