// A capture of a line: what a host sent and what came back, with times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"

namespace understudy::emulator::box {

using CapturedBytes = std::vector<std::uint8_t>;

/// Bytes of one direction that were seen together.
struct CapturedPiece {
  SimTime at{0};  // when the first of them began
  bool is_from_host = false;
  std::string line;  // its name in the capture
  CapturedBytes bytes;
  std::size_t place = 0;  // its line in the file, or the number of its packet
};

/// A request and everything that came before the next one.
struct Exchange {
  SimTime at{0};
  CapturedBytes request;
  std::optional<SimTime> replied_at{};  // nothing: there was no reply
  CapturedBytes reply{};
  std::size_t place = 0;  // of the request
};

struct Capture {
  std::string path;
  std::string line;  // the chosen line
  std::vector<Exchange> exchanges;
  std::size_t unasked = 0;  // pieces of the controller before the first request
};

/// Thrown for a bad capture. The message begins with the path and the place, and says what was expected.
struct CaptureReadError : FileError {
  using FileError::FileError;
};

/// Reads a capture of `serve --capture`, as pcapng or text. `line` chooses one of several lines; empty: the
/// only one. Throws CaptureReadError.
Capture read_capture(std::istream& file, const std::string& path, const std::string& line);

}  // namespace understudy::emulator::box
