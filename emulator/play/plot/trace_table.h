// Reads traces in CSV or VCD, in the form that this program writes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"

namespace understudy::emulator::play {

struct TraceTable {
  std::vector<std::string> names;
  std::vector<Tick> ticks;                   // ascending
  std::vector<std::vector<double>> columns;  // one per name, each as long as `ticks`
};

/// Both functions throw FileError, which contains the line number.
TraceTable parse_csv_trace(std::string_view text, const std::string& name);
TraceTable parse_vcd_trace(std::string_view text, const std::string& name);

/// Determines the format from the file's ending, .csv or .vcd. Throws FileError if the text is not valid, or
/// if the file cannot be read or has no rows.
TraceTable read_trace(const std::string& path);

}  // namespace understudy::emulator::play
