// Tables that count what a test suite has exercised on controllers, added up over any number of runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

/// Marks something impossible, such as a write to a read-only register.
inline constexpr std::int64_t kCannotBe = -1;

struct TouchedRow {
  std::string name;                  // "STATUS"
  std::vector<std::int64_t> counts;  // by column
  bool matters_most = false;         // a particularly serious gap if no run has touched it

  bool operator==(const TouchedRow&) const = default;
};

struct TouchedTable {
  std::string name;                  // "registers"
  std::vector<std::string> columns;  // "read", "written"
  std::vector<TouchedRow> rows{};    // in the order of the manual

  /// How many cells can be touched, and how many have been.
  struct Share {
    std::int64_t touched = 0;
    std::int64_t all = 0;
  };
  Share share() const;
  /// Returns the row with that name. Adds the row if there is none.
  TouchedRow& row(const std::string& name);
  void add(const TouchedTable& other);
  bool operator==(const TouchedTable&) const = default;
};

/// The tables of a model. Those whose gaps are the most serious come first.
using TouchedModel = std::vector<TouchedTable>;

/// A cell that no run has touched.
struct Untouched {
  std::string model;
  std::string table;
  std::string row;
  std::string column;
  bool matters_most = false;
};

struct TouchedReport {
  std::map<std::string, TouchedModel> models;  // by name

  void add(const TouchedReport& other);
  /// Returns all cells that no run has touched, the most serious ones first.
  std::vector<Untouched> untouched() const;
  bool operator==(const TouchedReport&) const = default;
};

/// Returns text such as "the host has never read STATUS".
std::string text_of(const Untouched& cell);

/// Returns the report as JSON: models, tables, rows with their counts (null: impossible), and `untouched`.
std::string json_text(const TouchedReport& report);

}  // namespace understudy::emulator::world
