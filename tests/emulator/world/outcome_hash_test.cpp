// One scenario, one outcome: every byte, pulse and output at its time.
#include <set>

#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/outcome_hash.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::world {
namespace outcome_hash_test {

const std::string kDay = play::kServoOn + play::kExampleMove +
                         "  - wait: { until: feeder.A.pulses > 1000, within: 1s }\n"
                         "  - inject: { lost_steps: feeder.A, one_in: 7 }\n"
                         "  - write: { feeder.DOUT_4: 1 }\n"
                         "  - expect: { feeder.STATUS.4: 1, feeder.DOUT_4: 1 }\n"
                         "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 37ms }\n"
                         "  - power: { feeder: cycle }\n"
                         "  - send: { bytes: 01 03 00 01 00 01 D5 CB, reply: nothing, within: 30ms }\n"
                         "  - input: { feeder.DIN_10: on }\n"
                         "  - expect: { feeder.DIN_10: 1 }\n";

std::uint64_t outcome(const std::string& steps, bool bulk_ticks = true, const std::string& more = "") {
  const play::RunOptions options{
      .make_executor =
          [&](const play::Scenario& scenario) {
            auto stage = play::make_free_executor(scenario);
            stage->with_world([&](World& world) { world.set_bulk_ticks(bulk_ticks); });
            return stage;
          },
      .with_hash = true};
  const play::ScenarioResult result = play::played(steps, more, options);
  EXPECT_TRUE(play::has_passed(result)) << play::why(result);
  return result.outcome_hash;
}

TEST(OutcomeHash, IsTheSameInTwentyRuns) {
  std::set<std::uint64_t> outcomes;
  for (int i = 0; i < 20; ++i) outcomes.insert(outcome(kDay));
  EXPECT_EQ(outcomes.size(), 1U);
}

TEST(OutcomeHash, IsTheSameWhetherQuietTicksAreLeftOutOrNot) {
  EXPECT_EQ(outcome(kDay, true), outcome(kDay, false));
}

TEST(OutcomeHash, DoesNotHingeOnWhoLooksOn) {
  EXPECT_EQ(outcome(kDay), outcome("  - never: feeder.A.pulses > 99999\n"
                                   "  - always: feeder.A.greatest_speed < 20000\n" +
                                   kDay));
}

TEST(OutcomeHash, DiffersWithWhateverComesOut) {
  // The same request, whoever composes it; it takes as long as the reply does.
  const std::string servo_on_in_bytes = "  - send: { bytes: 01 06 10 14 00 01 +crc, within: 5.333333ms }\n";
  EXPECT_EQ(outcome(play::kServoOn), outcome(servo_on_in_bytes));
  const std::set<std::uint64_t> outcomes = {
      outcome(play::kServoOn),
      outcome("  - write: { feeder.Baxis_SVON: 1 }\n"),  // another byte
      outcome(play::kServoOn + "  - advance: 1ms\n"),    // a tick more
      outcome("  - advance: 1us\n" + play::kServoOn),    // a microsecond later
      outcome(play::kServoOn + "  - advance: 1s\n"),
      outcome("  - power: { feeder: off }\n" + servo_on_in_bytes),  // without a reply
      outcome(play::kServoOn + play::kExampleMove + "  - advance: 100ms\n"),
      outcome(play::kServoOn + "  - inject: { alarm: feeder.A }\n" + play::kExampleMove +
              "  - advance: 101ms\n"),
      outcome(play::kServoOn + play::kServoOn),
      outcome(play::kServoOn + play::kServoOn, true, "gap: 1ms\n"),
  };
  EXPECT_EQ(outcomes.size(), 10U);
}

/// Two hosts send the same at the same time, and nothing replies: one is received, the other has different
/// line settings.
TEST(OutcomeHash, DiffersWithWhatWasReceived) {
  const auto of_host = [](int stop_bits) {
    World world(parse_bench(models::all_models(),
                            "understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }\n",
                            "bench.yaml", "/tmp"),
                {}, {});
    OutcomeHash hash(world);
    world.host_opened(0);
    world.host_settings(0, pty::HostSettings{.baud = 19200, .stop_bits = stop_bits});
    world.receive(0, hex("07 03 00 01"));
    world.advance_to(std::chrono::milliseconds(20));
    EXPECT_EQ(world.line(0).line.counters().bytes_unheard, stop_bits == 1 ? 0U : 4U);
    return hash.value();
  };
  EXPECT_EQ(of_host(1), of_host(1));
  EXPECT_NE(of_host(1), of_host(2));
}

}  // namespace outcome_hash_test
}  // namespace understudy::emulator::world
