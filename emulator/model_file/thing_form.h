// Reads the forms of a Thing's property: the registers to which they refer, and how hosts use them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// The combined contents of all Modbus forms of a property.
struct ThingForm {
  Table table = Table::holding;
  std::int64_t address = 0;  // as written
  bool counts_from_zero = false;
  std::optional<int> quantity{};  // registers or bits
  std::string type{};             // an XML Schema type, without its prefix
  std::optional<WordOrder> order{};
  std::optional<int> unit{};
  bool is_read = false;
  bool is_written = false;
};

/// Returns nothing if the property has no Modbus form. `base` is the Thing's base. Throws FileError.
std::optional<ThingForm> thing_form(const world::YamlFields& property, const std::string& base);

}  // namespace understudy::emulator::model_file
