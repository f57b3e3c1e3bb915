// The files that `understudy import` writes for a list of registers: a model file and a bench to go on from.
#pragma once

#include <string>
#include <vector>

#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// The registers of a list that stands alone. Throws FileError: everything that is wrong.
std::vector<models::imported::ListedRegister> read_list_file(const std::string& text,
                                                             const std::string& path);

/// A model file: the list by its path, the line and the map with what is usual, and an axis in comments, with
/// the registers of the list that by their names may be the ones.
std::string starter_model(const std::vector<models::imported::ListedRegister>& registers,
                          const std::string& name, const std::string& list_path);
/// A bench of one device of it, whose port is NAME.port.
std::string starter_bench(const std::string& name, const std::string& model_path);

}  // namespace understudy::emulator::model_file
