// Reads the numbers of a row: its range, its default, and the meanings of its values.
#pragma once

#include "emulator/model_file/list_row.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// Read a row's numbers for one register of this shape. Each throws FileError for the first mistake.
void read_range(const ListRow& row, const RowShape& shape, models::imported::ListedRegister& listed);
/// The range must be known.
void read_factory(const ListRow& row, const RowShape& shape, models::imported::ListedRegister& listed);
/// Adds a remark for a scale or a number of decimals that cannot be read, and is ignored.
void check_step(const ListRow& row);
/// Returns the unit, with the step of a scale in front: "0.1V".
std::string unit_of(const ListRow& row);

/// Returns the words of a text or of a quantity of 64 bits after power-up, in the order of the wire.
std::vector<std::uint16_t> factory_words(const ListRow& row, const RowShape& shape);

/// Returns a name in the characters that bit names may have.
std::string as_word(const std::string& text);

}  // namespace understudy::emulator::model_file
