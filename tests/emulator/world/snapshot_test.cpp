// A world that is saved, run on and restored continues as before: the same states at the same times, and the
// same bytes on its line. Random, seeded; UNDERSTUDY_SEED overrides.
#include "emulator/world/snapshot.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <set>

#include "base/state/state_bytes.h"
#include "emulator/world/stations/rtu_station.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/busy_acts.h"

namespace understudy::emulator::world {
namespace snapshot_test {

using namespace std::chrono_literals;

std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 40'001;
}

/// The visible state of a world just before an act.
struct Seen {
  std::uint64_t hash = 0;
  Bytes sent;
  std::optional<SimTime> next_due;
  bool operator==(const Seen&) const = default;
};

Seen look(World& world) {
  return {.hash = hash(world), .sent = take_output(world), .next_due = world.next_due()};
}

/// The number of moments in which something was running, so that the test does not only prove something for
/// quiet worlds.
struct Moments {
  int in_request = 0;
  int between_characters_and_service = 0;
  int in_reply = 0;
  int in_eeprom_write = 0;
  int in_homing = 0;
  int in_move = 0;
  int without_power = 0;
  int with_faults = 0;
  std::set<Value> program_commands;
};

void count(const World& world, Moments& moments) {
  const WorldLine& line = world.line(0);
  const pty::Line::State state = line.line.save();
  moments.in_request += state.input.empty() ? 0 : 1;
  moments.in_reply += state.leaving.empty() ? 0 : 1;
  for (const auto& station : line.stations) {
    moments.between_characters_and_service +=
        dynamic_cast<const RtuStation&>(*station).save().framer.save().ready.empty() ? 0 : 1;
  }
  for (const char* device : {"feeder.", "turner."}) {
    if (!world.device(device[0] == 'f' ? 0 : 1).powered()) {
      ++moments.without_power;
      continue;
    }
    const auto value = [&](const std::string& name) { return get(world, device + name); };
    moments.in_eeprom_write += value("EEPROM_Writing") != 0 ? 1 : 0;
    moments.in_homing += value("STATUS.6") != 0 || value("STATUS.7") != 0 ? 1 : 0;
    moments.in_move += value("STATUS.4") != 0 || value("STATUS.5") != 0 ? 1 : 0;
    if (value("PROG_MAIN_RunTime_Status") != 0) {
      const Value line_number = value("PROG_MAIN_NowLine");
      moments.program_commands.insert(value("MAIN_LINE" + std::to_string(line_number) + "_CMD"));
    }
  }
  moments.with_faults += world.faults().empty() ? 0 : 1;
}

struct Saved {
  std::size_t next_act = 0;
  WorldState state;
};

constexpr std::size_t kActsAfterwards = 25;

void save_and_go_on(std::uint64_t seed_value, Moments& moments) {
  BusyActs random(seed_value);
  const std::string timing = random.between(0, 2) == 0 ? "instant" : "wire";
  const WorldOptions options{.strict_framing = random.between(0, 3) == 0};
  World world = make_world(timing, 19'200, options);
  const std::vector<Act> acts = random.make(150);

  // A course, with snapshots of it between its acts.
  std::vector<Saved> snapshots;
  std::vector<Seen> lived;
  for (std::size_t i = 0; i < acts.size(); ++i) {
    const std::int64_t span = (acts[i].at - world.now()).count();
    if (random.between(0, 1) == 0) {
      // Often soon after an act, when the line is busy: a request takes 4.6 ms and more, a silence 2 ms.
      const std::int64_t soon = random.between(0, 3) == 0 ? span : std::min<std::int64_t>(span, 9'000'000);
      world.advance_to(world.now() + SimTime{random.between(0, soon)});
      count(world, moments);
      snapshots.push_back({i, save(world)});
    }
    world.advance_to(acts[i].at);
    lived.push_back(look(world));
    acts[i].carry_out(world);
  }

  World fresh = make_world(timing, 19'200, options);
  for (const Saved& saved : snapshots) {
    const std::size_t end = std::min(saved.next_act + kActsAfterwards, acts.size());
    // A world that has run already, and a new one.
    for (World* other : {&world, &fresh}) {
      const std::string which = " act " + std::to_string(saved.next_act) + " at " +
                                format_duration(saved.state.time) + " seed " + std::to_string(seed_value);
      restore(*other, saved.state);
      ASSERT_EQ(save(*other), saved.state) << "the restored state differs from the saved one;" << which;
      std::vector<Seen> again;
      for (std::size_t i = saved.next_act; i < end; ++i) {
        other->advance_to(acts[i].at);
        again.push_back(look(*other));
        acts[i].carry_out(*other);
      }
      for (std::size_t i = 0; i < again.size(); ++i) {
        ASSERT_EQ(again[i].sent, lived[saved.next_act + i].sent)
            << "sends something else before act " << saved.next_act + i << which;
        ASSERT_EQ(again[i], lived[saved.next_act + i])
            << "differs before act " << saved.next_act + i << which;
      }
    }
  }
}

TEST(Snapshot, AWorldThatIsRestoredContinuesAsItDid) {
  std::cout << "seed " << seed() << "\n";
  Moments moments;
  for (std::uint64_t i = 0; i < 8 && !testing::Test::HasFatalFailure(); ++i) {
    save_and_go_on(seed() + i, moments);
  }
  if (testing::Test::HasFatalFailure()) return;
  EXPECT_GT(moments.in_request, 100);
  EXPECT_GT(moments.between_characters_and_service, 4);
  EXPECT_GT(moments.in_reply, 30);
  EXPECT_GT(moments.in_eeprom_write, 80);
  EXPECT_GT(moments.in_homing, 60);
  EXPECT_GT(moments.in_move, 150);
  EXPECT_GT(moments.without_power, 10);
  EXPECT_GT(moments.with_faults, 100);
  EXPECT_GT(moments.program_commands.size(), 40u);  // of 115, because one line is caught at a time
}

/// The register map's own comparison, which does not use the bytes.
TEST(Snapshot, EqualBytesAreEqualStates) {
  int equal = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    BusyActs random(seed() + 500 + i);
    World world = make_world("wire");
    World twin = make_world("wire");
    for (const Act& act : random.make(120)) {
      world.advance_to(act.at);
      twin.advance_to(act.at);
      act.carry_out(world);
      if (random.between(0, 30) != 0) act.carry_out(twin);  // otherwise they diverge
      for (std::size_t d = 0; d < 2; ++d) {
        const Device& one = world.device(d);
        const Device& other = twin.device(d);
        bool same = one.same_state(other) && one.powered() == other.powered();
        for (int terminal = 0; terminal < 22; ++terminal) {
          same = same && one.input(terminal) == other.input(terminal);
        }
        EXPECT_EQ(one.save_state() == other.save_state(), same) << "act at " << format_duration(act.at);
        EXPECT_EQ(one.state_hash() == other.state_hash(), same) << "act at " << format_duration(act.at);
        equal += same ? 1 : 0;
      }
      if (hash(world) == hash(twin)) {
        EXPECT_TRUE(same_state(world.device(0), twin.device(0)));
      } else if (random.between(0, 3) == 0) {
        restore(twin, save(world));
      }
    }
  }
  EXPECT_GT(equal, 300);
}

TEST(Snapshot, TheHashDoesNotDependOnHowTicksWereRunOrWhoReads) {
  BusyActs random(seed() + 900);
  World world = make_world("wire");
  World single = make_world("wire");
  single.set_bulk_ticks(false);
  for (const Act& act : random.make(150)) {
    world.advance_to(act.at);
    single.advance_to(act.at);
    ASSERT_EQ(hash(world), hash(single)) << format_duration(act.at);
    take_output(world);  // a host that reads, and one that does not
    act.carry_out(world);
    act.carry_out(single);
  }
  EXPECT_GT(world.ticks_skipped(), 1000u);
  EXPECT_EQ(single.ticks_skipped(), 0u);
  // They are part of the saved state, though.
  const std::uint64_t skipped = world.ticks_skipped();
  restore(single, save(world));
  EXPECT_EQ(single.ticks_skipped(), skipped);
  EXPECT_EQ(take_output(single), take_output(world));
}

TEST(Snapshot, AStateThatIsReadOncePutsTheWorldIntoItEachTime) {
  World world = make_world("wire");
  BusyActs random(seed() + 950);
  const std::vector<Act> acts = random.make(60);
  for (std::size_t i = 0; i < 30; ++i) {
    world.advance_to(acts[i].at);
    acts[i].carry_out(world);
  }
  const WorldState middle = save(world);
  const auto put = read_state(world, middle);
  std::set<std::uint64_t> ends;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 30; i < acts.size(); ++i) {
      world.advance_to(acts[i].at);
      acts[i].carry_out(world);
    }
    ends.insert(hash(world));
    put();
    ASSERT_EQ(save(world), middle) << "round " << round;
  }
  EXPECT_EQ(ends.size(), 1u);
  EXPECT_FALSE(ends.contains(hash(world)));
}

