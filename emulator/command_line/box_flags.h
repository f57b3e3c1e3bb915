// The flags of commands for real controllers. Only flags.cpp includes this file, because CLI11 is slow to
// compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

/// Adds the flags of a stage with real controllers, except the flags for its ports.
inline void add_stage_flags(CLI::App& command, OnArguments& on) {
  command.add_flag("--allow-writes", on.allow_writes,
                   "Also send requests that only change values [only reads are sent]");
  command.add_flag("--allow-memory", on.allow_memory,
                   "Also send requests that change memory; implies --allow-writes");
  command.add_flag("--allow-outputs", on.allow_outputs,
                   "Also send requests that may switch an output; implies --allow-writes");
  command.add_flag(
      "--allow-motion", on.allow_motion,
      "Also send requests that may move an axis, and all other requests. KEEP CLEAR OF THE MACHINE");
  command
      .add_option(
          "--envelope", on.envelope,
          "File with limits for targets, speeds and distances; requests outside these limits are not sent")
      ->check(kNotEmpty);
  command
      .add_option("--rig", on.rig,
                  "Command that acts on the machine, called as `COMMAND input feeder.DIN_2 on`")
      ->check(kNotEmpty);
  command.add_flag("--ask", on.ask, "Ask the person at the terminal to act on the machine");
  command.add_flag("--plan", on.plan, "Print every request, and send nothing");
  command.add_option("--reply-timeout", on.timeout, "How long to wait for a reply from a real controller")
      ->capture_default_str();
}

inline void add_photograph_flags(CLI::App& command, PhotographArguments& photograph) {
  command
      .add_option(
          "PORT", photograph.port,
          "The controller's port: /dev/ttyUSB0[,SPEED[,8E1]], rtu://HOST:PORT, modbus-tcp://HOST:PORT "
          "or rfc2217://HOST:PORT[,SPEED[,8E1]] [tries all speeds of the model]")
      ->required()
      ->check(kNotEmpty);
  command.add_option("--model", photograph.model, "The controller's model, or a model file")
      ->required()
      ->check(kNotEmpty);
  command
      .add_option("-o,--output", photograph.output,
                  "NV image to write, BOX.nv.json; the photograph is BOX.photo.json next to it")
      ->required()
      ->check(kNotEmpty);
  command.add_option("--station", photograph.station,
                     "Station number of the controller [the model's factory setting]");
  command.add_option("--firmware", photograph.firmware, "The controller's firmware version [newest]")
      ->check(kNotEmpty);
  command.add_option("--modules", photograph.modules, "Number of modules to read in the chain [as in PN50]");
  command.add_option("--timeout", photograph.timeout, "How long to wait for a reply")->capture_default_str();
  command.add_flag("--arrays", photograph.arrays, "SLIM: also read NS(0) to RS(2000), which takes a minute");
}

/// Adds the flag for the controller's name in evidence.
inline void add_box_name(CLI::App& command, std::string& box) {
  command.add_option("--box", box, "A name for the controller, such as its serial number, for the evidence")
      ->check(kNotEmpty);
}

inline void add_probe_flags(CLI::App& command, ProbeArguments& probe) {
  command.add_option("PORT", probe.port, "The controller's port, as for photograph")
      ->required()
      ->check(kNotEmpty);
  command.add_option("--model", probe.model, "The controller's model")->required()->check(kNotEmpty);
  command.add_option("-o,--output", probe.output, "Evidence to write: FILE.json")->check(kNotEmpty);
  add_box_name(command, probe.box);
  command.add_option("--station", probe.station, "Station to ask [that of the proofs]");
  command.add_option("--modules", probe.modules, "Modules of the chain")->capture_default_str();
  command.add_option("--firmware", probe.firmware, "The controller's firmware version [newest]")
      ->check(kNotEmpty);
  command.add_option("--proofs", probe.proofs, "Folder of proofs [the one that comes with this program]")
      ->check(kNotEmpty);
  add_stage_flags(command, probe.on);
}

