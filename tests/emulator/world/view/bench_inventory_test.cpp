// Names and faults are checked with the contents of a bench in the same way as in the world that is made from
// it.
#include "emulator/world/view/bench_inventory.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/trigger_text.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"
#include "tests/emulator/world/view/same_inventory.h"

namespace understudy::emulator::world {
namespace bench_inventory_test {

constexpr const char* kBench = R"(understudy: 1
lines:
  rs485:
    stations:
      - { name: feeder, model: simple2-r3, address: 1 }
      - { name: turner, model: simple2-r3, address: 2, firmware: "1.40" }
  serial: { stations: [ { name: arm, model: slim } ] }
plant:
  feeder.A: { encoder: { per_revolution: 1000, on: wheel } }
  feeder.B: { encoder: { per_revolution: 1000 } }
)";

template <typename Act>
std::string diagnostic_of(const Act& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "(none)";
}

class BenchInventoryTest : public testing::Test {
 protected:
  Bench bench_ = parse_bench(models::all_models(), kBench, "test.yaml", "/tmp");
  BenchInventory inventory_{bench_};
  World world_{bench_, {}, {}};
};

TEST_F(BenchInventoryTest, HasWhatTheWorldHas) { expect_same_inventory(bench_); }

TEST_F(BenchInventoryTest, UnderstandsTheSameNames) {
  const ProbeNames names(inventory_);
  const Probes probes(world_);
  for (const char* name : {"time",
                           "feeder.Cord_A",
                           "feeder.STATUS.4",
                           "turner.DIN_10",
                           "feeder.A.pulses",
                           "feeder.A",
                           "feeder",
                           "feeder.A.speeed",
                           "turner.power",
                           "arm.requests",
                           "arm.PE",
                           "arm.T2PE",
                           "arm.nothing",
                           "rs485.bytes_in",
                           "rs485.bytes",
                           "Cord_A",
                           "feeder.A.pwm",
                           "arm.pulse_format",
                           "feeder.pulse_format",
                           "nobody.Cord_A",
                           "feeder.A.greatest_speed",
                           "serial.collisions",
                           "feeder.0x1000"}) {
    SCOPED_TRACE(name);
    Unit here{};
    Unit there{};
    EXPECT_EQ(diagnostic_of([&] { here = names.resolve(name).unit; }),
              diagnostic_of([&] { there = probes.resolve(name).unit; }));
    EXPECT_EQ(here, there);
  }
}

TEST_F(BenchInventoryTest, JudgesFaultsAsTheWorldDoes) {
  struct Case {
    const char* kind;
    const char* place;
    std::vector<std::pair<std::string, std::string>> fields;
    const char* diagnostic;
  };
  const Case cases[] = {
      {"stall", "feeder.A", {}, "(none)"},
      {"stall", "feeder.A", {{"when", "feeder.Cord_A > 5"}}, "(none)"},
      {"encoder_noise", "feeder.B", {{"counts", "3"}}, "(none)"},
      {"encoder_noise", "turner.A", {{"counts", "3"}}, "turner.A has no encoder; expected one in `plant`"},
      {"turn", "feeder.A", {{"counts", "3"}}, "(none)"},
      {"turn",
       "feeder.B",
       {{"counts", "3"}},
       "feeder.B has no hand wheel; expected `encoder: { on: wheel }` in `plant`"},
      {"busy", "arm", {}, "busy: is a fault of Modbus frames, but arm uses text; expected a different fault"},
      {"stall",
       "feeder.A",
       {{"when", "feeder.A.greatest_speed > 5"}},
       "stall: when: 'feeder.A.greatest_speed' cannot be used in a fault; expected a value that the bench "
       "itself has"},
      {"stall", "feeder.A", {{"when", "time"}}, nullptr},
      {"stall", "feeder.A", {{"when", "feeder.Cord_Q > 5"}}, nullptr},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.kind) + " " + c.place);
    const auto judged = [&](const Inventory& inventory) {
      return diagnostic_of([&] {
        check_fault(inventory, find_fault(inventory.known(), {c.kind, c.place, c.fields}));
      });
    };
    const std::string here = judged(inventory_);
    EXPECT_EQ(here, judged(world_));
    if (c.diagnostic != nullptr) {
      EXPECT_EQ(here, c.diagnostic);
    } else {
      EXPECT_NE(here, "(none)");
    }
  }
}

}  // namespace bench_inventory_test
}  // namespace understudy::emulator::world
