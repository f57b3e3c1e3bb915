// Random programs with disturbances: pauses of all kinds change only the time; skipped quiet scans and ticks
// have the same result as if they had run.
#include <gtest/gtest.h>

#include <random>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace random_events_test {

using Random = std::mt19937;

int below(Random& random, int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); }
std::string number(Random& random, const char* letter, int limit) {
  return letter + std::to_string(below(random, limit));
}

// --- pauses -----------------------------------------------------------------------------------------

/// A program that ends on its own and depends on nothing: numbers, delays, motions, forward branches,
/// subroutines.
std::string random_program(Random& random) {
  std::string text = "AREA C\n";
  const auto body = [&](int count, bool may_call) {
    for (int i = 0; i < count; ++i) {
      switch (below(random, may_call ? 14 : 12)) {
        case 0: text += "TMR " + number(random, "K", 6) + "\n"; break;
        case 1: text += "INC " + number(random, "D", 6) + "\n"; break;
        case 2: text += "LIN " + number(random, "D", 6) + " K" + std::to_string(i) + "\n"; break;
        case 3: text += "DRV * " + number(random, "D", 6) + "\n"; break;
        case 4: text += "F " + number(random, "K", 900) + "\n"; break;
        case 5: text += below(random, 2) == 0 ? "INCC\n" : "ABSC\n"; break;
        case 6: text += "RPM " + number(random, "K", 900) + "\n"; break;
        case 7: text += "HOM K1\n"; break;
        case 8: text += "ADD " + number(random, "D", 6) + " K2 " + number(random, "D", 6) + "\n"; break;
        case 9: text += "VDRV K0\n"; break;
        case 10:
          text += "LD> " + number(random, "D", 6) + " " + number(random, "K", 5) + "\nIF\nINC " +
                  number(random, "D", 6) + "\nLIN K7\nELSE\nMRK K3\nENDI\n";
          break;
        case 11: text += "SET " + number(random, "M", 6) + "\nXZP\nCW K1 K1 K1 K1\n"; break;
        default: text += "CAL " + number(random, "K", 3) + " " + number(random, "K", 4) + "\n";
      }
    }
  };
  body(5 + below(random, 12), true);
  text += "END\n";
  for (int i = 0; i < 3; ++i) {
    text += "LAB K" + std::to_string(i) + "\n";
    body(1 + below(random, 4), false);
    text += "RET\n";
  }
  return text;
}

std::vector<std::string> motions_of(const ScriptedMachine& machine) {
  std::vector<std::string> motions;
  for (const std::string& line : machine.log) {
    const bool is_motion =
        line != "C: starts" && line != "C: hold" && line != "C: go on" && line != "C: ended";
    if (is_motion) motions.push_back(line);
  }
  return motions;
}

TEST(Super40ncRandomEvents, PausesChangeNothingButTheTime) {
  constexpr int kPrograms = 3000;
  int pauses = 0;
  for (int seed = 0; seed < kPrograms; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const std::string text = random_program(random);
    Running plain(text);
    Running disturbed(text);
    plain.start(Area::c);
    disturbed.start(Area::c);
    for (int tick = 0; tick < 3000 && plain.phase(Area::c) != Phase::idle; ++tick) plain.tick();
    ASSERT_EQ(plain.phase(Area::c), Phase::idle) << text;
    for (int tick = 0; tick < 9000; ++tick) {
      const Phase phase = disturbed.phase(Area::c);
      if (phase == Phase::idle) break;
      const bool rests = phase == Phase::paused || phase == Phase::held;
      switch (below(random, 12)) {
        case 0:
          disturbed.take(Event::hold, Area::c);
          ++pauses;
          break;
        case 1: disturbed.machine.set_special_contact(8000, false); break;
        case 2: disturbed.take(Event::contact_off, Area::c); break;
        case 3: disturbed.machine.set_special_contact(8004, random() % 2 != 0); break;
        case 4: disturbed.machine.set_special_contact(8001, random() % 4 == 0); break;
        case 5: disturbed.take(Event::plc_stop, Area::c); break;
        default:
          if (!rests || below(random, 3) != 0) break;
          if (random() % 2 == 0) {
            disturbed.start(Area::c);
          } else {
            disturbed.machine.set_special_contact(8000, true);
          }
      }
      disturbed.tick();
    }
    disturbed.machine.special.erase(8001);
    disturbed.machine.special.erase(8004);
    for (int tick = 0; tick < 3000 && disturbed.phase(Area::c) != Phase::idle; ++tick) {
      disturbed.machine.set_special_contact(8000, true);
      disturbed.tick();
    }
    ASSERT_EQ(motions_of(disturbed.machine), motions_of(plain.machine)) << seed << "\n" << text;
    ASSERT_EQ(disturbed.machine.memory, plain.machine.memory) << seed << "\n" << text;
    ASSERT_EQ(disturbed.machine.registers, plain.machine.registers) << seed << "\n" << text;
    ASSERT_TRUE(disturbed.machine.codes == plain.machine.codes) << seed << "\n" << text;
  }
  EXPECT_GT(pauses, kPrograms);
}

