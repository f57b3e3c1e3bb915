// The made-up controller on two lines, with a host on each that sends frames.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {

inline const ListedModel kWorkbenchModels[] = {&model()};

/// Returns a bench with the lines "pc" and "hmi". `of_line` has further settings of each line, `more` the
/// rest of the bench.
inline std::string two_lines_text(const std::string& of_line = "", const std::string& more = "") {
  return "understudy: 1\nlines:\n"
         "  pc: { " +
         of_line +
         "stations: [ { device: mill, port: PC } ] }\n"
         "  hmi: { " +
         of_line +
         "stations: [ { device: mill, port: HMI } ] }\n"
         "devices: { mill: { model: workbench } }\n" +
         more;
}

inline world::Bench workbench_bench(const std::string& text) {
  return world::parse_bench(kWorkbenchModels, text, "bench.yaml", "/tmp");
}

inline world::Bytes frame_of(std::string_view text) {
  world::Bytes made = world::hex(text);
  pty::append_rtu_crc(made);
  return made;
}

/// A world with such a bench. Hosts use the lines' own settings.
struct TwoLines {
  static constexpr std::size_t kPc = 0;
  static constexpr std::size_t kHmi = 1;

  explicit TwoLines(const std::string& text = two_lines_text("timing: instant, "),
                    const world::WorldOptions& options = {})
      : bench(workbench_bench(text)), world(bench, options, {}) {}

  const Workbench& mill() { return static_cast<const Workbench&>(world.device(0)); }
  void send(std::size_t line, std::string_view text) { world.receive(line, frame_of(text)); }
  void pass(SimTime time) { world.advance_to(world.now() + time); }
  /// Returns what was received since the last call as hexadecimal text, without a correct checksum.
  std::string came(std::size_t line) {
    const auto output = world.line(line).line.output();
    const world::Bytes bytes(output.begin(), output.end());
    world.take_output(line, bytes.size());
    if (bytes.size() < 4 || !pty::rtu_crc_ok(bytes)) return world::text(bytes);
    return world::text(std::span(bytes).first(bytes.size() - 2));
  }
  std::string ask(std::size_t line, std::string_view text) {
    send(line, text);
    pass(std::chrono::milliseconds(200));
    return came(line);
  }

  world::Bench bench;
  world::World world;
};

}  // namespace understudy::emulator::workbench
