// Measures work in processor time of the calling thread, so that other threads on the same processor do not
// count.
#pragma once

#include <time.h>

#include <chrono>

namespace understudy::benchmarks {

inline std::chrono::nanoseconds processor_time_here() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

}  // namespace understudy::benchmarks
