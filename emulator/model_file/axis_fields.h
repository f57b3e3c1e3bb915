// Reads the axes of a model file.
#pragma once

#include <string>

#include "emulator/model_file/binder.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// Reads an entry of `axes`. The inputs must already have been read. Collects all errors.
models::imported::AxisBinding read_axis(const world::YamlFields& fields, const std::string& name,
                                        const models::imported::Description& description, Binder& binder,
                                        world::Diagnostics& diagnostics);

}  // namespace understudy::emulator::model_file
