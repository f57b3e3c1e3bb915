// What survives power-off, what the Initial Table does, and that a state is complete (8, 3.19, 4.3.1).
#include <gtest/gtest.h>

#include "base/state/state_error.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_memory_test {

TEST(RsM8194hMemory, TheInitialTableCountsFromTheNextLoadOn) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V INITIAL_XY 50000", "RSM_SET_ALARM INITIAL_Y 1 1",
            "RSM_SET_SLMT INITIAL_U 1000 -1000 1", "RSM_SERVO_ON INITIAL_Z"});
  EXPECT_EQ(rsm.state().units[0].basic, BasicSettings{});
  EXPECT_EQ(rsm.get("Servo Z"), 0);
  rsm.send("RSM_LOAD_INITIAL");
  EXPECT_EQ(rsm.state().units[0].basic.max_v, 50000u);
  EXPECT_EQ(rsm.get("Servo Z"), 1);
  EXPECT_EQ(rsm.get("DI_ALL_Y"), 0x03F0);
  rsm.send({"RSM_SET_MAX_V X 60000", "RSM_RESET_CARD"});
  EXPECT_EQ(rsm.state().units[0].basic.max_v, 50000u);
  rsm.device().switch_power(false);
  rsm.device().switch_power(true);
  EXPECT_EQ(rsm.state().units[1].basic.max_v, 50000u);
  EXPECT_TRUE(rsm.state().units[3].basic.soft_limits);
  EXPECT_EQ(rsm.state().units[3].basic.reverse_soft_limit, -1000);
}

TEST(RsM8194hMemory, KeepsWhatTheManualSaysAndLosesTheRest) {
  OneRsm rsm({.program = "MP 5\nRSM_MACRO_SET_VAR VAR1 3\nEND\nTRIGGER 8.4 on MP5\n"});
  rsm.set("MD3", -5);
  rsm.send("RSM_WRITE_MD 1500 0 321.65");
  rsm.set("VAR3", 9);
  rsm.set("bVAR3", 9);
  rsm.set("FRNET_EVENT", 1);
  rsm.set("WORD_ORDER", 1);
  rsm.send({"RSM_SET_LP X 5"});
  rsm.run(5);
  const NvImage image = rsm.device().memory()->nv_image();
  EXPECT_EQ(parse_nv_image(to_json(image)), image);
  rsm.device().switch_power(false);
  rsm.device().switch_power(true);
  EXPECT_EQ(rsm.get("MD3"), -5);
  EXPECT_EQ(rsm.get("MD1500"), value_of_real(321.65F));
  EXPECT_EQ(rsm.get("FRNET_EVENT"), 1);
  for (const char* name : {"VAR3", "bVAR3", "WORD_ORDER", "LP_X"}) EXPECT_EQ(rsm.get(name), 0) << name;
  EXPECT_EQ(rsm.device().user_program()->program_text(),
            "MP 5\n  RSM_MACRO_SET_VAR VAR1 3\nEND\n\nTRIGGER 8.4 on MP5\n");

  // Into another device, through its image.
  DeviceSettings settings;
  settings.name = "other";
  settings.nv = image;
  const auto other = make_device(rs_m8194h::model(), settings);
  EXPECT_EQ(other->user_program()->program_text(), rsm.device().user_program()->program_text());
  EXPECT_TRUE(holds_the_same(other->memory()->nv_image(), rsm.device().memory()->nv_image()));
}

