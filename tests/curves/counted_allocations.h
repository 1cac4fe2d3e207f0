#pragma once

#include <cstddef>

namespace tweenfall::test {

/// How often memory was asked for so far, in all of the executable.
std::size_t allocations() noexcept;

}  // namespace tweenfall::test
