// Samples the values of several names over a stretch of time. It stores the minimum and the maximum for each
// of many equal parts ("dots"), so a drawing of that width does not lose any peak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

class Curves final : private TickWatcher {
 public:
  /// `to` must be later than `from`. The world must outlive this object. Throws NameError.
  Curves(World& world, const std::vector<std::string>& names, SimTime from, SimTime to, std::size_t dots);
  ~Curves() override { stop(); }
  Curves(const Curves&) = delete;
  Curves& operator=(const Curves&) = delete;

  /// Samples the present values.
  void look();
  /// Samples the values at every tick from now on.
  void watch();
  void stop();
  /// Ends the stretch of time. The last values apply until its end.
  void finish();

  /// Return the values per dot. Values of a device without power are 0.
  const std::vector<double>& min(std::size_t name) const { return rows_[name].min; }
  const std::vector<double>& max(std::size_t name) const { return rows_[name].max; }

 private:
  struct Row {
    std::int32_t handle = 0;
    double last = 0;
    std::vector<double> min;
    std::vector<double> max;
  };
  void on_tick(Tick tick) override { take(time_of(tick)); }
  Tick next_poll(Tick done) const override;
  void take(SimTime time);
  std::size_t dot_of(SimTime time) const;
  void last_until(std::size_t dot);

  World& world_;
  Probes probes_;
  SimTime from_;
  SimTime to_;
  std::size_t dots_;
  std::size_t dot_ = 0;  // the current dot
  bool has_values_ = false;
  bool is_watching_ = false;
  std::vector<Row> rows_;
};

}  // namespace understudy::emulator::world