struct Block {
  const char* kind;
  const char* name;
  const char* text;
  bool fits;
};
constexpr Block kBlocks[] = {
    {"initial", "X", "RSM_SET_MAX_V INITIAL_X 50000\n", true},
    {"initial", "X", "RSM_FIXED_MOVE X 5\n", false},
    {"initial", "X", "RSM_MACRO_SET_MAX_V X 50000\n", true},  // the same setting, as a macro has it
    {"initial", "X", "MAX_V 5\n", false},
    {"initial", "W", "RSM_SET_MAX_V INITIAL_X 50000\n", false},
    {"mp", "157", "MP 157\n  RSM_MACRO_TIMER 5\nEND\n", true},
    {"mp", "01", "MP 1\n  RSM_MACRO_TIMER 5\nEND\n", false},
    {"mp", "158", "MP 158\n  RSM_MACRO_TIMER 5\nEND\n", false},
    {"mp", "0", "MP 1\n  RSM_MACRO_TIMER 5\nEND\n", false},
    {"mp", "1", "MP 1\n  RSM_MACRO_NEXT\nEND\n", false},
    {"isr", "20", "ISR 20\n  RSM_MACRO_SET_VAR VAR1 5\nEND\n", true},
    {"isr", "21", "ISR 21\n  RSM_MACRO_SET_VAR VAR1 5\nEND\n", false},
    {"isr", "1", "ISR 1\n  RSM_MACRO_TIMER 5\nEND\n", false},
    {"triggers", "15.15", "TRIGGER 15.15 on MP1\n", true},
    {"triggers", "16.0", "TRIGGER 16.0 on MP1\n", false},
    {"triggers", "7.15", "TRIGGER 7.15 on MP1\n", false},
    {"triggers", "8.0", "TRIGGER 8.0 on MP158\n", false},
    {"macros", "1", "MP 1\n  RSM_MACRO_TIMER 5\nEND\n", false},
};

// Values that a choice allows are persistent, too.
TEST(RsM8194hMemory, KeepsMacrosThatOnlyAChoiceAllows) {
  const std::string text = "MP 41\n  RSM_MACRO_RECTANGLE X Y 0 0 0 1000 1000 600 1000 1000 1000 1000\nEND\n";
  const std::map<std::string, std::string> kChoices[] = {{{"rectangle_radius", "drawn_shorter"}},
                                                         {{"rectangle_sides", "straight_parts"}}};
  for (const auto& choices : kChoices) {
    OneRsm rsm({.program = text, .choices = choices});
    EXPECT_EQ(rsm.device().user_program()->program_text(), text);
    rsm.device().switch_power(false);
    rsm.device().switch_power(true);
    EXPECT_EQ(rsm.device().user_program()->program_text(), text);
    rsm.send("RSM_MP_CALL 41");
    rsm.run(10);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
    DeviceSettings settings;
    settings.name = "other";
    settings.choices = choices;
    settings.nv = rsm.device().memory()->nv_image();
    EXPECT_EQ(make_device(rs_m8194h::model(), settings)->user_program()->program_text(), text);
  }
}

TEST(RsM8194hMemory, TakesWhatIsOneOfItsBlocksAlone) {
  for (const Block& block : kBlocks) {
    DeviceSettings settings;
    settings.name = "other";
    NvImage image = OneRsm().device().memory()->nv_image();
    image.blocks[block.kind][block.name] = SharedText(block.text);
    settings.nv = image;
    bool fits = true;
    try {
      (void)make_device(rs_m8194h::model(), settings);
    } catch (const std::runtime_error&) {
      fits = false;
    }
    EXPECT_EQ(fits, block.fits) << block.kind << " " << block.name << ": " << block.text;
  }
}

TEST(RsM8194hMemory, TheFactorysIsEmpty) {
  OneRsm rsm;
  const NvImage image = rsm.device().memory()->nv_image();
  EXPECT_TRUE(image.registers.empty());
  EXPECT_TRUE(image.reals.empty());
  EXPECT_TRUE(image.blocks.empty());
}

/// One of each kind, for a state that contains everything.
std::string_view busy_course(int step) {
  constexpr std::string_view kCommands[] = {"RSM_CONTINUE_MOVE Z 3000",
                                            "RSM_MIX_2D_INITIAL X Y 1 1000 10000 50000",
                                            "RSM_MIX_2D_CONTINUE 0 1 0 0 3000 0",
                                            "RSM_MIX_2D_CONTINUE 0 3 0 500 0 1000",
                                            "RSM_INTFACTOR_ENABLE Z 0 1",
                                            "RSM_ENABLE_INT",
                                            "RSM_SYNC_ACTION Z U 1 3 1 0 0 0 0 0 0 0",
                                            "RSM_SET_COMPARE Z 0 0 500",
                                            "RSM_MP_CALL 1",
                                            "RSM_MIX_2D_CONTINUE 1 1 0 0 -3000 0",
                                            "RSM_DRV_HOLD U"};
  return kCommands[static_cast<std::size_t>(step) % std::size(kCommands)];
}

