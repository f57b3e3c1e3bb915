// Simple2-R3: what its manual leaves open, and what we chose. docs/fidelity/simple2-r3.md is made from
// these rows; a bench overrides one with `choices: { ID: OPTION }`.
#pragma once

#include "emulator/choices.h"

namespace understudy::emulator::simple2_r3 {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

inline constexpr ChoiceRow kChoices[] = {
    // --- the wire ---
    {"station_0_request", "RS485", "a request to address 0 while the rotary switch is 1 to 15",
     "broadcast|ignored", kLikely, "Modbus broadcast: writes are carried out, nothing is answered"},
    {"switch_0_broadcast", "RS485", "a request to address 0 while the rotary switch is 0", "answered|silent",
     kFollows,
     "at switch 0 every station number is received and processed; the reply carries the request's address"},
    {"exceptions", "RS485", "which exceptions there are", "modbus_v1_1b3", kLikely,
     "the manual refers to the Modbus application protocol and names no exception"},
    {"end_time_counts", "RS485", "from where the END time is counted", "end_of_last_character", kProposal,
     "the tolerant reading: idle time after the stop bit"},
    {"reply_delay", "RS485", "when a reply begins", "after_end_time", kFollows,
     "the controller knows that a request is over only when the END time has passed"},
    {"switches_sampled", "RS485", "when the DIP switches are read", "at_power_up|always", kProposal,
     "not said"},
    // --- registers ---
    {"read_of_write_only", "位址列表", "what a register that can only be written reads as", "zero", kProposal,
     "operator panels read 0x1000 to 0x101D as one block, which has six such words inside"},
    {"speed_zero", "運動相關", "whether speed 0 may be written although the printed minimum is 1", "accepted",
     kFollows, "the factory value is 0 and appendix A says what it does"},
    {"encsync_maximum", "系統參數相關", "the printed maximum 2^16 of EncSync_NUM and _DEN", "65535", kFollows,
     "a 16-bit register cannot hold more"},
    {"half_writes", "位址列表", "a write to one half of a 32-bit register", "stored_unjudged", kProposal,
     "the half alone cannot be judged; the value is clamped where it is used"},
    {"version_encoding", "狀態相關", "how Version shows the firmware", "hundredths", kProposal,
     "1.52 reads 152"},
    {"trigger_read_back", "運動相關", "what Move_INC, Move_ABS read as", "one_while_in_progress", kFollows,
     "appendix A has the command cleared at once for distance 0, so it is there until then otherwise"},
    {"factory_reset_of_volatile", "附錄 C", "what Factory_Reset does to what is not persistent",
     "reset_too|kept", kProposal,
     "all parameters but 0xFF02 to 0xFF05 go back to the factory's; coordinates and encoders stay"},
    // --- inputs and outputs ---
    {"output_read_back", "輸入輸出相關", "what DOUT_n reads while its pin has a special function",
     "level_on_pin|written_level", kProposal,
     "a write is remembered and comes back when the function is taken away"},
    {"unassigned_input_status", "狀態相關", "alarm, Ready and limit bits of STATUS without an assigned input",
     "zero", kProposal, "nothing is connected that could say so"},
    {"aclr_output", "運動相關", "how long the ACLR output is on", "200ms", kFollows,
     "the register returns to 0 after 200 ms; the output follows it"},
    {"aclr_again", "運動相關", "a second ACLR within the 200 ms", "restarts|ignored", kProposal, "not said"},
    {"analog_scaling", "附錄 C", "Analog_A, Analog_B from ADC and its calibration",
     "line_through_both_points", kProposal,
     "200 at 1 V and 2000 at 10 V, rounded towards 200; 0 if both points are one"},
    {"adc_width", "附錄 C", "what ADC_A, ADC_B read", "12_bits_400_a_volt", kProposal,
     "not said; the factory's calibration is 400 and 4000, so that an uncalibrated input is right"},
    // --- memory ---
    {"eeprom_time", "狀態相關", "how long EEPROM_Writing is 1", "5ms_a_word|1ms_a_word", kProposal,
     "not said; one quantity after the other, and a value that is there already is not written again"},
    {"eeprom_erasure", "程式控制", "how long Erase_ALL and Factory_Reset write", "500ms", kProposal,
     "not said; one job in place of what waits"},
    {"power_cut", "狀態相關", "what a power cut leaves of what is being written", "old_value", kProposal,
     "not said; both halves of a 32-bit register are written as one"},
    {"password_kept", "附錄 C", "whether NEW_PWD outlives the power", "yes|no", kProposal,
     "no star is printed, but a lock that opens by power-off is useless"},
    {"first_password", "附錄 C", "the password from the factory", "0", kProposal,
     "PWD_Input is 0 at power-up, so the program is open until somebody sets one"},
    {"lock_judged", "附錄 C", "when PROG_UNLOCK is judged", "at_power_up_and_input|always", kProposal,
     "so that a new password does not shut out who sets it"},
    {"locked_writes", "附錄 C", "writes to program memory while it is locked", "allowed|ignored", kProposal,
     "only reading is said to be void"},
    // --- motion ---
    {"appendix_a", "附錄 A", "the top speed of a short move, printed as P/(TA+TD)/2", "consistent", kFollows,
     "2P/(TA+TD): the worked example and the line for TC take the area as (TA+TD)*R/2; the printed form "
     "misses the target"},
    {"servo_at_power_up", "運動相關", "SVON or SVOFF after power-up", "off|on", kProposal,
     "pulses come only after SVON; the coordinate example says nothing of it"},
    {"command_while_servo_off", "程式指令列表", "a motion command while SVOFF", "dropped", kFollows,
     "pulses are inhibited; the trigger reads 0"},
    {"command_while_moving", "附錄 A", "a new move while one is in progress", "replaces", kProposal,
     "the old one is dropped where it is, the new one starts from standstill"},
    {"stop", "運動相關", "how STOP stops", "at_once", kFollows,
     "the instructions say forcibly, the registers say stop; one behaviour for both"},
    {"pulse_rate_cap", "附錄 B", "a speed above 100 kHz", "top_speed_lowered", kProposal,
     "the limit is the manual's, the way to keep it is ours"},
    {"limit_reaction", "輸入輸出功能指配相關", "what a limit switch does", "stops_that_direction|none",
     kFollows, "the cover promises limit protection; motion away from the switch stays possible"},
    {"alarm_reaction", "狀態相關", "what an alarm does to motion", "stops|none", kProposal,
     "commands are dropped while it lasts, the servo stays on"},
    {"alarm_latch", "狀態相關", "whether the alarm bit is latched", "level", kProposal,
     "ACLR only pulses its output"},
    {"ready_gates", "狀態相關", "whether Ready gates motion", "no", kProposal, "not said"},
    {"coordinate_overflow", "編碼器，座標，類比輸入相關", "a coordinate beyond 32 bits", "wraps", kProposal,
     "not said"},
    {"preset_while_moving", "編碼器，座標，類比輸入相關", "a coordinate written during an absolute move",
     "keeps_remaining_pulses", kProposal, "the move was planned as a number of pulses"},
    // --- homing and the other modes ---
    {"homing_sequence", "運動相關", "how the home switch is searched", "edge_met_in_direction", kProposal,
     "the manual gives speed, times and the first direction only; the reference is always the edge that is "
     "met "
     "in that direction"},
    {"home_coordinate", "運動相關", "the coordinate when home is found", "zero|kept", kProposal,
     "not said; the zeroing instructions exist beside it"},
    {"home_bit", "狀態相關", "when the home bit goes out", "homing_begins", kProposal,
     "also at power-up and by a factory reset"},
    {"velocity_unit", "系統參數相關", "the unit of VelMode_ACC, printed 2mRPM/s",
     "literal|two_rpm_per_second", kProposal,
     "the literal unit makes the steepest ramp 65.5 RPM/s; a factor of 1000 may have been lost"},
    {"velocity_commit", "系統參數相關", "a lone write to DirectmRPM_L",
     "waits_for_the_high_word|takes_effect", kProposal,
     "the note that it takes effect at once stands in the row of the high word"},
    {"mode_after_stop", "運動相關", "the mode after STOP or SVOFF", "position", kProposal,
     "STOP is documented to leave sync mode; the others likewise"},
    {"pwm", "運動相關", "what DirectPWM needs and counts", "servo_on_no_coordinate", kProposal, "not said"},
    {"sync_ratio", "系統參數相關", "what EncSync_NUM / _DEN is", "pulses_per_encoder_count", kProposal,
     "not said"},
    {"sync_slope", "系統參數相關", "the unit of SyncSlope", "rpm_each_5ms", kProposal, "not printed"},
    {"sync_lost_pulses", "系統參數相關", "pulses lost to SyncRPM or SyncSlope", "forgotten", kProposal,
     "the axis follows speed; it does not catch up"},
    {"encoder_speed", "編碼器，座標，類比輸入相關", "how ENCx_RPM is measured", "window_of_100ms", kProposal,
     "not said"},
    // --- programs ---
    {"wait_move_b_139", "程式指令列表", "Wait_Move_B up to 1.39", "as_move_inc_b_wait|waits", kFollows,
     "the text says both; the remark exists for B alone, so it is taken for a defect"},
    {"loop_count", "程式指令列表", "a Loop of n", "passes|further_passes", kProposal,
     "the sentence can be read both ways"},
    {"loop_left", "程式指令列表", "a Loop left by a jump or a skip", "forgotten|remembered", kProposal,
     "not said"},
    {"loop_nesting", "程式指令列表", "when a Loop inside a Loop ends the program",
     "when_met|when_outer_starts", kProposal, "not said"},
    {"unknown_command", "程式指令列表", "a command that the list does not have", "does_nothing|ends",
     kProposal, "not said"},
    {"after_last_line", "程式控制", "after line 255", "ends|goes_on_at_0", kProposal, "not said"},
    {"delay_counts", "程式指令列表", "what a delay is counted to", "to_next_line|before_next_slot", kProposal,
     "not said"},
    {"same_flag_twice", "程式指令列表", "several lines with one flag", "last_line", kFollows,
     "the last one set counts, read by line number"},
    {"arithmetic", "程式指令列表", "overflow and division", "wraps_truncates_zero_for_zero", kProposal,
     "32 bits; by zero the result is 0 for all four divisions"},
    {"timer_unit", "程式應用相關", "the unit of the timers", "1ms", kProposal, "not said"},
    {"program_end", "程式控制", "what goes on when the program ends", "motion_and_timers", kProposal,
     "not said"},
    {"old_firmware_direction", "1.40 以前", "DIR_Polarity up to 1.40", "coordinate_counts_physical_sense",
     kFollows, "absolute moves go wrong and incremental ones do not, which this explains"},
};

inline constexpr std::size_t kStation0Request = choice_number(kChoices, "station_0_request");
inline constexpr std::size_t kSwitch0Broadcast = choice_number(kChoices, "switch_0_broadcast");
inline constexpr std::size_t kFactoryResetVolatile = choice_number(kChoices, "factory_reset_of_volatile");
inline constexpr std::size_t kOutputReadBack = choice_number(kChoices, "output_read_back");
inline constexpr std::size_t kAclrAgain = choice_number(kChoices, "aclr_again");
inline constexpr std::size_t kServoAtPowerUp = choice_number(kChoices, "servo_at_power_up");
inline constexpr std::size_t kLimitReaction = choice_number(kChoices, "limit_reaction");
inline constexpr std::size_t kAlarmReaction = choice_number(kChoices, "alarm_reaction");
inline constexpr std::size_t kHomeCoordinate = choice_number(kChoices, "home_coordinate");
inline constexpr std::size_t kVelocityUnit = choice_number(kChoices, "velocity_unit");
inline constexpr std::size_t kVelocityCommit = choice_number(kChoices, "velocity_commit");
inline constexpr std::size_t kSwitchesSampled = choice_number(kChoices, "switches_sampled");
inline constexpr std::size_t kEepromTime = choice_number(kChoices, "eeprom_time");
inline constexpr std::size_t kPasswordKept = choice_number(kChoices, "password_kept");
inline constexpr std::size_t kLockJudged = choice_number(kChoices, "lock_judged");
inline constexpr std::size_t kLockedWrites = choice_number(kChoices, "locked_writes");
inline constexpr std::size_t kWaitMoveB139 = choice_number(kChoices, "wait_move_b_139");
inline constexpr std::size_t kLoopCount = choice_number(kChoices, "loop_count");
inline constexpr std::size_t kLoopLeft = choice_number(kChoices, "loop_left");
inline constexpr std::size_t kLoopNesting = choice_number(kChoices, "loop_nesting");
inline constexpr std::size_t kUnknownCommand = choice_number(kChoices, "unknown_command");
inline constexpr std::size_t kAfterLastLine = choice_number(kChoices, "after_last_line");
inline constexpr std::size_t kDelayCounts = choice_number(kChoices, "delay_counts");

}  // namespace understudy::emulator::simple2_r3
