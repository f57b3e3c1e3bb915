// Kinds of errors in received characters that are not a frame.
#pragma once

#include <cstdint>

namespace understudy::pty {

enum class ReceiveError : std::uint8_t {
  bad_checksum,  // as long as a frame, but with a wrong checksum
  overlong,      // longer than any frame
  cut_off,       // ends before its frame is complete
};

}  // namespace understudy::pty
