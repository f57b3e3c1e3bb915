// A world of two Simple2-R3 on one line, with machines and wires between them.
#pragma once

#include <string>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::world {

using Bytes = std::vector<std::uint8_t>;

inline std::string two_devices(const std::string& timing, int baud) {
  return "understudy: 1\n"
         "lines:\n"
         "  rs485:\n"
         "    baud: " +
         std::to_string(baud) +
         "\n"
         "    timing: " +
         timing +
         "\n"
         "    stations:\n"
         "      - { name: feeder, model: simple2-r3, address: 1 }\n"
         "      - { name: turner, model: simple2-r3, address: 2, firmware: \"1.40\" }\n"
         "plant:\n"
         "  feeder.A: { travel: [-300, 900], home: { at: 0, width: 20 }, limits: { lower: -200, upper: 800 },"
         " encoder: { per_revolution: 4000 } }\n"
         "  turner.B: { limits: { upper: 100 }, encoder: { per_revolution: 700 } }\n"
         "wires:\n"
         "  - feeder.DOUT_4 -> turner.DIN_10\n"
         "  - feeder.DOUT_1 -> turner.DIN_0\n"
         "  - turner.DOUT_0 -> feeder.DIN_7\n"
         "  - turner.DOUT_5 -> feeder.DIN_7\n";
}

inline World make_world(const std::string& timing = "instant", int baud = 19200,
                        const WorldOptions& options = {}) {
  return World(parse_bench(models::all_models(), two_devices(timing, baud), "two.yaml", "."), options, {});
}

inline Bytes framed(Bytes bytes) {
  pty::append_rtu_crc(bytes);
  return bytes;
}

inline Bytes request(int station, int function, int address, int value) {
  const auto byte = [](int n) { return static_cast<std::uint8_t>(n); };
  return framed(
      {byte(station), byte(function), byte(address >> 8), byte(address), byte(value >> 8), byte(value)});
}
inline Bytes write_request(int station, int address, int value) {
  return request(station, 0x06, address, value);
}
inline Bytes read_request(int station, int address, int count) {
  return request(station, 0x03, address, count);
}

inline Value get(const World& world, std::string_view name) {
  const RegisterName found = find_register(world.known(), name);
  return read_value(*world.device(found.device).register_bank(), found.place);
}

inline Refusal set(World& world, std::string_view name, Value value) {
  const RegisterName found = find_register(world.known(), name);
  return write_value(*world.device(found.device).register_bank(), found.place, value);
}

inline void set_input(World& world, std::string_view name, bool on) {
  const InputName found = find_input(world.known(), name);
  world.set_external_input(found.device, found.terminal, on);
}

inline Bytes take_output(World& world) {
  const pty::Line& line = world.line(0).line;
  const Bytes bytes(line.output().begin(), line.output().end());
  world.take_output(0, bytes.size());
  return bytes;
}

}  // namespace understudy::emulator::world
