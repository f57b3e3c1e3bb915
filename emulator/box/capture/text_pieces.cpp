#include <charconv>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

namespace {

/// Parses "12.005333333" into nanoseconds, without rounding.
std::optional<SimTime> parse_seconds(std::string_view text) {
  constexpr std::size_t kDigits = 9;
  const std::size_t point = text.find('.');
  std::string digits(text.substr(0, point));
  std::string fraction(point == std::string_view::npos ? "" : text.substr(point + 1));
  if (digits.empty() || fraction.size() > kDigits) return {};
  fraction.resize(kDigits, '0');
  digits += fraction;
  std::int64_t nanoseconds = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), nanoseconds);
  if (error != std::errc() || end != digits.data() + digits.size() || nanoseconds < 0) return {};
  return SimTime{nanoseconds};
}

std::optional<std::uint8_t> parse_byte(std::string_view text) {
  unsigned byte = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), byte, 16);
  if (text.size() != 2 || error != std::errc() || end != text.data() + text.size()) return {};
  return static_cast<std::uint8_t>(byte);
}

/// Takes the name of a line, "pc", or with the device's port, "pc (mill PC)".
std::string take_name(std::istream& words) {
  std::string name;
  words >> name;
  if ((words >> std::ws).peek() != '(') return name;
  for (std::string word; !name.ends_with(')') && words >> word;) name += " " + word;
  return name;
}

}  // namespace

void read_text_pieces(std::istream& file, const std::string& path, const PieceSink& sink) {
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find(" # ")));
    if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto refuse = [&](const std::string& what) {
      return CaptureReadError(path + ":" + std::to_string(number) + ": " + what +
                              "; expected a line such as `0.005333333 out rs485 01 03 02 C0 01 29 84`");
    };
    std::string time, way;
    words >> time >> way;
    CapturedPiece piece{.line = {}, .bytes = {}, .place = number};
    const auto at = parse_seconds(time);
    if (!at) throw refuse(quoted(time) + " is not a time in seconds");
    if (way != "in" && way != "out") throw refuse(quoted(way) + " is not a direction");
    piece.at = *at;
    piece.is_from_host = way == "in";
    piece.line = take_name(words);
    for (std::string word; words >> word;) {
      const auto byte = parse_byte(word);
      if (!byte) throw refuse(quoted(word) + " is not a byte");
      piece.bytes.push_back(*byte);
    }
    if (!piece.bytes.empty()) sink(std::move(piece));
  }
}

}  // namespace understudy::emulator::box
