#include "pty/ascii_frame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "pty/rtu_crc.h"

namespace understudy::pty {

namespace {

constexpr std::size_t kEnd = 2;       // CR, LF
constexpr std::size_t kMinBytes = 3;  // address, function, LRC
constexpr std::string_view kHexadecimal = "0123456789ABCDEF";

std::optional<int> digit(std::uint8_t character) {
  if (character >= '0' && character <= '9') return character - '0';
  if (character >= 'A' && character <= 'F') return character - 'A' + 10;
  if (character >= 'a' && character <= 'f') return character - 'a' + 10;
  return std::nullopt;
}

/// Returns the bytes between ':' and CR LF, with the LRC, or nothing if the form is wrong.
std::optional<std::vector<std::uint8_t>> content_of(std::span<const std::uint8_t> frame) {
  const bool has_ends = frame.size() >= 1 + 2 * kMinBytes + kEnd && frame.size() <= kAsciiMaxFrame &&
                        frame.size() % 2 == 1 && frame.front() == ':' && frame[frame.size() - 2] == '\r' &&
                        frame.back() == '\n';
  if (!has_ends) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 1; i + kEnd < frame.size(); i += 2) {
    const auto high = digit(frame[i]);
    const auto low = digit(frame[i + 1]);
    if (!high || !low) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(*high << 4 | *low));
  }
  return bytes;
}

}  // namespace

std::uint8_t lrc(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint8_t>(-sum);
}

std::vector<std::uint8_t> ascii_of_rtu(std::span<const std::uint8_t> frame) {
  constexpr std::size_t kCrc = 2;
  const auto content = frame.first(frame.size() < kCrc ? 0 : frame.size() - kCrc);
  std::vector<std::uint8_t> made{':'};
  const auto put = [&](std::uint8_t byte) {
    made.push_back(static_cast<std::uint8_t>(kHexadecimal[byte >> 4]));
    made.push_back(static_cast<std::uint8_t>(kHexadecimal[byte & 0x0F]));
  };
  for (const std::uint8_t byte : content) put(byte);
  put(lrc(content));
  made.push_back('\r');
  made.push_back('\n');
  return made;
}

std::optional<std::vector<std::uint8_t>> rtu_of_ascii(std::span<const std::uint8_t> frame) {
  auto bytes = content_of(frame);
  if (!bytes) return std::nullopt;
  const std::uint8_t check = bytes->back();
  bytes->pop_back();
  if (lrc(*bytes) != check) return std::nullopt;
  append_rtu_crc(*bytes);
  return bytes;
}

bool has_ascii_form(std::span<const std::uint8_t> frame) { return content_of(frame).has_value(); }

}  // namespace understudy::pty
