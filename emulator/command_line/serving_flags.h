// The flags of everything that serves a bench. Included by flags.cpp only: CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// `--link "$UNSET"` is a slip, not a wish for the default.
inline const CLI::Validator kNotEmpty(
    [](const std::string& value) { return value.empty() ? std::string("is empty; expected a value") : ""; },
    "");

inline const CLI::Validator kSeed(
    [](const std::string& value) {
      const auto number = parse_integer(value);
      return number && *number >= 0 ? std::string()
                                    : quoted(value) + " is not a seed; expected a whole number from 0 to " +
                                          std::to_string(INT64_MAX);
    },
    "");

inline constexpr const char* kTraceAlsoHelp =
    "More for the trace: registers and anything else that conditions can name, such as feeder.Cord_A";
inline constexpr const char* kLintHelp =
    "Report at the end what a real controller would not forgive its host";

/// Those of everything that serves a bench.
inline void add_serving_flags(CLI::App& command, ServeArguments& serving) {
  serving.version = UNDERSTUDY_VERSION;
  command.add_option("BENCH", serving.bench, "A bench file; or else --model");
  command.add_option("--model", serving.model, "One device of this model on one line")->check(kNotEmpty);
  command.add_option("--station", serving.station, "Its station number (with --model) [1, or its memory's]");
  command.add_option("--modules", serving.modules,
                     "How many modules it has, if it is a chain (with --model)");
  command.add_option("--firmware", serving.firmware, "Its firmware version (with --model) [newest]")
      ->check(kNotEmpty);
  command.add_option("--baud", serving.baud, "Its line speed (with --model) [the factory's]");
  command
      .add_option("--link", serving.link,
                  "Path of the link to its port (with --model); further ports are at PATH.NAME "
                  "[a private one]")
      ->check(kNotEmpty);
  command.add_option("--links", serving.links, "Folder for links that are relative, or that nobody named")
      ->check(kNotEmpty);
  command
      .add_option("--listen", serving.listen,
                  "Let TCP clients use a line: rtu://[HOST]:PORT (its raw bytes), rfc2217://[HOST]:PORT (its "
                  "settings as well) or modbus-tcp://[HOST]:PORT (as behind a gateway), after LINE= where "
                  "there are several lines; without HOST on this machine only")
      ->check(kNotEmpty);
  command.add_flag("--no-pty", serving.no_pty, "Lines that listen on TCP have no pseudo-terminal");
  command.add_option("--group", serving.group, "Group that may open the ports, such as dialout [none]")
      ->check(kNotEmpty);
  command
      .add_option("--timing", serving.timing,
                  "wire: bytes take their time; instant: none [wire, or the bench's]")
      ->check(kNotEmpty);
  command.add_flag("--strict-framing", serving.strict_framing,
                   "Only silence ends a frame, as on a real line");
  command.add_flag("--ignore-baud", serving.ignore_baud,
                   "Hear hosts that set another speed or other stop bits");
  command
      .add_option("--baud-tolerance", serving.baud_tolerance,
                  "How much faster or slower a host may be and still be heard [2%, or the bench's]")
      ->check(kNotEmpty);
  command
      .add_option("--byte-timeout", serving.byte_timeout,
                  "How long the rest of a frame is waited for [200ms, or the bench's]")
      ->check(kNotEmpty);
  command.add_option("--speed", serving.speed, "real, free, manual, or a factor such as 10x")
      ->capture_default_str();
  command.add_option("--control", serving.control, "Path of the control socket [a private one]")
      ->check(kNotEmpty);
  command
      .add_option("--nv", serving.nv,
                  "Folder for the devices' non-volatile memories [they last as long as the run]")
      ->check(kNotEmpty);
  command
      .add_option("--capture", serving.capture,
                  "Write what goes over the lines to this file: FILE.pcapng for Wireshark, else a text log")
      ->check(kNotEmpty);
  command
      .add_option("--record", serving.record,
                  "Write everything that comes from outside to this file, for `understudy replay`")
      ->check(kNotEmpty);
  command
      .add_option("--trace", serving.trace,
                  "Write what moves and switches to this file: FILE.csv, or FILE.vcd for GTKWave")
      ->check(kNotEmpty);
  command.add_option("--trace-also", serving.trace_also, kTraceAlsoHelp)->delimiter(',')->check(kNotEmpty);
  command.add_flag("--lint", serving.lint, kLintHelp);
}

}  // namespace understudy::emulator::command_line
