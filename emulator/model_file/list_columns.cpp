#include "emulator/model_file/list_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

namespace {

constexpr std::size_t kMaxTitles = 20;  // lines that may precede the headings
constexpr std::size_t kSampled = 50;    // rows that are examined to determine the contents of a column

/// One meaning that a heading may have.
struct Claim {
  int rank;
  std::size_t cell;
  Column column;
};

/// Returns the index of a spreadsheet column: both "A" and "1" are the first column.
std::optional<std::size_t> cell_of_letters(const std::string& text) {
  if (const auto number = parse_integer(text)) {
    return *number >= 1 ? std::optional(static_cast<std::size_t>(*number - 1)) : std::nullopt;
  }
  const bool are_letters = !text.empty() && text.size() <= 2 &&
                           std::all_of(text.begin(), text.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  if (!are_letters) return std::nullopt;
  std::size_t number = 0;
  for (const char c : text) number = number * 26 + static_cast<std::size_t>(c - 'A') + 1;
  return number - 1;
}

std::optional<std::size_t> cell_called(const CsvRow& row, const std::string& heading) {
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    if (lower(row.cells[i].text) == lower(heading)) return i;
  }
  return std::nullopt;
}

bool has_meaning(const CsvRow& row, Column column) {
  return std::any_of(row.cells.begin(), row.cells.end(), [&](const CsvCell& cell) {
    const std::string key = heading_key(cell.text);
    return std::any_of(headings().begin(), headings().end(), [&](const Heading& heading) {
      return heading.column == column && heading.key == key;
    });
  });
}

/// Returns the first row that contains headings for addresses and for names. If there is none, returns the
/// first row.
std::size_t find_headings(const std::vector<CsvRow>& rows, const ListReading& reading) {
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxTitles); ++i) {
    const auto has = [&](Column column) {
      for (const auto& [named, heading] : reading.columns) {
        if (named == column) return cell_called(rows[i], heading).has_value();
      }
      return has_meaning(rows[i], column);
    };
    if (has(Column::address) && has(Column::name)) return i;
  }
  return 0;
}

class Planner {
 public:
  Planner(const std::vector<CsvRow>& rows, const ListReading& reading, const ListPlace& place,
          world::Diagnostics& diagnostics, Remarks& remarks)
      : rows_(rows), reading_(reading), place_(place), diagnostics_(diagnostics), remarks_(remarks) {
    plan_.heading_row = find_headings(rows, reading);
    plan_.columns.assign(row().cells.size(), Column::left_out);
    is_known_.assign(row().cells.size(), false);
  }

  ColumnPlan plan() {
    if (plan_.heading_row > 0) {
      remarks_.add("titles", {place_.file, rows_.front().line + place_.lines_before, 1},
                   "columns: the headings are in line " + std::to_string(row().line + place_.lines_before) +
                       "; the lines before them are ignored");
    }
    take_named();
    std::vector<Claim> claims = claims_of_headings();
    std::stable_sort(claims.begin(), claims.end(),
                     [](const Claim& one, const Claim& other) { return one.rank < other.rank; });
    for (const Claim& claim : claims) take(claim);
    for (const Claim& claim : claims) {  // if a row has no name, the next best column may contain one
      if (claim.column == Column::name && plan_.columns[claim.cell] == Column::left_out)
        plan_.names.push_back(claim.cell);
    }
    require_needed();
    report_passed_over();
    return std::move(plan_);
  }

 private:
  const CsvRow& row() const { return rows_[plan_.heading_row]; }
  FilePlace place_of(std::size_t cell) const {
    return {place_.file, row().line + place_.lines_before,
            cell < row().cells.size() ? row().cells[cell].column : 1};
  }

  void put(std::size_t cell, Column column) {
    plan_.columns[cell] = column;
    is_known_[cell] = true;
    seen_[static_cast<std::size_t>(column)] = cell;
    if (column == Column::name) plan_.names.insert(plan_.names.begin(), cell);
    if (column == Column::address) plan_.has_hexadecimal_addresses = says_hexadecimal(row().cells[cell].text);
  }

  void take_named() {
    for (const auto& [column, heading] : reading_.columns) {
      diagnostics_.attempt([&, &called = heading, &which = column] {
        auto cell = cell_called(row(), called);
        if (!cell) cell = cell_of_letters(called);
        if (!cell || *cell >= row().cells.size()) {
          std::vector<std::string> known;
          for (const CsvCell& one : row().cells) known.push_back(one.text);
          throw FileError(place_of(0),
                          "columns: there is no heading " + quoted(called) + suggestion(called, known));
        }
        put(*cell, which);
      });
    }
  }

