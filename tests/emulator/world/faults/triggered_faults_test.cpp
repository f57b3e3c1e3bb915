// Faults of machines and devices with triggers: exactly when they begin and end, and their effect.
#include <gtest/gtest.h>

#include <algorithm>

#include "emulator/world/probe/probes.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/stations/rtu_station.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace triggered_faults_test {

using namespace std::chrono_literals;

const std::string kMachine = "plant: { feeder.A: { encoder: { per_revolution: 3200 } } }\n";

std::int64_t probe(const World& world, std::string_view name) {
  const Probes probes(world);
  return probes.value(probes.resolve(name).handle).whole();
}

void begin_move(FaultyLine& line) { line.ask_all({kSwitchServoOn, kSetMove, kMove}); }

/// Pulses that the move of begin_move() has sent after each tick.
const std::vector<std::int64_t>& sent_without_faults() {
  static const std::vector<std::int64_t> all = [] {
    FaultyLine line;
    begin_move(line);
    std::vector<std::int64_t> sent(static_cast<std::size_t>(tick_at(line.world().now()) + 1));
    for (Tick tick = tick_at(line.world().now()) + 1; tick <= 4000; ++tick) {
      line.world().advance_to(time_of(tick));
      sent.push_back(line.world().sent_pulses(0, 0));
    }
    return sent;
  }();
  return all;
}

Tick tick_with(std::int64_t pulses) {
  const auto& sent = sent_without_faults();
  Tick tick = 0;
  while (sent[static_cast<std::size_t>(tick)] < pulses) ++tick;
  return tick;
}
std::int64_t sent_at(Tick tick) { return sent_without_faults()[static_cast<std::size_t>(tick)]; }

TEST(TriggeredFaults, AStallAfter12000PulsesLosesWhatIsSentMeanwhile) {
  ASSERT_EQ(sent_without_faults().back(), 32000);
  const Tick strikes = tick_with(12'001);
  const std::int64_t lost = sent_at(strikes + 100) - sent_at(strikes);
  EXPECT_NEAR(static_cast<double>(lost), 1066.7, 1.0) << "100 ms at 10,666.7 pulses a second";
  FaultyLine line(kMachine);
  const std::size_t number = line.inject("stall feeder.A when=\"feeder.A.pulses > 12000\" for=100ms");
  begin_move(line);
  EXPECT_EQ(line.course(number).hits, 0);
  line.world().advance_to(time_of(strikes));
  EXPECT_TRUE(line.course(number).in_force);
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), sent_at(strikes)) << "from the next tick on";
  line.world().advance_to(time_of(strikes + 100));
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), sent_at(strikes));
  line.world().advance_to(4s);
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), 32'000 - lost);
  EXPECT_EQ(line.course(number).hits, 1) << "the condition has been true ever since";
}

TEST(TriggeredFaults, AFrameBreaksAMachineUntilItIsCleared) {
  for (const char* how : {"", " for=20ms"}) {
    FaultyLine line(kMachine);
    const std::size_t number = line.inject("stuck feeder.DIN_3 level=on function=6 nth=2" + std::string(how));
    line.ask_all({kAskFeeder, kSwitchServoOn, kAskTurner});
    EXPECT_EQ(probe(line.world(), "feeder.DIN_3"), 0);
    line.world().advance_to(400ms);
    line.world().receive(0, kSetSpeed, 400ms);
    line.world().advance_to(405ms);
    EXPECT_FALSE(line.course(number).in_force);
    line.world().advance_to(406ms);  // executed at 405,333,333 ns
    EXPECT_TRUE(line.course(number).in_force);
    EXPECT_EQ(probe(line.world(), "feeder.DIN_3"), 1);
    line.world().advance_to(425ms);
    EXPECT_TRUE(line.course(number).in_force);
    line.world().advance_to(426ms);
    EXPECT_EQ(line.course(number).in_force, *how == '\0') << "until 425.3 ms, detected in the tick after it";
    EXPECT_EQ(line.course(number).seen, 3) << "not the other one's requests";
    line.world().clear_fault(number);
    line.world().advance_to(427ms);
    EXPECT_EQ(probe(line.world(), "feeder.DIN_3"), 0);
  }
}

TEST(TriggeredFaults, ASlipHappensOnEachHit) {
  FaultyLine line(kMachine);
  line.inject("slip feeder.A pulses=-7 every=2");
  line.ask_all({kAskFeeder, kAskFeeder, kAskTurner, kAskFeeder, kAskFeeder, kAskFeeder});
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), -14);
  line.inject("slip feeder.A pulses=100 at=700ms");
  line.world().advance_to(700ms);
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), -14);
  line.world().advance_to(701ms);
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), 86);
  line.world().advance_to(2s);
  EXPECT_EQ(probe(line.world(), "feeder.A.position"), 86);
}

