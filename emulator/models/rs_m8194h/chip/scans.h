// RS-M8194H: LINE_SCAN, triggers at equal distances along an axis (7.4.12).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

class Scans final : public Part {
 public:
  Scans(const Ground& ground, Chip& chip, Interrupts& interrupts)
      : Part(ground), chip_(chip), interrupts_(interrupts) {}

  /// Begins the scans of LINE_SCAN_START. The flag for finished scans is off until all of them have ended.
  void open(AxisMask axes);
  /// Returns true if a choice makes a scan at this speed void.
  bool is_too_fast(std::size_t axis, const motion::SpeedLaw& law) const;
  /// Begins the scan of an axis when its drive of `distance_pulses` has begun.
  void begin(std::size_t axis, std::int64_t distance_pulses);
  /// Sends the triggers of a tick, and ends the scans of axes that are at rest.
  void step(Tick tick);
  /// Returns the travel that the scan's Type counts. The counter itself may wrap in a ring, or be set.
  std::int64_t travel(std::size_t axis) const;
  bool is_open() const { return chip_.state().scanning != 0; }

 private:
  std::int64_t spacing(const LineScan& scan) const;
  void end(std::size_t axis);

  Chip& chip_;
  Interrupts& interrupts_;
};

}  // namespace understudy::emulator::models::rs_m8194h
