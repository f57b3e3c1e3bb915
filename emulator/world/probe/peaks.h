// Records the maximum planned speed and acceleration of each axis. It is updated in every tick.
#pragma once

#include <cstddef>
#include <vector>

#include "emulator/world/view/world_view.h"

namespace understudy::emulator::world {

class Peaks final : public TickWatcher {
 public:
  struct Peak {
    double speed_pps = 0;      // at the tick before
    double greatest_pps = 0;   // a magnitude, like the next one
    double greatest_pps2 = 0;  // pulses per second, per second
    bool operator==(const Peak&) const = default;
  };
  /// The peaks so far, as a value.
  using State = std::vector<std::vector<Peak>>;  // [device][axis]

  /// Watches from this moment on, if added by World::add_watcher(). The view must outlive it.
  explicit Peaks(const WorldView& view);

  void on_tick(Tick tick) override;
  Tick next_poll(Tick) const override { return kNever; }
  /// Starts again. The speed at this moment does not count.
  void reset();

  const Peak& peak(std::size_t device, int axis) const {
    return peaks_[device][static_cast<std::size_t>(axis)];
  }
  const State& save() const { return peaks_; }
  void restore(const State& state) { peaks_ = state; }

 private:
  const WorldView& view_;
  State peaks_;
};

}  // namespace understudy::emulator::world