TEST(TriggeredFaults, EncoderNoiseIsOnTheCountAndNotOnTheMachine) {
  // 3200 counts for 3200 pulses: the count is the position.
  FaultyLine line(kMachine);
  line.inject("encoder_noise feeder.A counts=5 period=4ms from=10ms to=19ms");
  for (Tick tick = 1; tick <= 30; ++tick) {
    line.world().advance_to(time_of(tick));
    // Active from the moment 10 ms on; then alternately two ticks too many and two too few.
    const bool in_force = tick >= 10 && tick < 19;
    const std::int64_t noise = !in_force ? 0 : tick % 4 < 2 ? 5 : -5;
    EXPECT_EQ(probe(line.world(), "feeder.A.encoder"), noise) << tick;
    EXPECT_EQ(probe(line.world(), "feeder.A.position"), 0);
  }
  line.inject("encoder_noise feeder.A counts=-3");
  EXPECT_EQ(probe(line.world(), "feeder.A.encoder"), -3);
  line.world().advance_to(40ms);
  EXPECT_EQ(probe(line.world(), "feeder.ENCA"), -3) << "as the controller sees it";
}

// --- power ---------------------------------------------------------------------------------------

TEST(PowerCut, AtAMomentCutsTheReplyAtThatVeryCharacter) {
  // The reply's characters start at 105,333,333 ns and every 572,916.7 ns after.
  struct Case {
    const char* at;
    std::size_t characters;
  };
  for (const auto& [at, characters] : std::vector<Case>{{"105.333333ms", 0},
                                                        {"105.333334ms", 1},
                                                        {"105.906249ms", 1},
                                                        {"105.90625ms", 2},
                                                        {"107ms", 3},
                                                        {"108.8ms", 7},
                                                        {"120ms", 7}}) {
    FaultyLine line;
    line.inject("power_cut feeder for=30ms at=" + std::string(at));
    const Answer answer = line.ask(kAskFeeder);
    EXPECT_EQ(answer.bytes,
              Bytes(kFeederSays.begin(), kFeederSays.begin() + static_cast<std::ptrdiff_t>(characters)))
        << at;
    EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays) << "the power is back";
  }
}

TEST(PowerCut, InTheMiddleOfAnEepromWriteKeepsWhatWasDone) {
  // A position set is written at 111.6 ms (19 characters and the silence): after tick 111. The pair of Pulse
  // takes 10 ms from tick 112 on and is done at tick 122, then Speed, AccTime and DecTime 5 ms each.
  const Bytes write =
      with_crc({0x01, 0x10, 0x20, 0x00, 0x00, 0x05, 0x0A, 0x11, 0x10, 0x00, 0x01, 0, 7, 0, 8, 0, 9});
  struct Case {
    const char* at;
    Bytes kept;
  };
  const Bytes nothing(10, 0);
  for (const auto& [at, kept] :
       std::vector<Case>{{"at=115ms", nothing},
                         {"at=121.999ms", nothing},
                         {"at=122ms", {0x11, 0x10, 0x00, 0x01, 0, 0, 0, 0, 0, 0}},
                         {"at=126.9ms", {0x11, 0x10, 0x00, 0x01, 0, 0, 0, 0, 0, 0}},
                         {"at=127ms", {0x11, 0x10, 0x00, 0x01, 0, 7, 0, 0, 0, 0}},
                         {"at=136.5ms", {0x11, 0x10, 0x00, 0x01, 0, 7, 0, 8, 0, 0}},
                         {"at=137ms", {0x11, 0x10, 0x00, 0x01, 0, 7, 0, 8, 0, 9}},
                         {"address=0x2000 times=1", nothing},
                         {"when=\"time >= 130ms\" times=1", {0x11, 0x10, 0x00, 0x01, 0, 7, 0, 0, 0, 0}}}) {
    FaultyLine line;
    const std::size_t number = line.inject("power_cut feeder for=40ms " + std::string(at));
    const Answer answer = line.ask(write);
    EXPECT_EQ(answer.bytes.empty(), std::string(at).starts_with("address"))
        << "executed, but without a reply";
    EXPECT_EQ(line.course(number).hits, 1);
    EXPECT_TRUE(line.world().device(0).powered());
    Bytes reply{0x01, 0x03, 0x0A};
    reply.insert(reply.end(), kept.begin(), kept.end());
    EXPECT_EQ(hex(line.ask(with_crc({0x01, 0x03, 0x20, 0x00, 0x00, 0x05})).bytes), hex(with_crc(reply)))
        << at;
  }
}

