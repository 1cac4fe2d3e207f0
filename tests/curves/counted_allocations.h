#pragma once

#include <cstddef>

namespace tweenfall::test {

/// How often memory was allocated so far, in the whole executable.
std::size_t allocations() noexcept;
/// How much of it has not been freed, bytes.
std::size_t bytes_held() noexcept;

}  // namespace tweenfall::test
