// A bell that the kernel rings in the thread that listens to it: whether a descriptor may have something to
// read, known without a system call.
#pragma once

namespace understudy::pty {

/// What was there before a system call of this thread had its effect has rung when that call returns: the
/// kernel interrupts the thread (SIGIO) as soon as it goes on. A signal interrupts waiting: epoll_wait() and
/// the like then return early.
class Bell {
 public:
  /// Whether the descriptor may have something since it was last answered. Always, where there is no bell:
  /// the first time in each thread, and where the signal is somebody else's.
  bool has_rung(int descriptor);
  /// To be called before the descriptor is read to its end.
  void answer();

 private:
  bool hang_up_at(int descriptor);

  bool hangs_ = false;
  unsigned listener_ = 0;  // the thread; 0: none yet
  unsigned heard_ = 0;     // how many rings
};

}  // namespace understudy::pty
