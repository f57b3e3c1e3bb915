#include "pty/bell.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace understudy::pty {

namespace {

std::atomic<unsigned> rings{0};  // of all bells: a ring for one lets all look once

void ring(int /*signal_number*/) { rings.fetch_add(1, std::memory_order_relaxed); }

/// False if something else has the signal.
bool take_signal() {
  struct sigaction now_there {};
  if (sigaction(SIGIO, nullptr, &now_there) != 0 || (now_there.sa_flags & SA_SIGINFO) != 0) return false;
  if (now_there.sa_handler == ring) return true;
  if (now_there.sa_handler != SIG_DFL) return false;
  struct sigaction ours {};
  ours.sa_handler = ring;
  ours.sa_flags = SA_RESTART;
  sigemptyset(&ours.sa_mask);
  return sigaction(SIGIO, &ours, nullptr) == 0;
}

bool is_blocked_here() {
  sigset_t blocked;
  sigemptyset(&blocked);
  return pthread_sigmask(SIG_SETMASK, nullptr, &blocked) != 0 || sigismember(&blocked, SIGIO) != 0;
}

/// Numbers are not used again, as the kernel's own would be.
unsigned this_thread() {
  static std::atomic<unsigned> last{0};
  thread_local const unsigned number = ++last;
  return number;
}

}  // namespace

bool Bell::has_rung(int descriptor) {
  if (listener_ != this_thread()) {
    listener_ = this_thread();
    hangs_ = hang_up_at(descriptor);
    return true;
  }
  return !hangs_ || heard_ != rings.load(std::memory_order_relaxed);
}

void Bell::answer() { heard_ = rings.load(std::memory_order_relaxed); }

bool Bell::hang_up_at(int descriptor) {
  static const bool is_ours = take_signal();
  if (!is_ours || is_blocked_here()) return false;
  const f_owner_ex owner{.type = F_OWNER_TID, .pid = gettid()};
  const int flags = fcntl(descriptor, F_GETFL);
  return flags >= 0 && fcntl(descriptor, F_SETOWN_EX, &owner) == 0 &&
         fcntl(descriptor, F_SETFL, flags | O_ASYNC) == 0;
}

}  // namespace understudy::pty
