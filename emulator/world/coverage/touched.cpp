#include "emulator/world/coverage/touched.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator::world {

namespace {

void add_counts(std::vector<std::int64_t>& counts, const std::vector<std::int64_t>& other) {
  for (std::size_t i = 0; i < counts.size() && i < other.size(); ++i) {
    if (other[i] == kCannotBe) continue;
    counts[i] = std::max<std::int64_t>(counts[i], 0) + other[i];
  }
}

}  // namespace

TouchedTable::Share TouchedTable::share() const {
  Share share;
  for (const TouchedRow& row : rows) {
    for (const std::int64_t count : row.counts) {
      if (count == kCannotBe) continue;
      ++share.all;
      if (count > 0) ++share.touched;
    }
  }
  return share;
}

TouchedRow& TouchedTable::row(const std::string& of) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const TouchedRow& row) { return row.name == of; });
  if (found != rows.end()) return *found;
  return rows.emplace_back(TouchedRow{of, std::vector<std::int64_t>(columns.size(), kCannotBe)});
}

void TouchedTable::add(const TouchedTable& other) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < rows.size(); ++i) places.emplace(rows[i].name, i);
  for (const TouchedRow& theirs : other.rows) {
    const auto place = places.find(theirs.name);
    if (place == places.end()) {
      rows.push_back(theirs);
    } else {
      add_counts(rows[place->second].counts, theirs.counts);
    }
  }
}

void TouchedReport::add(const TouchedReport& other) {
  for (const auto& [name, theirs] : other.models) {
    TouchedModel& own = models[name];
    for (const TouchedTable& table : theirs) {
      const auto found = std::find_if(own.begin(), own.end(),
                                      [&](const TouchedTable& one) { return one.name == table.name; });
      if (found == own.end()) {
        own.push_back(table);
      } else {
        found->add(table);
      }
    }
  }
}

std::vector<Untouched> TouchedReport::untouched() const {
  std::vector<Untouched> cells;
  for (const auto& [model, tables] : models) {
    for (const TouchedTable& table : tables) {
      for (const TouchedRow& row : table.rows) {
        for (std::size_t i = 0; i < row.counts.size(); ++i) {
          if (row.counts[i] != 0) continue;
          cells.push_back({model, table.name, row.name, table.columns[i], row.matters_most && i == 0});
        }
      }
    }
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Untouched& a, const Untouched& b) { return a.matters_most > b.matters_most; });
  return cells;
}

std::string text_of(const Untouched& cell) {
  return cell.model + ": " + cell.table + ": " + cell.row + ": never " + cell.column;
}

std::string json_text(const TouchedReport& report) {
  using ReportJson = nlohmann::ordered_json;
  ReportJson json{
      {"kind", "device-coverage"}, {"models", ReportJson::object()}, {"untouched", ReportJson::array()}};
  for (const auto& [model, tables] : report.models) {
    ReportJson& own = json["models"][model] = ReportJson::object();
    for (const TouchedTable& table : tables) {
      const TouchedTable::Share share = table.share();
      ReportJson rows = ReportJson::object();
      for (const TouchedRow& row : table.rows) {
        ReportJson& counts = rows[row.name] = ReportJson::array();
        for (const std::int64_t count : row.counts)
          counts.push_back(count == kCannotBe ? ReportJson() : ReportJson(count));
      }
      own[table.name] = ReportJson{{"touched", share.touched},
                                   {"of", share.all},
                                   {"columns", table.columns},
                                   {"rows", std::move(rows)}};
    }
  }
  for (const Untouched& cell : report.untouched()) {
    json["untouched"].push_back(
        {{"model", cell.model}, {"table", cell.table}, {"row", cell.row}, {"never", cell.column}});
  }
  return json.dump(1, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

}  // namespace understudy::emulator::world
