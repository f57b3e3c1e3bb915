// Reads a line of a bench file, except its stations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

pty::Timing read_timing(const YamlFields& timing);

/// Returns the tolerance in millionths.
std::int64_t read_baud_tolerance(const YamlFields& tolerance);

bool read_echo(const YamlFields& echo);

SimTime read_byte_timeout(const YamlFields& timeout);

/// Reads one or several addresses into `line`. No other line may listen on any of these addresses.
void read_listen(const YamlFields& listen, const std::vector<LineSetup>& lines, LineSetup& line,
                 Diagnostics& diagnostics);

/// Checks that the ports of a line are consistent and match its stations. `fields` are those of the line,
/// whose stations have already been read.
void require_ports(const YamlFields& fields, const LineSetup& line, const Bench& bench);

/// Reads the path of a link, which is relative to `folder`. No other line may have the same link.
std::string read_link(const YamlFields& link, const std::optional<std::string>& folder,
                      const std::vector<LineSetup>& lines);

}  // namespace understudy::emulator::world