// --- quiet scans ------------------------------------------------------------------------------------

std::string random_ladder(Random& random) {
  std::string text = "AREA PLC\n";
  for (int rung = 3 + below(random, 8); rung > 0; --rung) {
    constexpr const char* kLoads[] = {"LD X", "LDI X", "LDP X", "LDF X", "LD M",
                                      "LD T", "LDI T", "LD C",  "LD Y",  "LDP M"};
    constexpr const char* kMore[] = {"AND X", "OR M", "ANI T", "ORI Y", "ANP X", "ORF M"};
    text += number(random, kLoads[below(random, 10)], 3) + "\n";
    for (int i = below(random, 3); i > 0; --i) text += number(random, kMore[below(random, 6)], 3) + "\n";
    if (below(random, 5) == 0) text += "AD> " + number(random, "D", 3) + " " + number(random, "K", 4) + "\n";
    if (below(random, 12) == 0) text += "OR< " + number(random, "T", 3) + " K20\n";
    for (int i = 1 + below(random, 2); i > 0; --i) {
      switch (below(random, 16)) {
        case 0: text += number(random, "OUT Y", 3) + "\n"; break;
        case 1: text += number(random, "OUT M", 3) + "\n"; break;
        case 2: text += number(random, "SET M", 3) + "\n"; break;
        case 3: text += number(random, "RST M", 3) + "\n"; break;
        case 4:
        case 5:
        case 6:
          text += number(random, "OUT T", 3) + " K" + std::to_string(5 + below(random, 300)) + "\n";
          break;
        case 7:
          text += number(random, "OUT C", 3) + " K" + std::to_string(1 + below(random, 5)) + "\n";
          break;
        case 8: text += number(random, "PLS M", 3) + "\n"; break;
        case 9: text += number(random, "ALT Y", 3) + "\n"; break;
        case 10: text += number(random, "MOV K", 5) + number(random, " D", 3) + "\n"; break;
        case 11: text += below(random, 4) == 0 ? number(random, "INC D", 3) + "\n" : "INV\n"; break;
        case 12: text += number(random, "RST C", 3) + "\n"; break;
        case 13: text += "ZRST D1 D2\n"; break;
        case 14: text += number(random, "OUT T", 3) + number(random, " D", 3) + "\n"; break;
        default: text += number(random, "MOV T", 3) + " D" + std::to_string(3 + below(random, 2)) + "\n";
      }
    }
  }
  return text + "END\n";
}

TEST(Super40ncRandomEvents, SkippedScansAreAsIfTheyHadBeenRun) {
  constexpr int kLadders = 1500;
  constexpr int kMs = 600;
  std::int64_t skipped = 0;
  for (int seed = 0; seed < kLadders; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const std::string text = random_ladder(random);
    ASSERT_TRUE(check(text).program) << text << to_string(check(text).errors.at(0));
    Running all(text);
    Running some(text);
    all.run_plc();
    some.run_plc();
    std::int64_t change_at = 0;
    for (std::int64_t ms = 0; ms < kMs;) {
      if (ms == change_at) {
        const Operand input = below(random, 3) == 0 ? m(below(random, 3)) : x(below(random, 3));
        const bool on = random() % 2 != 0;
        for (Running* plc : {&all, &some}) plc->machine.set(input, on);
        change_at = ms + 1 + below(random, 90);
      }
      all.scan();
      const Scanned scanned = some.scan();
      ++ms;
      ASSERT_EQ(all.machine.memory, some.machine.memory) << seed << " at " << ms << "\n" << text;
      ASSERT_EQ(all.plc, some.plc) << seed << " at " << ms << "\n" << text;
      const std::int64_t quiet = std::min(scanned.has_changed ? 0 : scanned.quiet_scans, change_at - ms);
      if (quiet <= 0) continue;
      fast_forward(some.plc, some.ladder, some.machine, quiet, some.options);
      for (std::int64_t i = 0; i < quiet; ++i) all.scan();
      ms += quiet;
      skipped += quiet;
      ASSERT_EQ(all.machine.memory, some.machine.memory) << seed << " at " << ms << "\n" << text;
      ASSERT_EQ(all.plc, some.plc) << seed << " at " << ms << "\n" << text;
    }
  }
  EXPECT_GT(skipped, std::int64_t{kLadders} * kMs / 3);
}

}  // namespace random_events_test
}  // namespace understudy::interpreter::super_40nc