TEST(RsM8194hMemory, AStateContinuesAsIfNothingHadHappened) {
  const std::string program =
      "MP 1\nRSM_MACRO_FOR 50\nRSM_MACRO_TIMER 7\nRSM_MACRO_VAR_CALCULATE VAR1 + 1 "
      "VAR1\nRSM_MACRO_NEXT\nEND\n"
      "ISR 1\nRSM_MACRO_VAR_CALCULATE VAR2 + 1 VAR2\nEND\n";
  OneRsm rsm({.program = program});
  for (int step = 0; step < 40; ++step) {
    (void)rsm.exception(busy_course(step));
    rsm.run(23);
    OneRsm twin({.program = program});
    const std::vector<std::byte> saved = rsm.device().save_state();
    twin.device().restore_state(saved);
    ASSERT_TRUE(twin.device().same_state(rsm.device()));
    ASSERT_EQ(twin.device().save_state(), saved);
    ASSERT_EQ(twin.device().state_difference(saved, twin.device().save_state()), "");
  }
}

TEST(RsM8194hMemory, WhatIsRestoredIsTheSameAtEachTickBehind) {
  OneRsm plain;
  OneRsm restored;
  for (OneRsm* const one : {&plain, &restored}) {
    one->send({"RSM_SET_SV X 1000", "RSM_FIXED_MOVE X 5000"});
    one->run(40);
  }
  world::restore(restored.world(), world::save(restored.world()));
  for (int tick = 0; tick < 10; ++tick) {
    ASSERT_EQ(plain.device().state_difference(plain.device().save_state(), restored.device().save_state()),
              "")
        << tick;
    plain.run(1);
    restored.run(1);
  }
}

TEST(RsM8194hMemory, AFlippedByteIsRefusedOrCanBeLivedOn) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_TIMER 900\nEND\n"});
  for (int step = 0; step < 11; ++step) {
    (void)rsm.exception(busy_course(step));
    rsm.run(3);
  }
  const std::vector<std::byte> saved = rsm.device().save_state();
  OneRsm twin;
  int lived = 0;
  for (std::size_t at = 0; at < saved.size(); at += 11) {
    std::vector<std::byte> bytes = saved;
    bytes[at] ^= std::byte{1} << (at % 8);
    try {
      twin.device().restore_state(bytes);
    } catch (const StateError&) {
      continue;
    }
    ++lived;
    for (Tick tick = rsm.now() + 1; tick < rsm.now() + 6; ++tick) {
      twin.device().sample_inputs(tick);
      twin.device().run_interpreters(tick);
      twin.device().step_motion(tick);
      twin.device().set_now(tick);
      twin.device().update_outputs(tick);
    }
    (void)twin.ask("04 00 00 00 60");
  }
  EXPECT_GT(lived, 100);
}

TEST(RsM8194hMemory, QuietTicksMayBeSkipped) {
  // The same sequence, with and without an observer of every tick.
  OneRsm stepped;
  OneRsm skipped;
  const auto both = [&](std::string_view command) {
    EXPECT_EQ(stepped.exception(command), skipped.exception(command));
  };
  const std::string_view commands[] = {
      "RSM_SET_SV XYZ 1000",     "RSM_SET_V XYZ 9000",        "RSM_SET_A XYZ 3000", "RSM_FIXED_MOVE X 70000",
      "RSM_FIXED_MOVE X -20000", "RSM_CONTINUE_MOVE Y -5000", "RSM_STOP_SLOWLY Y",  "RSM_SET_LP X 4"};
  for (const std::string_view command : commands) {
    both(command);
    for (int i = 0; i < 1700; ++i) stepped.run(1);
    skipped.run(1700);
    ASSERT_EQ(stepped.device().state_difference(stepped.device().save_state(), skipped.device().save_state()),
              "")
        << command;
  }
  stepped.run(10000);
  skipped.run(10000);
  EXPECT_EQ(stepped.positions(), skipped.positions());
}

