// Reads the machines of a bench file.
#pragma once

#include <string>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Returns the number of the axis with this name.
int require_axis(const YamlFields& fields, const Model& model, const std::string& name);

/// Reads an entry of `plant`, which is the machine on an axis. Keeps all errors. `model` and `axis` are null
/// if the entry's name does not determine them.
PlantSetup read_machine(const YamlFields& fields, const Model* model, const AxisRow* axis,
                        Diagnostics& diagnostics);

}  // namespace understudy::emulator::world
