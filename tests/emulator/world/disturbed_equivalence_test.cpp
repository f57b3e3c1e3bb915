// However a world is stepped, it is the same world: here with everything that a user can do to it besides the
// line: power, faults, analog inputs, switches on the housing, drives. The events of
// world_equivalence_test.cpp are mostly on the line. Random, seeded; UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>
#include <utility>

#include "emulator/models/models.h"
#include "tests/emulator/world/stepping.h"

namespace understudy::emulator::world {
namespace disturbed_equivalence_test {

using namespace std::chrono_literals;

std::uint64_t seed() { return seed_or(88'001); }

World make_disturbed_world(const std::string& timing) {
  const std::string drives =
      "understudy: 1\n"
      "lines:\n"
      "  rs485:\n"
      "    timing: " +
      timing +
      "\n"
      "    stations:\n"
      "      - { name: feeder, model: simple2-r3, address: 1, set: { DOUT0_Aaxis_SVON: 1, DIN1_Aaxis_Ready: "
      "1,\n"
      "          DIN0_Aaxis_Alarm: 1, DOUT1_Aaxis_ACLR: 1, DIN2_Aaxis_UP_Limit: 1, Aaxis_Speed: 30 } }\n"
      "      - { name: turner, model: simple2-r3, address: 2, set: { DOUT2_Baxis_SVON: 1, DIN6_Baxis_Ready: "
      "1,\n"
      "          DIN5_Baxis_Alarm: 1, Baxis_ALM_Polarity: 1, Baxis_SVON_Polarity: 0 },\n"
      "          choices: { switches_sampled: always, servo_at_power_up: on } }\n"
      "plant:\n"
      "  feeder.A: { travel: [-3000, 900], home: { at: 50, width: 20, hysteresis: 6 },\n"
      "              limits: { lower: -200, upper: 800, hysteresis: 9 }, encoder: { per_revolution: 4000 },\n"
      "              drive: { ready_after: 25ms } }\n"
      "  turner.B: { limits: { upper: 100 }, encoder: { per_revolution: 700, reversed: true },\n"
      "              drive: { ready_after: 400ms, enabled_by: off, alarm_contact: opens } }\n"
      "wires: [ feeder.DOUT_1 -> turner.DIN_0, turner.DOUT_2 -> feeder.DIN_7, feeder.DOUT_0 -> turner.DIN_9 "
      "]\n"
      "faults: [ { lost_steps: feeder.A, one_in: 17 } ]\n";
  return World(parse_bench(models::all_models(), drives, "disturbed.yaml", "."), {}, {});
}

enum class Kind : std::uint8_t { frame, input, power, inject, clear };

struct Event {
  SimTime at{0};
  Kind kind = Kind::frame;
  Bytes bytes{};
  std::size_t device = 0;
  int terminal = 0;
  std::int32_t level = 0;  // of an input; on or off for the power; which of the active faults
  Fault fault{};
};

class RandomEvents {
 public:
  RandomEvents(std::uint64_t seed_value, const Model& model) : random_(seed_value), model_(model) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

  std::vector<Event> make(int count) {
    std::vector<Event> events;
    for (int i = 0; i < count; ++i) {
      if (between(0, 4) != 0) time_ += gap();  // otherwise at the same moment as the previous one
      events.push_back(next());
      events.back().at = time_;
    }
    return events;
  }

 private:
  SimTime gap() {
    switch (between(0, 5)) {
      case 0: return SimTime{between(1, 2'000'000)};
      case 1: return SimTime{between(0, 3'000'000'000)};
      case 2: return kTickLength - time_ % kTickLength;
      case 3: return (kTickLength - time_ % kTickLength) * 2 - 1ns;
      default: return SimTime{between(5'000'000, 90'000'000)};
    }
  }

  Event next() {
    Event event{.device = static_cast<std::size_t>(between(0, 1))};
    switch (between(0, 9)) {
      case 0: {
        event.kind = Kind::input;
        do {
          event.terminal = static_cast<int>(between(0, static_cast<int>(model_.terminals.size()) - 1));
        } while (!is_input(model_.terminals[static_cast<std::size_t>(event.terminal)].kind));
        const TerminalRow& row = model_.terminals[static_cast<std::size_t>(event.terminal)];
        event.level = static_cast<std::int32_t>(between(row.lowest, row.highest));
        break;
      }
      case 1:
        event.kind = Kind::power;
        event.level = between(0, 2) != 0;
        break;
      case 2:
      case 3:
        event.kind = Kind::inject;
        event.fault = fault(event.device);
        break;
      case 4:
      case 5:
        event.kind = Kind::clear;
        event.level = static_cast<std::int32_t>(between(0, 1000));
        break;
      default: event.bytes = frame(static_cast<int>(event.device) + 1); break;
    }
    return event;
  }

  Fault fault(std::size_t device) {
    Fault fault{.kind = static_cast<Fault::Kind>(between(0, 4)), .device = device};
    fault.place = static_cast<int>(between(0, 1));
    switch (fault.kind) {
      case Fault::Kind::lost_steps: fault.amount = between(1, 90); break;
      case Fault::Kind::slip: fault.amount = between(-400, 400); break;
      case Fault::Kind::stuck:
        fault.place = static_cast<int>(between(0, 10));
        fault.amount = between(0, 1);
        break;
      default: break;
    }
    if (between(0, 9) == 0) fault = {.kind = Fault::Kind::power_cut, .device = device};
    if (between(0, 2) == 0) fault.trigger = trigger(fault);
    return fault;
  }

  FaultTrigger trigger(const Fault& fault) {
    FaultTrigger trigger;
    const bool lasts = fault.kind != Fault::Kind::slip && between(0, 1) == 0;
    if (lasts) trigger.lasts = std::chrono::microseconds(between(1, 90'000));
    switch (between(0, 4)) {
      case 0: trigger.at = std::chrono::microseconds(between(0, 3'000'000)); break;
      case 1: trigger.from = std::chrono::microseconds(between(1, 3'000'000)); break;
      case 2: trigger.when = "time / 1ms % 97 > 60"; break;
      case 3: trigger.chance = kAlways / 50; break;
      default: trigger.every = between(1, 3); break;
    }
    return trigger;
  }

  Bytes frame(int station) {
    const int axis = station - 1;  // the one with the drive
    switch (between(0, 9)) {
      case 0: return write_request(station, 0x1014 + axis, between(0, 4) != 0);  // SVON
      case 1: return write_request(station, 0x1017 + axis, 1);                   // ACLR
      case 2: return write_request(station, 0x101B + axis, 1);                   // GoHome
      case 3:
        return write_request(station, 0x0A00 + static_cast<int>(between(0, 13)),
                             static_cast<int>(between(0, 1)));
      case 4:
        return write_request(station, 0xF012 + static_cast<int>(between(0, 7)),
                             static_cast<int>(between(0, 1)));
      case 5: return read_request(station, 0x0000, 1);
      case 6: return read_request(station, 0x0E00, 16);
      default: return whole_move(station, axis);
    }
  }

  Bytes whole_move(int station, int axis) {
    const auto byte = [](std::int64_t n) { return static_cast<std::uint8_t>(n); };
    const int first = 0x1000 + 6 * axis;
    const std::int64_t distance = between(-1500, 1500);
    Bytes bytes{byte(station), 0x10, byte(first >> 8), byte(first), 0, 6, 12};
    for (const std::int64_t word :
         {distance, distance >> 16, between(1, 400), between(0, 30), between(0, 30), std::int64_t{1}}) {
      bytes.push_back(byte(word >> 8));
      bytes.push_back(byte(word));
    }
    return framed(bytes);
  }

  std::mt19937_64 random_;
  const Model& model_;
  SimTime time_{0};
};

void apply(World& world, const Event& event) {
  switch (event.kind) {
    case Kind::frame: world.receive(0, event.bytes, event.at); break;
    case Kind::input: world.set_external_input(event.device, event.terminal, event.level); break;
    case Kind::power: world.switch_power(event.device, event.level != 0); break;
    case Kind::inject: world.inject(event.fault); break;
    case Kind::clear: {
      if (world.faults().empty()) break;
      auto found = world.faults().begin();
      std::advance(found, event.level % static_cast<int>(world.faults().size()));
      world.clear_fault(found->first);
      break;
    }
  }
}

/// The sequences are meaningful only if much happens in them.
struct Lively {
  std::uint64_t skipped = 0;
  std::uint64_t run = 0;
  std::uint64_t replies = 0;
  std::int64_t lost = 0;
  std::int64_t moved = 0;
  int ready = 0;
  int alarms = 0;
  int dark = 0;
};

void compare(std::uint64_t seed_value, const std::string& timing, const Stepping& stepping, Lively& sum) {
  World plain = make_disturbed_world(timing);
  World twin = make_disturbed_world(timing);
  RandomEvents random(seed_value, plain.device(0).model());
  std::int64_t before = plain.plant(0, 0).position_pulses();
  const auto look = [&] {
    const std::int64_t now = plain.plant(0, 0).position_pulses();
    sum.moved += std::abs(now - std::exchange(before, now));
    sum.ready += plain.plant(0, 0).ready() || plain.plant(1, 1).ready();
    sum.alarms += plain.plant(0, 0).in_alarm();
    sum.dark += !plain.device(0).powered() || !plain.device(1).powered();
  };
  ASSERT_NO_FATAL_FAILURE(play_both(plain, twin, random.make(300), stepping,
                                    "seed " + std::to_string(seed_value) + " " + timing, look));
  sum.skipped += plain.ticks_skipped();
  sum.run += plain.ticks_run();
  sum.lost += plain.plant(0, 0).lost_pulses();
  for (const auto& station : plain.line(0).stations) sum.replies += station->counters().replies;
}

void compare_all(std::uint64_t first_seed, const Stepping& stepping) {
  std::cout << "seed " << first_seed << "\n";
  Lively sum;
  for (std::uint64_t i = 0; i < 12; ++i) {
    ASSERT_NO_FATAL_FAILURE(compare(first_seed + i, i % 2 == 0 ? "wire" : "instant", stepping, sum));
  }
  EXPECT_GT(sum.skipped, 100'000u);
  EXPECT_GT(sum.run, 10'000u);
  EXPECT_GT(sum.replies, 200u);
  EXPECT_GT(sum.lost, 100);
  EXPECT_GT(sum.moved, 500);
  EXPECT_GT(sum.ready, 100);
  EXPECT_GT(sum.alarms, 100);
  EXPECT_GT(sum.dark, 100);
}

TEST(DisturbedEquivalence, BulkTicksAreSingleTicksBitForBit) { compare_all(seed(), by_single_ticks); }
TEST(DisturbedEquivalence, OddStepsAreOneBigStep) { compare_all(seed() + 1000, by_odd_steps(seed())); }
TEST(DisturbedEquivalence, WakingOnlyWhenSomethingIsDueMissesNothing) {
  compare_all(seed() + 2000, by_what_is_due);
}

}  // namespace disturbed_equivalence_test
}  // namespace understudy::emulator::world
