// Parses the meanings of values as people print them: "0: off, 1: on", "0 = stop / 1 = run", "Bit 3: ready".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::model_file {

/// A value and its meaning: "0: off". With "10-20: level", there are several values.
struct NamedValue {
  std::int64_t value = 0;
  std::int64_t last = 0;
  bool is_bit = false;  // "b0: off", "Bit 0: off"
  std::string name{};
};

/// Returns nothing if the text is not an enumeration, or if some of it may be a value without a meaning. The
/// meanings may be separated by commas, semicolons, slashes, line breaks or blanks.
std::optional<std::vector<NamedValue>> parse_enumeration(std::string_view text);

}  // namespace understudy::emulator::model_file
