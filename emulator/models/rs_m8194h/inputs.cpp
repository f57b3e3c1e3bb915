// What comes in: pins with their filters, the bench's switches, external drives, the FRnet scan.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/machine_edges.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "motion/axis.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"
#include "motion/external_drive.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// Whole ticks by which a filter delays, by FLn; those below 1.024 ms do not show (3.14).
constexpr std::array<Tick, 8> kFilterTicks{0, 0, 0, 1, 2, 4, 8, 16};
/// The bit of FEn that filters a pin, in the order of Pin.
constexpr std::array<std::uint8_t, kPinsOfAxis> kFilterBits{0, 0, 0, 0, 1, 4, 3, 3, 2, 2};

/// The scan takes 2.88 ms (1.1): counted in units of 10 us.
constexpr Tick kScanUnits = 288;
constexpr Tick kTickUnits = 100;

Tick filter_ticks(const AxisUnit& unit, int pin, const MachineOptions& options) {
  const bool filters =
      options.filters_delay && (unit.basic.filtered >> kFilterBits[static_cast<std::size_t>(pin)] & 1) != 0;
  if (!filters) return 0;
  return std::max<Tick>(kFilterTicks[unit.basic.filter_time], options.short_filters_take_a_tick ? 1 : 0);
}

/// A pin that tells the chip something, and the setting of its active level.
struct PinFunction {
  Pin pin;
  motion::Signal signal;
};
constexpr PinFunction kFunctions[] = {
    {Pin::limit_plus, motion::Signal::limit_plus},
    {Pin::limit_minus, motion::Signal::limit_minus},
    {Pin::near_home, motion::Signal::near_home},
    {Pin::home, motion::Signal::home},
    {Pin::index, motion::Signal::index},
    {Pin::in3, motion::Signal::mark},
    {Pin::in_position, motion::Signal::in_position},
    {Pin::alarm, motion::Signal::alarm},
};

/// Whether a pin is active while on; nothing where it is not looked at.
std::optional<bool> active_while_on(const BasicSettings& basic, Pin pin, const MachineOptions& options) {
  switch (pin) {
    case Pin::limit_plus: return basic.forward_limit_level == 0;
    case Pin::limit_minus: return basic.reverse_limit_level == 0;
    case Pin::near_home: return basic.near_home_level == 0;
    case Pin::home: return basic.home_level == 0;
    case Pin::index: return basic.index_level == 0;
    case Pin::in3: return options.in3_rises_when_it_closes;  // else the line's level: high while off
    case Pin::in_position: return basic.in_position_level == 0;
    case Pin::alarm: return basic.alarm ? std::optional(basic.alarm_level == 0) : std::nullopt;
    case Pin::external_plus:
    case Pin::external_minus: break;
  }
  return std::nullopt;
}

}  // namespace

bool Module::is_filtering(const AxisUnit& unit) const {
  return unit.pins.raw != unit.pins.passed || unit.emergency != state_.emergency_input;
}

void Module::pass_pins(Tick tick) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    for (int i = 0; i < kPinsOfAxis; ++i) {
      const auto pin = static_cast<Pin>(i);
      const std::int32_t level = input(terminal(a, pin));
      // Counted inputs change with each edge.
      const bool is_counted = pin == Pin::external_plus || pin == Pin::external_minus;
      const bool is_on = is_counted ? (level & 1) != 0 : level != 0;
      const std::uint16_t bit = bit_of(pin);
      if (((unit.pins.raw & bit) != 0) != is_on) {
        unit.pins.raw ^= bit;
        unit.pins.since[static_cast<std::size_t>(i)] = tick;
      }
      const bool differs = ((unit.pins.raw ^ unit.pins.passed) & bit) != 0;
      if (differs && tick - unit.pins.since[static_cast<std::size_t>(i)] >= filter_ticks(unit, i, machine_)) {
        unit.pins.passed ^= bit;
      }
    }
  }
  const bool is_emergency = (input(kEmergencyPin) != 0) != machine_.emergency_while_off;
  if (is_emergency != state_.emergency_input) state_.emergency_since = tick;
  state_.emergency_input = is_emergency;
  // Each axis has its own filter for it, that of its limits and home.
  for (AxisUnit& unit : state_.units) {
    const Tick delay = filter_ticks(unit, static_cast<int>(Pin::limit_plus), machine_);
    if (tick - state_.emergency_since >= delay) unit.emergency = is_emergency;
  }
  state_.holds_back = std::any_of(state_.units.begin(), state_.units.end(),
                                  [this](const AxisUnit& unit) { return is_filtering(unit); });
}

