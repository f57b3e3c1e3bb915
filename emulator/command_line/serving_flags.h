// The flags of all commands that serve a bench. Only flags.cpp includes this file, because CLI11 is slow to
// compile.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Rejects an empty value: `--link "$UNSET"` is a mistake, not a request for the default.
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
    "Also trace these: registers, or anything else that a condition can name, such as feeder.Cord_A";
inline constexpr const char* kLintHelp = "At exit, report protocol violations by the host";
inline constexpr const char* kCoverageHelp =
    "Write the line coverage of the controllers' programs to this file: FILE.info for lcov, FILE.xml for "
    "Cobertura, or FILE.html";

inline constexpr const char* kDeviceCoverageHelp =
    "Write to this file which features of the devices were used, and which were not: FILE.json or FILE.html";

/// Adds the flags that select a bench, or a single device without a bench.
inline void add_bench_flags(CLI::App& command, ServeArguments& serving) {
  command.add_option("BENCH", serving.bench, "A bench file, unless you use --model");
  command.add_option("--model", serving.model, "Serve one device of this model, without a bench file")
      ->check(kNotEmpty);
  command.add_option("--station", serving.station,
                     "Station number of the device (with --model) [1, or the one in its memory]");
  command.add_option("--modules", serving.modules,
                     "Number of modules, if the model is a chain (with --model)");
  command
      .add_option("--firmware", serving.firmware, "Firmware version of the device (with --model) [newest]")
      ->check(kNotEmpty);
  command.add_option("--baud", serving.baud, "Line speed (with --model) [the factory setting]");
}

/// Adds the flags for connections between hosts and lines.
inline void add_port_flags(CLI::App& command, ServeArguments& serving) {
  command
      .add_option("--link", serving.link,
                  "Path of the link to the port (with --model); other ports get PATH.NAME [a private path]")
      ->check(kNotEmpty);
  command.add_option("--links", serving.links, "Folder for links with a relative path, or without one")
      ->check(kNotEmpty);
  command
      .add_option("--listen", serving.listen,
                  "Accept TCP clients on a line: rtu://[HOST]:PORT (raw bytes), rfc2217://[HOST]:PORT (with "
                  "serial settings) or modbus-tcp://[HOST]:PORT (as behind a gateway); if there are several "
                  "lines, put LINE= in front; without HOST, only this machine can connect")
      ->check(kNotEmpty);
  command.add_flag("--no-pty", serving.no_pty, "Create no pseudo-terminal for lines that listen on TCP");
  command.add_option("--group", serving.group, "Group that may open the ports, such as dialout [none]")
      ->check(kNotEmpty);
  command
      .add_option(
          "--timing", serving.timing,
          "wire: bytes take as long as on a real line; instant: no time [wire, or the bench's setting]")
      ->check(kNotEmpty);
  command.add_flag("--strict-framing", serving.strict_framing,
                   "Let only silence end a frame, as on a real line");
  command.add_flag("--ignore-baud", serving.ignore_baud,
                   "Accept hosts that set another speed or other stop bits");
  command
      .add_option("--baud-tolerance", serving.baud_tolerance,
                  "How much a host's speed may differ from the line's [2%, or the bench's setting]")
      ->check(kNotEmpty);
  command
      .add_option("--byte-timeout", serving.byte_timeout,
                  "How long to wait for the rest of a frame [200ms, or the bench's setting]")
      ->check(kNotEmpty);
}

/// Adds the flags for running the bench and for its output files.
inline void add_running_flags(CLI::App& command, ServeArguments& serving) {
  command
      .add_option("--speed", serving.speed,
                  "How fast simulated time runs: real, free, manual, or a factor such as 10x")
      ->capture_default_str();
  command.add_option("--control", serving.control, "Path of the control socket [a private path]")
      ->check(kNotEmpty);
  command.add_option("--nv", serving.nv, "Folder for the devices' non-volatile memories [discarded at exit]")
      ->check(kNotEmpty);
  command
      .add_option("--capture", serving.capture,
                  "Write the traffic on the lines to this file: FILE.pcapng for Wireshark, any other name "
                  "for a text log")
      ->check(kNotEmpty);
  command.add_option("--record", serving.record, "Record all input to this file, for `understudy replay`")
      ->check(kNotEmpty);
  command
      .add_option("--trace", serving.trace,
                  "Write positions and signals over time to this file: FILE.csv, or FILE.vcd for GTKWave")
      ->check(kNotEmpty);
  command.add_option("--trace-also", serving.trace_also, kTraceAlsoHelp)->delimiter(',')->check(kNotEmpty);
  command.add_option("--coverage", serving.coverage, kCoverageHelp)->check(kNotEmpty);
  command.add_option("--device-coverage", serving.device_coverage, kDeviceCoverageHelp)->check(kNotEmpty);
  command.add_flag("--lint", serving.lint, kLintHelp);
}

/// Adds all flags of a command that serves a bench, in the order in which --help lists them.
inline void add_serving_flags(CLI::App& command, ServeArguments& serving) {
  serving.version = UNDERSTUDY_VERSION;
  add_bench_flags(command, serving);
  add_port_flags(command, serving);
  add_running_flags(command, serving);
}

}  // namespace understudy::emulator::command_line
