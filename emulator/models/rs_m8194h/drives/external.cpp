#include "emulator/models/rs_m8194h/drives/external.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/external_drive.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// If a tick has more edges than the chip can count (4 MHz), only the last ones count.
constexpr std::uint32_t kMaxEdgesPerTick = 8'000;

}  // namespace

/// Returns the number of edges of an input since the last call, independent of the direction in which its
/// count has changed.
std::uint32_t External::edges_of(std::size_t axis, std::size_t which) {
  AxisUnit& unit = chip_.unit(axis);
  const Pin pin = which == 0 ? Pin::external_plus : Pin::external_minus;
  const auto count = static_cast<std::uint32_t>(input(terminal(axis, pin)));
  const std::uint32_t turned = count - unit.external_seen[which];
  std::uint32_t edges = std::min(turned, 0U - turned);
  if (edges > kMaxEdgesPerTick) edges = kMaxEdgesPerTick - (edges & 1U);
  unit.external_seen[which] = count;
  if (chip_.is_filtered(axis, pin)) {
    // The edges pass through the input's filter: pulses that are too short are lost, and others arrive late.
    const bool was_high = which == 0 ? unit.external.plus_high : unit.external.minus_high;
    const bool is_high = (unit.pins.passed & bit_of(pin)) == 0;
    edges = was_high != is_high ? 1 : 0;
    // When the filter is removed, the level that it held back becomes an edge.
    if (((count & 1U) == 0) != is_high) --unit.external_seen[which];
  }
  // If the mode is off, only the final level matters.
  if (unit.external.mode == motion::ExternalDrive::Mode::off && edges > 1) edges = 2 - (edges & 1U);
  return edges;
}

/// Distributes the edges of an input evenly over the tick, interleaved with those of the other input.
void External::watch(std::size_t axis, Tick tick) {
  AxisUnit& unit = chip_.unit(axis);
  const std::array<std::uint32_t, 2> edges{edges_of(axis, 0), edges_of(axis, 1)};
  std::array<std::uint32_t, 2> done{};
  while (done[0] < edges[0] || done[1] < edges[1]) {
    const auto place = [&](std::size_t i) { return std::int64_t{done[i]} * 2 + 1; };  // in 1 / (2 * edges[i])
    const bool is_plus =
        done[1] == edges[1] || (done[0] < edges[0] && place(0) * edges[1] <= place(1) * edges[0]);
    const std::size_t i = is_plus ? 0 : 1;
    const std::int64_t half_ns = kTickLength.count() / (std::int64_t{edges[i]} * 2);
    std::int64_t at_ns = time_of(tick).count() + half_ns * place(i);
    ++done[i];
    // If the other input also has edges, the exact time is not known.
    const std::int64_t max_ns = edges[0] != 0 && edges[1] != 0 ? half_ns : 0;
    at_ns = std::clamp(unit.external_free_ns, at_ns, at_ns + max_ns);
    // A line is high while it does not conduct; each edge inverts it.
    const bool plus = is_plus ? !unit.external.plus_high : unit.external.plus_high;
    const bool minus = is_plus ? unit.external.minus_high : !unit.external.minus_high;
    const bool is_busy = chip_.is_driving(axis) && !is_free(axis, at_ns);
    apply(axis, motion::watch_inputs(unit.external, plus, minus, is_busy), at_ns);
  }
}

/// Returns true if the axis counts as driving only because drives end at ticks, although the pulses of its
/// last edge have already been sent.
bool External::is_free(std::size_t axis, std::int64_t at_ns) const {
  const AxisUnit& unit = chip_.unit(axis);
  const motion::Axis& motor = chip_.motor(axis);
  const bool is_its = unit.external_free_ns != 0 && chip_.activity(axis) == Activity::single;
  return is_its && !motor.slowing && !motor.settling && at_ns >= unit.external_free_ns;
}

