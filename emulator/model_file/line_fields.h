// What a model file says of its line and its map.
#pragma once

#include <string>

#include "emulator/model_file/binder.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// The number of a word among those that a form lists; fails for another one.
std::size_t read_word(const world::YamlFields& field, const world::Form& form);

/// But for `station_in`. All that is wrong is kept.
void read_line(const world::YamlFields& fields, models::imported::Line& line, world::Complaints& complaints);
void read_policy(const world::YamlFields& fields, MapPolicy& policy, world::Complaints& complaints);
/// The name of the register that holds the station number.
std::string read_station_register(const world::YamlFields& field, const Binder& binder,
                                  const models::imported::Description& description);

}  // namespace understudy::emulator::model_file
