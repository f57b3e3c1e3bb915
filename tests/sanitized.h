// Whether the product under test is looked at by a sanitizer. Tests ask when they run: they may have been
// compiled without.
#pragma once

extern "C" {
__attribute__((weak)) void __asan_init();  // NOLINT: their own names
__attribute__((weak)) void __tsan_init();
}

namespace understudy {

inline bool is_address_sanitized() { return &__asan_init != nullptr; }
inline bool is_sanitized() { return is_address_sanitized() || &__tsan_init != nullptr; }

/// Returns how much of something a test does: a fraction of `all` where a sanitizer makes each a dozen times
/// as slow.
template <class Count>
Count fewer_if_sanitized(Count all, Count divisor) {
  return is_sanitized() ? all / divisor : all;
}

}  // namespace understudy
