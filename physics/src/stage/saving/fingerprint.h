#pragma once

#include <tweenfall/physics/stage/description.h>

#include <cstdint>

namespace tweenfall::staging {

/// A number that tells two descriptions of a stage apart, from everything that affects how it runs.
[[nodiscard]] std::uint64_t fingerprint(const StageDescription& description);

}  // namespace tweenfall::staging
