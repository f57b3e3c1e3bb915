// Creates the registers that a row of a list describes.
#pragma once

#include <optional>
#include <vector>

#include "emulator/model_file/list_addresses.h"
#include "emulator/model_file/list_row.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

/// A row has several registers if it contains text, has 64 bits, or contains a range of addresses.
struct RowRegisters {
  std::vector<models::imported::ListedRegister> registers{};
  /// Set if the row describes only some bits of its register; another row may describe the other bits.
  std::optional<models::imported::BitName> part{};
};

/// Collects all errors. If there is an error, the result is empty. `printed` is the address of the row, or
/// nothing if the cell is not an address.
RowRegisters registers_of(const ListRow& row, const std::optional<PrintedAddress>& printed,
                          world::Diagnostics& diagnostics);
/// Returns the table that follows from the row's own cells.
std::optional<Table> table_in_cells(const ListRow& row);

}  // namespace understudy::emulator::model_file