/// A command of a random sequence: most of those that move, stop, hold and wait.
std::string random_command(std::uint32_t& seed) {
  const auto draw = [&](std::uint32_t max) {
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) % max;
  };
  constexpr const char* kMasks[] = {"X", "Y", "Z", "U", "XY", "XYZU", "YU"};
  const std::string axes = kMasks[draw(7)];
  const std::string distance = std::to_string(static_cast<int>(draw(20000)) - 10000);
  switch (draw(24)) {
    case 0: return "RSM_FIXED_MOVE " + axes + " " + distance;
    case 1: return "RSM_ABS_FIXED_MOVE " + axes + " " + distance;
    case 2: return "RSM_CONTINUE_MOVE " + axes + " " + distance;
    case 3: return "RSM_STOP_SLOWLY " + axes;
    case 4: return "RSM_STOP_SUDDENLY " + axes;
    case 5: return "RSM_CLEAR_STOP " + axes;
    case 6: return "RSM_DRV_HOLD " + axes;
    case 7: return "RSM_DRV_START " + axes;
    case 8: return "RSM_STOP_WAIT " + axes;
    case 9: return "RSM_LINE_2D " + distance + " 3000";
    case 10: return "RSM_ARC_CW 0 " + std::to_string(draw(4000) + 1) + " 0 0";
    case 11: return "RSM_SET_LP " + axes + " " + distance;
    case 12: return "RSM_SET_V " + axes + " " + std::to_string(draw(30000));
    case 13: return "RSM_SET_COMPARE " + axes + " 0 0 " + distance;
    case 14: return "RSM_MP_CALL 1";
    case 15: return "RSM_CLEAR_VSTOP";
    case 16: return "RSM_VSTOP_SLOWLY";
    case 17: return "RSM_EMERGENCY_STOP 1";
    case 18:
    case 19: return "RSM_CLEAR_EMERGENCY_STOP";
    case 20: return "RSM_HOME_START " + axes;
    case 21: return "RSM_MP_TERMINATE";
    case 22: return "RSM_CLEAR_CARD_BUFFER";
    default: return "RSM_SET_PULSE " + axes + " " + distance;
  }
}

TEST(RsM8194hMemory, RandomCoursesAreTheSameSteppedOrFastForwarded) {
  const std::string program =
      "MP 1\nRSM_MACRO_FIXED_MOVE X 500\nRSM_MACRO_TIMER 40\nRSM_MACRO_STOP_WAIT XY\nEND\n"
      "ISR 1\nRSM_MACRO_FIXED_MOVE U 77\nEND\n";
  for (std::uint32_t first = 1; first <= 40; ++first) {
    std::uint32_t seed = first;
    std::string course;
    OneRsm stepped({.program = program});
    OneRsm skipped({.program = program});
    for (OneRsm* rsm : {&stepped, &skipped}) {
      rsm->send({"RSM_SET_SV XYZU 1000", "RSM_SET_A XYZU 90000", "RSM_AXIS_ASSIGN X Y 0", "RSM_SET_VV 8000",
                 "RSM_ENABLE_INT", "RSM_SYNC_ACTION Z U 1 3 1 0 0 1 0 0 0 1"});
    }
    for (int i = 0; i < 40; ++i) {
      const std::string command = random_command(seed);
      course += command + "\n";
      ASSERT_EQ(stepped.exception(command), skipped.exception(command)) << course;
      const Tick ticks = static_cast<Tick>(seed >> 16) % 400 + 1;
      for (Tick tick = 0; tick < ticks; ++tick) stepped.run(1);
      skipped.run(ticks);
      ASSERT_EQ(
          stepped.device().state_difference(stepped.device().save_state(), skipped.device().save_state()), "")
          << course << first;
    }
  }
}

}  // namespace rs_m8194h_memory_test
}  // namespace understudy::emulator::models::rs_m8194h
