#include "emulator/world/probe/peaks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::world {

Peaks::Peaks(const WorldView& view) : view_(view) {
  for (std::size_t d = 0; d < view.device_count(); ++d) {
    const Device& device = view.device(d);
    auto& axes = peaks_.emplace_back(device.model().axes.size());
    for (std::size_t a = 0; a < axes.size(); ++a)
      axes[a].speed_pps = device.axes()->speed_pps(static_cast<int>(a));
  }
}

void Peaks::on_tick(Tick) {
  constexpr double kTicksPerSecond = 1000;
  for (std::size_t d = 0; d < peaks_.size(); ++d) {
    const Device& device = view_.device(d);
    for (std::size_t a = 0; a < peaks_[d].size(); ++a) {
      Peak& peak = peaks_[d][a];
      const double speed = device.axes()->speed_pps(static_cast<int>(a));
      peak.greatest_pps = std::max(peak.greatest_pps, std::abs(speed));
      peak.greatest_pps2 = std::max(peak.greatest_pps2, std::abs(speed - peak.speed_pps) * kTicksPerSecond);
      peak.speed_pps = speed;
    }
  }
}

void Peaks::reset() {
  for (auto& axes : peaks_) {
    for (Peak& peak : axes) peak.greatest_pps = peak.greatest_pps2 = 0;
  }
}

}  // namespace understudy::emulator::world
