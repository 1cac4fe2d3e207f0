#pragma once

#include <cstddef>

namespace tweenfall::state {

/// Prefetches what will soon be read: if there are more bodies and contacts than fit into the nearest cache, each step
/// reads each of them only once, and would wait for each. Changes nothing.
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
