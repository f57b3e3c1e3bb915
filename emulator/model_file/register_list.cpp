#include "emulator/model_file/register_list.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "base/text/utf8.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/list_row.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

constexpr std::size_t kMaxRegisters = 20'000;

/// The names and addresses that are taken, and the lines that took them.
class Taken {
 public:
  void require_free(const ListRow& row, const ListedRegister& listed) const {
    for (int word = 0; word < (is_32_bit(listed.type) ? 2 : 1); ++word) {
      const auto found = words_.find({listed.table, listed.address + word});
      if (found == words_.end()) continue;
      row.fail(Column::address, quoted(row.text(Column::address)) + " is taken by " + found->second.first +
                                    " in line " + std::to_string(found->second.second) +
                                    "; expected a free one in the table " +
                                    std::string(to_string(listed.table)) +
                                    (is_32_bit(listed.type) ? " (32 bits take two addresses)" : ""));
    }
    for (const std::string& name : names_of(listed)) {
      const auto found = names_.find({listed.table, name});
      if (found == names_.end()) continue;
      row.fail(Column::name, quoted(name) + " is a name of line " + std::to_string(found->second) +
                                 " already; expected another one in the table " +
                                 std::string(to_string(listed.table)));
    }
  }
  void take(const ListRow& row, const ListedRegister& listed) {
    for (int word = 0; word < (is_32_bit(listed.type) ? 2 : 1); ++word)
      words_[{listed.table, listed.address + word}] = {listed.name, row.line()};
    for (const std::string& name : names_of(listed)) names_[{listed.table, name}] = row.line();
  }

 private:
  static std::vector<std::string> names_of(const ListedRegister& listed) {
    if (!is_32_bit(listed.type)) return {listed.name};
    return {listed.name, listed.name + "_L", listed.name + "_H"};  // the halves have names as well
  }
  std::map<std::pair<Table, int>, std::pair<std::string, int>> words_;
  std::map<std::pair<Table, std::string>, int> names_;
};

std::vector<Column> read_headings(const CsvRow& row, const ListPlace& place,
                                  world::Diagnostics& diagnostics) {
  std::vector<Column> columns;
  std::vector<std::string> known;
  for (const auto& [word, column] : kHeadings) known.emplace_back(word);
  std::array<bool, kColumns> seen{};
  for (const CsvCell& cell : row.cells) {
    const auto fail = [&](const std::string& what) {
      throw FileError({place.file, row.line + place.lines_before, cell.column}, "columns: " + what);
    };
    columns.push_back(Column::left_out);
    diagnostics.attempt([&] {
      if (cell.text.empty()) return;
      const auto column = column_called(cell.text);
      if (!column) fail(quoted(cell.text) + " is not a column" + suggestion(cell.text, known));
      if (*column == Column::left_out) return;
      if (std::exchange(seen[static_cast<std::size_t>(*column)], true))
        fail(quoted(cell.text) + " appears twice; expected it once");
      columns.back() = *column;
    });
  }
  diagnostics.attempt([&] {
    for (const Column needed : {Column::address, Column::name}) {
      if (seen[static_cast<std::size_t>(needed)]) continue;
      throw FileError({place.file, row.line + place.lines_before, 1},
                      std::string("columns: there is no ") + (needed == Column::name ? "name" : "address") +
                          "; expected a first line such as address,name,access,width,unit,min,max,default");
    }
  });
  return columns;
}

void require_text(const std::string& text, const ListPlace& place) {
  const auto wrong = first_not_utf8(text);
  if (!wrong) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(*wrong), '\n');
  throw FileError({place.file, static_cast<int>(line) + place.lines_before, 1},
                  "registers: the line is not UTF-8; expected the list saved as CSV in UTF-8");
}

}  // namespace

BitName bits_called(const std::string& name, const std::string& bits, Type type) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (type == Type::bit || type == Type::f32) refuse("there are no bits to name; expected none");
  const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
  if (is_number || name.find_first_of(".{}\"'=<>!, ") != std::string::npos || one_line(name) != name)
    refuse(quoted(name) + " cannot be used as a bit's name; expected a word");
  const std::size_t dash = bits.find('-', 1);
  const auto first = parse_integer(bits.substr(0, dash));
  const auto last = dash == std::string::npos ? first : parse_integer(bits.substr(dash + 1));
  const int width = width_of(type);
  if (!first || !last || *first < 0 || *last < *first || *last >= width)
    refuse(quoted(bits) + " is not a bit; expected 0 to " + std::to_string(width - 1) +
           ", or two of them as in 4-7");
  return {.name = name, .bit = static_cast<int>(*first), .width = static_cast<int>(*last - *first) + 1};
}

std::vector<BitName> parse_bits(const std::string& text, Type type) {
  std::vector<BitName> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(",;", begin), text.size());
    std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    part.erase(0, std::min(part.find_first_not_of(' '), part.size()));
    part.erase(part.find_last_not_of(' ') + 1);
    const std::size_t blank = part.find(' ');
    if (blank == std::string::npos)
      throw std::invalid_argument(quoted(part) + " is not a bit; expected 0 READY");
    all.push_back(bits_called(part.substr(part.find_first_not_of(' ', blank)), part.substr(0, blank), type));
  }
  require_apart(all);
  return all;
}

void require_apart(const std::vector<BitName>& all) {
  std::uint32_t taken = 0;
  for (const BitName& name : all) {
    const std::uint32_t mask = bits(name.bit, "", name.width).mask();
    if ((taken & mask) != 0)
      throw std::invalid_argument(name.name + " shares a bit; expected bits of its own");
    taken |= mask;
    const auto same =
        std::count_if(all.begin(), all.end(), [&](const BitName& other) { return other.name == name.name; });
    if (same > 1) throw std::invalid_argument(quoted(name.name) + " appears twice; expected it once");
  }
}

std::vector<ListedRegister> read_register_list(const std::string& text, const ListPlace& place,
                                               world::Diagnostics& diagnostics) {
  std::vector<ListedRegister> all;
  diagnostics.attempt([&] {
    require_text(text, place);
    const std::vector<CsvRow> rows = parse_csv(text, place.file);
    const auto fail = [&](const std::string& what) {
      throw FileError({place.file, 1 + place.lines_before, 1}, "registers: " + what);
    };
    if (rows.size() < 2) fail("there is none; expected a line of columns, and one for each register");
    if (rows.size() > kMaxRegisters)
      fail("there are too many; expected " + std::to_string(kMaxRegisters) + " at most");
    const std::size_t before = diagnostics.count();
    const std::vector<Column> columns = read_headings(rows.front(), place, diagnostics);
    if (diagnostics.count() != before) return;  // the meaning of the columns is not known
    Taken taken;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      diagnostics.attempt([&] {
        const ListRow row(rows[i], columns, place.file, place.lines_before);
        if (rows[i].cells.size() > columns.size()) {
          throw FileError({place.file, row.line(), rows[i].cells[columns.size()].column},
                          "columns: the row has " + std::to_string(rows[i].cells.size()) +
                              " cells; expected " + std::to_string(columns.size()) +
                              ", and quotes around a cell with a separator in it");
        }
        ListedRegister listed = register_of(row);
        taken.require_free(row, listed);
        taken.take(row, listed);
        all.push_back(std::move(listed));
      });
    }
  });
  return all;
}

}  // namespace understudy::emulator::model_file
