#include "emulator/world/fault_watch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"
#include "pty/wire_fault.h"

namespace understudy::emulator::world {

namespace {

using Kind = Fault::Kind;

constexpr int kDeviceBusy = 6;  // the Modbus exception with that name

pty::WireFault stage_of(const Fault& fault) {
  using Stage = pty::WireFault::Kind;
  pty::WireFault stage{.before = fault.before, .after = fault.after};
  switch (fault.kind) {
    case Kind::slow:
    case Kind::delay: stage.kind = Stage::delay; break;
    case Kind::corrupt_checksum: stage.kind = Stage::corrupt_checksum; break;
    case Kind::truncate: stage.kind = Stage::truncate; break;
    case Kind::duplicate: stage.kind = Stage::duplicate; break;
    case Kind::noise: stage.kind = Stage::noise; break;
    case Kind::collision: stage.kind = Stage::collision; break;
    case Kind::split: stage.kind = Stage::split; break;
    default: stage.kind = Stage::drop; break;
  }
  if (stage.kind == Stage::truncate || stage.kind == Stage::split) {
    stage.size = static_cast<std::size_t>(fault.amount);
  } else {
    stage.time = SimTime{fault.amount};
  }
  if (stage.kind == Stage::split) stage.time = time_of(fault.over_ticks);
  return stage;
}

pty::Strike strike_of(std::size_t number, const Fault& fault, bool is_request) {
  const FaultKindRow& row = fault_kind(fault.kind);
  const bool is_other = is_request && !row.effect_on_request.empty();
  return {.fault = number, .kind = row.name, .effect = is_other ? row.effect_on_request : row.effect};
}

/// Returns true if at least part of a reply can be sent immediately in spite of this stage.
bool is_sent_at_once(const pty::WireFault& stage) {
  using Stage = pty::WireFault::Kind;
  return stage.kind != Stage::drop && stage.kind != Stage::delay &&
         ((stage.kind != Stage::truncate && stage.kind != Stage::split) || stage.size > 0);
}

bool is_of_requests(const Fault& fault) {
  return is_of_wire(fault.kind) && !is_of_gateway(fault.kind) &&
         (fault.kind == Kind::slow || fault.side != Fault::Side::reply);
}

bool is_of_replies(const Fault& fault) {
  return is_of_wire(fault.kind) && fault.kind != Kind::slow && fault.side != Fault::Side::request;
}

}  // namespace

std::int64_t encoder_noise_counts(const Fault& fault, Tick tick) {
  const bool is_second_half = fault.period_ticks != 0 && tick % fault.period_ticks >= fault.period_ticks / 2;
  return is_second_half ? -fault.amount : fault.amount;
}

FaultWatch::FaultWatch(World& world, Faults& faults, std::uint64_t seed)
    : world_(world), faults_(faults), seed_(seed), lines_(world.device_count()), probes_(world) {
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    lines_[d].resize(world.device(d).model().line.ports.size(), world.line_count());
  }
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    for (const auto& station : world.line(i).stations) {
      for (std::size_t d = 0; d < world.device_count(); ++d) {
        if (&station->device() == &world.device(d)) lines_[d][station->port()] = i;
      }
    }
  }
  for (const auto& [number, armed] : faults_) {
    const std::string& when = armed.fault.trigger.when;
    if (!when.empty()) conditions_.try_emplace(when, parse_condition(when, probes_));
  }
}

/// Returns false for a condition without a result.
bool FaultWatch::holds(const std::string& expression) {
  try {
    return is_true(conditions_.at(expression), probes_);
  } catch (const ExpressionError&) {
    return false;
  }
}

/// Returns the fault's own random stream, which is independent of other faults.
std::uint64_t FaultWatch::stream(std::size_t number) const { return draw(draw(seed_, 1), number); }

// --- time ----------------------------------------------------------------------------------------

SimTime FaultWatch::next_moment() const {
  if (has_news()) return SimTime{0};
  SimTime next = kForever;
  for (const auto& [number, armed] : faults_) {
    if (is_of_frames(armed.fault.kind) || !waits(armed.fault)) continue;
    next = std::min(next, world::next_moment(armed.fault.trigger, armed.course));
  }
  return next;
}

Tick FaultWatch::next_tick(Tick done) const {
  Tick next = kNever;
  for (const auto& [number, armed] : faults_) {
    const Fault& fault = armed.fault;
    if (is_of_frames(fault.kind)) continue;
    if (waits(fault)) next = std::min(next, next_poll(fault.trigger, armed.course, done));
    if (fault.kind == Kind::encoder_noise && armed.course.in_force && fault.period_ticks != 0) {
      const Tick half = fault.period_ticks / 2;
      next = std::min(next, (done / half + 1) * half);
    }
  }
  return next;
}

void FaultWatch::check(SimTime now, bool is_tick) {
  for (auto& [number, armed] : faults_) {
    auto& [fault, course] = armed;
    if (is_of_frames(fault.kind) || !waits(fault)) continue;
    if (is_tick == is_of_time_alone(fault.trigger)) continue;
    if (!is_tick && world::next_moment(fault.trigger, course) > now) continue;
    const bool was_in_force = course.in_force;
    bool strikes = false;
    if (is_about_frames(fault.trigger)) {
      course.in_force = course.in_force && now < course.until;
    } else {
      strikes = strikes_time(fault.trigger, course, now, *this, stream(number));
    }
    course.is_news =
        course.is_news || (is_done_at_once(fault.kind) ? strikes : course.in_force != was_in_force);
  }
}

