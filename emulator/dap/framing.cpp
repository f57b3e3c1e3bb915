#include "emulator/dap/framing.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"

namespace understudy::emulator::dap {

namespace {

constexpr std::string_view kEnd = "\r\n\r\n";
constexpr std::string_view kLength = "Content-Length:";

std::size_t length_in(std::string_view head) {
  while (!head.empty()) {
    const std::size_t end = head.find("\r\n");
    std::string_view line = head.substr(0, end);
    head.remove_prefix(end == std::string_view::npos ? head.size() : end + 2);
    if (!line.starts_with(kLength)) continue;
    line.remove_prefix(kLength.size());
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto length = parse_integer(line);
    if (!length || *length < 0 || *length > static_cast<long long>(kLongestMessage))
      throw FramingError("Content-Length: " + quoted(line) + " is not a length; expected 0 to " +
                         std::to_string(kLongestMessage));
    return static_cast<std::size_t>(*length);
  }
  throw FramingError("the header of a message has no Content-Length; expected \"Content-Length: N\"");
}

}  // namespace

std::optional<std::string> Unframer::take() {
  const std::size_t end = bytes_.find(kEnd);
  // If the head has the maximum length, three of the four bytes that end it may have arrived.
  if (std::min(end, bytes_.size()) > kLongestHead + (end == std::string::npos ? kEnd.size() - 1 : 0))
    throw FramingError("the header of a message has no end; expected at most 1024 bytes and an empty line");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t begin = end + kEnd.size();
  const std::size_t length = length_in(std::string_view(bytes_).substr(0, end));
  if (bytes_.size() - begin < length) return std::nullopt;
  std::string message = bytes_.substr(begin, length);
  bytes_.erase(0, begin + length);
  return message;
}

std::string framed(const std::string& message) {
  return std::string(kLength) + " " + std::to_string(message.size()) + std::string(kEnd) + message;
}

}  // namespace understudy::emulator::dap
