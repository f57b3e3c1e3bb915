#include "emulator/world/names/level.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/text/parse_integer.h"
#include "emulator/device/model.h"

namespace understudy::emulator::world {

namespace {

/// Returns 2500 for "2.5" volts. At most three decimal places are allowed.
std::optional<std::int64_t> parse_volts(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) {
    const auto volts = parse_integer(text);
    return volts && *volts >= 0 && *volts < 1'000'000 ? std::optional(*volts * 1000) : std::nullopt;
  }
  const std::string_view whole = text.substr(0, point);
  const std::string_view part = text.substr(point + 1);
  if (whole.empty() || part.empty() || part.size() > 3) return std::nullopt;
  if (text.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  const auto volts = parse_volts(whole);
  if (!volts || part.find('.') != std::string_view::npos) return std::nullopt;
  std::int64_t millivolts = 0;
  for (std::size_t i = 0; i < 3; ++i) millivolts = millivolts * 10 + (i < part.size() ? part[i] - '0' : 0);
  return *volts + millivolts;
}

}  // namespace

std::optional<std::int64_t> parse_level(std::string_view text, TerminalRow::Kind kind) {
  if (kind == TerminalRow::Kind::analog_in) {
    if (text.ends_with("mV")) return parse_integer(text.substr(0, text.size() - 2));
    if (text.ends_with("V")) return parse_volts(text.substr(0, text.size() - 1));
    return parse_integer(text);
  }
  if (!has_two_levels(kind)) return parse_integer(text);
  if (text == "on" || text == "true") return 1;
  if (text == "off" || text == "false") return 0;
  return parse_integer(text);
}

std::string level_text(const TerminalRow& row, std::int64_t level) {
  if (has_two_levels(row.kind)) return level != 0 ? "on" : "off";
  return std::to_string(level) + (is_in_millivolts(row.kind) ? "mV" : "");
}

std::string_view level_example(TerminalRow::Kind kind) {
  switch (kind) {
    case TerminalRow::Kind::analog_in: return "a voltage such as 2.5V";
    case TerminalRow::Kind::analog_number:
    case TerminalRow::Kind::counted_in: return "a number";
    default: return "on or off";
  }
}

}  // namespace understudy::emulator::world
