// Parses and checks messages of browsers (docs/page.md) before the page acts on them.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {

using Json = nlohmann::ordered_json;

/// Reports a browser's mistake in one line.
struct BrowserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BrowserMessage {
  enum class What : std::uint8_t { watch, ask } what = What::watch;
  std::size_t bench = 0;
  // These fields are for `watch`. A message without them stops watching.
  bool watches = false;
  std::vector<std::string> names{};
  bool frames = false;
  bool events = false;
  bool status = false;
  // These fields are for `ask`.
  std::string id{};       // a whole number
  std::string message{};  // a line of JSON for the control socket; empty: refused
  std::string refusal{};  // the reason why it is refused
};

/// Parses a message. Throws BrowserError.
BrowserMessage parse_browser_message(std::string_view text, std::size_t benches, bool is_read_only);

/// Returns the token of a first message, or an empty text.
std::string token_of(std::string_view text);

/// Returns why a message for the control socket is not passed on, or an empty text. Messages that name a
/// file are refused, because browsers must not reach the machine's files.
std::string why_not_sent(const Json& message, bool is_read_only);

}  // namespace understudy::emulator::page
