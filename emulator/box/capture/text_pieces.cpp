#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
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

/// The second word of a line.
struct SideWord {
  std::string_view word;
  Side side;
  bool is_heard;  // by a tap: bytes as they came, not frames of a bench
};
constexpr std::array kSideWords{SideWord{"in", Side::host, false}, SideWord{"out", Side::station, false},
                                SideWord{"one", Side::one, true}, SideWord{"other", Side::other, true},
                                SideWord{"any", Side::unknown, true}};

const SideWord* side_called(std::string_view word) {
  const auto* const found = std::ranges::find(kSideWords, word, &SideWord::word);
  return found == kSideWords.end() ? nullptr : found;
}

std::optional<std::uint8_t> parse_byte(std::string_view text) {
  unsigned byte = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), byte, 16);
  if (text.size() != 2 || error != std::errc() || end != text.data() + text.size()) return {};
  return static_cast<std::uint8_t>(byte);
}

constexpr std::string_view kBlank = " \t\r";

/// Takes the next word; empty: there are no more.
std::string_view take_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kBlank));
  rest.remove_prefix(word.size());
  return word;
}

/// Takes the name of a line, "pc", or with the device's port, "pc (mill PC)".
std::string take_name(std::string_view& rest) {
  std::string name(take_word(rest));
  std::string_view ahead = rest;
  if (!take_word(ahead).starts_with('(')) return name;
  while (!name.ends_with(')')) {
    const std::string_view word = take_word(rest);
    if (word.empty()) break;
    name += " " + std::string(word);
  }
  return name;
}

bool is_remark(std::string_view line) {
  return line.starts_with('#') || line.find_first_not_of(kBlank) == std::string_view::npos;
}

}  // namespace

/// The first line that is no remark tells, so that a mistake further down is told with its line.
bool is_our_text(std::string_view head) {
  for (const TextLine line : TextLines(head)) {
    if (is_remark(line.text)) continue;
    std::string_view rest = line.text;
    const std::string_view time = take_word(rest);
    return parse_log_seconds(time).has_value() && side_called(take_word(rest)) != nullptr;
  }
  return head.starts_with("# simulated seconds") || head.starts_with("# seconds since 1970, one");
}

void read_text_pieces(std::istream& file, const std::string& path, const PieceSink& sink) {
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (is_remark(line)) continue;
    std::string_view rest = std::string_view(line).substr(0, line.find(" # "));
    const auto refuse = [&](const std::string& what) {
      return CaptureReadError(path + ":" + std::to_string(number) + ": " + what +
                              "; expected a line such as `0.005333333 out rs485 01 03 02 C0 01 29 84`");
    };
    const std::string_view time = take_word(rest);
    const std::string_view way = take_word(rest);
    CapturedPiece piece{.line = {}, .bytes = {}, .place = number};
    const auto at = parse_log_seconds(time);
    if (!at) throw refuse(quoted(time) + " is not a time in seconds");
    const SideWord* const side = side_called(way);
    if (side == nullptr) throw refuse(quoted(way) + " is not a direction");
    piece.at = *at;
    piece.side = side->side;
    piece.is_frame = piece.counts_from_power_up = !side->is_heard;
    piece.line = take_name(rest);
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const auto byte = parse_byte(word);
      if (!byte) throw refuse(quoted(word) + " is not a byte");
      piece.bytes.push_back(*byte);
    }
    if (!piece.bytes.empty()) sink(std::move(piece));
  }
}

}  // namespace understudy::emulator::box
