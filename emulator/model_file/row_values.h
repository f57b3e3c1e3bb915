// Reads the numbers in a row: its range, its default, and the meanings of its values.
#pragma once

#include "emulator/model_file/list_row.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// These read a row's numbers for a register of this shape. They throw FileError for the first mistake.
void read_range(const ListRow& row, const RowShape& shape, models::imported::ListedRegister& listed);
/// The range must already be known.
void read_factory(const ListRow& row, const RowShape& shape, models::imported::ListedRegister& listed);
/// Adds a remark for a scale or a number of decimals that cannot be read, and is ignored.
void check_step(const ListRow& row);
/// Returns the unit, with the step of a scale in front: "0.1V".
std::string unit_of(const ListRow& row);

/// Returns the power-up words of a text or a 64-bit quantity, in the order of the line.
std::vector<std::uint16_t> factory_words(const ListRow& row, const RowShape& shape);

/// Returns a name that contains only characters which are allowed in bit names.
std::string as_word(const std::string& text);

}  // namespace understudy::emulator::model_file