TEST(Snapshot, OneStateHasSeveralContinuations) {
  World world = make_world("instant");
  set(world, "feeder.Aaxis_SVON", 1);
  set(world, "feeder.Aaxis_Speed", 60);  // 3200 pulses per second
  set(world, "feeder.Aaxis_AccTime", 1);
  set(world, "feeder.Aaxis_DecTime", 1);
  world.advance_to(100ms);
  const WorldState start = save(world);
  const auto go = [&](std::int64_t pulses) {
    restore(world, start);
    EXPECT_EQ(world.now(), 100ms);
    set(world, "feeder.Aaxis_Pulse", pulses);
    set(world, "feeder.Aaxis_Move_INC", 1);
    world.advance_to(2s);
    return get(world, "feeder.Cord_A");
  };
  EXPECT_EQ(go(100), 100);
  EXPECT_EQ(go(-50), -50);
  EXPECT_EQ(go(320), 320);
  EXPECT_EQ(go(100), 100);
}

// --- refusals --------------------------------------------------------------------------------------

/// A busy world, with everything that can be changed.
void keep_busy(World& world, std::uint64_t seed_value) {
  BusyActs random(seed_value);
  for (const Act& act : random.make(80)) {
    world.advance_to(act.at);
    act.carry_out(world);
  }
}

