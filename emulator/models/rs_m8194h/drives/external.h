// RS-M8194H: drives that the inputs EXP+ and EXP- start (7.1.12), including edges within a tick.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "motion/external_drive.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

class External final : public Part {
 public:
  External(const Ground& ground, Chip& chip, Drives& drives) : Part(ground), chip_(chip), drives_(drives) {}

  /// Handles the edges of a tick.
  void watch(std::size_t axis, Tick tick);
  /// Starts the drives that waited for the end of the tick in which earlier pulses were sent.
  void start_waiting();
  /// Sets EXD_MP, EXD_FP or EXD_CP with their data, or switches them off.
  void set(std::size_t axis, motion::ExternalDrive::Mode mode, std::uint32_t data);
  /// Records the levels of the inputs at power-up, which do not count as edges.
  void take_levels(std::size_t axis);

 private:
  std::uint32_t edges_of(std::size_t axis, std::size_t which);
  bool is_free(std::size_t axis, std::int64_t at_ns) const;
  void apply(std::size_t axis, const motion::DriveOrder& order, std::int64_t at_ns);
  motion::SpeedLaw law_of(std::size_t axis) const;
  bool start(std::size_t axis, const motion::DriveOrder& order);

  Chip& chip_;
  Drives& drives_;
};

}  // namespace understudy::emulator::models::rs_m8194h
