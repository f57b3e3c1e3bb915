// Reports whether a sanitizer checks the product under test. Tests ask at run time, because they may have
// been compiled without one.
#pragma once

extern "C" {
__attribute__((weak)) void __asan_init();  // NOLINT: their own names
__attribute__((weak)) void __tsan_init();
}

namespace understudy {

inline bool is_address_sanitized() { return &__asan_init != nullptr; }
inline bool is_sanitized() { return is_address_sanitized() || &__tsan_init != nullptr; }

/// Returns how much of something a test does: a fraction of `all` under a sanitizer, which makes each case a
/// dozen times as slow.
template <class Count>
Count fewer_if_sanitized(Count all, Count divisor) {
  return is_sanitized() ? all / divisor : all;
}

}  // namespace understudy
