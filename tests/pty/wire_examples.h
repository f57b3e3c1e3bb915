// Frames that a manual or a specification prints, with their checksums: an oracle that is independent of our
// code.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

namespace understudy::pty {

using Bytes = std::vector<std::uint8_t>;
using Frames = std::vector<Bytes>;

/// Converts text such as "01 03 D5" to bytes.
inline Bytes hex(std::string_view text) {
  Bytes bytes;
  for (std::size_t at = 0; at + 1 < text.size(); at += 3) {
    std::uint8_t value = 0;
    std::from_chars(text.data() + at, text.data() + at + 2, value, 16);
    bytes.push_back(value);
  }
  return bytes;
}

inline constexpr std::array kRequestExamples = {
    std::string_view("01 03 00 01 00 01 D5 CA"),
    std::string_view("01 04 00 00 00 01 31 CA"),
    std::string_view("01 06 10 02 00 C8 2D 5C"),
    std::string_view("01 10 10 00 00 05 0A 7D 00 00 00 00 C8 00 05 00 05 B3 F7"),
    std::string_view("01 10 10 00 00 02 04 FE 0C FF FF CE 34"),
    std::string_view("01 06 10 14 00 01 0C CE"),
    std::string_view("01 06 10 05 00 01 5C CB"),
    std::string_view("01 03 0E 04 00 02 87 22"),
    std::string_view("01 03 F0 02 00 02 56 CB"),
    std::string_view("01 05 00 00 FF 00 8C 3A"),
    std::string_view("01 03 00 03 00 01 74 0A"),
    std::string_view("01 06 10 03 0B B9 BB 88"),
};

inline constexpr std::array kReplyExamples = {
    std::string_view("01 03 02 C0 01 29 84"),
    std::string_view("01 10 10 00 00 05 04 CA"),
    std::string_view("01 10 10 00 00 02 45 08"),
    std::string_view("01 03 04 7D 00 00 00 E2 5F"),
    std::string_view("01 03 04 0C 80 00 00 F8 8B"),
    std::string_view("01 85 01 83 50"),
    std::string_view("01 83 02 C0 F1"),
    std::string_view("01 86 03 02 61"),
};

}  // namespace understudy::pty
