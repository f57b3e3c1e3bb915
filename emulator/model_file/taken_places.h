// The names and addresses of a list that are already in use, and the lines that use them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "emulator/model_file/list_row.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

class TakenPlaces {
 public:
  /// If all registers of a row are already in the list, joins them with those in the list (joined_rows.h).
  /// Throws FileError if the rows contradict each other.
  bool join(const ListRow& row, const std::vector<models::imported::ListedRegister>& registers,
            std::vector<models::imported::ListedRegister>& list);
  /// Renames a register whose name is already in use. Throws FileError if an address is in use.
  void place(const ListRow& row, std::vector<models::imported::ListedRegister>& registers);
  /// Records registers. `number` is the number of the first of them in the list.
  void take(const ListRow& row, const std::vector<models::imported::ListedRegister>& registers,
            std::size_t number);
  /// Returns the number of the register at an address, plus 1, or 0 if there is none.
  std::size_t at(Table table, int address) const;
  /// Returns the row that took an address first.
  const ListRow& row_at(Table table, int address) const;

 private:
  struct Place {
    std::size_t number = 0;  // the number of the register in the list, plus 1
    const ListRow* row = nullptr;
    std::string name{};
  };
  /// Returns true if the row of a place gives one word to a type that has two.
  static bool is_said_to_be_short(const Place& place);
  static std::vector<std::string> names_of(const models::imported::ListedRegister& listed);
  int line_of_name(const models::imported::ListedRegister& listed) const;
  /// Returns the name. If it is in use, the address is appended.
  std::string free_name(const models::imported::ListedRegister& listed) const;
  void join_one(const ListRow& row, const models::imported::ListedRegister& again,
                models::imported::ListedRegister& whole, const ListRow& first_row);

  std::array<std::vector<Place>, 4> words_;  // the registers, by table and address
  std::array<std::unordered_map<std::string, int>, 4> names_;
};

}  // namespace understudy::emulator::model_file
