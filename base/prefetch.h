// Prefetches memory that is needed soon. If there are many devices, the state of a device is no longer in the
// processor's caches at its next tick. The prefetch loads it while earlier devices run.
#pragma once

#include <cstddef>

namespace understudy {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// Prefetches the cache line of `address`. This affects only speed, and any address is allowed.
inline void prefetch_line(const void* address) {
  __builtin_prefetch(address, 1);
  // Without this statement, the compiler considers a function that only prefetches to have no effect, and
  // drops its calls.
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
