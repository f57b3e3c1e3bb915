// Patterns for lines of logs that have bytes in hex.
//
//   {time}    a time (log_time.h)
//   {us}      microseconds
//   {sample}  the number of a sample
//   {dir}     a word for a direction: > < tx rx send recv write read request response out in
//   {name}    the name of a channel: the first name is one side, the second the other
//   {hex}     bytes: 01 03, 0x1 0x3, 01:03, 0103, [01][03]
//   {bytes}   bytes of one side in square brackets, of the other in angle ones, as libmodbus prints them
//   {*}       anything
//
// Everything else stands for itself, and a space for any white space. A pattern describes a whole line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

struct LogLine {
  std::optional<SimTime> at{};
  bool is_time_of_day = false;
  std::optional<std::uint64_t> sample{};
  Side side = Side::unknown;
  std::string name{};
  CapturedBytes bytes{};
};

class LogPattern {
 public:
  /// Throws std::invalid_argument if the text has an unknown field, or none for bytes and `needs_bytes`.
  explicit LogPattern(std::string_view text, bool needs_bytes = true);
  std::optional<LogLine> match(std::string_view line) const;

  enum class Field : std::uint8_t { literal, space, time, us, sample, dir, name, hex, bytes, any };
  struct Token {
    Field field = Field::literal;
    std::string literal{};
  };

 private:
  bool match_from(std::size_t token, std::string_view text, LogLine& line) const;
  std::vector<Token> tokens_;
};

/// Takes bytes in hex from the beginning of the text, and returns how many characters they take.
std::size_t take_hex(std::string_view text, CapturedBytes& bytes);

}  // namespace understudy::emulator::box
