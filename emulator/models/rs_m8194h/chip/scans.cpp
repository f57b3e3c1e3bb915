#include "emulator/models/rs_m8194h/chip/scans.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/encoder_line.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The limit in 7.4.12.
constexpr double kMaxScanTriggers_hz = 100'000;
/// Triggers closer than 10 us to the previous trigger are dropped, so at most 100 of them fit in a tick
/// (7.4.12).
constexpr std::int64_t kMaxTriggersOfATick = 100;

}  // namespace

void Scans::open(AxisMask axes) {
  if (axes == 0) return;
  interrupts_.clear(Rint::line_scan);
  chip_.state().scanning |= axes;
}

bool Scans::is_too_fast(std::size_t axis, const motion::SpeedLaw& law) const {
  if (!chose(option("scan_too_fast", "the_scan_is_void"))) return false;
  const LineScan& scan = chip_.scan(axis);
  return scan.set && law.top_speed_u_s / static_cast<double>(spacing(scan)) > kMaxScanTriggers_hz;
}

void Scans::begin(std::size_t axis, std::int64_t distance_pulses) {
  open(mask_of(axis));
  LineScan& scan = chip_.scan(axis);
  if (!scan.set) return;
  scan.running = true;
  scan.begin = travel(axis);
  scan.triggered = 0;
  const bool is_against = (scan.pitch < 0) != (distance_pulses < 0);
  if (is_against && chose(option("scan_sign", "no_triggers"))) end(axis);
}

void Scans::step(Tick tick) {
  if (chip_.state().scanning == 0) return;
  bool runs = false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    LineScan& scan = chip_.scan(a);
    if (!scan.running) continue;
    const std::int64_t passed = std::abs(travel(a) - scan.begin) / spacing(scan);
    if (passed > scan.triggered) {
      const std::int64_t max =
          machine_options().all_scan_triggers_are_given ? INT64_MAX : kMaxTriggersOfATick;
      const std::int64_t given = std::min(passed - scan.triggered, max);
      chip_.give_pulse(a, tick, given);
      scan.triggered = passed;
    }
    // An encoder that does not move with the axis reports the last pulses one tick later.
    const AxisUnit& unit = chip_.unit(a);
    const bool lags = scan.type >= 2 && unit.has_encoder && !chip_.environment(a).encoder.is_known() &&
                      unit.sent_pulses != 0;
    if (!chip_.is_driving(a) && !lags) end(a);
    runs = runs || scan.running;
  }
  if (!runs && (chip_.driving() & chip_.state().scanning) == 0) {
    chip_.state().scanning = 0;
    interrupts_.raise(Rint::line_scan);
  }
}

/// Ends a scan. A choice can leave C+ where the next trigger would have been.
void Scans::end(std::size_t axis) {
  LineScan& scan = chip_.scan(axis);
  if (chose(option("scan_comparator", "the_next_trigger"))) {
    const std::int64_t direction = travel(axis) < scan.begin ? -1 : +1;
    const std::int64_t next = scan.begin + direction * (scan.triggered + 1) * spacing(scan);
    const AxisUnit& unit = chip_.unit(axis);
    const motion::Counter& counter = scan.type >= 2 ? unit.encoder : unit.logic;
    chip_.unit(axis).compare[0] = {.value = static_cast<std::int32_t>(counter.at(next)),
                                   .source = static_cast<std::uint8_t>(scan.type >= 2 ? 1 : 0)};
  }
  const bool lasts = chose(option("scan_setting_lasts", "until_the_next_setting"));
  if (!lasts && chose(option("scan_output", "that_of_set_out_which_comes_back"))) {
    chip_.unit(axis).out.level = scan.level_before;
    chip_.unit(axis).out.width_code = scan.width_before;
  }
  scan = lasts ? LineScan{.set = true,
                          .type = scan.type,
                          .pitch = scan.pitch,
                          .level_before = scan.level_before,
                          .width_before = scan.width_before}
               : LineScan{};
  chip_.rearm(axis);
}

std::int64_t Scans::travel(std::size_t axis) const {
  const motion::Axis& motor = chip_.motor(axis);
  if (chip_.scan(axis).type < 2) return motor.travel_pulses;
  const motion::EncoderLine& encoder = chip_.environment(axis).encoder;
  return encoder.is_known() ? encoder.at(motor.travel_pulses) : encoder_travel(chip_.unit(axis), motor);
}

std::int64_t Scans::spacing(const LineScan& scan) const {
  const bool is_as_printed = machine_options().pitch_is_distance && scan.pitch > 0;
  return std::max<std::int64_t>(std::abs(std::int64_t{scan.pitch}) + (is_as_printed ? 0 : 1), 1);
}

}  // namespace understudy::emulator::models::rs_m8194h
