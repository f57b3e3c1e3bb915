// Reads a register list (docs/import.md): CSV with the columns of `understudy describe MODEL registers
// --format csv`.
#pragma once

#include <string>
#include <vector>

#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

struct RegisterList {
  std::vector<models::imported::ListedRegister> registers{};
  AddressReading addresses = AddressReading::wire;  // how the addresses were read
  Remarks remarks{};
};

/// Returns the registers of a list (UTF-8), in its order. They form a valid register map: no two registers
/// have the same address or name, and the values match their types. Collects all errors with line and column;
/// rows with errors are omitted.
RegisterList read_register_list(const std::string& text, const ListPlace& place, const ListReading& reading,
                                world::Diagnostics& diagnostics);

/// Parses the named bits in a list: "READY, 4-7 STATE". Throws std::invalid_argument, which contains what is
/// wrong and what was expected.
std::vector<models::imported::BitName> parse_bits(const std::string& text, Type type);
/// Requires that no two names are equal or have bits in common. Throws std::invalid_argument.
void require_apart(const std::vector<models::imported::BitName>& all);
/// Parses the bits of a name: "4", "4-7". Throws std::invalid_argument.
models::imported::BitName bits_called(const std::string& name, const std::string& bits, Type type);

}  // namespace understudy::emulator::model_file
