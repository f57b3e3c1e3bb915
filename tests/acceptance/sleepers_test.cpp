// In real time, fifty times as fast: the daemon sleeps until something is due, and the inputs of a sleeping
// controller wake it.
#include <gtest/gtest.h>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace sleepers_test {

constexpr const char* kZone =
    "understudy: 1\n"
    "model: zone\n"
    "registers: |\n"
    "  table,address,name,access,width,signed\n"
    "  holding,0,GO,R/W,16,0\n"
    "  holding,1,SPEED,R/W,16,0\n"
    "  holding,2,POSITION,R,32,1\n"
    "  coil,0,ZONE,R,1,0\n"
    "outputs: { ZONE_OUT: ZONE }\n"
    "axes:\n"
    "  X: { speed: SPEED, forward: GO.0, position: POSITION }\n"
    "shows: { ZONE: POSITION > 5000 }\n";

constexpr const char* kBench =
    "understudy: 1\n"
    "lines:\n"
    "  a: { stations: [ { device: mill, port: RS232 } ] }\n"
    "  b: { stations: [ { name: drive, model: zone.yaml } ] }\n"
    "  c: { stations: [ { name: feeder, model: simple2-r3 } ] }\n"
    "devices:\n"
    "  mill:\n"
    "    model: super-40nc\n"
    "    program: |\n"
    "      AREA PLC\n"
    "      LD M8139\n"
    "      OUT Y15\n"
    "      END\n"
    "wires: [ drive.ZONE_OUT -> feeder.DIN_0 ]\n";

bool comes(const RunningUnderstudy& daemon, const std::string& name, const std::string& value) {
  return eventually([&] { return daemon.ctl({"get", name}).output == name + " " + value + "\n"; });
}

TEST(SleepersServed, AreWokenByAlarmsAndByWires) {
  const PrivateFolder folder;
  std::string bench = kBench;
  bench.replace(bench.find("zone.yaml"), 9, folder.write("zone.yaml", kZone));
  const auto served = RunningUnderstudy::of_bench(bench, {"--speed", "50"});
  const RunningUnderstudy& daemon = *served;
  for (const char* level : {"on", "off", "on"}) {
    ASSERT_EQ(daemon.ctl({"input", std::string("mill.ALM_X=") + level}).exit_code, 0);
    EXPECT_TRUE(comes(daemon, "mill.Y15", std::string(level) == "on" ? "1" : "0")) << level;
  }
  ASSERT_EQ(daemon.ctl({"set", "drive.SPEED=1000", "drive.GO=1"}).exit_code, 0);
  EXPECT_TRUE(comes(daemon, "feeder.DIN_0", "1"));
  EXPECT_TRUE(comes(daemon, "drive.ZONE", "1"));
}

}  // namespace sleepers_test
}  // namespace understudy::acceptance
