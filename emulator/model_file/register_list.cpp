#include "emulator/model_file/register_list.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/utf8.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/joined_rows.h"
#include "emulator/model_file/list_addresses.h"
#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/row_registers.h"
#include "emulator/model_file/taken_places.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

constexpr std::size_t kMaxRegisters = 20'000;

void require_text(const std::string& text, const ListPlace& place) {
  const auto wrong = first_not_utf8(text);
  if (!wrong) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(*wrong), '\n');
  throw FileError({place.file, static_cast<int>(line) + place.lines_before, 1},
                  "registers: the line is not UTF-8; expected a list saved as CSV in UTF-8");
}

}  // namespace

BitName bits_called(const std::string& name, const std::string& bits, Type type) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (type == Type::bit || type == Type::f32)
    refuse("the register has no bits to name; expected no names of bits");
  const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
  if (is_number || name.find_first_of(".{}\"'=<>!, ") != std::string::npos || one_line(name) != name)
    refuse(quoted(name) + " cannot be used as a bit's name; expected a word");
  const std::size_t dash = bits.find('-', 1);
  const auto first = parse_integer(bits.substr(0, dash));
  const auto last = dash == std::string::npos ? first : parse_integer(bits.substr(dash + 1));
  const int width = width_of(type);
  if (!first || !last || *first < 0 || *last < *first || *last >= width)
    refuse(quoted(bits) + " is not a bit; expected 0 to " + std::to_string(width - 1) +
           ", or a range such as 4-7");
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
      throw std::invalid_argument(quoted(part) +
                                  " is not a named bit; expected a number and a name, as in 0 READY");
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
      throw std::invalid_argument(name.name + " shares a bit with another name; expected separate bits");
    taken |= mask;
    const auto same =
        std::count_if(all.begin(), all.end(), [&](const BitName& other) { return other.name == name.name; });
    if (same > 1) throw std::invalid_argument(quoted(name.name) + " appears twice; expected it only once");
  }
}

namespace {

class ListReader {
 public:
  /// Cells of the rows are changed.
  ListReader(std::vector<CsvRow>& rows, const ListPlace& place, const ListReading& reading,
             world::Diagnostics& diagnostics, RegisterList& list)
      : rows_(rows), place_(place), reading_(reading), diagnostics_(diagnostics), list_(list) {}

  void read() {
    const std::size_t before = diagnostics_.count();
    plan_ = plan_columns(rows_, reading_, place_, diagnostics_, list_.remarks);
    if (diagnostics_.count() != before) return;  // the meaning of the columns is unknown
    for (std::size_t i = plan_.heading_row + 1; i < rows_.size(); ++i) {
      const bool is_empty = std::all_of(rows_[i].cells.begin(), rows_[i].cells.end(),
                                        [](const CsvCell& cell) { return cell.text.empty(); });
      if (is_empty || is_section(rows_[i])) continue;
      make_plain(rows_[i]);
      cells_.push_back(&rows_[i]);
      read_rows_.emplace_back(rows_[i], context_);
    }
    read_addresses();
    if (!decide_addresses()) return;
    context_.addresses = list_.addresses;
    for (std::size_t i = 0; i < read_rows_.size(); ++i)
      diagnostics_.attempt([&] { read_row(*cells_[i], read_rows_[i], printed_[i]); });
  }

 private:
  /// Removes typographic signs, and words for "none", from the cells that hold no names.
  void make_plain(CsvRow& row) {
    const ListRow as_printed(row, context_);
    const bool is_text = as_printed.type() && as_printed.type()->kind == TypeMeaning::Kind::text;
    for (std::size_t i = 0; i < std::min(row.cells.size(), plan_.columns.size()); ++i) {
      std::string& text = row.cells[i].text;
      switch (plan_.columns[i]) {
        case Column::min:
        case Column::max:
        case Column::range:
        case Column::values:
        case Column::scale:
        case Column::decimals:
        case Column::offset:
        case Column::words:
        case Column::width: text = plain_cell(text); break;
        case Column::factory:
          if (!is_text) text = plain_cell(text);
          break;
        case Column::unit:
        case Column::order:
        case Column::persistent:
        case Column::since:
          if (plain_cell(text).empty()) text.clear();
          break;
        default: break;
      }
    }
  }

