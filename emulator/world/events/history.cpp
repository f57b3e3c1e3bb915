#include "emulator/world/events/history.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::world {

namespace {

SimTime duration_of(const World& world, const FrameLog::Decoded& frame) {
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    if (world.line(i).line.name() != frame.line) continue;
    return world.line(i).line.options().settings.duration_of(static_cast<std::int64_t>(frame.bytes.size()));
  }
  return SimTime{0};
}

}  // namespace

void History::collect(const World& world, const FrameLog& frames, EventLog& events) {
  for (const FrameLog::Decoded& frame : frames.since(next_frame_, SIZE_MAX)) {
    next_frame_ = frame.number + 1;
    take(world, frame);
  }
  for (Event& event : events.since(next_event_, SIZE_MAX)) {
    next_event_ = event.number + 1;
    // This event only marks the state in which the run begins.
    if (event.what == "restored") continue;
    if (events_.size() == kMaxEvents) {
      events_.pop_front();
      ++dropped_;
    }
    events_.push_back(std::move(event));
  }
}

/// Returns the exchange to which a station's frame belongs, or null.
Exchange* History::request_of(const FrameLog::Decoded& frame) {
  const auto kept = [&](std::uint64_t number) {
    return number < dropped_exchanges_ ? nullptr : &exchanges_[number - dropped_exchanges_];
  };
  if (frame.request) {
    const auto asked = requests_.find(*frame.request);
    Exchange* const exchange = asked == requests_.end() ? nullptr : kept(asked->second);
    // The second copy of a reply is listed separately.
    return exchange != nullptr && exchange->reply.empty() ? exchange : nullptr;
  }
  if (!frame.bytes.empty()) return nullptr;
  // The entry for a fault that acted on a reply has no bytes.
  const auto last = last_requests_.find(frame.line);
  return last == last_requests_.end() ? nullptr : kept(last->second);
}

void History::take(const World& world, const FrameLog::Decoded& frame) {
  const bool is_request = frame.direction == pty::Direction::from_host;
  const SimTime end = frame.time + duration_of(world, frame);
  if (Exchange* const request = is_request ? nullptr : request_of(frame)) {
    Exchange& exchange = *request;
    exchange.end = std::max(exchange.end, end);
    if (!frame.text.empty()) exchange.reply = frame.text;
    if (!frame.remark.empty()) exchange.remark += (exchange.remark.empty() ? "" : "; ") + frame.remark;
    if (frame.latency) exchange.latency = frame.latency;
    exchange.is_refusal = exchange.is_refusal || frame.is_refusal || frame.is_ignored;
    return;
  }
  if (exchanges_.size() == kMaxExchanges) {
    exchanges_.pop_front();
    ++dropped_exchanges_;
    ++dropped_;
  }
  exchanges_.push_back({.line = frame.line,
                        .begin = frame.time,
                        .end = end,
                        .request = is_request ? frame.text : std::string(),
                        .reply = is_request ? std::string() : frame.text,
                        .remark = frame.remark,
                        .is_refusal = frame.is_refusal});
  if (!is_request) return;
  const std::uint64_t number = dropped_exchanges_ + exchanges_.size() - 1;
  last_requests_[frame.line] = number;
  requests_[frame.number] = number;
  if (requests_.size() > kMaxUnanswered) requests_.erase(requests_.begin());
}

}  // namespace understudy::emulator::world
