// Advances a world by many ticks in one step while its axes move and nothing else happens.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/terminals.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

/// Informs a device how far its machines can move before a contact changes.
class Machines final : public ClearTravel {
 public:
  explicit Machines(const std::vector<PlantAxis>& plants) : plants_(plants) {}

  PulseRoom room(int axis) const override {
    const PlantAxis& plant = plants_[static_cast<std::size_t>(axis)];
    const PulseSpan alike = plant.places_alike();
    if (alike.last < alike.first) return {};
    return {.min = alike.first - plant.position_pulses(), .max = alike.last - plant.position_pulses()};
  }
  bool has_encoder(int axis) const override { return plants_[static_cast<std::size_t>(axis)].has_encoder(); }
  std::int64_t encoder_counts(int axis, std::int64_t pulses) const override {
    return plants_[static_cast<std::size_t>(axis)].encoder_counts_after(pulses);
  }

 private:
  const std::vector<PlantAxis>& plants_;
};

}  // namespace

/// Returns true if a wire begins at an output that may change while axes only continue to move.
bool World::has_moving_wires() const {
  return std::any_of(wires_.begin(), wires_.end(), [&](const WireSetup& wire) {
    const bool is_outputs = wire.from_axis < 0 && devices_[wire.from_device]->powered();
    return is_outputs && devices_[wire.from_device]->terminals()->output_moves(wire.from_terminal);
  });
}

/// Returns the first tick in which anything but continuous motion happens, at most `limit` + 1.
Tick World::next_event_tick(Tick limit) const {
  constexpr Tick kFarAhead = 1'000'000'000'000;  // prevents closed forms from overflowing
  if (!input_turns_.empty() || has_moving_wires()) return done_ + 1;
  Tick last = std::min({limit, next_fault_tick() - 1, done_ + kFarAhead});
  for (std::size_t d = 0; d < devices_.size() && last > done_; ++d) {
    for (const PlantAxis& plant : plants_[d]) last = std::min(last, plant.next_active_tick(done_) - 1);
    if (last <= done_ || !devices_[d]->powered()) continue;
    last = std::min(last, devices_[d]->next_event_tick(done_, last, Machines(plants_[d])) - 1);
  }
  return last + 1;
}

/// Returns the tick to which to fast-forward, or done_ if that is not worthwhile.
Tick World::last_tick_to_skip(Tick limit) {
  const Tick last = next_event_tick(limit) - 1;
  if (last - done_ >= kMinSkip) {
    skip_tries_.apart = 1;
    return last;
  }
  skip_tries_.next = done_ + skip_tries_.apart;
  skip_tries_.apart = std::min(2 * skip_tries_.apart, SkipTries::kMaxApart);
  return done_;
}

void World::fast_forward_to(Tick tick) {
  std::vector<std::int64_t> pulses;
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    pulses.assign(plants_[d].size(), 0);
    if (devices_[d]->powered()) devices_[d]->fast_forward_to(done_, tick, Machines(plants_[d]), pulses);
    for (std::size_t a = 0; a < pulses.size(); ++a) {
      count_sent(sent_pulses_[d][a], pulses[a]);
      plants_[d][a].fast_forward(pulses[a]);
    }
    devices_[d]->set_now(tick);
  }
  ticks_.skipped += static_cast<std::uint64_t>(tick - done_);
  done_ = tick;
}

}  // namespace understudy::emulator::world
