#pragma once

#include <cstddef>

namespace tweenfall::state {

/// Has what will soon be looked at brought near the processor: of more bodies and contacts than its nearest memory
/// holds each step looks at each only once, and would wait for each. Changes nothing.
template <class Thing>
inline void fetch(const Thing* thing) {
#if defined(__GNUC__)
  constexpr std::size_t line = 64;
  const char* at = reinterpret_cast<const char*>(thing);
  for (std::size_t i = 0; i < sizeof(Thing); i += line) __builtin_prefetch(at + i);
#else
  static_cast<void>(thing);
#endif
}

}  // namespace tweenfall::state
