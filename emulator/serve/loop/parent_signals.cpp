#include "emulator/serve/loop/parent_signals.h"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <functional>
#include <system_error>
#include <utility>

#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

ParentSignals::ParentSignals() {
  sigset_t reported;
  sigemptyset(&reported);
  for (const int signal_number : {SIGTERM, SIGINT, SIGHUP, SIGCHLD}) sigaddset(&reported, signal_number);
  descriptor_ = signalfd(-1, &reported, SFD_NONBLOCK | SFD_CLOEXEC);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  sigset_t blocked = reported;
  sigaddset(&blocked, SIGTTOU);  // otherwise, this process would stop when it takes the terminal back
  sigprocmask(SIG_BLOCK, &blocked, &mask_before_);
  pipe_before_ = signal(SIGPIPE, SIG_IGN);
}

ParentSignals::~ParentSignals() {
  restore();
  close(descriptor_);
}

void ParentSignals::watch(EventLoop& loop, std::function<void(int)> on_signal) {
  loop.watch(descriptor_, EventLoop::readable, [this, on_signal = std::move(on_signal)](std::uint32_t) {
    signalfd_siginfo reported;
    while (read(descriptor_, &reported, sizeof reported) == static_cast<ssize_t>(sizeof reported)) {
      on_signal(static_cast<int>(reported.ssi_signo));
    }
  });
}

void ParentSignals::restore() const {
  signal(SIGPIPE, pipe_before_);
  sigprocmask(SIG_SETMASK, &mask_before_, nullptr);
}

}  // namespace understudy::emulator::serve
