#include <charconv>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/log_time.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

namespace {

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

/// The first line that is no remark tells, so that a mistake further down is told with its line.
bool is_our_text(std::string_view head) {
  for (const TextLine line : TextLines(head)) {
    if (line.text.starts_with('#') || line.text.find_first_not_of(" \t\r") == std::string_view::npos)
      continue;
    std::istringstream words{std::string(line.text)};
    std::string time, way;
    words >> time >> way;
    return parse_log_seconds(time).has_value() && (way == "in" || way == "out");
  }
  return head.starts_with("# simulated seconds");
}

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
    const auto at = parse_log_seconds(time);
    if (!at) throw refuse(quoted(time) + " is not a time in seconds");
    if (way != "in" && way != "out") throw refuse(quoted(way) + " is not a direction");
    piece.at = *at;
    piece.side = way == "in" ? Side::host : Side::station;
    piece.is_frame = true;
    piece.counts_from_power_up = true;
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
