// Memory that is needed soon. With many devices each one's state has left the processor's caches by the time
// of its next tick; if it is asked for while the devices before it run, it is back in time.
#pragma once

#include <cstddef>

namespace understudy {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// The one line that an address is on. Only speed depends on it; any address will do.
inline void prefetch_line(const void* address) {
  __builtin_prefetch(address, 1);
  // Otherwise the compiler sees a function that only prefetches as one without effect, and drops the calls.
  asm volatile("");
}

inline void prefetch(const void* first, std::size_t bytes) {
  const char* address = static_cast<const char*>(first);
  for (std::size_t i = 0; i < bytes; i += kCacheLine) prefetch_line(address + i);
  if (bytes > 0) prefetch_line(address + bytes - 1);
}

template <typename T>
void prefetch(const T& object) {
  prefetch(&object, sizeof object);
}

}  // namespace understudy
