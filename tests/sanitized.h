// Reports whether a sanitizer checks the product under test. Tests check at run time, because they may have
// been compiled without a sanitizer.
#pragma once

extern "C" {
__attribute__((weak)) void __asan_init();  // NOLINT: the sanitizer's names
__attribute__((weak)) void __tsan_init();
}

namespace understudy {

inline bool is_address_sanitized() { return &__asan_init != nullptr; }
inline bool is_sanitized() { return is_address_sanitized() || &__tsan_init != nullptr; }

/// Returns how many cases a test runs: a fraction of `all` under a sanitizer, because each case is then a
/// dozen times slower.
template <class Count>
Count fewer_if_sanitized(Count all, Count divisor) {
  return is_sanitized() ? all / divisor : all;
}

}  // namespace understudy
