// EP on a machine with an encoder: only its counts, from the first pulse on, however time advances.
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

/// SET_ENCODER (3.10): edges of A and B, of A, or rising edges of A; B first counts down. Up and down pulses
/// are counted one by one.
TEST(RsM8194hEncoder, IsDividedAndTurnedRound) {
  for (int mode = 0; mode < 4; ++mode) {
    for (int division = 0; division < 3; ++division) {
      World world = cell("{ per_revolution: 4000, motor_pulses_per_revolution: 1000 }");
      for (const int code : {0x0A0D, 0x0A47, 0x0A48}) {
        world.receive(0, command(code, 1, 8000));
        world.advance_to(world.now() + 5ms);
      }
      move_by(world, 10);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 40);
      const auto byte = [](int number) { return static_cast<std::uint8_t>(number); };
      world.receive(0, framed({0x01, 0x10, 0x1F, 0x40, 0x00, 0x05, 0x0A, 0x0A, 0x14, 0x00, 0x01, 0x00,
                               byte(mode), 0x00, byte(division), 0x00, 0x00}));
      world.advance_to(world.now() + 5ms);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 40) << "the counts stay";
      const bool is_quadrature = mode == 0 || mode == 2;
      const int by = is_quadrature ? 1 << division : 1;
      const int direction = mode < 2 ? 1 : -1;
      move_by(world, 1001);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 40 + direction * (4004 / by)) << mode << " " << division;
      move_by(world, -1001);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 40) << mode << " " << division;
      move_by(world, -300);
      EXPECT_EQ(value_of(world, "cell.EP_X"), 40 - direction * (1200 / by)) << mode << " " << division;
      EXPECT_EQ(value_of(world, "cell.LP_X"), -290);
    }
  }
}

}  // namespace rs_m8194h_encoder_test
}  // namespace understudy::emulator::world
