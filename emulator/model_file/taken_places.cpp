#include "emulator/model_file/taken_places.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/joined_rows.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_words.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

using models::imported::ListedRegister;

namespace {

constexpr std::size_t kAddresses = 65'536;

int words_of(const ListedRegister& listed) { return is_32_bit(listed.type) ? 2 : 1; }
std::size_t index_of(Table table) { return static_cast<std::size_t>(table); }

}  // namespace

bool TakenPlaces::is_said_to_be_short(const Place& place) {
  return place.row->text(Column::words) == "1" && place.row->type() && place.row->type()->words == 2;
}

std::vector<std::string> TakenPlaces::names_of(const ListedRegister& listed) {
  if (!is_32_bit(listed.type)) return {listed.name};
  return {listed.name, listed.name + "_L", listed.name + "_H"};  // the halves also have names
}

int TakenPlaces::line_of_name(const ListedRegister& listed) const {
  const auto& names = names_[index_of(listed.table)];
  for (const std::string& name : names_of(listed)) {
    const auto found = names.find(name);
    if (found != names.end()) return found->second;
  }
  return 0;
}

std::size_t TakenPlaces::at(Table table, int address) const {
  const auto& words = words_[index_of(table)];
  return words.empty() ? 0 : words[static_cast<std::size_t>(address)].number;
}

const ListRow& TakenPlaces::row_at(Table table, int address) const {
  return *words_[index_of(table)][static_cast<std::size_t>(address)].row;
}

std::string TakenPlaces::free_name(const ListedRegister& listed) const {
  ListedRegister tried = listed;
  const std::string begin = listed.name + "_" + std::to_string(listed.address);
  for (int more = 1; line_of_name(tried) != 0; ++more)
    tried.name = more == 1 ? begin : begin + "_" + std::to_string(more);
  return tried.name;
}

void TakenPlaces::join_one(const ListRow& row, const ListedRegister& again, ListedRegister& whole,
                           const ListRow& first_row) {
  const DescribedTwice both{whole, first_row, row, again};
  const std::string line = " in line " + std::to_string(first_row.line());
  const std::string before = whole.name;
  const std::string alias = whole.alias;
  const bool is_word = is_word_of(both);
  const bool is_byte = !is_word && are_bytes(both);
  const std::string why = is_word ? "" : is_byte ? join_bytes(both) : join_rows(both);
  if (!why.empty()) {
    row.fail(Column::address, quoted(row.text(Column::address)) + " is taken by " + before + line +
                                  ", which has " + why + "; expected rows that agree, or a free address");
  }
  if (is_byte) whole.name = free_name(whole);
  if (whole.alias != alias) {
    ListedRegister named = whole;
    named.name = whole.alias;
    whole.alias = named.name = free_name(named);
    for (const std::string& name : names_of(named)) names_[index_of(named.table)][name] = row.line();
  }
  for (const std::string& name : names_of(whole)) names_[index_of(whole.table)].emplace(name, row.line());
  if (is_reserved(row.text(Column::name))) return;
  const std::string is_known = is_word ? " is half of " + quoted(before) + line + "; it gets no separate name"
                               : is_byte
                                   ? " is a byte of " + quoted(whole.name) + ", as " + quoted(before) + line
                               : whole.alias.empty() ? " is also" + line + "; the rows are one register"
                                                     : " is another name of " + quoted(before) + line;
  row.remark("joined", Column::name, quoted(row.text(Column::name)) + is_known);
}

bool TakenPlaces::join(const ListRow& row, const std::vector<ListedRegister>& registers,
                       std::vector<ListedRegister>& list) {
  const auto is_known = [&](const ListedRegister& listed) {
    const std::size_t number = at(listed.table, listed.address);
    if (number == 0) return false;
    const ListedRegister& whole = list[number - 1];
    const ListRow& first = *words_[index_of(listed.table)][listed.address].row;
    ListedRegister copy = whole;
    return whole.address == listed.address || is_word_of({copy, first, row, listed});
  };
  if (!std::all_of(registers.begin(), registers.end(), is_known)) return false;
  for (const ListedRegister& again : registers) {
    const Place& place = words_[index_of(again.table)][again.address];
    join_one(row, again, list[place.number - 1], *place.row);
  }
  return true;
}

void TakenPlaces::place(const ListRow& row, std::vector<ListedRegister>& registers) {
  for (ListedRegister& listed : registers) {
    const auto& words = words_[index_of(listed.table)];
    for (int word = 0; word < words_of(listed) && !words.empty(); ++word) {
      const Place& taken = words[static_cast<std::size_t>(listed.address + word)];
      if (taken.number == 0) continue;
      row.fail(
          Column::address,
          quoted(row.text(Column::address)) + " is taken by " + taken.name + " in line " +
              std::to_string(taken.row->line()) + "; expected a free address in the table " +
              std::string(to_string(listed.table)) +
              (is_32_bit(listed.type)       ? " (32 bits take two addresses)"
               : is_said_to_be_short(taken) ? " (" + taken.name + " has the words " +
                                                  quoted(taken.row->text(Column::words)) + ", but 32 bits)"
                                            : ""));
    }
    const int line = line_of_name(listed);
    if (line == 0) continue;
    const std::string before = listed.name;
    listed.name = free_name(listed);
    if (is_reserved(row.text(Column::name))) continue;
    row.remark("repeated", Column::name,
               quoted(before) + " is already a name in line " + std::to_string(line) +
                   "; here it is called " + quoted(listed.name));
  }
}

void TakenPlaces::take(const ListRow& row, const std::vector<ListedRegister>& registers, std::size_t number) {
  for (const ListedRegister& listed : registers) {
    auto& words = words_[index_of(listed.table)];
    if (words.empty()) words.resize(kAddresses);
    ++number;
    for (int word = 0; word < words_of(listed); ++word) {
      words[static_cast<std::size_t>(listed.address + word)] = {
          .number = number, .row = &row, .name = listed.name};
    }
    for (const std::string& name : names_of(listed)) names_[index_of(listed.table)][name] = row.line();
  }
}

}  // namespace understudy::emulator::model_file
