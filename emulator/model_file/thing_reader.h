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

struct ThingList {
  std::string csv{};          // a list of registers, with addresses on the wire
  std::optional<int> unit{};  // the station number that its forms give
  RegisterList list{};        // the same list, read
};

/// Reads properties as registers. `path` is for messages; `addresses` replaces what the forms say about
/// counting from 0 or 1. Throws FileError with all errors.
ThingList read_thing(const std::string& text, const std::string& path,
                     std::optional<AddressReading> addresses);

}  // namespace understudy::emulator::model_file