/// What the motor meets: where an input changes with the place, zones; else its level.
void Module::update_environment(std::size_t axis) {
  const AxisUnit& unit = state_.units[axis];
  const MachineEdges& edges = edges_[axis];
  motion::Environment found;
  for (const PinFunction& function : kFunctions) {
    const auto active = active_while_on(unit.basic, function.pin, machine_);
    if (!active) continue;
    const int number = terminal(axis, function.pin);
    const bool is_filtered = filter_ticks(unit, static_cast<int>(function.pin), machine_) > 0;
    if (const MachineEdges::Span* const span = is_filtered ? nullptr : edges.span_of(number)) {
      const bool is_inside = span->level_inside == *active;
      (is_inside ? found.add(function.signal, span->first, span->last, span->slack)
                 : found.add_outside(function.signal, span->first, span->last, span->slack));
    } else if (!is_filtered && edges.index.period != 0 && edges.index.input == number) {
      const MachineEdges::Index& index = edges.index;
      const bool is_inside = index.level_inside == *active;
      found.index_period = index.period;
      found.index_at = is_inside ? index.at : index.at + index.width;
      found.index_width = is_inside ? index.width : index.period - index.width;
      found.index_from = index.first;
      found.index_to = index.last;
    } else {
      found.set_steady(function.signal, ((unit.pins.passed & bit_of(function.pin)) != 0) == *active);
    }
  }
  found.set_steady(motion::Signal::emergency, unit.emergency);
  auto machine = edges.encoder.as<motion::EncoderLine>();
  machine.factor = machine_.edges_per_encoder_count;
  if (machine.is_known()) found.encoder = encoder_line(unit, machine);
  motion::Environment& environment = state_.environment[axis];
  found.version = environment.version;
  if (found == environment) return;
  ++found.version;
  environment = found;
}

void Module::rearm(std::size_t axis) {
  const AxisUnit& unit = state_.units[axis];
  motion::Events asked = state_.sync.triggers[axis].factors;
  constexpr motion::Event kEvents[kIsrFactors] = {motion::Event::pulse,
                                                  motion::Event::comparator_3,
                                                  motion::Event::comparator_2,
                                                  motion::Event::comparator_1,
                                                  motion::Event::comparator_0,
                                                  motion::Event::constant_ended,
                                                  motion::Event::constant_started,
                                                  motion::Event::ended};
  for (std::size_t i = 0; i < kIsrFactors; ++i) {
    const bool is_asked = machine_.all_factors_are_noted || (unit.factors >> i & 1) != 0;
    if (is_asked) asked |= motion::bit(kEvents[i]);
  }
  // A scan has C+ for itself (7.4.12).
  const LineScan& scan = state_.scans[axis];
  constexpr motion::Events kOfPlus =
      motion::bit(motion::Event::comparator_0) | motion::bit(motion::Event::comparator_1);
  if (scan.set) asked &= static_cast<motion::Events>(~kOfPlus);
  arm(unit, state_.motors[axis], asked, machine_.axis);
  update_environment(axis);
}

/// More edges in a tick than the chip counts (4 MHz) are the last of them.
constexpr std::uint32_t kMaxEdgesPerTick = 8'000;