TEST(PowerCut, GivesBackOnlyWhatItHasTaken) {
  FaultyLine line;
  line.world().switch_power(0, false);
  const std::size_t number = line.inject("power_cut feeder at=20ms for=20ms");
  line.inject("power_cut turner");
  EXPECT_FALSE(line.world().device(1).powered()) << "at once";
  line.world().advance_to(100ms);
  EXPECT_FALSE(line.world().device(0).powered()) << "it was off before";
  EXPECT_EQ(line.course(number).hits, 1);
  line.world().clear_fault(number);
  EXPECT_FALSE(line.world().device(0).powered());
  line.world().clear_fault(2);
  EXPECT_TRUE(line.world().device(1).powered());
}

TEST(PowerCut, LastsAsLongAsAnyOfThem) {
  FaultyLine line;
  World& world = line.world();
  const auto feeder_at = [&](SimTime time) {
    world.advance_to(time);
    return world.device(0).powered();
  };
  // From 20 to 60 ms, from 40 to 80 ms, and one within the second, from 65 to 70 ms.
  line.inject("power_cut feeder at=20ms for=40ms");
  line.inject("power_cut feeder at=40ms for=40ms");
  line.inject("power_cut feeder at=65ms for=5ms");
  EXPECT_TRUE(feeder_at(19'999us));
  for (const SimTime time : {20ms, 39ms, 41ms, 59ms, 61ms, 66ms, 71ms, 79ms}) EXPECT_FALSE(feeder_at(time));
  EXPECT_TRUE(feeder_at(80ms));

  const std::size_t first = line.inject("power_cut feeder");
  const std::size_t second = line.inject("power_cut feeder");
  world.clear_fault(first);
  EXPECT_FALSE(world.device(0).powered()) << "the second one is active";
  world.clear_fault(second);
  EXPECT_TRUE(world.device(0).powered());
  EXPECT_TRUE(world.device(1).powered());
}

TEST(PowerCut, AndTheSwitchAreTwoThings) {
  struct Case {
    std::vector<bool> switched;  // during the cut, one after another
    bool on_afterwards;
  };
  for (const auto& [switched, on_afterwards] : std::vector<Case>{{{}, true},
                                                                 {{false}, false},
                                                                 {{true}, true},
                                                                 {{false, true}, true},
                                                                 {{false, true, false}, false}}) {
    FaultyLine timed;
    timed.inject("power_cut feeder at=10ms for=20ms");
    FaultyLine cleared;
    cleared.world().advance_to(10ms);
    const std::size_t number = cleared.inject("power_cut feeder");
    for (FaultyLine* line : {&timed, &cleared}) {
      World& world = line->world();
      world.advance_to(15ms);
      EXPECT_FALSE(world.device(0).powered());
      for (const bool on : switched) {
        world.switch_power(0, on);
        EXPECT_FALSE(world.device(0).powered()) << "it is truncated";
      }
      // Another world that continues from here knows the state of the switch.
      FaultyLine other;
      restore(other.world(), save(world));
      for (World* one : {&world, &other.world()}) {
        one->advance_to(29'999us);
        EXPECT_FALSE(one->device(0).powered());
        one->advance_to(30ms);
        if (line == &cleared) one->clear_fault(number);
        EXPECT_EQ(one->device(0).powered(), on_afterwards);
        one->switch_power(0, true);
        EXPECT_TRUE(one->device(0).powered());
      }
    }
  }
}

// --- chance and state ------------------------------------------------------------------------------

std::vector<int> hits_of(FaultyLine& line) {
  std::vector<int> hits;
  for (int frame = 1; frame <= 10; ++frame) {
    if (line.ask(kAskFeeder).bytes.empty()) hits.push_back(frame);
  }
  return hits;
}

TEST(Chance, BeginsWithTheSeedOfTheBench) {
  // Calculated with another program: splitmix64 seeded with the first number of a splitmix64 seeded with the
  // bench's seed, and the number of the fault; hits are the draws below a half.
  const std::vector<std::vector<int>> expected{{1, 3, 6, 8, 9}, {3, 5, 8, 9, 10}, {1, 4, 5, 6, 7, 8, 10}};
  for (std::size_t seed = 0; seed < 3; ++seed) {
    FaultyLine line("seed: " + std::to_string(seed) + "\nfaults: [ { drop: feeder, chance: 50% } ]\n");
    EXPECT_EQ(hits_of(line), expected[seed]) << seed;
    FaultyLine given("", {}, seed);
    given.inject("drop feeder chance=50%");
    EXPECT_EQ(hits_of(given), expected[seed]) << seed;
  }
}

TEST(Chance, OfOneFaultDoesNotDependOnOthers) {
  FaultyLine alone(kMachine);
  alone.inject("drop feeder chance=50%");
  FaultyLine among(kMachine);
  among.inject("drop feeder chance=50%");
  among.inject("delay rs485 by=1ms chance=30%");
  among.inject("encoder_noise feeder.A counts=1 chance=10%");
  EXPECT_EQ(hits_of(alone), hits_of(among));
}

TEST(FaultState, IsSavedAndRestoredWithAllThatIsUnderWay) {
  const std::string bench = kMachine +
                            "seed: 5\n"
                            "faults:\n"
                            "  - { drop: feeder, chance: 30% }\n"
                            "  - { duplicate: rs485, after: 130ms, every: 2 }\n"
                            "  - { delay: turner, by: 33ms, of: both }\n"
                            "  - { power_cut: turner, at: 350ms, for: 75ms }\n"
                            "  - { stall: feeder.A, when: feeder.A.pulses > 500, for: 30ms, times: 2 }\n"
                            "  - { encoder_noise: feeder.A, counts: 9, chance: 10% }\n"
                            "  - { noise: feeder, before: 'FF', nth: 3.. }\n";
  const auto play = [](World& world, SimTime from, SimTime to) {
    std::vector<Bytes> came;
    const std::vector<Bytes> frames{kSwitchServoOn, kAskTurner, kSetMove,  kMove,
                                    kAskFeeder,     kAskTurner, kAskFeeder};
    for (SimTime now = from; now < to; now += 7ms) {
      world.advance_to(now);
      if (now % 49ms == 0ms) world.receive(0, frames[static_cast<std::size_t>(now / 49ms) % 7], now);
      const auto printed = world.line(0).line.output();
      came.emplace_back(printed.begin(), printed.end());
      world.take_output(0, printed.size());
    }
    return came;
  };
  FaultyLine whole(bench);
  const auto expected = play(whole.world(), 7ms, 1400ms);
  std::size_t late = 0;
  for (SimTime half = 14ms; half < 1400ms; half += 35ms) {
    FaultyLine first(bench);
    auto came = play(first.world(), 7ms, half);
    for (const auto& station : first.world().line(0).stations) {
      late += dynamic_cast<const RtuStation&>(*station).save().late.size();
    }
    const WorldState state = save(first.world());
    FaultyLine second(bench);
    restore(second.world(), state);
    EXPECT_EQ(save(second.world()), state);
    const auto rest = play(second.world(), half, 1400ms);
    came.insert(came.end(), rest.begin(), rest.end());
    ASSERT_EQ(came, expected) << format_duration(half);
    ASSERT_EQ(hash(second.world()), hash(whole.world())) << format_duration(half);
  }
  EXPECT_GT(late, 10u);
}

TEST(FaultState, OfWhatNoFaultCanBeIsRefused) {
  FaultyLine line("faults: [ { drop: feeder, when: time > 5ms } ]\n");
  const WorldState good = save(line.world());
  // The condition is the only text in it of this form.
  WorldState bad = good;
  auto& bytes = bad.parts[0].bytes;
  const std::string_view text = "time > 5ms";
  const auto found = std::search(bytes.begin(), bytes.end(), text.begin(), text.end(),
                                 [](std::byte b, char c) { return std::to_integer<char>(b) == c; });
  ASSERT_NE(found, bytes.end());
  *found = std::byte{'x'};
  EXPECT_THROW(restore(line.world(), bad), StateError);
  EXPECT_EQ(save(line.world()), good);
}

// --- the same, however ticks are run ----------------------------------------------------------------

TEST(TriggeredFaults, AreTheSameWhetherQuietTicksAreRunOrSkipped) {
  for (const char* text :
       {"stall feeder.A at=333.4ms for=10ms", "power_cut turner from=200ms to=250.5ms",
        "stuck feeder.DIN_3 level=1 when=\"feeder.A.pulses > 100\"",
        "power_cut feeder when=\"time >= 450ms\" for=3ms", "slip feeder.A pulses=3 chance=5% seed=3",
        "alarm feeder.A function=6 for=55ms", "encoder_noise feeder.A counts=2 period=6ms",
        "lost_steps feeder.A one_in=3 chance=20% for=7ms", "drop rs485 when=\"time / 1ms % 2 == 1\""}) {
    FaultyLine crossing(kMachine);
    FaultyLine running(kMachine);
    running.world().set_bulk_ticks(false);
    for (FaultyLine* line : {&crossing, &running}) line->inject(text);
    for (const Bytes& frame : {kSwitchServoOn, kAskTurner, kSetMove, kMove, kAskFeeder, kAskTurner}) {
      EXPECT_EQ(crossing.ask(frame), running.ask(frame)) << text;
      EXPECT_EQ(crossing.world().faults(), running.world().faults()) << text;
      EXPECT_EQ(hash(crossing.world()), hash(running.world())) << text;
    }
    EXPECT_GT(crossing.course(1).hits + (crossing.course(1).in_force ? 1 : 0), 0) << text;
  }
}

}  // namespace triggered_faults_test
}  // namespace understudy::emulator::world
