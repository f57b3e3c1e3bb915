// The part of the debugger that runs at the end of each tick.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/user_program.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/debug/debugger_parts.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kProgramError = "program-error";

std::string text_of_place(const std::string& device, const InstructionPlace& place) {
  std::string text = device;
  if (!place.program.empty()) text += " " + place.program;
  if (place.line != 0) text += " line " + std::to_string(place.line);
  return text + ": " + place.text;
}

}  // namespace

/// A condition without a result counts as true, so that its author learns the reason.
bool Debugger::holds(Point& point, const Probes& probes) {
  point.no_result.clear();
  if (point.condition.code.empty()) return true;
  try {
    return is_true(point.condition, probes);
  } catch (const std::runtime_error& error) {
    point.no_result = error.what();
    return true;
  }
}

std::string Debugger::log_text(const Point& point) const {
  std::string text;
  for (const Point::Piece& piece : point.log) {
    if (const auto* const plain = std::get_if<std::string>(&piece)) {
      text += *plain;
      continue;
    }
    try {
      text += number_text(evaluate(std::get<Expression>(piece), probes_));
    } catch (const std::runtime_error& error) {
      text += std::string("(") + error.what() + ")";
    }
  }
  return text;
}

/// Returns the location of a program of the device: the program with that name, or the first one.
std::optional<ProgramLocation> Debugger::location_of(std::size_t device, const std::string& program) const {
  for (ProgramLocation& place : world_.device(device).user_program()->program_locations()) {
    if (program.empty() || place.program == program) return std::move(place);
  }
  return std::nullopt;
}

bool Debugger::stands(std::size_t number) const {
  const Device& device = world_.device(number);
  const Axes* const axes = device.axes();
  for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
    const int axis = static_cast<int>(a);
    if (!axes->has_axis(axis)) continue;
    if (axes->speed_pps(axis) != 0 || axes->pulses_this_tick(axis) != 0) return false;
  }
  return true;
}

std::vector<Debugger::Sign> Debugger::signs_of_machines() const {
  std::vector<Sign> signs;
  for (std::size_t d = 0; d < world_.device_count(); ++d) {
    const Device& device = world_.device(d);
    for (int axis = 0; axis < static_cast<int>(device.model().axes.size()); ++axis) {
      signs.push_back({.what = "limit", .device = d, .axis = axis, .contact = Contact::lower_limit});
      signs.push_back({.what = "limit", .device = d, .axis = axis, .contact = Contact::upper_limit});
      signs.push_back({.what = "alarm", .device = d, .axis = axis, .contact = Contact::alarm});
    }
    if (device.user_program() != nullptr) signs.push_back({.what = kProgramError, .device = d});
  }
  for (Sign& sign : signs) sign.is_on = shows(sign);
  return signs;
}

bool Debugger::shows(const Sign& sign) const {
  if (sign.what != kProgramError) return world_.plant(sign.device, sign.axis).contact(sign.contact);
  const Device& device = world_.device(sign.device);
  if (!device.powered()) return false;
  const std::vector<ProgramLocation> places = device.user_program()->program_locations();
  return std::any_of(places.begin(), places.end(), [](const ProgramLocation& place) {
    return place.state == ProgramLocation::State::failed;
  });
}

std::string Debugger::text_of(const Sign& sign) const {
  const Device& device = world_.device(sign.device);
  if (sign.what != kProgramError) {
    const std::string which = sign.contact == Contact::lower_limit   ? ": its lower limit"
                              : sign.contact == Contact::upper_limit ? ": its upper limit"
                                                                     : ": its drive's alarm";
    return device.name() + "." + std::string(device.model().axes[static_cast<std::size_t>(sign.axis)].name) +
           which;
  }
  std::string text = device.name();
  for (const ProgramLocation& place : device.user_program()->program_locations()) {
    if (place.state != ProgramLocation::State::failed) continue;
    text += (place.program.empty() ? "" : " " + place.program) + (place.why.empty() ? "" : ": " + place.why);
  }
  return text;
}

/// Adds the signs of machines and programs that are new in this tick, because the event log does not contain
/// them.
void Debugger::check_signs() {
  for (Sign& sign : signs_) {
    const auto waits_for_it = [&](const auto& point) {
      return point->breakpoint.setup.kind == BreakpointSetup::Kind::event &&
             point->breakpoint.setup.name == sign.what;
    };
    if (std::none_of(points_.begin(), points_.end(), waits_for_it)) continue;
    const bool was_on = std::exchange(sign.is_on, shows(sign));
    if (sign.is_on && !was_on) new_events_.push_back({.what = sign.what, .by = {}, .text = text_of(sign)});
  }
}

bool Debugger::waits_for_events() const {
  return std::any_of(points_.begin(), points_.end(), [](const auto& point) {
    return point->breakpoint.setup.kind == BreakpointSetup::Kind::event ||
           point->breakpoint.setup.kind == BreakpointSetup::Kind::write;
  });
}

void Debugger::check_events() {
  new_events_.clear();
  if (!waits_for_events()) return;
  new_events_ = events_.since(next_event_, SIZE_MAX);
  if (!new_events_.empty()) next_event_ = new_events_.back().number + 1;
  check_signs();
}

