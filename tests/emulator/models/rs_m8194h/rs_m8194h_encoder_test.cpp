// EP where the machine has an encoder: its counts alone, from the first pulse on, however time goes by.
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace rs_m8194h_encoder_test {

using namespace std::chrono_literals;

World cell(const std::string& encoder) {
  return World(
      parse_bench(
          models::all_models(),
          "understudy: 1\n"
          "lines: { com: { timing: instant, stations: [ { name: cell, model: rs-m8194h, address: 1 } ] } }\n"
          "plant: { cell.X: { encoder: " +
              encoder + " } }\n",
          "cell.yaml", "."),
      {}, {});
}

Bytes command(int code, int axis, int value) {
  const auto byte = [](int n) { return static_cast<std::uint8_t>(n); };
  return framed({0x01, 0x10, 0x1F, 0x40, 0x00, 0x04, 0x08, byte(code >> 8), byte(code), 0x00, byte(axis),
                 byte(value >> 24), byte(value >> 16), byte(value >> 8), byte(value)});
}

std::int64_t value_of(const World& world, const std::string& name) {
  const Probes probes(world);
  return probes.value(probes.resolve(name).handle).whole();
}

void move_by(World& world, int pulses) {
  world.receive(0, command(0x0A4E, 1, pulses));
  world.advance_to(world.now() + 2s);
}

TEST(RsM8194hEncoder, AloneIsCountedHoweverTimeGoesBy) {
  for (const bool in_bulk : {true, false}) {
    for (const auto& [encoder, counts] :
         {std::pair{"{ per_revolution: 1000, motor_pulses_per_revolution: 1000 }", 1},
          {"{ per_revolution: 4000, motor_pulses_per_revolution: 1000 }", 4}}) {
      World world = cell(encoder);
      world.set_bulk_ticks(in_bulk);
      for (const int code : {0x0A0D, 0x0A47, 0x0A48}) {  // MAX_V, SV, V
        world.receive(0, command(code, 1, 8000));
        world.advance_to(world.now() + 5ms);
      }
      move_by(world, 1000);
      EXPECT_EQ(value_of(world, "cell.LP_X"), 1000) << encoder << in_bulk;
      EXPECT_EQ(value_of(world, "cell.X.encoder"), 1000 * counts) << encoder << in_bulk;
      EXPECT_EQ(value_of(world, "cell.EP_X"), 1000 * counts) << encoder << in_bulk;
      move_by(world, -300);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 700 * counts) << encoder << in_bulk;
      world.switch_power(0, false);
      world.switch_power(0, true);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 0) << encoder << in_bulk;
    }
  }
}

}  // namespace rs_m8194h_encoder_test
}  // namespace understudy::emulator::world
