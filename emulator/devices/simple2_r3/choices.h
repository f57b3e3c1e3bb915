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
    {"switches_sampled", "RS485", "when DIP switches and the rotary switch are read", "at_power_up",
     kProposal, "not said; hosts cannot turn them"},
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

}  // namespace understudy::emulator::simple2_r3
