// Joins rows of a list that describe the same register: one row for reading and one for writing, or one for
// each byte.
#pragma once

#include <string>

#include "emulator/model_file/list_row.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// A register in the list, the first row that described it, and a later row for the same address.
struct DescribedTwice {
  models::imported::ListedRegister& whole;
  const ListRow& first_row;
  const ListRow& row;
  const models::imported::ListedRegister& again;

  bool has_other_name() const {
    return whole.name != again.name && first_row.text(Column::name) != row.text(Column::name);
  }
};

/// Returns the register for the first row that describes some of its bits, with the row's own values.
models::imported::ListedRegister register_of_part(const ListRow& row,
                                                  const models::imported::ListedRegister& only,
                                                  const models::imported::BitName& part);
/// Adds to the register what a row says about some of its bits; `again` has that row's values. Throws
/// FileError if it contradicts the register.
void join_part(const DescribedTwice& both, models::imported::BitName part, bool is_made_of_parts);

/// Returns true if the rows are the high and the low byte of a register.
bool are_bytes(const DescribedTwice& both);
/// Converts both rows to names of bits. Returns what prevents this, or an empty text.
std::string join_bytes(const DescribedTwice& both);
/// Returns true if, according to its name, the later row is the high or the low word of a 32-bit register.
bool is_word_of(const DescribedTwice& both);
/// Adds the properties in the later row to the register. Returns the first property in which they differ,
/// such as "another unit (V, here A)", or an empty text. In the former case, the register has already
/// changed.
std::string join_rows(const DescribedTwice& both);

}  // namespace understudy::emulator::model_file