inline void add_capture_flags(CLI::App& command, CompareArguments& compare) {
  command
      .add_option("--pattern", compare.pattern,
                  "Format of a log's lines, such as '{time} {dir} {hex}'; {*} matches anything")
      ->check(kNotEmpty);
  command.add_option("--every", compare.every, "Time between requests in a log without times, such as 20ms")
      ->check(kNotEmpty);
  command
      .add_option("--sample-rate", compare.sample_rate,
                  "Samples per second in a decoder's log that counts samples, such as 1000000")
      ->check(CLI::PositiveNumber);
}

inline void add_compare_flags(CLI::App& command, CompareArguments& compare) {
  command.add_option("CAPTURE", compare.captures, "Captures of the controller's line")->required();
  command.add_option("--bench", compare.bench, "The bench whose replies are compared with the controller's")
      ->required()
      ->check(kNotEmpty);
  command.add_option("--line", compare.line, "The line, if the bench or a capture has several")
      ->check(kNotEmpty);
  command.add_option("--from", compare.from, "NV image of the controller's memory at the beginning")
      ->check(kNotEmpty);
  command.add_option("--tolerance", compare.tolerance, "How much times may differ")->capture_default_str();
  command.add_flag("--power-up", compare.power_up,
                   "Time 0 of the captures is the controller's power-up, so its whole state is known");
  command
      .add_option(
          "--inputs", compare.inputs,
          "What the inputs did: a file with lines such as '0.250 feeder.DIN_2 on' [what replies show]")
      ->check(kNotEmpty);
  add_capture_flags(command, compare);
}

inline void add_compare_looks(CLI::App& command, CompareArguments& compare) {
  CLI::Option* const format =
      command.add_option("--format", compare.format, "Output format: text, json, sarif or github")
          ->capture_default_str();
  CLI::Option* const report =
      command.add_option("--report", compare.report, "Write a page with the comparison: FILE.html")
          ->check(kNotEmpty);
  command
      .add_flag("--follow", compare.follow,
                "Follow a growing capture: report each difference immediately, until Ctrl-C")
      ->excludes(format)
      ->excludes(report);
}

inline void add_tap_flags(CLI::App& command, TapArguments& tap) {
  command
      .add_option("PORT", tap.ports,
                  "One adapter that receives both directions, or two adapters that receive one direction "
                  "each: /dev/ttyUSB0[,SPEED[,8E1]], rtu://HOST:PORT [19200,8E1]")
      ->required()
      ->expected(1, 2)
      ->check(kNotEmpty);
  command.add_option("-o,--output", tap.output, "Capture to write: FILE.pcapng, or FILE.txt")
      ->required()
      ->check(kNotEmpty);
  command.add_option("--line", tap.line, "The line's name in the capture")
      ->capture_default_str()
      ->check(kNotEmpty);
}

inline void add_calibrate_flags(CLI::App& command, CalibrateArguments& calibrate) {
  add_compare_flags(command, calibrate.compare);
  command.add_option("-o,--output", calibrate.output, "Evidence to write: FILE.json")->check(kNotEmpty);
  add_box_name(command, calibrate.box);
  command.add_flag("--choices", calibrate.choices, "Print only the choices that the bench needs");
}

inline void add_certificate_flags(CLI::App& command, CertificateArguments& certificate) {
  command
      .add_option(
          "FILE", certificate.evidence,
          "Evidence files of one controller, from `calibrate` and `probe`; with --verify, a certificate")
      ->required()
      ->check(kNotEmpty);
  CLI::Option* const verify =
      command.add_flag("--verify", certificate.verify, "Verify the certificate FILE, signed in FILE.sig");
  command
      .add_option("--signers", certificate.signers,
                  "Keys that you trust, one per line: NAME ssh-ed25519 AAAA... (see ssh-keygen)")
      ->check(kNotEmpty)
      ->needs(verify);
  command
      .add_option("-o,--output", certificate.output,
                  "Certificate to write, FILE.json; its page is FILE.html next to it")
      ->check(kNotEmpty)
      ->excludes(verify);
  add_box_name(command, certificate.box);
}

}  // namespace understudy::emulator::command_line
