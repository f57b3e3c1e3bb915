// Reads single numbers of a row, as counts or in its unit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/row_shape.h"

namespace understudy::emulator::model_file {

/// The two ends of a range, as they are written, and their columns.
struct Ends {
  std::string min{};
  std::string max{};
  Column first = Column::min;
  Column last = Column::max;
};

/// Adds remarks for a step that cannot be read and is ignored, or that contradicts the step of the unit.
void check_step(const ListRow& row);
/// Returns the step of a row's counts: that of its unit, or else of its scale or its decimals.
std::optional<Step> step_of(const ListRow& row);
/// Returns true if the step is 1, which changes nothing.
bool is_one(const Step& step);

/// Reads numbers of one row. They are counts, unless one of them has decimals: then all are in the unit.
class RowNumbers {
 public:
  /// The row and the shape must outlive it.
  RowNumbers(const ListRow& row, const RowShape& shape, const Ends& ends);

  /// Throws FileError if the word is not a number of this shape.
  Value value(Column column, const std::string& word) const;
  /// Returns the lowest or the highest number that the shape can hold.
  Value limit(bool is_highest) const;
  std::string limit_text(bool is_highest) const;

  /// False also for real numbers, which have no counts.
  bool are_counts() const { return !in_units_ && shape_.type != Type::f32; }

 private:
  TypeLimits limits() const;
  Value real(Column column, std::string word) const;
  std::optional<std::int64_t> whole(Column column, const std::string& word) const;
  std::optional<std::int64_t> counts(Column column, const std::string& word) const;
  void say_what_commas_mean(Column column, const std::string& word) const;

  const ListRow& row_;
  const RowShape& shape_;
  bool in_units_ = false;
  Column column_with_decimals_ = Column::min;
  std::string with_decimals_{};
};

/// Returns nothing for a word that is neither on nor off, nor yes nor no.
std::optional<bool> on_or_off_called(const std::string& word);

}  // namespace understudy::emulator::model_file
