// Times at the beginning of lines of logs.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::box {

struct LogTime {
  SimTime at{0};           // since any moment
  std::size_t size = 0;    // characters
  bool is_of_day = false;  // it has no date, so it begins again at midnight
};
/// Takes a time: seconds ("0.125"), a clock ("14:03:07.125"), with a date ("2026-11-28 14:03:07,125",
/// "2026/11/28 ...", "...T...Z"), or as `ts` writes it ("Nov 28 14:03:07").
std::optional<LogTime> take_log_time(std::string_view text);

/// Parses "12.005333333" into nanoseconds, without rounding; more than nine digits are cut.
std::optional<SimTime> parse_log_seconds(std::string_view text);

}  // namespace understudy::emulator::box
