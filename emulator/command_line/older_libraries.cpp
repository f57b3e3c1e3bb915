// Defines functions that would otherwise require a newer C library than that of Ubuntu 22.04 (glibc 2.35).
#include <sys/random.h>
#include <sys/types.h>

#include <cstdint>

/// The C++ library of g++ 12, which is part of the program, gets random numbers (for example for the live
/// page's websockets) from this function of glibc 2.36. The program's own definition takes precedence.
extern "C" __attribute__((visibility("hidden"))) std::uint32_t arc4random() noexcept {
  std::uint32_t number = 0;
  while (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
    // Only a signal can interrupt this call.
  }
  return number;
}
