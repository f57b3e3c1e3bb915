#include "emulator/world/bench_file/line_fields.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/protocol/line_protocol.h"
#include "pty/line.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kLongestLinkName = 200;  // leaves room for the name of the lock file

}  // namespace

pty::Timing read_timing(const YamlFields& timing) {
  if (timing.text() != "wire" && timing.text() != "instant") {
    timing.fail(understudy::quoted(timing.text()) + " is not a timing; expected wire or instant");
  }
  return timing.text() == "wire" ? pty::Timing::wire : pty::Timing::instant;
}

std::int64_t read_baud_tolerance(const YamlFields& tolerance) {
  if (const auto ppm = parse_baud_tolerance(tolerance.text())) return *ppm;
  tolerance.fail(understudy::quoted(tolerance.text()) + " is not valid; " +
                 std::string(kBaudToleranceExpected));
}

bool read_echo(const YamlFields& echo) {
  if (echo.text() != "on" && echo.text() != "off")
    echo.fail(understudy::quoted(echo.text()) + " is not valid; expected on or off");
  return echo.text() == "on";
}

SimTime read_byte_timeout(const YamlFields& timeout) {
  if (const auto time = parse_byte_timeout(timeout.text())) return *time;
  timeout.fail(understudy::quoted(timeout.text()) + " is not valid; " + std::string(kByteTimeoutExpected));
}

void read_listen(const YamlFields& listen, const std::vector<LineSetup>& lines, LineSetup& line,
                 Diagnostics& diagnostics) {
  const auto read_place = [&](const YamlFields& place) {
    TcpAddress address;
    try {
      address = parse_tcp_address(place.text());
    } catch (const ListeningError& error) {
      place.fail(understudy::quoted(place.text()) + " " + error.what());
    }
    const auto is_present = [&](const TcpAddress& other) { return is_same_place(address, other); };
    for (const LineSetup& other : lines) {
      if (std::ranges::any_of(other.tcp, is_present))
        place.fail("line " + understudy::quoted(other.name) + " listens there; expected another port");
    }
    if (std::ranges::any_of(line.tcp, is_present)) place.fail("appears twice; expected it only once");
    line.tcp.push_back(address);
  };
  const auto places = listen.is_list() ? listen.elements() : std::vector{listen};
  for (const YamlFields& place : places) diagnostics.attempt([&] { read_place(place); });
  if (places.empty()) listen.fail("is empty; " + std::string(kListeningExpected));
}

void require_ports(const YamlFields& fields, const LineSetup& line, const Bench& bench) {
  if (!line.has_pty && !fields.has("listen"))
    fields.at("pty").fail("leaves the line without a port; expected `listen`");
  if (!line.has_pty && !line.link.empty())
    fields.at("link").fail("needs a pseudo-terminal, but `pty` is false; expected one of the two");
  const bool is_text = !line.stations.empty() &&
                       protocol_of(*bench.devices[line.stations.front().device].model).carries_text();
  const bool has_modbus_tcp =
      std::ranges::find(line.tcp, TcpProtocol::modbus_tcp, &TcpAddress::protocol) != line.tcp.end();
  if (is_text && has_modbus_tcp)
    fields.at("listen").fail(
        "the line carries lines of text, not Modbus; expected rtu:// or rfc2217://, which carry any bytes");
}

std::string read_link(const YamlFields& link, const std::optional<std::string>& folder,
                      const std::vector<LineSetup>& lines) {
  namespace fs = std::filesystem;
  const std::string written = link.text();
  if (written.find("://") != std::string::npos)
    link.fail(understudy::quoted(written) +
              " is a network address; expected a path for a pseudo-terminal (`listen` has addresses)");
  std::string path = path_in(folder, link);
  if (one_line(path) != path) link.fail("has a control character; expected a path without one");
  const std::string name = fs::path(path).filename().string();
  if (name.size() > kLongestLinkName) {
    link.fail("has a name of " + std::to_string(name.size()) + " characters; expected at most " +
              std::to_string(kLongestLinkName));
  }
  std::error_code ignored;
  const fs::file_type there = fs::symlink_status(path, ignored).type();
  if (name.empty() || name == "." || name == ".." || there == fs::file_type::directory)
    link.fail(understudy::quoted(written) + " is a folder; expected the path of a link in this folder");
  if (there == fs::file_type::character || there == fs::file_type::block)
    link.fail(understudy::quoted(written) + " is a device file of this machine; expected a free path");
  const auto absolute = [](const std::string& some) { return fs::weakly_canonical(fs::absolute(some)); };
  for (const LineSetup& other : lines) {
    if (!other.link.empty() && absolute(other.link) == absolute(path))
      link.fail("line " + understudy::quoted(other.name) + " has the same link; expected another path");
  }
  return path;
}

}  // namespace understudy::emulator::world
