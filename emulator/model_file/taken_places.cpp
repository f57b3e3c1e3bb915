#include "emulator/model_file/taken_places.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
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

std::vector<std::string> TakenPlaces::names_of(const ListedRegister& listed) {
  if (!is_32_bit(listed.type)) return {listed.name};
  return {listed.name, listed.name + "_L", listed.name + "_H"};  // the halves have names too
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

void TakenPlaces::place(const ListRow& row, std::vector<ListedRegister>& registers) {
  for (ListedRegister& listed : registers) {
    const auto& words = words_[index_of(listed.table)];
    for (int word = 0; word < words_of(listed) && !words.empty(); ++word) {
      const Place& taken = words[static_cast<std::size_t>(listed.address + word)];
      if (taken.number == 0) continue;
      row.fail(Column::address, quoted(row.text(Column::address)) + " is taken by " + taken.name +
                                    " in line " + std::to_string(taken.line) +
                                    "; expected a free one in the table " +
                                    std::string(to_string(listed.table)) +
                                    (is_32_bit(listed.type) ? " (32 bits take two addresses)" : ""));
    }
    const int line = line_of_name(listed);
    if (line == 0) continue;
    const std::string before = listed.name;
    const std::string begin = before + "_" + std::to_string(listed.address);
    listed.name = begin;
    for (int more = 2; line_of_name(listed) != 0; ++more) listed.name = begin + "_" + std::to_string(more);
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
          .number = number, .line = row.line(), .name = listed.name};
    }
    for (const std::string& name : names_of(listed)) names_[index_of(listed.table)][name] = row.line();
  }
}

}  // namespace understudy::emulator::model_file