/// How many edges an input has had since it was looked at, whichever way its count was turned.
std::uint32_t Module::external_edges(std::size_t axis, std::size_t which) {
  AxisUnit& unit = state_.units[axis];
  const Pin pin = which == 0 ? Pin::external_plus : Pin::external_minus;
  const auto count = static_cast<std::uint32_t>(input(terminal(axis, pin)));
  const std::uint32_t turned = count - unit.external_seen[which];
  std::uint32_t edges = std::min(turned, 0U - turned);
  if (edges > kMaxEdgesPerTick) edges = kMaxEdgesPerTick - (edges & 1U);
  unit.external_seen[which] = count;
  if (filter_ticks(unit, static_cast<int>(pin), machine_) > 0) {
    // Through its filter: what is too short is lost, the rest comes late.
    const bool was_high = which == 0 ? unit.external.plus_high : unit.external.minus_high;
    const bool is_high = (unit.pins.passed & bit_of(pin)) == 0;
    edges = was_high != is_high ? 1 : 0;
    // What it holds back is an edge to come, should it be taken off.
    if (((count & 1U) == 0) != is_high) --unit.external_seen[which];
  }
  // While off nothing but the level at the end matters.
  if (unit.external.mode == motion::ExternalDrive::Mode::off && edges > 1) edges = 2 - (edges & 1U);
  return edges;
}

/// The edges of a tick lie evenly in it, those of one input between those of the other.
void Module::watch_external(std::size_t axis, Tick tick) {
  AxisUnit& unit = state_.units[axis];
  const std::array<std::uint32_t, 2> edges{external_edges(axis, 0), external_edges(axis, 1)};
  std::array<std::uint32_t, 2> done{};
  while (done[0] < edges[0] || done[1] < edges[1]) {
    const auto place = [&](std::size_t i) { return std::int64_t{done[i]} * 2 + 1; };  // of 2 * edges[i]
    const bool is_plus =
        done[1] == edges[1] || (done[0] < edges[0] && place(0) * edges[1] <= place(1) * edges[0]);
    const std::size_t i = is_plus ? 0 : 1;
    const std::int64_t half_ns = kTickLength.count() / (std::int64_t{edges[i]} * 2);
    std::int64_t at_ns = time_of(tick).count() + half_ns * place(i);
    ++done[i];
    // Beside edges of the other input nobody knows its time so well.
    const std::int64_t most_ns = edges[0] != 0 && edges[1] != 0 ? half_ns : 0;
    at_ns = std::clamp(unit.external_free_ns, at_ns, at_ns + most_ns);
    // A line is high while it does not conduct; each edge turns it over.
    const bool plus = is_plus ? !unit.external.plus_high : unit.external.plus_high;
    const bool minus = is_plus ? unit.external.minus_high : !unit.external.minus_high;
    const bool is_busy = is_driving(axis) && !is_free_for_external(axis, at_ns);
    obey_external(axis, motion::watch_inputs(unit.external, plus, minus, is_busy), at_ns);
  }
}

/// Whether it only drives because drives end at ticks: the pulses of its last edge are out by then.
bool Module::is_free_for_external(std::size_t axis, std::int64_t at_ns) const {
  const AxisUnit& unit = state_.units[axis];
  const motion::Axis& motor = state_.motors[axis];
  const bool is_its = unit.external_free_ns != 0 && activity(axis) == Activity::single;
  return is_its && !motor.slowing && !motor.settling && at_ns >= unit.external_free_ns;
}

void Module::obey_external(std::size_t axis, const motion::DriveOrder& order, std::int64_t at_ns) {
  using What = motion::DriveOrder::What;
  AxisUnit& unit = state_.units[axis];
  if (order.what == What::nothing) return;
  if (order.what == What::slow_down) {
    if (activity(axis) == Activity::single) state_.motors[axis].slow_down(now());
    return;
  }
  const bool waits = order.what == What::move && is_free_for_external(axis, at_ns);
  if (waits) unit.external_waiting += order.pulses;
  if (!waits && !start_external(axis, order)) return;
  if (order.what == What::run) return;
  const double pulses = std::abs(static_cast<double>(order.pulses));
  unit.external_free_ns = after(at_ns, motion::plan(pulses, external_law(axis)).duration_s);
}

motion::SpeedLaw Module::external_law(std::size_t axis) const {
  motion::SpeedLaw law = law_of(axis);
  if (chose(option("exd_speed", "v_without_ramps"))) law.start_speed_u_s = law.top_speed_u_s;
  return law;
}

