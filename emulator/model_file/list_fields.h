// Reads the settings for reading a list, either from a model file or from flags of `import`.
#pragma once

#include <string>

#include "emulator/model_file/list_reading.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// Collects all errors.
void read_list_fields(const world::YamlFields& fields, ListReading& reading, world::Diagnostics& diagnostics);

/// Parses "address=Reg,name=Tag". Throws std::invalid_argument, which contains what is wrong and what was
/// expected.
void parse_columns(const std::string& text, ListReading& reading);

/// Returns the section `list` for a model file, or an empty text if it is not needed.
std::string list_section(const ListReading& reading, AddressReading addresses);

/// Returns any text as a YAML scalar.
std::string quoted_yaml(const std::string& text);

}  // namespace understudy::emulator::model_file
