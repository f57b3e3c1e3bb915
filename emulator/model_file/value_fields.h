// Reads the terminals of a model file, and the values that do not belong to an axis.
#pragma once

#include "emulator/model_file/binder.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// Reads `inputs`, or the `outputs` that follow them. Like all readers, it collects all errors.
void read_terminals(const world::YamlFields& fields, bool are_inputs, models::imported::Description& made,
                    Binder& binder, world::Diagnostics& diagnostics);
void read_followings(const world::YamlFields& fields, models::imported::Description& made, Binder& binder,
                     world::Diagnostics& diagnostics);
void read_comparisons(const world::YamlFields& fields, models::imported::Description& made, Binder& binder,
                      world::Diagnostics& diagnostics);
void read_momentary(const world::YamlFields& field, models::imported::Description& made, const Binder& binder,
                    world::Diagnostics& diagnostics);

/// Reports errors that can only be detected in the whole file: commands in registers that show something
/// else, relations between relations, and others.
void check_bindings(const world::YamlFields& root, const models::imported::Description& made,
                    world::Diagnostics& diagnostics);

}  // namespace understudy::emulator::model_file
