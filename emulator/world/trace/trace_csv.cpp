#include <memory>
#include <string>
#include <utility>
#include <vector>
#include "base/simulated_time.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/trace/trace.h"

namespace understudy::emulator::world {

namespace {

/// Writes a row for each tick in which something changed, and a row for the end. Each row contains all
/// values: `time_ms,feeder.A.pulses,...`.
class CsvTrace final : public TraceFormat {
 public:
  explicit CsvTrace(TakeLine take) : take_(std::move(take)) {}

  void begin(const std::vector<TraceSignal>& signals) override {
    std::string line = "time_ms";
    for (const TraceSignal& signal : signals) line += "," + signal.name;
    take_(line + "\n");
  }

  void row(SimTime at, const std::vector<Number>& values, const std::vector<bool>&) override {
    end(at, values);
  }

  void end(SimTime at, const std::vector<Number>& values) override {
    std::string line = std::to_string(tick_at(at));
    for (const Number value : values) line += "," + number_text(value);
    take_(line + "\n");
  }

 private:
  TakeLine take_;
};

}  // namespace

std::unique_ptr<TraceFormat> csv_format(TakeLine take) { return std::make_unique<CsvTrace>(std::move(take)); }

}  // namespace understudy::emulator::world
