// Records the maximum planned speed and acceleration of each axis, and is updated in every tick.
#pragma once

#include <cstddef>
#include <vector>

#include "emulator/world/view/world_view.h"

namespace understudy::emulator::world {

class Peaks final : public TickWatcher {
 public:
  struct Peak {
    double speed_pps = 0;      // in the previous tick
    double greatest_pps = 0;   // the maximum magnitude of the speed
    double greatest_pps2 = 0;  // the maximum magnitude of the acceleration, in pulses per second squared
    bool operator==(const Peak&) const = default;
  };
  /// The current peaks, as a value.
  using State = std::vector<std::vector<Peak>>;  // [device][axis]

  /// When added with World::add_watcher(), watches from this moment on. The view must outlive this object.
  explicit Peaks(const WorldView& view);

  void on_tick(Tick tick) override;
  Tick next_poll(Tick) const override { return kNever; }
  /// Starts again. The present speed is not counted.
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