/// Whether it has begun.
bool Module::start_external(std::size_t axis, const motion::DriveOrder& order) {
  AxisUnit& unit = state_.units[axis];
  unit.external.running = 0;
  if (may_start(axis, Starter::external) != Start::starts) {
    note_obstacles(mask_of(axis));
    return false;
  }
  const bool is_run = order.what == motion::DriveOrder::What::run;
  const auto speed = static_cast<std::int32_t>(std::min<std::uint32_t>(unit.external_pps, INT32_MAX));
  const std::uint32_t drive_pps = unit.speed.drive_pps;  // the input's speed does not replace V
  start(axis,
        {.what = is_run ? Drive::What::endless : Drive::What::fixed,
         .value = is_run ? order.direction * speed : static_cast<std::int32_t>(order.pulses)},
        chose(option("exd_speed", "v_without_ramps")));
  unit.speed.drive_pps = drive_pps;
  const bool has_begun = activity(axis) == Activity::single;
  if (is_run && has_begun) unit.external.running = order.direction;
  return has_begun;
}

/// What has waited for the tick in which the pulses before it were over. A drive that something else has
/// ended has nothing behind it.
void Module::start_waiting_external() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    if (unit.external_free_ns == 0 || is_driving(a)) continue;
    const std::int64_t free_ns = std::exchange(unit.external_free_ns, 0);
    const std::int64_t waiting = std::exchange(unit.external_waiting, 0);
    if (waiting == 0 || state_.motors[a].cause != motion::Cause::arrived) continue;
    const bool begins = start_external(a, {.what = motion::DriveOrder::What::move, .pulses = waiting});
    if (begins) unit.external_free_ns = free_ns;
  }
}

void Module::set_external(std::size_t axis, motion::ExternalDrive::Mode mode, std::uint32_t data) {
  using Mode = motion::ExternalDrive::Mode;
  AxisUnit& unit = state_.units[axis];
  motion::Axis& motor = state_.motors[axis];
  const bool was_running = unit.external.running != 0;
  unit.external.mode = mode;
  unit.external.pulses = data;
  unit.external_pps = data;
  if (!was_running) return;
  if (mode == Mode::continuous) {
    // Another speed of what runs, which its input still stops.
    motion::SpeedLaw law = motor.law;
    law.top_speed_u_s = law_at(unit, data, machine_.speed).top_speed_u_s;
    law.start_speed_u_s = std::min(law.start_speed_u_s, law.top_speed_u_s);
    motor.change_speed(law, now());
    return;
  }
  unit.external.running = 0;
  const bool ends = activity(axis) == Activity::single && chose(option("exd_disable", "slows_down"));
  if (ends) motor.slow_down(now());
}

bool Module::scans_frnet_at(Tick tick) const {
  if (machine_.frnet_every_tick) return true;
  const Tick since = tick - state_.powered_at;
  if (since <= 0) return false;
  const Tick in_round = (since - 1) % kScanUnits + 1;  // as many ticks as a scan has units: whole scans
  return in_round * kTickUnits / kScanUnits > (in_round - 1) * kTickUnits / kScanUnits;
}

Tick Module::next_scan(Tick after) const {
  for (Tick tick = std::max(after, state_.powered_at) + 1;; ++tick) {
    if (scans_frnet_at(tick)) return tick;
  }
}

std::array<std::uint16_t, kFrnetGroups> Module::frnet_inputs() const {
  std::array<std::uint16_t, kFrnetGroups> words{};
  for (int group = 0; group < kFrnetGroups; ++group) {
    std::uint16_t word = 0;
    for (int channel = 0; channel < kFrnetChannels; ++channel) {
      const bool is_on = input(kFirstDi + group * kFrnetChannels + channel) != 0;
      if (is_on) word |= static_cast<std::uint16_t>(1U << channel);
    }
    words[static_cast<std::size_t>(group)] = word;
  }
  return words;
}

void Module::scan_frnet() {
  state_.sent = state_.outputs;
  if (state_.unscanned) state_.inputs = frnet_inputs();
  state_.unscanned = false;
}

}  // namespace understudy::emulator::models::rs_m8194h