  /// Returns the first non-empty text below a heading.
  std::string sample(std::size_t cell) const {
    for (std::size_t i = plan_.heading_row + 1; i < std::min(rows_.size(), plan_.heading_row + kSampled);
         ++i) {
      if (cell < rows_[i].cells.size() && !rows_[i].cells[cell].text.empty())
        return rows_[i].cells[cell].text;
    }
    return {};
  }

  /// Returns false if the text below a heading shows that the heading has a different meaning.
  bool suits(std::size_t cell, const Heading& heading) const {
    const std::string text = sample(cell);
    if (text.empty()) return true;
    switch (heading.column) {
      case Column::table: return heading.rank == 0 || listed_table_called(text).has_value();
      case Column::function: return table_of_function(text).has_value();
      case Column::type: return type_called(text) || (!listed_table_called(text) && !access_called(text));
      default: return true;
    }
  }

  std::vector<Claim> claims_of_headings() {
    std::vector<Claim> claims;
    for (std::size_t i = 0; i < row().cells.size(); ++i) {
      if (plan_.columns[i] != Column::left_out) continue;
      const std::string key = heading_key(row().cells[i].text);
      for (const Heading& heading : headings()) {
        if (heading.key != key) continue;
        if (heading.column == Column::left_out) is_known_[i] = true;
        if (heading.column != Column::left_out && suits(i, heading))
          claims.push_back({heading.rank, i, heading.column});
      }
      if (key == "type" || key == "typ") {
        const std::string text = sample(i);
        if (!type_called(text) && listed_table_called(text)) claims.push_back({2, i, Column::table});
        if (!type_called(text) && access_called(text)) claims.push_back({4, i, Column::access});
      }
    }
    return claims;
  }

  void take(const Claim& claim) {
    const auto& other = seen_[static_cast<std::size_t>(claim.column)];
    if (plan_.columns[claim.cell] != Column::left_out) return;
    if (!other) return put(claim.cell, claim.column);
    diagnostics_.attempt([&] {
      if (lower(row().cells[claim.cell].text) != lower(row().cells[*other].text)) return;
      throw FileError(place_of(claim.cell), "columns: " + quoted(row().cells[claim.cell].text) +
                                                " appears twice; expected it only once");
    });
  }

  void require_needed() {
    for (const Column needed : {Column::address, Column::name}) {
      if (seen_[static_cast<std::size_t>(needed)]) continue;
      diagnostics_.attempt([&] {
        const std::string name(name_of(needed));
        std::vector<std::string> headings_there;
        for (const CsvCell& cell : row().cells) headings_there.push_back(cell.text);
        const auto near = near_word(name, headings_there);
        throw FileError(place_of(0), "columns: there is no column " + name +
                                         (near ? ", but " + quoted(*near) : "") +
                                         "; expected a first line such as "
                                         "address,name,access,width,unit,min,max,default, or --columns " +
                                         name + "=HEADING");
      });
    }
  }

  void report_passed_over() {
    std::string passed;
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < row().cells.size(); ++i) {
      const std::string& text = row().cells[i].text;
      if (is_known_[i] || text.empty()) continue;
      const bool is_name = std::find(plan_.names.begin(), plan_.names.end(), i) != plan_.names.end();
      if (is_name) continue;
      if (!first) first = i;
      passed += (passed.empty() ? "" : ", ") + one_line(text);
    }
    if (!first) return;
    remarks_.add("columns", place_of(*first),
                 "columns: ignored: " + passed + "; --columns COLUMN=HEADING gives them a meaning");
  }

  const std::vector<CsvRow>& rows_;
  const ListReading& reading_;
  const ListPlace& place_;
  world::Diagnostics& diagnostics_;
  Remarks& remarks_;
  ColumnPlan plan_;
  std::vector<bool> is_known_;
  std::array<std::optional<std::size_t>, kColumns> seen_{};  // the cell of each column
};

}  // namespace

ColumnPlan plan_columns(const std::vector<CsvRow>& rows, const ListReading& reading, const ListPlace& place,
                        world::Diagnostics& diagnostics, Remarks& remarks) {
  return Planner(rows, reading, place, diagnostics, remarks).plan();
}

}  // namespace understudy::emulator::model_file
