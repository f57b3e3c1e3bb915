// A row of a register list: its cells by column.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "base/files/file_error.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

/// Caches the meanings of type words, because a list has many rows but only a few different types.
class KnownTypes {
 public:
  const std::optional<TypeMeaning>& of(const std::string& word) {
    const auto found = all_.find(word);
    return found != all_.end() ? found->second : all_.emplace(word, type_called(word)).first->second;
  }

 private:
  std::map<std::string, std::optional<TypeMeaning>> all_;
};

/// The data that all rows of a list share. It must outlive the rows.
struct ListContext {
  const ListReading& reading;
  const ColumnPlan& plan;
  const ListPlace& place;
  AddressReading addresses;
  Remarks& remarks;
  KnownTypes& types;
};

class ListRow {
 public:
  /// Both arguments must outlive this object.
  ListRow(const CsvRow& row, const ListContext& context);

  const ListContext& context() const { return context_; }
  const std::string& text(Column column) const;
  bool has(Column column) const { return !text(column).empty(); }
  int line() const { return row_.line + context_.place.lines_before; }
  FilePlace place_of(Column column) const;
  /// Throws FileError with the position of the column's cell.
  [[noreturn]] void fail(Column column, const std::string& what) const;
  /// Adds a remark about something that was ignored or guessed, with the position of the column's cell.
  void remark(const std::string& kind, Column column, const std::string& what) const;
  bool yes_or_no(Column column) const;
  /// Returns the meaning of the `type` cell.
  const std::optional<TypeMeaning>& type() const { return context_.types.of(text(Column::type)); }

 private:
  const CsvRow& row_;
  const ListContext& context_;
  std::array<const CsvCell*, kColumns> cells_{};
};

}  // namespace understudy::emulator::model_file
