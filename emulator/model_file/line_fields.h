// Reads the line settings and the map policy of a model file.
#pragma once

#include <string>

#include "emulator/model_file/binder.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// Returns the index of a word in a schema's list. Throws FileError for any other word.
std::size_t read_word(const world::YamlFields& field, const world::Schema& schema);

/// Reads everything except `station_in`. Collects all errors.
void read_line(const world::YamlFields& fields, models::imported::Line& line,
               world::Diagnostics& diagnostics);
void read_policy(const world::YamlFields& fields, MapPolicy& policy, world::Diagnostics& diagnostics);
/// Returns the name of the register that stores the station number.
std::string read_station_register(const world::YamlFields& field, const Binder& binder,
                                  const models::imported::Description& description);

}  // namespace understudy::emulator::model_file
