#include "emulator/serve/host_time/host_timers.h"

#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

void HostTimers::set(const host_time::Message& message, Descriptor counter) {
  const std::pair key{message.process, message.sequence};
  timers_.erase(key);
  if (message.until_ns == host_time::kNever) return;
  const Expired notice{message.process, message.target, message.signal, message.value};
  timers_.emplace(key,
                  Timer{SimTime{message.until_ns}, SimTime{message.interval_ns}, notice, std::move(counter)});
}

void HostTimers::process_ended(int process) {
  std::erase_if(timers_, [&](const auto& each) { return each.first.first == process; });
}

std::optional<SimTime> HostTimers::next() const {
  std::optional<SimTime> next;
  for (const auto& [key, timer] : timers_) {
    if (!next || timer.next < *next) next = timer.next;
  }
  return next;
}

std::vector<HostTimers::Expired> HostTimers::expire(SimTime now) {
  std::vector<Expired> expired;
  for (auto it = timers_.begin(); it != timers_.end();) {
    Timer& timer = it->second;
    if (timer.next > now) {
      ++it;
      continue;
    }
    expired.push_back(timer.notice);
    std::uint64_t count = 1;
    if (timer.interval > SimTime{0}) count += static_cast<std::uint64_t>((now - timer.next) / timer.interval);
    // The counter cannot overflow: that would take 2^64 unread expirations.
    if (timer.counter) [[maybe_unused]]
      const ssize_t size = write(timer.counter.get(), &count, sizeof count);
    timer.next += timer.interval * static_cast<std::int64_t>(count);
    it = timer.interval > SimTime{0} ? std::next(it) : timers_.erase(it);
  }
  return expired;
}

void send_signal(const HostTimers::Expired& expired) {
  if (expired.signal_number <= 0) return;
  siginfo_t info{};
  info.si_signo = expired.signal_number;
  info.si_code = SI_TIMER;
  info.si_value.sival_ptr = reinterpret_cast<void*>(static_cast<std::intptr_t>(expired.value));
  if (expired.target > 0) {
    syscall(SYS_rt_tgsigqueueinfo, expired.process, expired.target, expired.signal_number, &info);
  } else {
    syscall(SYS_rt_sigqueueinfo, expired.process, expired.signal_number, &info);
  }
}

}  // namespace understudy::emulator::serve