  /// Returns true for a title between rows, which is alone in its row.
  bool is_section(const CsvRow& row) {
    constexpr std::ptrdiff_t kLetters = 3;
    const CsvCell* only = nullptr;
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      if (row.cells[i].text.empty()) continue;
      if (only != nullptr || i >= plan_.columns.size()) return false;
      if (plan_.columns[i] != Column::address && plan_.columns[i] != Column::left_out) return false;
      only = &row.cells[i];
    }
    const std::string& text = only->text;
    const auto letters = std::count_if(text.begin(), text.end(),
                                       [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; });
    if (letters < kLetters || parse_address(text, plan_.has_hexadecimal_addresses)) return false;
    list_.remarks.add("section", {place_.file, row.line + place_.lines_before, only->column},
                      "registers: " + quoted(text) + " is alone in its row; it is ignored as a title");
    return true;
  }

  void read_addresses() {
    const bool is_hexadecimal = plan_.has_hexadecimal_addresses ||
                                std::any_of(read_rows_.begin(), read_rows_.end(), [](const ListRow& row) {
                                  return has_hexadecimal_letters(row.text(Column::address));
                                });
    for (const ListRow& row : read_rows_) {
      printed_.push_back(parse_address(row.text(Column::address), is_hexadecimal));
      if (!printed_.back()) continue;
      const auto table = table_in_cells(row);
      const auto& type = row.type();
      const bool holds_words = type && !(type->kind == TypeMeaning::Kind::number && type->type == Type::bit);
      const bool can_be_modicon =
          evidence_.add(*printed_.back(), table ? table : printed_.back()->table, holds_words);
      if (!can_be_modicon && not_modicon_ == nullptr) not_modicon_ = &row;
    }
    if (is_hexadecimal && !read_rows_.empty()) {
      read_rows_.front().remark("hexadecimal", Column::address,
                                "all addresses are read as hexadecimal numbers, because some of them are");
    }
  }

  /// Returns false if the unit of the addresses is unclear.
  bool decide_addresses() {
    const auto guessed = reading_.guesses_addresses ? evidence_.likely() : evidence_.certain();
    if (reading_.addresses) {
      list_.addresses = *reading_.addresses;
      return true;
    }
    list_.addresses = guessed.value_or(AddressReading::wire);
    if (read_rows_.empty()) return true;
    const ListRow& row = read_rows_.front();
    const PrintedAddress first = printed_.front().value_or(PrintedAddress{});
    const auto as_modicon = wire_address(first, AddressReading::modicon);
    if (!guessed && reading_.guesses_addresses) {
      return diagnostics_.attempt([&] {
        row.fail(Column::address, "the addresses can be Modicon numbers or addresses on the wire: " +
                                      quoted(row.text(Column::address)) + " is " +
                                      std::string(to_string(as_modicon->table.value_or(Table::holding))) +
                                      " register " + std::to_string(as_modicon->address) + ", or register " +
                                      std::to_string(first.number) +
                                      "; expected --addresses modicon, or --addresses wire");
      });
    }
    if (list_.addresses == AddressReading::modicon && as_modicon) {
      row.remark("addresses", Column::address,
                 "read as Modicon numbers: " + quoted(row.text(Column::address)) + " is " +
                     std::to_string(as_modicon->address) +
                     " on the wire (--addresses wire leaves the addresses unchanged)");
    } else if (!guessed) {
      row.remark(
          "addresses", Column::address,
          "read as addresses on the wire, although all of them may be Modicon numbers (`list: { addresses: "
          "modicon }`)");
    } else if (evidence_.begins_a_block && not_modicon_ != nullptr && reading_.guesses_addresses) {
      not_modicon_->remark("addresses", Column::address,
                           "read as addresses on the wire, like all others of the list: " +
                               quoted(not_modicon_->text(Column::address)) +
                               " is not a Modicon number, although others can be (--addresses modicon)");
    } else if (evidence_.lowest == 1 && reading_.guesses_addresses) {
      row.remark(
          "addresses", Column::address,
          "read as addresses on the wire: 1 is the second register (with --addresses from_one, the first)");
    }
    return true;
  }

