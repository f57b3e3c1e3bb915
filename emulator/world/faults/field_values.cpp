#include "emulator/world/faults/field_values.h"
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/model.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/level.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::world {

namespace {

constexpr SimTime kLongest = std::chrono::hours(24 * 365);
constexpr std::size_t kMaxBytes = 256;
constexpr std::int64_t kOnePercent = kAlways / 100;

[[noreturn]] void not_possible(std::string_view name, const std::string& text, const std::string& expected) {
  throw NameError(std::string(name) + ": " + quoted(text) + " is not valid; expected " + expected);
}

std::int64_t in_range(std::string_view name, std::int64_t value, std::int64_t lowest, std::int64_t highest) {
  if (value >= lowest && value <= highest) return value;
  throw NameError(std::string(name) + ": " + std::to_string(value) + " is out of range; expected " +
                  std::to_string(lowest) + " to " + std::to_string(highest));
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::int64_t field_number(std::string_view name, const std::string& text, std::int64_t lowest,
                          std::int64_t highest) {
  const auto number = parse_integer(text);
  if (!number) not_possible(name, text, "a whole number");
  return in_range(name, *number, lowest, highest);
}

std::pair<std::int64_t, std::int64_t> field_span(std::string_view name, const std::string& text,
                                                 std::int64_t lowest, std::int64_t highest) {
  const std::size_t dots = text.find("..");
  const auto first = parse_integer(std::string_view(text).substr(0, dots));
  const std::string_view behind = dots == std::string::npos ? "" : std::string_view(text).substr(dots + 2);
  auto last = dots == std::string::npos ? first : parse_integer(behind);
  if (dots != std::string::npos && behind.empty()) last = highest;
  if (!first || !last) not_possible(name, text, "a whole number, or a range such as 3..7");
  in_range(name, *first, lowest, highest);
  in_range(name, *last, lowest, highest);
  if (*first > *last) not_possible(name, text, "a range that does not end before it begins");
  return {*first, *last};
}

std::int64_t field_level(std::string_view name, const std::string& text) {
  const auto level = parse_level(text, TerminalRow::Kind::digital_in);
  if (!level) not_possible(name, text, "on or off");
  return in_range(name, *level, 0, 1);
}

SimTime field_duration(std::string_view name, const std::string& text, SimTime shortest) {
  const auto duration = parse_duration(text);
  if (!duration) not_possible(name, text, "a duration such as 250ms");
  if (*duration >= shortest && *duration <= kLongest) return *duration;
  throw NameError(std::string(name) + ": " + format_duration(*duration) + " is out of range; expected " +
                  format_duration(shortest) + " to 8760h");
}

std::vector<std::uint8_t> field_bytes(std::string_view name, const std::string& text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') {
      ++i;
      continue;
    }
    const int high = digit_of(text[i]);
    const int low = i + 1 < text.size() ? digit_of(text[i + 1]) : -1;
    if (high < 0 || low < 0) not_possible(name, text, "bytes such as \"FF 00\"");
    bytes.push_back(static_cast<std::uint8_t>(high << 4 | low));
    i += 2;
  }
  if (bytes.empty() || bytes.size() > kMaxBytes) {
    not_possible(name, text, "1 to " + std::to_string(kMaxBytes) + " bytes such as \"FF 00\"");
  }
  return bytes;
}

std::int64_t field_chance(std::string_view name, const std::string& text) {
  const std::string expected = "more than 0% up to 100%, as in 0.5%";
  const std::size_t point = text.find('.');
  if (!text.ends_with("%")) not_possible(name, text, expected);
  const std::string whole = text.substr(0, std::min(point, text.size() - 1));
  std::string part = point == std::string::npos ? "" : text.substr(point + 1, text.size() - point - 2);
  const bool is_number = !whole.empty() && whole.size() <= 3 && part.size() <= 6 &&
                         (point == std::string::npos || !part.empty()) &&
                         (whole + part).find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) not_possible(name, text, expected);
  part.resize(6, '0');
  const std::int64_t chance = std::stoll(whole) * kOnePercent + std::stoll(part);
  if (chance < 1 || chance > kAlways) not_possible(name, text, expected);
  return chance;
}

std::size_t field_word(std::string_view name, const std::string& text,
                       std::span<const std::string_view> words) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == text) return i;
    all += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + std::string(words[i]);
  }
  not_possible(name, text, all);
}

std::string hex_text(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string chance_text(std::int64_t chance) {
  std::string text = std::to_string(chance / kOnePercent);
  if (chance % kOnePercent != 0) {
    const std::string part = std::to_string(kOnePercent + chance % kOnePercent).substr(1);
    text += "." + part.substr(0, part.find_last_not_of('0') + 1);
  }
  return text + "%";
}

}  // namespace understudy::emulator::world
