#pragma once

// What a message about a wrong name says of the right ones.

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// `"a", "b"` of names, up to 24 of them and how many more there are.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

// The one of `names` that was meant: what other programs' word for it stands for, or the nearest; or nothing.
[[nodiscard]] std::string name_meant(std::string_view wrong, const std::vector<std::string>& names);

// "; did you mean X?", or which names there are, or nothing when there are none.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

// The same where the name that was meant, or that there is none, is known.
[[nodiscard]] std::string suggestion_of(const std::string& meant, const std::vector<std::string>& names);

// The same for nodes and clips, which may be those of an import, by their bare name, or of one that is not there.
[[nodiscard]] std::string suggestion_or_import(std::string_view wrong, const std::vector<std::string>& names);

// "hinge.rotation" for "hinge.rot" or "hinge.rotate"; nothing for a track of ours and for what is near to none.
[[nodiscard]] std::string property_meant(std::string_view track);

// What a track's name may mean that ends in something like a component which is none, after "there is no node ...", or
// nothing.
[[nodiscard]] std::string component_meant(std::string_view track);

}  // namespace tweenfall::document
