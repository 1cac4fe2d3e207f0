#pragma once

// Small changes that authors, editors and broken transfers make, and some that nobody would.

#include "attack/attack.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tweenfall::attack {

/// A number that programs stumble over: zero, tiny, huge, negative, or not a number if `hostile`.
double odd_number(Random& random, bool hostile = false);

/// Changes, drops, inserts, repeats or moves some bytes.
void mutate_bytes(Random& random, std::string& bytes);

/// Changes some values of a document for others, drops, copies, renames or repeats them.
void mutate_structure(Random& random, nlohmann::ordered_json& document);

/// From 0 to below `count`.
inline std::size_t below(Random& random, std::size_t count) {
  return count ? random.bits() % count : 0;
}

}  // namespace tweenfall::attack
