#include "emulator/serve/host_time/host_waits.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

namespace {

bool waits_for_line(const host_time::Message& wait, int terminal) {
  if (wait.line_count == host_time::kAnyLine) return true;
  const std::uint32_t count = std::min(wait.line_count, host_time::kLinesInMessage);
  return std::any_of(wait.lines, wait.lines + count, [&](int line) { return line == terminal; });
}

}  // namespace

void HostWaits::happen(int number, Thread& thread, HostEvent event) {
  const HostStep step = host_step(thread.state, event);
  thread.state = step.next;
  if (step.answer != HostAnswer::nothing) report_(number, step.answer, thread);
}

void HostWaits::on_message(int number, const host_time::Message& message) {
  const auto found = threads_.find(number);
  if (found == threads_.end()) return;
  Thread& thread = found->second;
  switch (message.what) {
    case host_time::MessageKind::hello:
      thread.process = message.process;
      thread.thread = message.thread;
      return happen(number, thread, HostEvent::hello);
    case host_time::MessageKind::wait: thread.wait = message; return happen(number, thread, HostEvent::wait);
    case host_time::MessageKind::cancel:
      thread.wait.sequence = message.sequence;
      return happen(number, thread, HostEvent::cancel);
    case host_time::MessageKind::outside: thread.is_outside = true; return;
    case host_time::MessageKind::inside: thread.is_outside = false; return;
    case host_time::MessageKind::child:
    case host_time::MessageKind::leaves:
    case host_time::MessageKind::stays:
    case host_time::MessageKind::timer:
    case host_time::MessageKind::watch:
    case host_time::MessageKind::go:
    case host_time::MessageKind::cancelled: return;
  }
}

bool HostWaits::time_is(SimTime now) {
  bool has_ended = false;
  for (auto& [number, thread] : threads_) {
    if (thread.state != HostState::waiting || thread.wait.until_ns > now.count()) continue;
    happen(number, thread, HostEvent::time);
    has_ended = true;
  }
  return has_ended;
}

bool HostWaits::happen_on_line(int terminal, bool is_drained) {
  bool has_ended = false;
  for (auto& [number, thread] : threads_) {
    if (thread.state != HostState::waiting || (thread.wait.is_for_drain != 0) != is_drained) continue;
    if (!waits_for_line(thread.wait, terminal)) continue;
    happen(number, thread, HostEvent::line);
    has_ended = true;
  }
  return has_ended;
}

bool HostWaits::line_has_news(int terminal) { return happen_on_line(terminal, false); }

bool HostWaits::line_is_drained(int terminal) { return happen_on_line(terminal, true); }

void HostWaits::process_ended(int process) {
  for (auto& [number, thread] : threads_) {
    if (thread.process == process) happen(number, thread, HostEvent::left);
  }
}

bool HostWaits::is_any_waiting() const {
  return std::any_of(threads_.begin(), threads_.end(),
                     [](const auto& each) { return each.second.state == HostState::waiting; });
}

bool HostWaits::is_any_for_bench() const {
  return std::any_of(threads_.begin(), threads_.end(), [](const auto& each) {
    const host_time::Message& wait = each.second.wait;
    return each.second.state == HostState::waiting &&
           (wait.until_ns != host_time::kNever || wait.line_count != 0);
  });
}

bool HostWaits::is_any_outside() const {
  return std::any_of(threads_.begin(), threads_.end(), [](const auto& each) {
    return each.second.is_outside && each.second.state == HostState::running;
  });
}

std::optional<SimTime> HostWaits::next_end() const {
  std::optional<SimTime> end;
  for (const auto& [number, thread] : threads_) {
    if (thread.state != HostState::waiting || thread.wait.until_ns == host_time::kNever) continue;
    const SimTime until{thread.wait.until_ns};
    if (!end || until < *end) end = until;
  }
  return end;
}

bool HostWaits::is_line_waited_for(int terminal) const {
  return std::any_of(threads_.begin(), threads_.end(), [&](const auto& each) {
    return each.second.state == HostState::waiting && waits_for_line(each.second.wait, terminal);
  });
}

}  // namespace understudy::emulator::serve
