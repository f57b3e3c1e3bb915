// The type of a row: how many words it occupies, and what they contain.
#pragma once

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

struct RowShape {
  TypeMeaning::Kind kind = TypeMeaning::Kind::number;
  Type type = Type::u16;  // of each register; for `only_words`, f32 means a 64-bit real number
  int words = 1;          // words per quantity
  int count = 1;          // how many quantities follow each other
  int bits = 0;           // for a part, its number of bits
  WordOrder order{};
  bool is_flag = false;  // true for a 0 or 1 that occupies a whole word

  bool holds_only_words() const {
    return kind == TypeMeaning::Kind::text || kind == TypeMeaning::Kind::only_words;
  }
};

/// `printed_words` is the number of addresses in the row, such as in 10-11. Throws FileError for the first
/// mistake.
RowShape shape_of(const ListRow& row, Table table, int printed_words);

}  // namespace understudy::emulator::model_file
