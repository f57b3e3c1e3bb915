#include "emulator/model_file/list_row.h"

#include <cstddef>
#include <string>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

ListRow::ListRow(const CsvRow& row, const ListContext& context) : row_(row), context_(context) {
  const ColumnPlan& plan = context.plan;
  for (std::size_t i = 0; i < row.cells.size() && i < plan.columns.size(); ++i) {
    if (plan.columns[i] != Column::left_out)
      cells_[static_cast<std::size_t>(plan.columns[i])] = &row.cells[i];
  }
  const CsvCell*& name = cells_[static_cast<std::size_t>(Column::name)];
  for (const std::size_t cell : plan.names) {
    if (name != nullptr && !name->text.empty()) break;
    if (cell < row.cells.size() && !row.cells[cell].text.empty()) name = &row.cells[cell];
  }
}

const std::string& ListRow::text(Column column) const {
  static const std::string kNone;
  const CsvCell* const cell = cells_[static_cast<std::size_t>(column)];
  return cell == nullptr ? kNone : cell->text;
}

FilePlace ListRow::place_of(Column column) const {
  const CsvCell* const cell = cells_[static_cast<std::size_t>(column)];
  return {context_.place.file, line(), cell == nullptr ? 1 : cell->column};
}

void ListRow::fail(Column column, const std::string& what) const {
  throw FileError(place_of(column), std::string(name_of(column)) + ": " + what);
}

void ListRow::remark(const std::string& kind, Column column, const std::string& what) const {
  context_.remarks.add(kind, place_of(column), std::string(name_of(column)) + ": " + what);
}

bool ListRow::yes_or_no(Column column) const {
  if (const auto answer = yes_or_no_called(text(column))) return *answer;
  fail(column, quoted(text(column)) + " is neither yes nor no; expected 1 or 0");
}

}  // namespace understudy::emulator::model_file
