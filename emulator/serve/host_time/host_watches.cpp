#include "emulator/serve/host_time/host_watches.h"

#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

namespace {

void send_signal(const host_time::Message& watch) {
  if (watch.value == host_time::owner_group) {
    kill(-watch.target, watch.signal);
    return;
  }
  siginfo_t info{};
  info.si_signo = watch.signal;
  info.si_code = SI_SIGIO;
  info.si_fd = static_cast<int>(watch.sequence);
  info.si_band = POLLIN | POLLRDNORM;
  if (watch.value == host_time::owner_thread) {
    syscall(SYS_rt_tgsigqueueinfo, watch.process, watch.target, watch.signal, &info);
  } else {
    syscall(SYS_rt_sigqueueinfo, watch.target, watch.signal, &info);
  }
}

}  // namespace

void HostWatches::set(const host_time::Message& message) {
  const std::pair key{message.process, message.sequence};
  watches_.erase(key);
  if (message.signal > 0) watches_.emplace(key, message);
}

void HostWatches::process_ended(int process) {
  std::erase_if(watches_, [&](const auto& each) { return each.first.first == process; });
}

bool HostWatches::is_watched(int terminal) const {
  return std::any_of(watches_.begin(), watches_.end(),
                     [&](const auto& each) { return each.second.lines[0] == terminal; });
}

bool HostWatches::line_has_news(int terminal) const {
  bool have_been_sent = false;
  for (const auto& [key, watch] : watches_) {
    if (watch.lines[0] != terminal) continue;
    send_signal(watch);
    have_been_sent = true;
  }
  return have_been_sent;
}

}  // namespace understudy::emulator::serve
