// Waits of no length, such as a poll with timeout 0. They take no time. But a wait ends exactly at its
// timeout here, never a little later as in real time, so a host that waits until a moment is past ("while now
// <= end: poll for end - now") would then check forever. Therefore a thread that checks again and again,
// while nothing else makes time advance, waits a little from some number of checks on: ever longer, so that
// also a clock that counts in seconds moves soon. A line's byte ends such a wait as it ends any other.
#include "pty/host_time/shim.h"

namespace understudy::host_time {

namespace {

constexpr uint32_t kFree = 32;  // checks that take no time: a host may check many things once
constexpr int64_t kShortest_ns = 1'000;
constexpr int64_t kLongest_ns = 1'000'000;
constexpr int64_t kGrowth = 8;  // a check takes this part of the time that the earlier ones took

/// Checks in a row.
struct Checks {
  uint32_t count;
  int64_t spent_ns;
  int64_t end_ns;  // of the last one: if it is not now, something else has made time advance
};
__thread Checks checks __attribute__((tls_model("initial-exec")));

}  // namespace

int64_t length_of_check() {
  const int64_t now = now_ns();
  if (checks.end_ns != now) checks = {0, 0, now};
  if (checks.count < kFree) {
    ++checks.count;
    return 0;
  }
  int64_t length = checks.spent_ns / kGrowth;
  if (length < kShortest_ns) length = kShortest_ns;
  if (length > kLongest_ns) length = kLongest_ns;
  checks.spent_ns += length;
  checks.end_ns = now + length;
  return length;
}

void check_again() {
  const int64_t length = length_of_check();
  if (length == 0) return;
  Wait wait;
  wait.is_check = true;
  wait.until_ns = after(length);
  while (now_ns() < wait.until_ns) {
    if (wait_for(wait) == Woken::by_signal) return;
  }
}

}  // namespace understudy::host_time
