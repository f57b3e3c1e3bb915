// Reads a list of registers (docs/import.md): CSV with the columns of `understudy describe MODEL registers
// --format csv`.
#pragma once

#include <string>
#include <vector>

#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

/// The place of a list: a file of its own, or another file, in which it follows line `lines_before`.
struct ListPlace {
  std::string file;
  int lines_before = 0;
};

/// Returns the registers of a list, in its order. They are fit for a register map: no two share an address
/// or a name, and values suit their types. Keeps all errors with line and column; the rows concerned are
/// left out.
std::vector<models::imported::ListedRegister> read_register_list(const std::string& text,
                                                                 const ListPlace& place,
                                                                 world::Diagnostics& diagnostics);

/// Parses named bits of a list: "READY, 4-7 STATE". Throws std::invalid_argument with what is wrong and what
/// was expected.
std::vector<models::imported::BitName> parse_bits(const std::string& text, Type type);
/// Requires that no two share a bit or a name. Throws std::invalid_argument.
void require_apart(const std::vector<models::imported::BitName>& all);
/// Parses the bits of one name: "4", "4-7". Throws std::invalid_argument.
models::imported::BitName bits_called(const std::string& name, const std::string& bits, Type type);

}  // namespace understudy::emulator::model_file