void External::apply(std::size_t axis, const motion::DriveOrder& order, std::int64_t at_ns) {
  using What = motion::DriveOrder::What;
  AxisUnit& unit = chip_.unit(axis);
  if (order.what == What::nothing) return;
  if (order.what == What::slow_down) {
    if (chip_.activity(axis) == Activity::single) chip_.motor(axis).slow_down(now());
    return;
  }
  const bool waits = order.what == What::move && is_free(axis, at_ns);
  if (waits) unit.external_waiting += order.pulses;
  if (!waits && !start(axis, order)) return;
  if (order.what == What::run) return;
  const double pulses = std::abs(static_cast<double>(order.pulses));
  unit.external_free_ns = after(at_ns, motion::plan(pulses, law_of(axis)).duration_s);
}

motion::SpeedLaw External::law_of(std::size_t axis) const {
  motion::SpeedLaw law = chip_.law_of(axis);
  if (chose(option("exd_speed", "v_without_ramps"))) law.start_speed_u_s = law.top_speed_u_s;
  return law;
}

/// Starts a drive. Returns true if it has begun.
bool External::start(std::size_t axis, const motion::DriveOrder& order) {
  AxisUnit& unit = chip_.unit(axis);
  unit.external.running = 0;
  if (drives_.may_start(axis, Starter::external) != Start::starts) {
    drives_.note_obstacles(mask_of(axis));
    return false;
  }
  const bool is_run = order.what == motion::DriveOrder::What::run;
  const auto speed = static_cast<std::int32_t>(std::min<std::uint32_t>(unit.external_pps, INT32_MAX));
  const std::uint32_t drive_pps = unit.speed.drive_pps;  // the input's speed does not replace V
  drives_.start(axis,
                {.what = is_run ? Drive::What::endless : Drive::What::fixed,
                 .value = is_run ? order.direction * speed : static_cast<std::int32_t>(order.pulses)},
                chose(option("exd_speed", "v_without_ramps")));
  unit.speed.drive_pps = drive_pps;
  const bool has_begun = chip_.activity(axis) == Activity::single;
  if (is_run && has_begun) unit.external.running = order.direction;
  return has_begun;
}

/// If a drive was ended by something else, the pulses that are waiting for its end are dropped.
void External::start_waiting() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = chip_.unit(a);
    if (unit.external_free_ns == 0 || chip_.is_driving(a)) continue;
    const std::int64_t free_ns = std::exchange(unit.external_free_ns, 0);
    const std::int64_t waiting = std::exchange(unit.external_waiting, 0);
    if (waiting == 0 || chip_.motor(a).cause != motion::Cause::arrived) continue;
    const bool begins = start(a, {.what = motion::DriveOrder::What::move, .pulses = waiting});
    if (begins) unit.external_free_ns = free_ns;
  }
}

void External::set(std::size_t axis, motion::ExternalDrive::Mode mode, std::uint32_t data) {
  using Mode = motion::ExternalDrive::Mode;
  AxisUnit& unit = chip_.unit(axis);
  motion::Axis& motor = chip_.motor(axis);
  const bool was_running = unit.external.running != 0;
  unit.external.mode = mode;
  unit.external.pulses = data;
  unit.external_pps = data;
  if (!was_running) return;
  if (mode == Mode::continuous) {
    // Changes the speed of the running motion; its input still stops it.
    motion::SpeedLaw law = motor.law;
    law.top_speed_u_s = law_at(unit, data, machine_options().speed).top_speed_u_s;
    law.start_speed_u_s = std::min(law.start_speed_u_s, law.top_speed_u_s);
    motor.change_speed(law, now());
    return;
  }
  unit.external.running = 0;
  const bool ends = chip_.activity(axis) == Activity::single && chose(option("exd_disable", "slows_down"));
  if (ends) motor.slow_down(now());
}

void External::take_levels(std::size_t axis) {
  AxisUnit& unit = chip_.unit(axis);
  unit.external_seen = {static_cast<std::uint32_t>(input(terminal(axis, Pin::external_plus))),
                        static_cast<std::uint32_t>(input(terminal(axis, Pin::external_minus)))};
  set_external_levels(unit);
}

}  // namespace understudy::emulator::models::rs_m8194h
