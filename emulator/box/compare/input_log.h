// Reads the changes of a controller's inputs during a capture: a text with one change per line.
//
//   0.250 feeder.DIN_2 on
//   14:03:07.125 feeder.DIN_2 off      # times as in the capture
//   1.5 feeder.AIN_1 2500
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/box/capture/capture.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

/// The message begins with the path and the line.
struct InputLogError : FileError {
  using FileError::FileError;
};
/// Throws InputLogError.
std::vector<InputChange> parse_input_log(const world::Bench& bench, std::string_view text,
                                         const std::string& path);

}  // namespace understudy::emulator::box
