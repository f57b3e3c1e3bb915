// Choices where they interact with the rest of the device; docs/fidelity/proofs/rs-m8194h/ shows most of
// them.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_choices_test {

/// X moves without end; a drive, commands of two blocks and a stop wait for it.
void fill(OneRsm& rsm, int pairs) {
  rsm.send({"RSM_SET_V X 1000", "RSM_CONTINUE_MOVE X 1000"});
  rsm.run(10);
  rsm.send("RSM_FIXED_MOVE X 1");
  for (int i = 0; i < pairs; ++i) rsm.send("RSM_LINE_2D_INITIAL X Y 100 1000 10000");
}

TEST(RsM8194hChoices, AFifoOfOneBlockEachIsFilledAndRestored) {
  const GivenRsm given{.choices = {{"fifo_cost", "one_each"}, {"stops_bypass_fifo", "wait_like_others"}}};
  OneRsm rsm(given);
  fill(rsm, 28);
  rsm.send("RSM_STOP_SUDDENLY X");
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 0);
  EXPECT_EQ(rsm.exception("RSM_STOP_SUDDENLY X"), 6);
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 0xC1);
  OneRsm twin(given);
  twin.device().restore_state(rsm.device().save_state());
  EXPECT_TRUE(twin.device().same_state(rsm.device()));
  EXPECT_EQ(twin.get("FREE_BUFFER_SIZE"), 0);
  EXPECT_EQ(twin.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hChoices, AFifoFilledAsMarkedHoldsHalfAsMany) {
  OneRsm rsm;
  fill(rsm, 14);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 1);
  EXPECT_EQ(rsm.exception("RSM_LINE_2D_INITIAL X Y 100 1000 10000"), 6);
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run(10);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hChoices, AStopThatWaitsIsCarriedOutInItsTurn) {
  OneRsm rsm({.choices = {{"stops_bypass_fifo", "wait_like_others"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X 100",
            "RSM_STOP_SUDDENLY X", "RSM_FIXED_MOVE X 100"});
  rsm.run_to_rest();
  // The second drive has just started when it is stopped; the third one finds X locked.
  EXPECT_EQ(rsm.get("LP_X"), 100);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x100);
}

TEST(RsM8194hChoices, AHeldFifoContinuesBehindADownload) {
  OneRsm rsm({.choices = {{"fifo_during_download", "held"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X 100",
            "RSM_MP_CREATE 1"});
  rsm.run(1000);
  EXPECT_EQ(rsm.get("LP_X"), 100);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29);
  OneRsm twin({.choices = {{"fifo_during_download", "held"}}});
  twin.device().restore_state(rsm.device().save_state());
  twin.send({"RSM_MACRO_SET_V X 1", "RSM_MACRO_MP_CLOSE"});
  twin.run(200);
  EXPECT_EQ(twin.get("LP_X"), 200);
  EXPECT_EQ(twin.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hChoices, AnEmergencyInputCanBeActiveWhileOpen) {
  OneRsm rsm({.choices = {{"emg_level", "while_off"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100"});
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x20);
  EXPECT_EQ(rsm.get("DI_ALL_X") & 8, 8);
  rsm.input(kEmergencyPin, true);
  rsm.run(5);
  rsm.send("RSM_FIXED_MOVE X 100");
  rsm.run(50);
  EXPECT_GT(rsm.get("LP_X"), 0);
  const Value before = rsm.get("LP_X");
  rsm.input(kEmergencyPin, false);
  rsm.run(200);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_LT(rsm.get("LP_X"), before + 5);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x20);
}

/// ISR1 appends a 1 to VAR1, ISR2 a 2.
const char* const kTellers = R"(
ISR 1
  RSM_MACRO_VAR_CALCULATE VAR1 * 10 VAR1
  RSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1
END
ISR 2
  RSM_MACRO_VAR_CALCULATE VAR1 * 10 VAR1
  RSM_MACRO_VAR_CALCULATE VAR1 + 2 VAR1
END
)";

TEST(RsM8194hChoices, IsrsComeInTheOrderOfTheirEnabling) {
  struct Case {
    std::vector<const char*> enabling;
    Value order;
  };
  // D-END of X through a factor, and through an action of U that it triggers.
  const char* const kFactor = "RSM_INTFACTOR_ENABLE X 7 1";
  const char* const kAction = "RSM_SYNC_ACTION X U 0x20 0 0 0 0 1 0 0 0 2";
  const char* const kClear = "RSM_CLEAR_SYNC_ACTION X";
  const Case kCases[] = {
      {{kFactor, kAction}, 12},
      {{kAction, kFactor}, 21},
      {{kAction, kFactor, kAction}, 12},
      {{kAction, kFactor, kClear, kAction}, 12},
      {{kFactor, kAction, "RSM_INTFACTOR_DISABLE X 10", kFactor}, 21},
  };
  for (const Case& each : kCases) {
    OneRsm rsm({.program = kTellers, .choices = {{"isr_order", "by_order_of_enabling"}}});
    rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_ENABLE_INT"});
    for (const char* const command : each.enabling) rsm.send(command);
    OneRsm twin({.program = kTellers, .choices = {{"isr_order", "by_order_of_enabling"}}});
    twin.device().restore_state(rsm.device().save_state());
    twin.send("RSM_FIXED_MOVE X 10");
    twin.run(30);
    EXPECT_EQ(twin.get("VAR1"), each.order);
  }
}

TEST(RsM8194hChoices, EightLevelsOfCallsAreRestored) {
  const GivenRsm given{.program =
                           "MP 1\n  RSM_MACRO_MP_CALL 1\n  RSM_MACRO_TIMER 20\n"
                           "  RSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1\nEND\n",
                       .choices = {{"call_levels", "of_calls_alone"}}};
  OneRsm rsm(given);
  rsm.set("CALL_MP", 1);
  rsm.run(10);
  OneRsm twin(given);
  twin.device().restore_state(rsm.device().save_state());
  EXPECT_TRUE(twin.device().same_state(rsm.device()));
  twin.run(300);
  EXPECT_EQ(twin.get("VAR1"), 8);
}

TEST(RsM8194hChoices, ParametersMayComeInParts) {
  const GivenRsm given{.choices = {{"window_parts", "kept_for_the_command"}}};
  OneRsm rsm(given);
  // FIXED_MOVE X 300: its axis alone, its pulses alone, its code.
  EXPECT_EQ(rsm.ask("10 1F42 0002 04 0000 012C"), "10 1F 42 00 02");
  EXPECT_EQ(rsm.ask("10 1F41 0001 02 0001"), "10 1F 41 00 01");
  OneRsm twin(given);
  twin.device().restore_state(rsm.device().save_state());
  EXPECT_EQ(twin.ask("10 1F40 0001 02 0A4E"), "10 1F 40 00 01");
  EXPECT_EQ(twin.get("DRIVING_AXIS"), 1);
  twin.run_to_rest();
  EXPECT_EQ(twin.get("LP_X"), 300);
  // Beyond the window's end, and with too many registers, it is refused as usual.
  EXPECT_EQ(twin.ask("10 1FA4 0002 04 0000 0000"), "90 02");
  EXPECT_EQ(twin.ask("10 1F40 0005 0A 0A4E 0001 0000 0001 0000"), "90 03");
  // The same for a line of a macro.
  twin.send("RSM_MP_CREATE 1");
  EXPECT_EQ(twin.ask("10 1F41 0004 08 7FFF 0005 0000 0007"), "10 1F 41 00 04");
  EXPECT_EQ(twin.ask("10 1F40 0001 02 0CD2"), "10 1F 40 00 01");
  twin.send("RSM_MACRO_MP_CLOSE");
  twin.set("CALL_MP", 1);
  twin.run(5);
  EXPECT_EQ(twin.get("VAR5"), 7);
}

TEST(RsM8194hChoices, KeptVariablesThatACardResetClearsStayCleared) {
  OneRsm rsm({.choices = {{"variables_kept", "kept"}}});
  rsm.set("VAR5", -5);
  rsm.set("bVAR5", 5);
  rsm.send({"RSM_RESET_CARD", "RSM_WRITE_VAR VAR6 6"});
  rsm.run(1);
  rsm.device().switch_power(false);
  rsm.device().switch_power(true);
  EXPECT_EQ(rsm.get("VAR5"), 0);
  EXPECT_EQ(rsm.get("bVAR5"), 0);
  EXPECT_EQ(rsm.get("VAR6"), 6);
}

TEST(RsM8194hChoices, ErrorsOfADownloadThatShowAtCloseAreKept) {
  const GivenRsm given{.program = "MP 1\n  RSM_MACRO_SET_VAR VAR1 7\nEND\n",
                       .choices = {{"structure_faults", "at_close"}}};
  OneRsm rsm(given);
  rsm.send({"RSM_MP_CREATE 1", "RSM_MACRO_SET_VAR VAR1 8", "RSM_MACRO_ELSE"});
  // Also for an undefined command, which is not the first error.
  EXPECT_EQ(rsm.ask("10 1F40 0001 02 0C00"), "10 1F 40 00 01");
  // A wrong parameter is not an error of the download.
  EXPECT_EQ(rsm.ask("10 1F40 0002 04 0CCB 0000"), "90 03");
  OneRsm twin(given);
  twin.device().restore_state(rsm.device().save_state());
  EXPECT_EQ(twin.exception("RSM_MACRO_MP_CLOSE"), 3);
  EXPECT_EQ(twin.get("DOWNLOAD_ERROR"), 3);
  EXPECT_EQ(twin.get("DOWNLOAD_LINE"), 1);
  EXPECT_EQ(twin.get("RSM_STATE"), 0);
  twin.set("CALL_MP", 1);
  twin.run(5);
  EXPECT_EQ(twin.get("VAR1"), 7);
  // An undefined command alone, followed by a good download.
  twin.send("RSM_MP_CREATE 1");
  EXPECT_EQ(twin.ask("10 1F40 0001 02 0C00"), "10 1F 40 00 01");
  EXPECT_EQ(twin.exception("RSM_MACRO_MP_CLOSE"), 3);
  EXPECT_EQ(twin.get("DOWNLOAD_ERROR"), 0x0F);
  twin.send({"RSM_MP_CREATE 1", "RSM_MACRO_SET_VAR VAR1 8", "RSM_MACRO_MP_CLOSE"});
  EXPECT_EQ(twin.get("DOWNLOAD_ERROR"), 0);
}

TEST(RsM8194hChoices, AnErrorInATextIsReportedWithItsLine) {
  const GivenRsm given{.choices = {{"structure_faults", "at_close"}}};
  OneRsm rsm(given);
  try {
    rsm.device().user_program()->load_program(
        "MP 1\n  RSM_MACRO_SET_VAR VAR1 1\n  RSM_MACRO_ELSE\n  RSM_MACRO_EXIT_MACRO\nEND\n");
    ADD_FAILURE() << "was taken";
  } catch (const ProgramError& error) {
    EXPECT_EQ(error.mistakes.size(), 1U);
    EXPECT_EQ(error.first().line, 3);
  }
}

TEST(RsM8194hChoices, CallsOfMissingMacrosByMacrosAreErrors) {
  OneRsm rsm({.program =
                  "MP 1\n  RSM_MACRO_MP_CALL 9\n  RSM_MACRO_SET_VAR VAR1 7\n  RSM_MACRO_MP_CALL 2\nEND\n"
                  "MP 2\n  RSM_MACRO_SET_VAR VAR2 8\nEND\n",
              .choices = {{"missing_macro", "execution_error"}}});
  rsm.set("CALL_MP", 1);
  rsm.run(5);
  EXPECT_EQ(rsm.get("VAR1"), 7);
  EXPECT_EQ(rsm.get("VAR2"), 8);
  EXPECT_EQ(rsm.get("EXECUTION_MP"), 1);
  EXPECT_EQ(rsm.get("EXECUTION_LINE"), 0);
  EXPECT_EQ(rsm.get("EXECUTION_CMD"), 0x0ACB);
  EXPECT_EQ(rsm.get("EXECUTION_ERROR"), 0x0F);
  EXPECT_EQ(rsm.input_word(74), 1);  // MP1 is completed
  // An interrupt whose ISR is missing calls nothing.
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_ENABLE_INT", "RSM_INTFACTOR_ENABLE X 7 3",
            "RSM_FIXED_MOVE X 10"});
  rsm.run(50);
  EXPECT_EQ(rsm.get("EXECUTION_ISR"), 0);
}

TEST(RsM8194hChoices, HoldsAtOnceOvertakeWhatWaits) {
  OneRsm rsm({.choices = {{"holds_bypass_fifo", "at_once"}}});
  rsm.send({"RSM_SET_SV XYZU 1000", "RSM_SET_V XYZU 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X 100",
            "RSM_FIXED_MOVE Y 100", "RSM_DRV_HOLD Y"});
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 28);  // two drives wait, the hold does not
  rsm.run(1000);
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{200, 0, 0, 0}));
  rsm.send("RSM_DRV_START Y");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_Y"), 100);
}

