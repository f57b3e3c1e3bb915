// Reads W3C Thing Models and Thing Descriptions with the Modbus binding
// (https://w3c.github.io/wot-binding-templates/bindings/protocols/modbus), as lists of registers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/register_list.h"

namespace understudy::emulator::model_file {

/// Returns true for a JSON object with the keys of a Thing.
bool is_thing(std::string_view text);
/// Returns the text of a Thing in UTF-8, or nothing for bytes that are something else.
std::optional<std::string> text_of_thing(const std::string& bytes);

struct ThingList {
  std::string csv{};          // a register list, with addresses as on the line
  std::optional<int> unit{};  // the station number in the forms
  RegisterList list{};        // the same list after reading
};

/// Reads properties as registers. `path` is for messages. `addresses` overrides whether the forms count from
/// 0 or 1. Throws FileError with all errors.
ThingList read_thing(const std::string& text, const std::string& path,
                     std::optional<AddressReading> addresses);

}  // namespace understudy::emulator::model_file