std::string refusal_of(World& world, const WorldState& state) {
  try {
    restore(world, state);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

TEST(Snapshot, WhatIsOfAnotherWorldIsRefusedAndChangesNothing) {
  World world = make_world("wire");
  keep_busy(world, seed() + 1000);
  const WorldState good = save(world);
  const auto refused = [&](const std::string& what, auto spoil) {
    WorldState bad = good;
    spoil(bad);
    EXPECT_EQ(refusal_of(world, bad), what);
    EXPECT_EQ(save(world), good) << what;
  };
  refused("edge: is missing", [](WorldState& s) { s.parts.pop_back(); });
  refused("world: is missing", [](WorldState& s) { s.parts.clear(); });
  refused("device turner: is missing", [](WorldState& s) { s.parts[2].name = "device other"; });
  refused("edge: is not part of this world", [](WorldState& s) { s.parts.push_back(s.parts.back()); });
  for (std::size_t i = 0; i < good.parts.size(); ++i) {
    refused(good.parts[i].name + ": the bytes end too early",
            [&](WorldState& s) { s.parts[i].bytes.pop_back(); });
    refused(good.parts[i].name + ": the bytes end too early",
            [&](WorldState& s) { s.parts[i].bytes.clear(); });
    refused(good.parts[i].name + ": bytes are left over",
            [&](WorldState& s) { s.parts[i].bytes.push_back(std::byte{0}); });
  }
  World alone(
      parse_bench(models::all_models(),
                  "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n",
                  "one.yaml", "."),
      {}, {});
  const WorldState of_alone = save(alone);
  EXPECT_EQ(refusal_of(alone, good), "world: its devices are different");
  EXPECT_EQ(save(alone), of_alone);
}

TEST(Snapshot, IsRefusedWhereALineReceivesItsHostDifferently) {
  const Bench bench =
      parse_bench(models::all_models(),
                  "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n",
                  "one.yaml", ".");
  World tolerant(bench, {}, {});
  World strict(bench, {.strict_framing = true}, {});
  World any_speed(bench, {.enforce_settings = false}, {});
  World patient(bench, {.patience = 1s}, {});
  for (World* world : {&tolerant, &strict, &any_speed, &patient}) world->advance_to(20ms);
  EXPECT_EQ(refusal_of(tolerant, save(strict)),
            "line rs485: was saved with strict framing; expected a bench with strict framing");
  EXPECT_EQ(refusal_of(strict, save(tolerant)),
            "line rs485: was saved with tolerant framing; expected a bench without strict framing");
  EXPECT_EQ(refusal_of(tolerant, save(any_speed)),
            "line rs485: was saved by a bench that accepts hosts with any speed; expected a bench that also "
            "accepts them");
  EXPECT_EQ(refusal_of(any_speed, save(tolerant)),
            "line rs485: was saved by a bench that ignores hosts with another speed; expected a bench that "
            "also ignores them");
  EXPECT_EQ(refusal_of(tolerant, save(patient)), "") << "a daemon at another speed is more patient";
  EXPECT_EQ(refusal_of(strict, save(strict)), "");
}

TEST(Snapshot, AFaultLastsNoLongerThanTimeIsCounted) {
  constexpr Tick kLasts = 123'456'789;
  World world(parse_bench(models::all_models(),
                          "understudy: 1\n"
                          "lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n"
                          "plant: { feeder.A: { encoder: { per_revolution: 4000, on: wheel } } }\n"
                          "faults: [ { turn: feeder.A, counts: 500, in: 123456789ms, when: time > 1h } ]\n",
                          "one.yaml", "."),
              {}, {});
  const WorldState good = save(world);
  WorldState bad = good;
  const auto bytes_of = [](Tick ticks) { return std::bit_cast<std::array<std::byte, sizeof ticks>>(ticks); };
  auto& bytes = bad.parts[0].bytes;
  const auto wanted = bytes_of(kLasts);
  const auto place = std::search(bytes.begin(), bytes.end(), wanted.begin(), wanted.end());
  ASSERT_NE(place, bytes.end());
  std::ranges::copy(bytes_of(tick_at(kForever) + 1), place);
  EXPECT_EQ(refusal_of(world, bad), "world: a fault lasts beyond the end of simulated time");
  EXPECT_EQ(save(world), good);
}

/// Whatever a byte becomes, the state is refused without changes, or it can continue (sanitizers check that).
/// UNDERSTUDY_FLIPS: one in this many bytes of the devices.
void flip_bytes(std::uint64_t seed_value, const std::string& timing, std::size_t stride, int& refused,
                int& taken) {
  World world = make_world(timing);
  keep_busy(world, seed_value);
  const WorldState good = save(world);
  const std::uint64_t good_hash = hash(world);
  std::mt19937_64 random(seed_value);
  for (std::size_t p = 0; p < good.parts.size(); ++p) {
    const std::size_t step = good.parts[p].bytes.size() > 4000 ? stride : 1;
    for (std::size_t i = random() % step; i < good.parts[p].bytes.size(); i += step) {
      WorldState bad = good;
      bad.parts[p].bytes[i] ^= static_cast<std::byte>(random() % 255 + 1);
      if (!refusal_of(world, bad).empty()) {
        ++refused;
        if (refused % 16 == 0) {
          ASSERT_EQ(hash(world), good_hash) << good.parts[p].name << " byte " << i;
        }
        continue;
      }
      ++taken;
      world.receive(0, read_request(1, 0, 1));
      world.advance_to(world.now() + 25ms);
      save(world);
      restore(world, good);
    }
  }
  ASSERT_EQ(save(world), good);
}

TEST(Snapshot, AFlippedByteIsRefusedOrCanBeLivedOn) {
  const char* given = std::getenv("UNDERSTUDY_FLIPS");
  const std::size_t stride = given != nullptr ? std::strtoull(given, nullptr, 10) : 97;
  std::cout << "seed " << seed() + 2000 << "\n";
  int refused = 0;
  int taken = 0;
  for (std::uint64_t i = 0; i < 6 && !testing::Test::HasFatalFailure(); ++i) {
    flip_bytes(seed() + 2000 + i, i % 2 == 0 ? "wire" : "instant", stride, refused, taken);
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(taken, 500);
}

}  // namespace snapshot_test
}  // namespace understudy::emulator::world
