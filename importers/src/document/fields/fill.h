#pragma once

// What a play shows before its start and after its end.

#include <tweenfall/anim/play.h>

#include "document/fields/table.h"

namespace tweenfall::document::fields {

/// @param name  of the field
template <class Thing, class Access>
[[nodiscard]] Row<Thing> filling(std::string name, Access access) {
  std::vector<std::pair<std::string, Fill>> words;
  words.reserve(std::size(fill_words));
  for (const std::string_view word : fill_words) words.emplace_back(word, static_cast<Fill>(words.size()));
  Row<Thing> row = one_of<Thing, Fill>(std::move(name), "a way to fill", std::move(words),
                                       "what shows of it outside its time: its first frame before, its last after, "
                                       "both or none; \"yielding\": both, the first where nothing below moves the node",
                                       access);
  row.elsewhere = {"fill_mode", "extrapolation"};
  return row;
}

}  // namespace tweenfall::document::fields
