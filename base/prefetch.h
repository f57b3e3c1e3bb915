// Prefetches memory that is needed soon. With many devices, a device's state has left the processor's caches
// by the time of its next tick. Requesting it while earlier devices run brings it back in time.
#pragma once

#include <cstddef>

namespace understudy {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// Prefetches the cache line of `address`. Only speed depends on it; any address is allowed.
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
