// Reads the machines of a bench file.
#pragma once

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Reads one entry of `plant`: the machine on an axis. Keeps all errors.
PlantSetup read_machine(const YamlFields& fields, const Model& model, int axis, Diagnostics& diagnostics);

}  // namespace understudy::emulator::world
