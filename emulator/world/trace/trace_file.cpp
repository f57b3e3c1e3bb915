#include "emulator/world/trace/trace_file.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "emulator/world/trace/trace.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

bool is_trace_name(const std::string& path) { return path.ends_with(".csv") || path.ends_with(".vcd"); }

TraceFile::TraceFile(World& world, const std::string& path, const std::vector<std::string>& also,
                     std::function<void(const std::string&)> log)
    : world_(world),
      signals_(trace_signals(world, also)),
      is_vcd_(path.ends_with(".vcd")),
      file_(path, ContentKind::trace, std::move(log)) {}

void TraceFile::begin() {
  const TakeLine take = [this](std::string_view lines) { file_.take(lines); };
  trace_ = std::make_unique<Trace>(world_, signals_, is_vcd_ ? vcd_format(take) : csv_format(take));
}

std::string TraceFile::finish() {
  trace_.reset();
  return file_.finish();
}

}  // namespace understudy::emulator::world
