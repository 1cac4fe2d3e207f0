#pragma once

// Small changes that authors, editors and broken transfers make, and some that nobody would.

#include "attack/attack.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tweenfall::attack {

/// A number that programs stumble over: zero, tiny, huge, negative, not a number where `hostile`.
double odd_number(Random& random, bool hostile = false);

/// Some bytes changed, dropped, put in, repeated or moved.
void mutate_bytes(Random& random, std::string& bytes);

/// Some values of a document changed for others, dropped, copied elsewhere, renamed or repeated.
void mutate_structure(Random& random, nlohmann::ordered_json& document);

/// From 0 to below `count`.
inline std::size_t below(Random& random, std::size_t count) {
  return count ? random.bits() % count : 0;
}

}  // namespace tweenfall::attack
