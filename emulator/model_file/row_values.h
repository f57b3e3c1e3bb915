// Reads the numbers in a row: its range, its default, and the meanings of its values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/model_file/list_row.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

/// Reads a row's range and default for one register of this shape. Collects all errors, and returns false if
/// there was one.
bool read_numbers(const ListRow& row, const RowShape& shape, models::imported::ListedRegister& listed,
                  world::Diagnostics& diagnostics);
/// Adds errors for words that are no numbers in any type, if the row's type is unknown.
void check_numbers(const ListRow& row, world::Diagnostics& diagnostics);
/// Returns the unit, with the step of a scale in front: "0.1V".
std::string unit_of(const ListRow& row);

/// Returns the power-up words of a text or a 64-bit quantity, in the order of the line.
std::vector<std::uint16_t> factory_words(const ListRow& row, const RowShape& shape);

/// Returns a name that contains only characters which are allowed in bit names.
std::string as_word(const std::string& text);

}  // namespace understudy::emulator::model_file
