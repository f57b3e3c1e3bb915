#include "emulator/trace/trace_file.h"

#include <utility>

namespace understudy::emulator {

bool is_trace_name(const std::string& path) { return path.ends_with(".csv") || path.ends_with(".vcd"); }

TraceFile::TraceFile(World& world, const std::string& path, const std::vector<std::string>& also,
                     std::function<void(const std::string&)> log)
    : TraceFile(world, path, trace_signals(world, also), std::move(log)) {}

TraceFile::TraceFile(World& world, const std::string& path, std::vector<TraceSignal> signals,
                     std::function<void(const std::string&)> log)
    : file_(path, "the trace", std::move(log)),
      trace_(world, std::move(signals),
             path.ends_with(".vcd") ? vcd_format([this](std::string_view lines) { file_.take(lines); })
                                    : csv_format([this](std::string_view lines) { file_.take(lines); })) {}

}  // namespace understudy::emulator
