#include "emulator/play/report/touched_page.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/report/page_parts.h"
#include "emulator/play/results/junit.h"
#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::play {

namespace {

using world::TouchedTable;
using world::Untouched;

constexpr std::size_t kWorstOnPage = 100;
constexpr std::size_t kWorstInText = 5;

std::string share_text(const TouchedTable& table) {
  const TouchedTable::Share share = table.share();
  return std::to_string(share.touched) + " of " + std::to_string(share.all);
}

std::string cell_of(std::int64_t counted) {
  if (counted == world::kCannotBe) return "<td></td>";
  return "<td class=\"time" + std::string(counted == 0 ? " bad" : "") + "\">" + std::to_string(counted) +
         "</td>";
}

std::string text_of(const TouchedTable& table) {
  std::string text = "<details class=\"scenario\"><summary><h2>" + xml_escaped(table.name) +
                     "</h2><span class=\"dim\">" + share_text(table) +
                     "</span></summary>\n<div class=\"scroll\"><table class=\"programs touched\">\n<tr><th "
                     "scope=\"col\"></th>";
  for (const std::string& column : table.columns) {
    text += "<th scope=\"col\" class=\"time\">" + xml_escaped(column) + "</th>";
  }
  text += "</tr>\n";
  for (const world::TouchedRow& row : table.rows) {
    text += "<tr><td><code>" + xml_escaped(row.name) + "</code></td>";
    for (const std::int64_t counted : row.counts) text += cell_of(counted);
    text += "</tr>\n";
  }
  return text + "</table></div></details>\n";
}

bool is_same_row(const Untouched& a, const Untouched& b) {
  return a.model == b.model && a.table == b.table && a.row == b.row && a.matters_most == b.matters_most;
}

std::string worst_of(const std::vector<Untouched>& cells) {
  if (cells.empty()) return "<p class=\"good\">Everything has been used.</p>\n";
  std::string text = "<div class=\"scroll\"><table>\n";
  std::size_t shown = 0;
  for (std::size_t rows = 0; shown < cells.size() && rows < kWorstOnPage; ++rows) {
    const Untouched& cell = cells[shown];
    std::string columns = cell.column;
    for (++shown; shown < cells.size() && is_same_row(cell, cells[shown]); ++shown) {
      columns += ", " + cells[shown].column;
    }
    text += "<tr><td class=\"dim\">" + xml_escaped(cell.model) + "</td><td class=\"dim\">" +
            xml_escaped(cell.table) + "</td><td><code>" + xml_escaped(cell.row) + "</code></td><td" +
            (cell.matters_most ? " class=\"bad\"" : "") + ">never " + xml_escaped(columns) + "</td></tr>\n";
  }
  text += "</table></div>\n";
  if (shown < cells.size()) {
    text +=
        "<p class=\"dim\">" + std::to_string(cells.size() - shown) + " more are in the tables below.</p>\n";
  }
  return text;
}

}  // namespace

std::string touched_text(const world::TouchedReport& report) {
  std::string text;
  for (const auto& [model, tables] : report.models) {
    text += "coverage of " + model + ":";
    for (const TouchedTable& table : tables) {
      text += std::string(&table == tables.data() ? " " : ", ") + table.name + " " + share_text(table);
    }
    text += "\n";
  }
  const std::vector<Untouched> cells = report.untouched();
  for (std::size_t i = 0; i < std::min(cells.size(), kWorstInText); ++i) {
    text += "  " + world::text_of(cells[i]) + "\n";
  }
  if (cells.size() > kWorstInText) {
    text += "  ... and " + std::to_string(cells.size() - kWorstInText) + " more\n";
  }
  return text;
}

std::string touched_page(const world::TouchedReport& report, std::string_view version) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Understudy: coverage of devices</title>\n<style>" +
      std::string(kPageStyle) +
      "</style>\n</head>\n<body>\n<header>\n<h1>Understudy</h1>\n<p>Coverage of devices</p>\n</header>\n"
      "<main>\n<h2>Never used, largest gaps first</h2>\n" +
      worst_of(report.untouched());
  for (const auto& [model, tables] : report.models) {
    page += "<h2>" + xml_escaped(model) + "</h2>\n";
    for (const TouchedTable& table : tables) page += text_of(table);
  }
  return page + "</main>\n<footer>understudy " + xml_escaped(version) + "</footer>\n</body>\n</html>\n";
}

}  // namespace understudy::emulator::play
