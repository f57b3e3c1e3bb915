// What browsers say (docs/page.md): all of it is judged here, before anything is done with it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {

using Json = nlohmann::ordered_json;

/// What a browser did wrong; one line.
struct BrowserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BrowserMessage {
  enum class What : std::uint8_t { watch, ask } what = What::watch;
  std::size_t bench = 0;
  // watch: none of it means nothing more.
  bool watches = false;
  std::vector<std::string> names{};
  bool frames = false;
  bool events = false;
  bool status = false;
  // ask
  std::string id{};       // a whole number
  std::string message{};  // for the control socket, a line of JSON; empty if it is not passed on:
  std::string refusal{};  // why
};

/// Throws BrowserError.
BrowserMessage parse_browser_message(std::string_view text, std::size_t benches, bool is_read_only);

/// The token of a first message; empty if it has none.
std::string token_of(std::string_view text);

/// Why a message for the control socket is not passed on; empty: it is. Files of the machine are nobody's
/// business here, so one that names a file is refused.
std::string why_not_sent(const Json& message, bool is_read_only);

}  // namespace understudy::emulator::page
