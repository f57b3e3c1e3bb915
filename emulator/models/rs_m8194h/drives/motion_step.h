// RS-M8194H: runs one or many ticks of the motion chip: the motors move, then their events take effect.
#pragma once

#include <cstdint>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/chip/scans.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/edges.h"
#include "emulator/models/rs_m8194h/drives/external.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/rows/ground.h"

namespace understudy::emulator::models::rs_m8194h {

class MotionStep final : public Part {
 public:
  MotionStep(const Ground& ground, Chip& chip, Interrupts& interrupts, Scans& scans, Streams& streams,
             Drives& drives, External& external, Edges& edges)
      : Part(ground),
        chip_(chip),
        interrupts_(interrupts),
        scans_(scans),
        streams_(streams),
        drives_(drives),
        external_(external),
        edges_(edges) {}

  void step(Tick tick);

  /// Returns true if no axis is moving, and none has anything to report.
  bool rests() const;
  /// Returns the last tick up to which only positions change, at most `last`, or `done` if there is none.
  Tick quiet_until(Tick done, Tick last, const ClearTravel& ahead) const;
  void fast_forward_to(Tick tick, const ClearTravel& ahead, std::span<std::int64_t> pulses);

 private:
  void step_axes(Tick tick);
  void on_path_speed(Tick tick);

  Chip& chip_;
  Interrupts& interrupts_;
  Scans& scans_;
  Streams& streams_;
  Drives& drives_;
  External& external_;
  Edges& edges_;
};

}  // namespace understudy::emulator::models::rs_m8194h