  void read_row(const CsvRow& cells, const ListRow& row, const std::optional<PrintedAddress>& printed) {
    require_width(cells);
    RowRegisters made = registers_of(row, printed, diagnostics_);
    if (made.registers.empty()) return;
    if (made.part) {
      const ListedRegister& only = made.registers.front();
      const std::size_t number = taken_.at(only.table, only.address);
      if (number != 0) {
        return join_part({list_.registers[number - 1], taken_.row_at(only.table, only.address), row, only},
                         *made.part, made_of_parts_.contains(number));
      }
      if (printed->bit >= 0) {
        made.registers.front() = register_of_part(row, only, *made.part);
        made_of_parts_.insert(list_.registers.size() + 1);
      }
    }
    if (taken_.join(row, made.registers, list_.registers)) return;
    taken_.place(row, made.registers);
    taken_.take(row, made.registers, list_.registers.size());
    list_.registers.insert(list_.registers.end(), std::make_move_iterator(made.registers.begin()),
                           std::make_move_iterator(made.registers.end()));
  }

  void require_width(const CsvRow& cells) const {
    const std::size_t width = plan_.columns.size();
    if (cells.cells.size() <= width) return;
    const bool are_empty =
        std::all_of(cells.cells.begin() + static_cast<std::ptrdiff_t>(width), cells.cells.end(),
                    [](const CsvCell& cell) { return cell.text.empty(); });
    if (are_empty) return;
    throw FileError({place_.file, cells.line + place_.lines_before, cells.cells[width].column},
                    "columns: the row has " + std::to_string(cells.cells.size()) + " cells; expected " +
                        std::to_string(width) + ", and quotes around a cell with a separator in it");
  }

  std::vector<CsvRow>& rows_;
  const ListPlace& place_;
  const ListReading& reading_;
  world::Diagnostics& diagnostics_;
  RegisterList& list_;
  ColumnPlan plan_;
  KnownTypes types_;
  ListContext context_{reading_, plan_, place_, AddressReading::wire, list_.remarks, types_};
  std::vector<const CsvRow*> cells_;  // the cells of non-empty rows
  std::vector<ListRow> read_rows_;    // the same rows after reading
  std::vector<std::optional<PrintedAddress>> printed_;
  AddressEvidence evidence_;
  const ListRow* not_modicon_ = nullptr;  // the first row whose address cannot be a Modicon number
  TakenPlaces taken_;
  std::set<std::size_t> made_of_parts_;  // the registers that began with a row for some of their bits
};

}  // namespace

RegisterList read_register_list(const std::string& text, const ListPlace& place, const ListReading& reading,
                                world::Diagnostics& diagnostics) {
  RegisterList list;
  diagnostics.attempt([&] {
    require_text(text, place);
    std::vector<CsvRow> rows = parse_csv(text, place.file);
    const auto fail = [&](const std::string& what) {
      throw FileError({place.file, 1 + place.lines_before, 1}, "registers: " + what);
    };
    const std::size_t before = diagnostics.count();
    if (rows.size() < 2) fail("the list is empty; expected a line of headings, and a line for each register");
    if (rows.size() > kMaxRegisters)
      fail("there are too many registers; expected at most " + std::to_string(kMaxRegisters));
    ListReader(rows, place, reading, diagnostics, list).read();
    if (list.registers.empty() && diagnostics.count() == before)
      fail("the list is empty; expected a line for each register below the headings");
    if (list.registers.size() > kMaxRegisters)
      fail("there are too many registers; expected at most " + std::to_string(kMaxRegisters));
  });
  return list;
}

}  // namespace understudy::emulator::model_file
