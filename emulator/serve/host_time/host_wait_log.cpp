#include "emulator/serve/host_time/host_wait_log.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/daemon/kept_waits.h"
#include "emulator/serve/host_time/host_waits.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

namespace {

std::uint64_t sum(const std::vector<std::size_t>& which, const HostWaitLog::Lines& lines,
                  std::uint64_t HostWaitLog::LineCount::*count) {
  return std::accumulate(which.begin(), which.end(), std::uint64_t{0},
                         [&](std::uint64_t all, std::size_t line) { return all + lines[line].*count; });
}

}  // namespace

HostWaitLog::Open HostWaitLog::open_for(const HostWaits::Thread& thread, const Lines& lines,
                                        SimTime now) const {
  const host_time::Message& wait = thread.wait;
  Open open{.until_ns = wait.until_ns, .sequence = wait.sequence, .begin = now, .end = now};
  open.is_check = wait.is_check != 0;
  if (wait.line_count == host_time::kAnyLine) {
    open.lines.resize(lines.size());
    std::iota(open.lines.begin(), open.lines.end(), std::size_t{0});
  } else {
    for (std::uint32_t i = 0; i < std::min(wait.line_count, host_time::kLinesInMessage); ++i) {
      const std::size_t line = line_of_(wait.lines[i]);
      if (line < lines.size()) open.lines.push_back(line);
    }
  }
  open.asked = sum(open.lines, lines, &LineCount::bytes_in);
  open.answered = sum(open.lines, lines, &LineCount::bytes_out);
  const bool is_asked = std::ranges::any_of(
      open.lines, [&](std::size_t line) { return lines[line].bytes_in > answers_[line].bytes_in; });
  const bool has_end = wait.until_ns != host_time::kNever;
  if (wait.is_for_drain != 0) {
    open.kind = Kind::drain;
  } else if (is_asked) {
    open.kind = Kind::reply;
  } else if (!open.lines.empty() && wait.line_count != host_time::kAnyLine) {
    open.kind = Kind::data;
  } else if (wait.is_on_word != 0) {
    open.kind = Kind::thread;
  } else if (has_end && wait.has_others == 0) {
    open.kind = Kind::sleep;
  }
  return open;
}

void HostWaitLog::begin(const HostWaits& waits, const Lines& lines, SimTime now) {
  answers_.resize(lines.size());
  std::map<std::size_t, const HostWaits::Thread*> threads;
  for (const auto& [connection, thread] : waits.threads()) threads.emplace(thread.order, &thread);
  std::map<std::size_t, Open> before = std::exchange(open_, {});
  for (const auto& [order, thread] : threads) {
    if (numbers_.try_emplace(order, next_number_).second) ++next_number_;
    if (thread->state != HostState::waiting) continue;
    Open open = open_for(*thread, lines, now);
    const auto found = before.find(order);
    if (found == before.end()) {
      open_.emplace(order, std::move(open));
      continue;
    }
    const Open& last = found->second;
    // The wait for a reply lasts until the reply is complete; its first bytes do not end the wait.
    const bool is_same_reply =
        last.kind == Kind::reply && (open.kind == Kind::data || open.kind == Kind::other);
    const bool is_same = (open.kind == last.kind || is_same_reply) && open.lines == last.lines &&
                         open.asked == last.asked && last.end == now &&
                         (open.sequence == last.sequence || (open.is_check && last.is_check) ||
                          (open.kind != Kind::sleep && last.until_ns > now.count()));
    if (is_same) {
      open.kind = last.kind;
      open.begin = last.begin;
      open.answered = last.answered;
    } else {
      report(order, last, lines);
    }
    open_.emplace(order, std::move(open));
    before.erase(found);
  }
  for (const auto& [order, last] : before) report(order, last, lines);
  std::erase_if(numbers_, [&](const auto& each) { return !threads.contains(each.first); });
}

void HostWaitLog::end(const Lines& lines, SimTime now) {
  answers_.resize(lines.size());  // a host may have ended without a wait
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].bytes_out != answers_[i].bytes_out) answers_[i] = {lines[i].bytes_out, lines[i].bytes_in};
  }
  for (auto& [order, open] : open_) open.end = now;
}

void HostWaitLog::finish(const Lines& lines) {
  for (const auto& [order, open] : std::exchange(open_, {})) report(order, open, lines);
}

std::vector<HostWait> HostWaitLog::under_way(const HostWaits& waits, const Lines& lines) const {
  std::vector<HostWait> all;
  for (const auto& entry : open_) {
    const std::size_t order = entry.first;
    const Open& open = entry.second;
    if (open.end <= open.begin) continue;
    // A wait is reported when time advances again, so this wait may already have ended.
    const bool still_waits = std::ranges::any_of(waits.threads(), [&](const auto& each) {
      const HostWaits::Thread& thread = each.second;
      return thread.order == order && thread.state == HostState::waiting &&
             thread.wait.sequence == open.sequence;
    });
    all.push_back(wait_of(order, open, lines, !still_waits));
  }
  return all;
}

HostWait HostWaitLog::wait_of(std::size_t thread, const Open& open, const Lines& lines,
                              bool has_ended) const {
  std::string text;
  switch (open.kind) {
    case Kind::reply: text = "waits for a reply"; break;
    case Kind::data: text = "waits for data"; break;
    case Kind::drain: text = "waits until its bytes are sent"; break;
    case Kind::thread: text = "waits for another thread"; break;
    case Kind::sleep: text = "sleeps"; break;
    case Kind::other: text = "waits"; break;
  }
  if (open.lines.size() == 1 && lines.size() > 1) text += " on " + lines[open.lines.front()].name;
  const bool is_in_vain =
      has_ended && open.kind == Kind::reply && sum(open.lines, lines, &LineCount::bytes_out) == open.answered;
  if (is_in_vain) text += " in vain";
  return {.thread = numbers_.at(thread), .begin = open.begin, .end = open.end, .text = text};
}

void HostWaitLog::report(std::size_t thread, const Open& open, const Lines& lines) {
  if (open.end > open.begin) report_(wait_of(thread, open, lines, true));
}

}  // namespace understudy::emulator::serve
