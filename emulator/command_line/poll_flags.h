// The flags of `poll`. Included by flags.cpp only: CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_poll_flags(CLI::App& command, PollArguments& poll) {
  command.add_option("PORT", poll.port, "A serial port or a link to one")->required();
  command.add_option("ITEM", poll.items,
                     "NAME, ADDRESS or ADDRESS:COUNT to read; NAME=VALUE or ADDRESS=VALUE to write");
  command.add_option("--command", poll.commands, "A command by the model's name, sent before the items")
      ->check(kNotEmpty)
      ->allow_extra_args(false);
  command.add_option("--station", poll.station,
                     "Station to ask; without it the model's factory number, or 1");
  command.add_option("--model", poll.model, "Model whose names to use")->check(kNotEmpty);
  command
      .add_option("--word-order", poll.word_order,
                  "low or high word first; without it as the device has it, or low without --model")
      ->check(kNotEmpty);
  command.add_option("--baud", poll.baud, "Line speed; without it the model's, or 19200");
  command.add_option("--parity", poll.parity, "even, odd or none; without it the model's, or even")
      ->check(kNotEmpty);
  command.add_option("--stop-bits", poll.stop_bits, "1 or 2; without it the model's, or 1");
  command
      .add_option("--function", poll.function,
                  "What to read addresses with: 1 coils, 2 discrete inputs, 3 holding or 4 input registers")
      ->capture_default_str();
  command.add_option("--type", poll.type, "u16, s16, u32, s32 or f32 of addresses without a model's name")
      ->capture_default_str();
  command.add_option("--timeout", poll.timeout, "How long to wait for a reply")->capture_default_str();
  command.add_option("--every", poll.every, "Time between two rounds")->check(kNotEmpty);
  command.add_option("--times", poll.times, "How many rounds; 0: no end")->capture_default_str();
}

}  // namespace understudy::emulator::command_line
