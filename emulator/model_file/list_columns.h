// Determines the meaning of the columns of a register list.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/model_file/csv.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

/// The location of a list: a separate file, or another file in which the list begins after line
/// `lines_before`.
struct ListPlace {
  std::string file;
  int lines_before = 0;
};

struct ColumnPlan {
  std::size_t heading_row = 0;       // the rows before it are titles
  std::vector<Column> columns{};     // the columns, by cell
  std::vector<std::size_t> names{};  // the cells that contain names, the best one first
  bool has_hexadecimal_addresses = false;
  bool operator==(const ColumnPlan&) const = default;
};

/// Collects all errors. If there is an error, the plan is unusable.
ColumnPlan plan_columns(const std::vector<CsvRow>& rows, const ListReading& reading, const ListPlace& place,
                        world::Diagnostics& diagnostics, Remarks& remarks);

}  // namespace understudy::emulator::model_file
