// The names and addresses of a list that are in use, and the lines that use them.
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
  /// Renames a register that has the name of an earlier one. Throws FileError if an address is in use.
  void place(const ListRow& row, std::vector<models::imported::ListedRegister>& registers);
  /// Remembers registers; the first of them has this number in the list.
  void take(const ListRow& row, const std::vector<models::imported::ListedRegister>& registers,
            std::size_t number);
  /// Returns the number of the register at an address plus 1, or 0.
  std::size_t at(Table table, int address) const;

 private:
  struct Place {
    std::size_t number = 0;  // the number of the register in the list, plus 1
    int line = 0;
    std::string name{};
  };
  static std::vector<std::string> names_of(const models::imported::ListedRegister& listed);
  int line_of_name(const models::imported::ListedRegister& listed) const;

  std::array<std::vector<Place>, 4> words_;  // the registers, by table and address
  std::array<std::unordered_map<std::string, int>, 4> names_;
};

}  // namespace understudy::emulator::model_file
