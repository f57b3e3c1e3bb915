#include "emulator/box/wire/port_name.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/world/bench/listening.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace {

constexpr std::string_view kExpected =
    "expected PORT, PORT,SPEED or PORT,SPEED,FRAMING, such as /dev/ttyUSB0,19200,8E1";

/// Parses "8E1".
std::optional<pty::LineSettings> parse_framing(std::string_view text) {
  if (text.size() != 3 || (text[0] != '7' && text[0] != '8') || (text[2] != '1' && text[2] != '2')) return {};
  pty::LineSettings framing;
  framing.data_bits = text[0] - '0';
  framing.stop_bits = text[2] - '0';
  switch (text[1]) {
    case 'E':
    case 'e': framing.parity = pty::Parity::even; break;
    case 'O':
    case 'o': framing.parity = pty::Parity::odd; break;
    case 'N':
    case 'n': framing.parity = pty::Parity::none; break;
    default: return {};
  }
  return framing;
}

std::string_view take_part(std::string_view& rest) {
  const std::size_t comma = rest.find(',');
  const std::string_view part = rest.substr(0, comma);
  rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
  return part;
}

}  // namespace

PortName parse_port_name(std::string_view text) {
  const auto refuse = [&](const std::string& why) -> PortNameError {
    return PortNameError(quoted(text) + ": " + why + "; " + std::string(kExpected));
  };
  std::string_view rest = text;
  PortName name;
  name.place = take_part(rest);
  if (name.place.empty()) throw refuse("has no port");
  if (name.place.find("://") != std::string::npos) {
    try {
      name.tcp = world::parse_tcp_address(name.place);
    } catch (const world::ListeningError& error) {
      throw PortNameError(quoted(text) + ": " + error.what());
    }
    if (name.tcp->port == 0) throw PortNameError(quoted(text) + ": has no TCP port; expected HOST:PORT");
  }
  if (!rest.empty() && !name.has_settings())
    throw PortNameError(quoted(text) + ": has settings, but " + name.place +
                        " carries none; expected them at the adapter, or rfc2217://");
  if (!rest.empty()) {
    const std::string_view part = take_part(rest);
    const auto baud = parse_integer(part);
    if (!baud || *baud < 50 || *baud > 4'000'000) throw refuse(quoted(part) + " is not a speed");
    name.baud = static_cast<int>(*baud);
  }
  if (!rest.empty()) {
    const std::string_view part = take_part(rest);
    name.framing = parse_framing(part);
    if (!name.framing || !rest.empty()) throw refuse(quoted(part) + " is not a framing");
  }
  return name;
}

}  // namespace understudy::emulator::box
