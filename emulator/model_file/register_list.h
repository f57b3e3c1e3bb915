// A list of registers (docs/import.md): CSV with the columns of `understudy describe MODEL registers --format
// csv`.
#pragma once

#include <string>
#include <vector>

#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/complaints.h"

namespace understudy::emulator::model_file {

/// Where a list stands: in a file of its own, or inside another one, whose line `lines_before` it follows.
struct ListPlace {
  std::string file;
  int lines_before = 0;
};

/// The registers of a list, in its order. A register map can be made of them: no two share an address or a
/// name, and values suit their types. Everything that is wrong is kept, at its line and column; such a row is
/// left out.
std::vector<models::imported::ListedRegister> read_register_list(const std::string& text,
                                                                 const ListPlace& place,
                                                                 world::Complaints& complaints);

/// "READY, 4-7 STATE": bits with names, as a list has them. Throws std::invalid_argument: what is wrong, and
/// what was expected.
std::vector<models::imported::BitName> parse_bits(const std::string& text, Type type);
/// No two have one bit or one name. Throws likewise.
void demand_apart(const std::vector<models::imported::BitName>& all);
/// The bits that one name stands for: "4", "4-7". Throws likewise.
models::imported::BitName bits_called(const std::string& name, const std::string& bits, Type type);

}  // namespace understudy::emulator::model_file
