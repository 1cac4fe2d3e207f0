#pragma once

#include <tweenfall/physics/stage/description.h>

#include <cstdint>

namespace tweenfall::staging {

/// A number by which two descriptions of a stage are told apart: of all that tells on how it runs.
[[nodiscard]] std::uint64_t fingerprint(const StageDescription& description);

}  // namespace tweenfall::staging
