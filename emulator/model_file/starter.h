// Creates the initial files that `understudy import` writes for a register list: a model file and a bench.
#pragma once

#include <string>

#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/register_list.h"

namespace understudy::emulator::model_file {

/// Returns the registers of a list that is a separate file. Throws FileError with all mistakes.
RegisterList read_list_file(const std::string& bytes, const std::string& path, const ListReading& reading);

/// Returns a model file: the path of the list, common settings for line and map, and an axis in comments,
/// with those registers of the list whose names suggest their meaning.
std::string starter_model(const RegisterList& list, const ListReading& reading, const std::string& name,
                          const std::string& list_path);
/// Returns a bench with one device of that model. Its port is NAME.port.
std::string starter_bench(const std::string& name, const std::string& model_path, int station = 1);

}  // namespace understudy::emulator::model_file
