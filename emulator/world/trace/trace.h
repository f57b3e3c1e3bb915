// Traces record the visible values of a world in every tick in which any of them changed: as CSV for
// spreadsheets and `understudy plot`, or as VCD for GTKWave.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// A column of a trace.
struct TraceSignal {
  std::string name;  // as in probe_names.h: "feeder.A.position"
  enum class Kind : std::uint8_t { whole, real, bit } kind = Kind::whole;
};

/// Receives the lines of a format.
using TakeLine = std::function<void(std::string_view lines)>;

class TraceFormat {
 public:
  virtual ~TraceFormat() = default;
  virtual void begin(const std::vector<TraceSignal>& signals) = 0;
  /// The values are in the order of the signals. `is_new[i]` is true if the value has changed since the last
  /// call. In the first call, all values are new.
  virtual void row(SimTime at, const std::vector<Number>& values, const std::vector<bool>& is_new) = 0;
  /// Called at the end. Nothing has changed since the last row.
  virtual void end(SimTime at, const std::vector<Number>& values) = 0;
};

std::unique_ptr<TraceFormat> csv_format(TakeLine take);
std::unique_ptr<TraceFormat> vcd_format(TakeLine take);

/// Returns the signals of each device: for each axis, its pulses, its planned speed, the position and
/// switches of its machine, and its duty cycle; inputs and outputs (groups as words), and the registers that
/// show its state. The signals in `also` (names in probe_names.h) come last. Throws NameError.
std::vector<TraceSignal> trace_signals(const World& world, const std::vector<std::string>& also);

/// Watches the world as long as this object exists.
class Trace final : private TickWatcher {
 public:
  Trace(World& world, const std::vector<TraceSignal>& signals, std::unique_ptr<TraceFormat> format);
  ~Trace() override;
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

 private:
  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override;
  void on_rest(Tick) override {}  // a trace contains only changes
  void sample(SimTime at);

  World& world_;
  Probes probes_;
  std::vector<std::int32_t> handles_;
  std::vector<Number> values_;
  std::vector<bool> is_new_;
  bool has_begun_ = false;
  Tick last_row_ = 0;
  std::unique_ptr<TraceFormat> format_;
};

}  // namespace understudy::emulator::world
