// All that is wrong with a file is told at once, in the file's order, and nothing twice.
#include <gtest/gtest.h>

#include "emulator/bench/complaints.h"
#include "tests/emulator/bench/bench_texts.h"
#include "tests/emulator/scenario/scenario_folder.h"

namespace understudy::emulator {
namespace {

FileError error_at(int line, int column, const std::string& text) {
  return {FilePlace{"a.yaml", line, column}, text};
}

TEST(Complaints, AreToldInTheFilesOrderAndOnce) {
  Complaints all;
  EXPECT_FALSE(all.attempt([] { throw error_at(7, 1, "late"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(2, 9, "right"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(2, 3, "left"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(7, 1, "late"); }));
  EXPECT_FALSE(all.attempt([] { throw Untold(); }));
  EXPECT_TRUE(all.attempt([] {}));
  try {
    all.throw_if_any();
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "a.yaml:2:3: left\na.yaml:2:9: right\na.yaml:7:1: late");
  }
}

TEST(Complaints, AreTwentyAtMost) {
  Complaints all;
  for (int line = 1; line <= 25; ++line) all.add(error_at(line, 1, "wrong"));
  try {
    all.throw_if_any();
    FAIL();
  } catch (const FileError& error) {
    ASSERT_EQ(error.complaints().size(), 21U);
    EXPECT_EQ(error.complaints()[19].text, "a.yaml:20:1: wrong");
    EXPECT_EQ(error.complaints()[20].text, "and 5 more; the first 20 are told");
  }
}

TEST(Complaints, EndTheReadingWhereTheyAreTooMany) {
  Complaints all;
  int tried = 0;
  EXPECT_THROW(all.demand([&] {
    for (; tried < 100'000; ++tried) all.attempt([&] { throw error_at(tried + 1, 1, "wrong"); });
  }),
               FileError);
  EXPECT_LE(tried, 1000);
}

TEST(AllComplaints, OfABench) {
  EXPECT_EQ(complaint(R"(understudy: 2
lines:
  a:
    bud: 9600
    baud: fast
    link: tcp://:1502
    stations:
      - { name: x, model: simple2-r3, adress: 1, firmware: new, set: { Aaxis_Speed: fast, Aaxis_Pulse: 1 } }
      - { name: y, model: simple2-r4, address: 2 }
      - { name: z, model: simple2-r3, address: 1 }
plant:
  x.A: { travel: [ 5, 10 ], home: { at: 0 }, limit: { lower: 1 } }
  x.Q: {}
  y.A: { nonsense: 1 }
wires: [ x.DOUT_1 -> z.DIN_1, x.DOUT_1 -> y.DIN_99, x.DOUT_99 -> x.DIN_1 ]
seed: -1
)"),
            R"(bench.yaml:1: understudy: '2' is not possible; expected a whole number from 1 to 1
bench.yaml:4: lines.a.bud: is no key here; expected one of link, baud, baud_tolerance, timing, stations (the nearest is 'baud')
bench.yaml:5: lines.a.baud: 'fast' is not possible; expected a whole number from 1 to 4000000
bench.yaml:6: lines.a.link: 'tcp://:1502' is an address of a network; expected a path, for a serial port
bench.yaml:8: lines.a.stations[0].adress: is no key here; expected one of name, model, address, firmware, modules, set, choices, dip, program, nv (the nearest is 'address')
bench.yaml:8: lines.a.stations[0].firmware: 'new' is no version; expected one like "1.52"
bench.yaml:8: lines.a.stations[0].set.Aaxis_Speed: 'fast' is not possible; expected a whole number from -2147483648 to 4294967295
bench.yaml:9: lines.a.stations[1].model: 'simple2-r4' is no model; the nearest is 'simple2-r3'
bench.yaml:10: lines.a.stations[2]: address 1 is taken on this line; expected another
bench.yaml:12: plant.x.A.travel: does not hold position 0, where the machine starts; expected it inside
bench.yaml:12: plant.x.A.home: 'width' is missing; expected it here
bench.yaml:12: plant.x.A.limit: is no key here; expected one of position, travel, home, limits, encoder, drive (the nearest is 'limits')
bench.yaml:13: plant.x.Q: 'Q' is no axis of simple2-r3; expected one of A, B
bench.yaml:15: wires[2]: 'DOUT_99' is no output of simple2-r3; the nearest is 'DOUT_0'
bench.yaml:16: seed: '-1' is not possible; expected a whole number from 0 to 9223372036854775807)");
}

TEST(AllComplaints, OfAScenario) {
  const ScenarioFolder folder;
  EXPECT_EQ(folder.complaint(R"(understudy: 1
bench: feeder.yaml
gap: soon
seeed: 1
steps:
  - write: { feeder.Aaxis_SVN: 1 }
  - inject: { stal: feeder.A, name: jam }
  - clear: jam
  - repeat: { times: 3, steps: [ advance: 1, fork: { a: [ wirte: 1 ], b: [ advance: 2 ] } ] }
  - advance: 1ms
  - expect: { feeder.Cord_A: x }
)"),
            R"(scenario.yaml:3: gap: 'soon' is no duration; expected one such as 250ms
scenario.yaml:4: seeed: is no key here; expected one of understudy, name, bench, nv, firmware, gap, seed, parameters, cases, steps (the nearest is 'seed')
scenario.yaml:6: steps[0].write.feeder.Aaxis_SVN: feeder: no register is called 'Aaxis_SVN'; the nearest is 'Aaxis_SVON'
scenario.yaml:7: steps[1].inject: )" +
                folder.complaint(ScenarioFolder::scenario_of("  - inject: { stal: feeder.A, name: jam }\n"))
                    .substr(std::string("scenario.yaml:4: steps[0].inject: ").size()) +
                R"(
scenario.yaml:9: steps[3].repeat.steps[0].advance: '1' is no duration; expected one such as 250ms
scenario.yaml:9: steps[3].repeat.steps[1].fork.a[0].wirte: is no step; the nearest is 'write'
scenario.yaml:9: steps[3].repeat.steps[1].fork.b[0].advance: '2' is no duration; expected one such as 250ms
scenario.yaml:11: steps[5].expect.feeder.Cord_A: )" +
                folder.complaint(ScenarioFolder::scenario_of("  - expect: { feeder.Cord_A: x }\n"))
                    .substr(std::string("scenario.yaml:4: steps[0].expect.feeder.Cord_A: ").size()));
}

TEST(AllComplaints, OfCasesAreToldForTheFirstOne) {
  const ScenarioFolder folder;
  EXPECT_EQ(
      folder.complaint("understudy: 1\nbench: feeder.yaml\ncases: [ { a: 1 }, { a: x }, { a: y } ]\nsteps:\n"
                       "  - advance: 1\n  - write: { feeder.Aaxis_Speed: \"${a}\" }\n"),
      "scenario.yaml:5: steps[0].advance: '1' is no duration; expected one such as 250ms  (a=1)\n"
      "scenario.yaml:6: steps[1].write.feeder.Aaxis_Speed: column 1 of 'x': no device is called 'x'; "
      "expected one of feeder, turner  (a=x)\n"
      "scenario.yaml:6: steps[1].write.feeder.Aaxis_Speed: column 1 of 'y': no device is called 'y'; "
      "expected one of feeder, turner  (a=y)");
}

}  // namespace
}  // namespace understudy::emulator
