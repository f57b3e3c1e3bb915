// What the manual leaves open about modules and their motion, and what to do instead.
#pragma once

#include <cstdint>

namespace understudy::emulator::slim {

struct ChainOptions {
  /// PR2 or PR3 differ between the modules of a coordinated command.
  enum class UnequalSpeeds : std::uint8_t { refused, by_module_0 };
  /// TAREDO, TAUPZ, REDO that have nothing to do.
  enum class InVain : std::uint8_t { silent, refused };
  /// FT without a load that anything says more of.
  enum class Thrust : std::uint8_t {
    stands,      // pushes against something
    runs_at_vj,  // forwards, until it is stopped
  };
  /// VM= and VJ= while a motion runs that they are the speed of. (AVM acts at once in any case.)
  enum class NewSpeed : std::uint8_t { next_motion, at_once };
  /// The fz of SAR, where the manual breaks off.
  enum class SarHeight : std::uint8_t { relative, absolute };

  UnequalSpeeds unequal_speeds = UnequalSpeeds::refused;
  InVain in_vain = InVain::silent;
  Thrust thrust = Thrust::stands;
  NewSpeed new_speed = NewSpeed::next_motion;
  SarHeight sar_height = SarHeight::relative;
  bool servo_at_power_up = true;
  std::uint8_t fifo_length = 32;  // 1 .. kFifoLength

  bool operator==(const ChainOptions&) const = default;
};

}  // namespace understudy::emulator::slim
