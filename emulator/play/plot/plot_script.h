#pragma once

#include <span>
#include <string>

#include "emulator/play/plot/trace_table.h"

namespace understudy::emulator::play {

enum class PlotFormat : std::uint8_t { png, svg };

/// Returns a gnuplot script that draws a trace and contains its data: positions, speeds, a panel for each of
/// `also`, and digital signals, over time. Columns that never change are omitted, except those in `also`. For
/// a long trace, the minimum and maximum of each stretch are drawn (envelope.h). The picture is written to
/// `output`. Throws FileError for a trace in which nothing changes, or for an unknown name in `also`. `name`
/// is the name of the trace.
std::string plot_script(const TraceTable& table, std::span<const std::string> also, PlotFormat format,
                        const std::string& output, const std::string& name);

}  // namespace understudy::emulator::play
