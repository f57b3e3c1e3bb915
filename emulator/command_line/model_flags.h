// The flags of commands that describe models, or check files and programs. Only flags.cpp includes this file,
// because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/run_flags.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_describe_flags(CLI::App& command, DescribeArguments& describe) {
  command.add_option("MODEL", describe.model, "A name from `understudy models`, or a model file")->required();
  command
      .add_option("WHAT", describe.what,
                  "registers, parameters, instructions, commands, choices, ports, blocks, or thing (W3C)")
      ->required();
  command.add_option("--format", describe.format, "Output format: table, csv, json or markdown")
      ->capture_default_str();
  command
      .add_option(
          "--evidence", describe.evidence,
          "For choices: show the measurements in these files, written by `calibrate -o` or `probe -o`")
      ->check(kNotEmpty);
}

inline void add_firmware_and_choices(CLI::App& command, ProgramTextArguments& text) {
  command.add_option("--firmware", text.firmware, "Firmware version that runs the program [newest]")
      ->check(kNotEmpty);
  command.add_option("--choice", text.choices, "Choose another option: ID=OPTION")->check(kNotEmpty);
}

inline void add_check_flags(CLI::App& command, CheckArguments& check) {
  command
      .add_option("FILE", check.files,
                  "Bench, scenario and model files, or folders of them; with --model, programs")
      ->required();
  command.add_option("--model", check.programs.model, "Check the files as programs of this model")
      ->check(kNotEmpty);
  add_firmware_and_choices(command, check.programs);
  add_save_below(command, check.save_below);
  command.add_option("--format", check.format, "Output format: text, json, sarif or github")
      ->capture_default_str();
}

}  // namespace understudy::emulator::command_line
