#include "motion/external_drive.h"

#include <cstdint>

namespace understudy::motion {

namespace {

DriveOrder move_by(std::int64_t pulses) {
  return pulses == 0 ? DriveOrder{} : DriveOrder{.what = DriveOrder::What::move, .pulses = pulses};
}

}  // namespace

DriveOrder watch_inputs(ExternalDrive& drive, bool plus_high, bool minus_high, bool axis_moving) {
  const bool plus_rises = plus_high && !drive.plus_high;
  const bool plus_falls = !plus_high && drive.plus_high;
  const bool minus_rises = minus_high && !drive.minus_high;
  const bool minus_falls = !minus_high && drive.minus_high;
  drive.plus_high = plus_high;
  drive.minus_high = minus_high;

  if (drive.mode != ExternalDrive::Mode::continuous) drive.running = 0;
  switch (drive.mode) {
    case ExternalDrive::Mode::off: break;
    case ExternalDrive::Mode::multiply:
      if (minus_high) break;
      if (plus_rises) return move_by(drive.pulses);
      if (plus_falls) return move_by(-drive.pulses);
      break;
    case ExternalDrive::Mode::fixed:
      if (axis_moving) break;
      if (plus_falls) return move_by(drive.pulses);
      if (minus_falls) return move_by(-drive.pulses);
      break;
    case ExternalDrive::Mode::continuous:
      if ((drive.running > 0 && plus_rises) || (drive.running < 0 && minus_rises)) {
        drive.running = 0;
        return {.what = DriveOrder::What::slow_down};
      }
      if (drive.running == 0 && (plus_falls || minus_falls)) {
        drive.running = plus_falls ? std::int8_t{+1} : std::int8_t{-1};
        return {.what = DriveOrder::What::run, .direction = drive.running};
      }
      break;
  }
  return {};
}

}  // namespace understudy::motion
