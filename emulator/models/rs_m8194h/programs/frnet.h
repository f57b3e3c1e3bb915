// RS-M8194H: FRnet, which transfers the input and output words in scans (1.1, 5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"

namespace understudy::emulator::models::rs_m8194h {

using FrnetWords = std::array<std::uint16_t, kFrnetGroups>;

struct FrnetState {
  FrnetWords outputs{};    // the outputs as set
  FrnetWords sent{};       // the outputs that the last scan sent
  FrnetWords inputs{};     // the inputs that the last scan read
  Tick powered_at = 0;     // the tick from which scans count
  bool unscanned = false;  // the inputs differ from those in the last scan

  bool operator==(const FrnetState&) const = default;
};

class Frnet final : public Part {
 public:
  Frnet(const Ground& ground, FrnetState& state) : Part(ground), state_(state) {}

  FrnetState& state() { return state_; }
  const FrnetState& state() const { return state_; }
  const FrnetWords& inputs() const { return state_.inputs; }

  /// Returns the outputs of groups 0 to 7, or the inputs of groups 8 to 15.
  std::uint16_t word(std::uint32_t group) const;
  void write(std::size_t group, std::uint16_t word) { state_.outputs[group] = word; }
  void write_bit(std::size_t group, std::size_t channel, bool is_on);
  void clear_outputs() { state_.outputs.fill(0); }

  /// Compares the inputs with those in the last scan. Call this when they may have changed.
  void check_inputs() { state_.unscanned = words_now() != state_.inputs; }
  bool scans_at(Tick tick) const;
  void scan();
  /// Performs the first scan after power-up.
  void scan_first();
  /// Returns the next tick after `done` in which a scan changes anything, or kNever.
  Tick next_active_tick(Tick done) const;

 private:
  FrnetWords words_now() const;

  FrnetState& state_;
};

}  // namespace understudy::emulator::models::rs_m8194h
