// Simple2-R3: the options of choices.h as the code asks for them, `device.chose(kAclrIgnored)`. A name or an
// option that the rows do not have is a compile error. Our option, the first of each row, does not need a
// name if the code has an else for it.
#pragma once

#include "emulator/models/simple2_r3/choices.h"

namespace understudy::emulator::models::simple2_r3 {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

// --- the wire ---
inline constexpr Option kStation0Ignored = option("station_0_request", "ignored");
inline constexpr Option kSwitch0Silent = option("switch_0_broadcast", "silent");
inline constexpr Option kRefusalsNotAnswered = option("exceptions", "no_answer");
inline constexpr Option kEffectsInTurn = option("request_effects", "each_in_its_turn");
inline constexpr Option kBoot100ms = option("boot_time", "100ms");
inline constexpr Option kBoot1s = option("boot_time", "1s");
inline constexpr Option kSwitchesAlwaysRead = option("switches_sampled", "always");
// --- registers ---
inline constexpr Option kUnmappedReadsZero = option("unmapped_addresses", "zero_and_ignored");
inline constexpr Option kWriteToReadOnlyIgnored = option("write_to_read_only", "ignored");
inline constexpr Option kWriteClamped = option("write_out_of_range", "clamped");
inline constexpr Option kReadOfWriteOnlyRefused = option("read_of_write_only", "exception_02");
inline constexpr Option kStoredUpToBadWord = option("request_with_bad_value", "those_before_stored");
inline constexpr Option kTriggersByThemselves = option("triggers_shown", "those_written_there");
inline constexpr Option kHalvesJudged = option("half_writes", "judged_with_other_half");
inline constexpr Option kVersionBcd = option("version_encoding", "bcd");
inline constexpr Option kTriggersReadZero = option("trigger_read_back", "zero");
inline constexpr Option kCommandValuesNotShown = option("command_values", "not_shown");
inline constexpr Option kSetMoveCopied = option("set_move", "copied");
inline constexpr Option kFactoryValuesLeast = option("factory_values", "least");
inline constexpr Option kResetKeepsVolatile = option("factory_reset_of_volatile", "kept");
inline constexpr Option kResetLeavesMotion = option("factory_reset_motion", "goes_on");
// --- inputs and outputs ---
inline constexpr Option kAssignedAtPowerUp = option("assignment_effect", "at_power_up");
inline constexpr Option kWriteUnderFunctionIgnored = option("write_under_function", "ignored");
inline constexpr Option kOutputReadsWritten = option("output_read_back", "written_level");
inline constexpr Option kStatusShowsPin = option("unassigned_input_status", "level_of_pin");
inline constexpr Option kAclrAgainIgnored = option("aclr_again", "ignored");
inline constexpr Option kAnalogThroughZero = option("analog_scaling", "line_through_zero");
inline constexpr Option kAdc10Bits = option("adc_width", "10_bits_100_a_volt");
// --- memory ---
inline constexpr Option kEeprom1msAWord = option("eeprom_time", "1ms_a_word");
inline constexpr Option kSameValueSaved = option("eeprom_same_value", "saved_again");
inline constexpr Option kErasure100ms = option("eeprom_erasure", "100ms");
inline constexpr Option kNotSavedWhileSaving = option("write_while_saving", "not_saved");
inline constexpr Option kPowerCutLeavesNew = option("power_cut", "new_value");
inline constexpr Option kPasswordKept = option("password_kept", "yes");
inline constexpr Option kFirstPassword65535 = option("first_password", "65535");
inline constexpr Option kPasswordReadsZero = option("password_read_back", "zero");
inline constexpr Option kLockAlwaysJudged = option("lock_judged", "always");
inline constexpr Option kLockedWritesIgnored = option("locked_writes", "ignored");
inline constexpr Option kLockedResetRefused = option("locked_reset", "ignored");
inline constexpr Option kLockedStartIgnored = option("locked_start", "ignored");
// --- motion ---
inline constexpr Option kServoOnAtPowerUp = option("servo_at_power_up", "on");
inline constexpr Option kKeptUntilServoOn = option("command_while_servo_off", "kept_until_servo_on");
inline constexpr Option kMoveInOtherModeIgnored = option("move_in_other_mode", "ignored");
inline constexpr Option kMoveFromTheSpeed = option("move_in_other_mode", "goes_on_from_the_speed");
inline constexpr Option kStopSlowsDown = option("stop", "slows_down");
inline constexpr Option kAfterLimitResumes = option("after_limit", "resumes");
inline constexpr Option kIntoLimitDropped = option("command_into_limit", "dropped");
inline constexpr Option kLimitStopsPwm = option("pwm_at_limit", "stops");
inline constexpr Option kAfterAlarmResumes = option("after_alarm", "resumes");
inline constexpr Option kAlarmLeavesSync = option("sync_after_alarm", "mode_left");
inline constexpr Option kSyncFollowsOther = option("sync_encoder", "other");
inline constexpr Option kServoWhereAssigned = option("servo_unassigned", "no_effect");
inline constexpr Option kLeastRamp1ms = option("least_ramp", "1ms");
inline constexpr Option kLeastRamp500us = option("least_ramp", "500us");
inline constexpr Option kDroppedValueForgotten = option("dropped_value", "forgotten");
inline constexpr Option kMoveWhileMovingIgnored = option("command_while_moving", "ignored");
inline constexpr Option kModeWhileMovingIgnored = option("mode_change_while_moving", "ignored");
inline constexpr Option kIncrementalFromOldTarget = option("incremental_while_moving", "old_target");
inline constexpr Option kSpeedAtOnce = option("speed_while_moving", "at_once");
inline constexpr Option kMoveBeginsOneTickIn = option("move_begins", "one_tick_in");
inline constexpr Option kMotionFirst = option("tick_order", "motion");
inline constexpr Option kTooFastDropped = option("pulse_rate_cap", "command_dropped");
inline constexpr Option kLimitsIgnored = option("limit_reaction", "none");
inline constexpr Option kLimitsPhysical = option("limit_sense", "physical");
inline constexpr Option kAlarmIgnored = option("alarm_reaction", "none");
inline constexpr Option kAlarmTakesServo = option("alarm_reaction", "stops_and_servo_off");
inline constexpr Option kAlarmLatched = option("alarm_latch", "latched");
inline constexpr Option kReadyNeeded = option("ready_gates", "yes");
inline constexpr Option kCoordinateSaturates = option("coordinate_overflow", "saturates");
inline constexpr Option kPresetKeepsTarget = option("preset_while_moving", "keeps_target");
// --- homing and the other modes ---
inline constexpr Option kHomeAtFirstEdge = option("homing_sequence", "stops_at_first_edge");
inline constexpr Option kHomeUnassignedDropped = option("home_unassigned", "dropped");
inline constexpr Option kHomeKeepsCoordinate = option("home_coordinate", "kept");
inline constexpr Option kHomeLeftByMotion = option("home_bit", "any_motion");
inline constexpr Option kMovingInPositionOnly = option("moving_bit", "position_only");
inline constexpr Option kHomingBitAlone = option("homing_bits", "homing_alone");
inline constexpr Option kVelocitySettingsLatched = option("velocity_settings", "next_command");
inline constexpr Option kSyncSettingsAtOnce = option("sync_settings", "at_once");
inline constexpr Option kStopsWithEncoder = option("sync_slope_end", "stops");
inline constexpr Option kVelocity2RpmPerSecond = option("velocity_unit", "two_rpm_per_second");
inline constexpr Option kVelocityByLowWord = option("velocity_commit", "takes_effect");
inline constexpr Option kVelocityPulsesFirst = option("velocity_step", "pulses");
inline constexpr Option kModeStaysAfterStop = option("mode_after_stop", "stays");
inline constexpr Option kValuesZeroAfterStop = option("values_after_stop", "zero");
inline constexpr Option kPwmWithoutServo = option("pwm_servo", "not_needed");
inline constexpr Option kSyncByRevolutions = option("sync_ratio", "revolutions");
inline constexpr Option kSlopeInPulses = option("sync_slope", "pulses");
inline constexpr Option kSyncCatchesUp = option("sync_lost_pulses", "caught_up");
inline constexpr Option kSyncEveryFifthTick = option("sync_period", "every_fifth_tick");
inline constexpr Option kEncoderWindow10ms = option("encoder_speed", "window_of_10ms");
inline constexpr Option kEncoderSpeedWraps = option("encoder_speed_overflow", "wraps");
// --- programs ---
inline constexpr Option kWaitMoveBWaits = option("wait_move_b_139", "waits");
inline constexpr Option kTimer1AlwaysJumps = option("timer1_defect", "always_jumps");
inline constexpr Option kLoopFurtherPasses = option("loop_count", "further_passes");
inline constexpr Option kLoopRemembered = option("loop_left", "remembered");
inline constexpr Option kLoopNestingAtStart = option("loop_nesting", "when_outer_starts");
inline constexpr Option kUndefinedFlagVoid = option("undefined_flag", "line_void");
inline constexpr Option kWaitsForLaterMove = option("wait_cut_short", "waits_on");
inline constexpr Option kRewrittenWaitsOn = option("rewritten_line", "waits_on");
inline constexpr Option kCutShortEndsProgram = option("wait_cut_short", "program_ends");
inline constexpr Option kWaitMoveLeavesHoming = option("wait_move_homing", "does_not_wait");
inline constexpr Option kVarsCountAsCounters = option("counter_by_var", "as_a_counter");
inline constexpr Option kProgramValueIgnored = option("program_value_of_32_bits", "ignored");
inline constexpr Option kTimersWithSign = option("timer_compare", "with_sign");
inline constexpr Option kTimersStay = option("timer_overflow", "stays");
inline constexpr Option kUnknownCommandEnds = option("unknown_command", "ends");
inline constexpr Option kUndefinedOperandEnds = option("undefined_operand", "ends");
inline constexpr Option kUndefinedParameterEnds = option("undefined_parameter", "ends");
inline constexpr Option kReadOnlyParameterEnds = option("read_only_parameter", "ends");
inline constexpr Option kLogicLowestBit = option("logic_operand", "lowest_bit");
inline constexpr Option kLow16Bits = option("value_out_of_range", "low_16_bits");
inline constexpr Option kProgramSpeedOfItsOwn = option("program_speed", "of_its_own");
inline constexpr Option kProgramPulseShown = option("program_pulse", "shown");
inline constexpr Option kGoesOnAt0 = option("after_last_line", "goes_on_at_0");
inline constexpr Option kDelayBeforeNextSlot = option("delay_counts", "before_next_slot");
inline constexpr Option kWaitSharesItsSlot = option("wait_slot", "in_the_same_slot");
inline constexpr Option kFlagsFoundAtStart = option("flags_found", "at_start");
inline constexpr Option kFlagsUpToEnd = option("flags_after_end", "does_not_count");
inline constexpr Option kFlagLastWritten = option("same_flag_twice", "last_written");
inline constexpr Option kArithmeticSaturates = option("arithmetic", "saturates");
inline constexpr Option kDivisionDownwards = option("division", "downwards");
inline constexpr Option kCountersSaturate = option("counter_overflow", "saturates");
inline constexpr Option kTimer10ms = option("timer_unit", "10ms");
inline constexpr Option kTimer100ms = option("timer_unit", "100ms");
inline constexpr Option kStartClears = option("program_start", "clears_them");
inline constexpr Option kStartJumps = option("start_while_running", "jumps");
inline constexpr Option kStartIgnored = option("start_while_running", "ignored");
inline constexpr Option kEndStopsMotion = option("program_end", "stops");
inline constexpr Option kTimersRunFromPowerUp = option("timers_at_power_up", "running");
inline constexpr Option kEndStopsTimers = option("timers_at_end", "stop");
inline constexpr Option kLineZeroAfterEnd = option("line_after_end", "zero");
inline constexpr Option kErasureLeavesProgram = option("erase_while_running", "goes_on");

}  // namespace understudy::emulator::models::simple2_r3
