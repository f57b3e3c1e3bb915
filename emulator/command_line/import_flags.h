// The flags of `import`. Only flags.cpp includes this file, because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_import_flags(CLI::App& command, ImportArguments& import) {
  const auto add = [&](const char* name, std::string& value, const char* help) {
    command.add_option(name, value, help)->check(kNotEmpty);
  };
  command
      .add_option("REGISTERS", import.list,
                  "A register list (CSV: address, name, access, ...), or a W3C Thing Model")
      ->required();
  add("-o,--output", import.output, "Model file to write [NAME.yaml next to the list]");
  add("--name", import.name, "Name of the model [that of the list]");
  add("--columns", import.columns, "Headings (or letters) of columns: address=Reg,name=B [by synonyms]");
  add("--addresses", import.addresses,
      "How addresses are counted: wire, from_one, modicon (40001) [guessed]");
  add("--table", import.table, "Table for rows that name none: holding, input, coil or discrete [holding]");
  add("--encoding", import.encoding, "Encoding of the list: utf-8, utf-16, latin-1, big5, gbk [guessed]");
}

}  // namespace understudy::emulator::command_line
