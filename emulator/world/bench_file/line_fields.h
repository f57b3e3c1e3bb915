// What a bench file says of a line, but for its stations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

pty::Timing read_timing(const YamlFields& timing);

/// In millionths.
std::int64_t read_baud_tolerance(const YamlFields& tolerance);

bool read_echo(const YamlFields& echo);

SimTime read_byte_timeout(const YamlFields& timeout);

/// One address or several, at which none of the other lines listens.
std::vector<TcpAddress> read_listen(const YamlFields& listen, const std::vector<LineSetup>& lines);

/// `fields` are a line's, whose stations are read: what it has in the way of ports fits together, and its
/// stations.
void demand_ports(const YamlFields& fields, const LineSetup& line, const Bench& bench);

/// The path of a link, in `folder`; none of the other lines may have it.
std::string read_link(const YamlFields& link, const std::optional<std::string>& folder,
                      const std::vector<LineSetup>& lines);

}  // namespace understudy::emulator::world