/// Returns how often the point was hit in this tick.
std::uint64_t Debugger::new_hits(Point& point) {
  const BreakpointSetup& setup = point.breakpoint.setup;
  std::uint64_t hits = 0;
  switch (setup.kind) {
    case BreakpointSetup::Kind::line:
    case BreakpointSetup::Kind::instruction:
      return holds(point, probes_) ? std::exchange(point.ran, 0) : (point.ran = 0);
    case BreakpointSetup::Kind::condition: {
      const bool was_true = std::exchange(point.was_true, holds(point, probes_));
      return point.was_true && !was_true ? 1 : 0;
    }
    case BreakpointSetup::Kind::event:
      for (const Event& event : new_events_) {
        if (event.what != setup.name) continue;
        point.who = !event.text.empty() ? event.text : event.device + " " + event.value;
        ++hits;
      }
      break;
    case BreakpointSetup::Kind::write: {
      const Number now = probes_.value(point.handle);
      const bool has_changed = !(std::exchange(point.value, now) == now);
      bool is_written = false;
      for (const Event& event : new_events_) {
        if (event.what != "write" || event.name != point.written) continue;
        is_written = true;
        if (!setup.by.empty() && setup.by != event.by) continue;
        point.who = event.by + " writes " + event.value;
        ++hits;
      }
      const bool may_be_device = setup.by.empty() || setup.by == "device";
      if (has_changed && !is_written && may_be_device) {
        point.who = "the device changes it to " + number_text(now);
        ++hits;
      }
      break;
    }
  }
  return hits > 0 && holds(point, probes_) ? hits : 0;
}

void Debugger::judge(Point& point) {
  const std::uint64_t hits = new_hits(point);
  if (hits == 0) return;
  point.breakpoint.hits += hits;
  const BreakpointSetup& setup = point.breakpoint.setup;
  if (point.breakpoint.hits < setup.nth) return;
  if (!setup.log.empty()) {
    events_.note({.what = "logpoint",
                  .by = {},
                  .value = std::to_string(point.breakpoint.number),
                  .text = log_text(point)});
    return;
  }
  DebugStop stop{.reason = DebugStop::Reason::breakpoint, .breakpoint = point.breakpoint.number};
  const std::string head = "breakpoint " + std::to_string(point.breakpoint.number) + ": ";
  if (setup.kind == BreakpointSetup::Kind::line || setup.kind == BreakpointSetup::Kind::instruction) {
    stop.device = world_.device(setup.device).name();
    if (const auto place = watches_.at(setup.device)->lines->place(*point.ran_last)) stop.place = *place;
    stop.depth = point.depth;
    stop.text = head + text_of_place(stop.device, stop.place);
  } else if (setup.kind == BreakpointSetup::Kind::condition) {
    stop.text = head + (point.no_result.empty() ? explain(point.condition, probes_) : setup.condition);
  } else {
    stop.text = head + setup.name + (point.who.empty() ? "" : ": " + point.who);
  }
  if (!point.no_result.empty()) stop.text += "; its condition has no result: " + point.no_result;
  stop_with(std::move(stop));
}

/// Returns true if the step's program no longer runs. This check is slow, so it is done only every kApart
/// ticks.
bool Debugger::has_ended(const Step& step) const {
  constexpr Tick kApart = 16;
  if (tick_at(world_.now()) % kApart != 0) return false;
  const auto place = location_of(step.device, step.program);
  if (!place) return true;
  return place->state == ProgramLocation::State::stopped || place->state == ProgramLocation::State::failed;
}

void Debugger::judge_step() {
  Step& step = *step_;
  const Device& device = world_.device(step.device);
  DebugStop stop{.reason = DebugStop::Reason::step, .text = "step: ", .device = device.name()};
  if (!device.powered()) {
    stop.reason = DebugStop::Reason::power;
    stop.text = "step: " + device.name() + " has lost its power";
    return stop_with(std::move(stop));
  }
  if (step.kind == StepKind::stand) {
    if (!stands(step.device)) return;
    stop.text += "the axes of " + device.name() + " are at rest";
    return stop_with(std::move(stop));
  }
  const DeviceWatch& watch = *watches_.at(step.device);
  if (watch.has_changed) {
    stop.reason = DebugStop::Reason::program;
    stop.text = "step: " + device.name() + " has a different program";
    return stop_with(std::move(stop));
  }
  if (!step.end && has_ended(step)) {
    stop.reason = DebugStop::Reason::program;
    stop.text = "step: the program of " + device.name() + " is not running";
    return stop_with(std::move(stop));
  }
  if (!step.end) return;
  if (const auto place = watch.lines->place(*step.end)) stop.place = *place;
  stop.depth = step.depth;
  stop.text += text_of_place(stop.device, stop.place);
  stop_with(std::move(stop));
}

/// Records a stop. Only the first stop in a tick counts.
void Debugger::stop_with(DebugStop stop) {
  stop.time = world_.now();
  events_.note({.what = "stop", .by = {}, .device = stop.device, .text = stop.text});
  if (is_fresh_ && stop_->time == stop.time) return;
  stop_ = std::move(stop);
  is_fresh_ = true;
  world_.stop_here();
}

void Debugger::on_tick(Tick /*tick*/) {
  if (sleeps_) return;
  check_events();
  for (const auto& point : points_) judge(*point);
  if (step_) judge_step();
  for (auto& [number, watch] : watches_) watch->has_changed = false;
  if (stop() == nullptr || !step_) return;
  step_.reset();
  settle();
}

Tick Debugger::next_poll(Tick done) const {
  if (sleeps_) return kNever;
  if (!watches_.empty() || step_) return done + 1;
  if (waits_for_events() && events_.next_number() > next_event_) return done + 1;
  Tick next = kNever;
  for (const auto& point : points_) {
    next = std::min(next, probes_.next_change(point->condition, done));
    if (point->breakpoint.setup.kind == BreakpointSetup::Kind::write)
      next = std::min(next, probes_.next_change(point->handle, done));
  }
  return next;
}

}  // namespace understudy::emulator::world
