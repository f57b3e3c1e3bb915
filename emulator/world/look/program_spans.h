// Records at which lines the programs of a bench are, and for how long.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/user_program.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

class ProgramSpans final : private TickWatcher {
 public:
  struct Span {
    std::string device;
    std::string program;  // as in ProgramLocation
    int line = 0;
    std::string text;
    std::string waits_for;
    bool has_failed = false;
    SimTime begin{0};
    SimTime end{0};
  };

  /// The world must outlive this object.
  explicit ProgramSpans(World& world) : world_(world) {}
  ~ProgramSpans() override { stop(); }
  ProgramSpans(const ProgramSpans&) = delete;
  ProgramSpans& operator=(const ProgramSpans&) = delete;

  void look() { take(world_.now()); }  // only the present moment
  void watch();                        // every tick from now on
  void stop();
  /// Ends the spans that are still open, and returns all spans in the order of their ends.
  std::vector<Span> finish();

 private:
  void on_tick(Tick tick) override { take(time_of(tick)); }
  Tick next_poll(Tick) const override { return kNever; }
  void take(SimTime time);

  World& world_;
  bool is_watching_ = false;
  SimTime last_{0};
  std::vector<Span> under_way_;
  std::vector<Span> over_;
};

}  // namespace understudy::emulator::world
