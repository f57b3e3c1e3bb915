// The flags of `poll`. Only flags.cpp includes this file, because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_poll_flags(CLI::App& command, PollArguments& poll) {
  command.add_option("PORT", poll.port, "A serial port, or a link to one")->required();
  command.add_option("ITEM", poll.items,
                     "NAME, ADDRESS or ADDRESS:COUNT to read; NAME=VALUE or ADDRESS=VALUE to write");
  command
      .add_option("--command", poll.commands, "Command to send before the items, by its name in the model")
      ->check(kNotEmpty)
      ->allow_extra_args(false);
  command.add_option("--station", poll.station,
                     "Station number of the device [the model's factory setting, or 1]");
  command.add_option("--model", poll.model, "Model whose register names to use")->check(kNotEmpty);
  command
      .add_option(
          "--word-order", poll.word_order,
          "Word of a 32-bit value that comes first: low or high [the device's order; low without --model]")
      ->check(kNotEmpty);
  command.add_option("--baud", poll.baud, "Line speed [the model's, or 19200]");
  command.add_option("--parity", poll.parity, "even, odd or none [the model's, or even]")->check(kNotEmpty);
  command.add_option("--stop-bits", poll.stop_bits, "1 or 2 [the model's, or 1]");
  command
      .add_option("--function", poll.function,
                  "Function that reads addresses: 1 coils, 2 discrete inputs, 3 holding or 4 input registers")
      ->capture_default_str();
  command
      .add_option("--type", poll.type,
                  "Type of values at addresses that the model does not name: u16, s16, u32, s32 or f32")
      ->capture_default_str();
  command.add_option("--timeout", poll.timeout, "How long to wait for a reply")->capture_default_str();
  command.add_option("--every", poll.every, "Repeat the items at this interval")->check(kNotEmpty);
  command.add_option("--times", poll.times, "Number of rounds; 0 repeats until Ctrl-C")
      ->capture_default_str();
}

}  // namespace understudy::emulator::command_line
