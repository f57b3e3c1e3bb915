// Joins rows of a list that describe one register: one for reading and one for writing, or one for each byte.
#pragma once

#include <string>

#include "emulator/model_file/list_row.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// A register of the list with the row that described it first, and a later row for the same place.
struct DescribedTwice {
  models::imported::ListedRegister& whole;
  const ListRow& first_row;
  const ListRow& row;
  const models::imported::ListedRegister& again;

  bool has_other_name() const {
    return whole.name != again.name && first_row.text(Column::name) != row.text(Column::name);
  }
};

/// Returns true if the rows are the high and the low byte of a register.
bool are_bytes(const DescribedTwice& both);
/// Makes both rows names of bits. Returns what is in the way, or an empty text.
std::string join_bytes(const DescribedTwice& both);
/// Returns true if the later row is the high or the low word of a register with 32 bits, by its name.
bool is_word_of(const DescribedTwice& both);
/// Adds to the register what the later row knows. Returns the first fact in which they differ, such as
/// "another unit (V, here A)", or an empty text. Then the register has changed.
std::string join_rows(const DescribedTwice& both);

}  // namespace understudy::emulator::model_file
