// The machine around a controller's axis: how far it travels, where its switches are, what its encoder
// counts. Positions are pulses of the motor, 0 where the machine stood at power-up.
#pragma once

#include <cstdint>
#include <optional>

namespace understudy::emulator {

/// Positions first to last, both included.
struct PulseSpan {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

struct PlantSetup {
  /// Hard stops: the machine does not pass them, pulses beyond are lost steps.
  std::optional<PulseSpan> travel;
  /// Where the home switch is on.
  std::optional<PulseSpan> home;
  /// The limit switches: on at the position and beyond.
  std::optional<std::int64_t> lower_limit;
  std::optional<std::int64_t> upper_limit;
  int encoder_counts_per_revolution = 0;  // 0: no encoder
  int pulses_per_revolution = 1;
};

class PlantAxis {
 public:
  explicit PlantAxis(PlantSetup setup = {}) : setup_(setup) {}

  void move(std::int64_t pulses);

  std::int64_t position_pulses() const { return position_pulses_; }
  std::int64_t lost_pulses() const { return lost_pulses_; }
  bool at_home() const;
  bool at_lower_limit() const;
  bool at_upper_limit() const;
  bool has_encoder() const { return setup_.encoder_counts_per_revolution != 0; }
  /// Rounded towards minus infinity, so that a slow turn through 0 counts evenly.
  std::int64_t encoder_counts() const;

  const PlantSetup& setup() const { return setup_; }

 private:
  PlantSetup setup_;
  std::int64_t position_pulses_ = 0;
  std::int64_t lost_pulses_ = 0;  // magnitude
};

}  // namespace understudy::emulator
