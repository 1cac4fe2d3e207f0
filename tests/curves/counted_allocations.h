#pragma once

#include <cstddef>

namespace tweenfall::test {

/// How often memory was asked for so far, in all of the executable.
std::size_t allocations() noexcept;
/// How much of it has not been given back, bytes.
std::size_t bytes_held() noexcept;

}  // namespace tweenfall::test