TEST(RsM8194hChoices, LatchesOutliveACardResetLikeTheCounters) {
  for (const bool are_kept : {false, true}) {
    OneRsm rsm({.choices = {{"reset_card_counters", are_kept ? "kept" : "zero"}}});
    rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_SET_LP X 500",
              "RSM_SYNC_ACTION X X 32 0 1 0 0 0 0 0 0 0", "RSM_FIXED_MOVE X 100"});
    rsm.run_to_rest();
    rsm.run(2);
    EXPECT_EQ(rsm.get("LATCH_X"), 600);
    rsm.send("RSM_RESET_CARD");
    rsm.run(2);
    EXPECT_EQ(rsm.get("LATCH_X"), are_kept ? 600 : 0);
    EXPECT_EQ(rsm.get("LP_X"), are_kept ? 600 : 0);
  }
}

TEST(RsM8194hChoices, ACardResetThatKeepsSettingsKeepsTheirOrder) {
  const auto counts = [](int number) {
    return "ISR " + std::to_string(number) +
           "\nRSM_MACRO_VAR_CALCULATE VAR0 + 1 VAR0\nRSM_MACRO_SET_VAR VAR" + std::to_string(number) +
           " VAR0\nEND\n";
  };
  OneRsm rsm({.program = counts(1) + counts(2),
              .choices = {{"reset_card_settings", "kept"}, {"isr_order", "by_order_of_enabling"}}});
  rsm.send({"RSM_SET_SV XY 1000", "RSM_SET_V XY 1000", "RSM_ENABLE_INT", "RSM_INTFACTOR_ENABLE Y 7 2",
            "RSM_INTFACTOR_ENABLE X 7 1", "RSM_RESET_CARD", "RSM_FIXED_MOVE XY 10"});
  rsm.run(50);
  EXPECT_EQ(rsm.get("VAR2"), 1);
  EXPECT_EQ(rsm.get("VAR1"), 2);
}

