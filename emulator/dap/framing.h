// Makes and reads the frames of the Debug Adapter Protocol: "Content-Length: N", an empty line, and N bytes
// of JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::emulator::dap {

/// Thrown if the input is not a frame; nothing after it can be read. The message is one line.
struct FramingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t kLongestMessage = std::size_t{4} << 20;
inline constexpr std::size_t kLongestHead = 1024;

class Unframer {
 public:
  void push(std::string_view bytes) { bytes_ += bytes; }
  /// Returns the next message, or nothing if it is not complete yet. Throws FramingError.
  std::optional<std::string> take();
  bool is_empty() const { return bytes_.empty(); }

 private:
  std::string bytes_;
};

std::string framed(const std::string& message);

}  // namespace understudy::emulator::dap
