// The type of a row: how many words it occupies, and what they hold.
#pragma once

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

struct RowShape {
  TypeMeaning::Kind kind = TypeMeaning::Kind::number;
  Type type = Type::u16;  // the type of each register; for `only_words`, f32 means a real number of 64 bits
  int words = 1;          // the number of words of one quantity
  int count = 1;          // the number of quantities, one after another
  int bits = 0;           // the number of bits of a part
  WordOrder order{};
  bool is_flag = false;  // true for a 0 or 1 in a whole word

  bool holds_only_words() const {
    return kind == TypeMeaning::Kind::text || kind == TypeMeaning::Kind::only_words;
  }
};

/// `printed_words` is the number of addresses that the row names, as in 10-11. Throws FileError for the first
/// mistake.
RowShape shape_of(const ListRow& row, Table table, int printed_words);

}  // namespace understudy::emulator::model_file
