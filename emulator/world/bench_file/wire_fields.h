// Reads the wires of a bench file.
#pragma once

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_names.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Reads an element of `wires`: "feeder.DOUT_4 -> turner.DIN_10", "feeder.A.home -> turner.DIN_10". The
/// bench's devices and machines must already have been read. Keeps the errors of both ends.
WireSetup read_wire(const YamlFields& wire, const Bench& bench, const BenchNames& names,
                    Diagnostics& diagnostics);

}  // namespace understudy::emulator::world