TEST(RsM8194hChoices, ACardResetLeavesAWordOrderThatIsKept) {
  for (const bool is_kept : {false, true}) {
    OneRsm rsm({.choices = {{"reset_card_own_words", "as_at_power_on"},
                            {"word_order_kept", is_kept ? "kept" : "0"}}});
    rsm.set("WORD_ORDER", 1);
    rsm.send("RSM_RESET_CARD");
    EXPECT_EQ(rsm.get("WORD_ORDER"), is_kept ? 1 : 0);
  }
}

TEST(RsM8194hChoices, VariablesThatHaveEndsTakeThem) {
  OneRsm rsm({.choices = {{"variable_range", "exception_3"}}});
  const std::pair<const char*, bool> kCases[] = {{"88 CA 6C 00", true},    // -2,000,000,000
                                                 {"88 CA 6B FF", false},   // one less
                                                 {"77 35 94 00", true},    // 2,000,000,000
                                                 {"77 35 94 01", false}};  // one more
  for (const auto& [value, is_good] : kCases) {
    // VAR1 and VAR2; a fault in one leaves the other unchanged.
    rsm.set("VAR1", 7);
    const std::string sent = std::string(" 00 04 08 00 00 00 05 ") + value;
    EXPECT_EQ(rsm.ask("10 01 2E" + sent), is_good ? "10 01 2E 00 04" : "90 03") << value;
    EXPECT_EQ(rsm.get("VAR1"), is_good ? 5 : 7) << value;
  }
}

TEST(RsM8194hChoices, WhatHasNoSpeedDoesNotGoHomeEither) {
  OneRsm rsm({.choices = {{"power_on_values", "0_and_no_drive"}}});
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_HOME_MODE X 1 1 0 0 0", "RSM_HOME_START X"});
  rsm.run(5);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  rsm.send({"RSM_SET_HV X 500", "RSM_HOME_START X"});
  rsm.run(5);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hChoices, PulsesThatOutHasGivenAreCountedBehindACardReset) {
  OneRsm rsm;
  rsm.send(
      {"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_LINE_SCAN X 0 0 4 99", "RSM_LINE_SCAN_START X 0 1000"});
  rsm.run_to_rest();
  const std::int64_t given = rsm.device().terminals()->output_pulses(kFirstOut);
  EXPECT_GT(given, 5);
  rsm.send("RSM_RESET_CARD");
  rsm.run(5);
  EXPECT_EQ(rsm.device().terminals()->output_pulses(kFirstOut), given);
}

}  // namespace rs_m8194h_choices_test
}  // namespace understudy::emulator::models::rs_m8194h