bool FaultWatch::has_news() const {
  return std::any_of(faults_.begin(), faults_.end(),
                     [](const auto& entry) { return entry.second.course.is_news; });
}

// --- frames --------------------------------------------------------------------------------------

bool FaultWatch::is_at(const Fault& fault, const ReceivedFrame& frame) const {
  if (!fault.on_line) return fault.device == frame.device;
  return lines_[fault.device][static_cast<std::size_t>(fault.place)] == frame.line;
}

bool FaultWatch::is_hit(std::size_t number, ArmedFault& armed, const ReceivedFrame& frame) {
  const LineProtocol& protocol = world_.line(frame.line).protocol;
  return strikes_frame(armed.fault.trigger, armed.course, protocol.facts_of(frame), *this, stream(number));
}

/// Returns true if the fault affects the request. All stations on a line receive the same request, so this is
/// decided once, when the first station asks.
bool FaultWatch::is_request_hit(std::size_t number, ArmedFault& armed, const ReceivedFrame& frame) {
  FaultCourse& course = armed.course;
  if (!armed.fault.on_line) return frame.is_for_device && is_hit(number, armed, frame);
  if (frame.last_character > course.judged_character) {
    course.judged_character = frame.last_character;
    course.was_hit = is_hit(number, armed, frame);
  }
  return frame.last_character == course.judged_character && course.was_hit;
}

/// Reports effects of faults to the observers of the line. This has no other effect.
void FaultWatch::report(const ReceivedFrame& frame, bool is_reply, bool is_sent,
                        std::span<const pty::Strike> strikes) {
  if (strikes.empty()) return;
  world_.report_strike(frame.line,
                       {.time = frame.now, .is_reply = is_reply, .is_sent = is_sent, .strikes = strikes});
}

bool FaultWatch::is_early(const ReceivedFrame& frame) {
  std::vector<pty::Strike> strikes;
  for (auto& [number, armed] : faults_) {
    if (armed.fault.kind != Kind::early_reply || !is_at(armed.fault, frame)) continue;
    if (is_hit(number, armed, frame)) strikes.push_back(strike_of(number, armed.fault, true));
  }
  report(frame, false, false, strikes);
  return !strikes.empty();
}

std::vector<pty::WireFault> FaultWatch::on_request(const ReceivedFrame& frame) {
  std::vector<pty::WireFault> stages;
  std::vector<pty::Strike> strikes;
  for (auto& [number, armed] : faults_) {
    if (!is_of_requests(armed.fault) || !is_at(armed.fault, frame)) continue;
    // All stations on a line ask about the same request, but it is reported only once.
    const bool is_news = !armed.fault.on_line || frame.last_character > armed.course.judged_character;
    if (!is_request_hit(number, armed, frame)) continue;
    if (is_news) strikes.push_back(strike_of(number, armed.fault, true));
    stages.push_back(stage_of(armed.fault));
    // A dropped request does not reach later stages.
    if (stages.back().kind == pty::WireFault::Kind::drop) break;
  }
  report(frame, false, false, strikes);
  return stages;
}

FrameFaults::Treatment FaultWatch::on_serving(const ReceivedFrame& frame) {
  Treatment treatment;
  std::vector<pty::Strike> strikes;
  for (auto& [number, armed] : faults_) {
    auto& [fault, course] = armed;
    if (!is_at(fault, frame)) continue;
    if (fault.kind == Kind::busy || fault.kind == Kind::exception) {
      if (treatment.exception != 0 || !is_hit(number, armed, frame)) continue;
      treatment.exception = fault.kind == Kind::busy ? kDeviceBusy : static_cast<int>(fault.amount);
      strikes.push_back(strike_of(number, fault, true));
      continue;
    }
    // A fault of a machine or device does not begin again while it is active.
    if (is_of_frames(fault.kind) || !is_about_frames(fault.trigger) || course.in_force) continue;
    if (!is_hit(number, armed, frame)) continue;
    strikes.push_back(strike_of(number, fault, true));
    course.is_news = true;
    if (is_done_at_once(fault.kind)) continue;
    course.in_force = true;
    if (fault.trigger.lasts == SimTime{0}) course.until = kForever;
    if (fault.kind == Kind::power_cut) treatment.is_answered = false;
  }
  report(frame, false, false, strikes);
  return treatment;
}

std::vector<pty::WireFault> FaultWatch::on_reply(const ReceivedFrame& frame) {
  std::vector<pty::WireFault> stages;
  std::vector<pty::Strike> strikes;
  for (auto& [number, armed] : faults_) {
    if (!is_of_replies(armed.fault) || !is_at(armed.fault, frame)) continue;
    if (!is_hit(number, armed, frame)) continue;
    strikes.push_back(strike_of(number, armed.fault, false));
    if (is_of_gateway(armed.fault.kind)) continue;
    stages.push_back(stage_of(armed.fault));
    if (stages.back().kind == pty::WireFault::Kind::drop) break;
  }
  report(frame, true, std::all_of(stages.begin(), stages.end(), is_sent_at_once), strikes);
  return stages;
}

}  // namespace understudy::emulator::world
