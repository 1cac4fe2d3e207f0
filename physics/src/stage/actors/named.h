#pragma once

#include <tweenfall/curves/nearest_name.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::staging {

/// @param what  name of the kind, for messages: "vehicle"
/// @throws std::invalid_argument with the nearest name
template <class Actor>
[[nodiscard]] std::size_t index_called(const std::vector<Actor>& actors, std::string_view name, const char* what) {
  std::vector<std::string> names;
  for (const Actor& actor : actors) {
    if (actor.described->name == name) return names.size();
    names.push_back(actor.described->name);
  }
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument(std::string("there is no ") + what + " \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace tweenfall::staging
