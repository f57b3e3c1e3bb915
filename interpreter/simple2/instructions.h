// Simple2-R3's program language as data: every opcode with its mnemonic and the kinds of its two operands.
// (Manual, list of program instructions.)
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::simple2 {

enum class Operand : std::uint8_t {
  none,
  flag,         // 1 to 64: the line with this flag in its JMP cell
  parameter,    // a parameter number
  immediate,    // -128 to 127
  input,        // DIN 0 to 10
  output,       // DOUT 0 to 6
  output_bits,  // bit n: DOUT n
  output_mask,  // bit n: DOUT n may change
  logic,        // 1 on, 0 off
  amount_low,   // low 8 bits of a 16-bit amount
  amount_high,
  percent,     // 0 to 100
  loop_count,  // 0: endless
  counter,     // 1 or 2
  timer,       // 1 or 2
  status_bit,  // 0 to 15
};

struct Instruction {
  std::uint8_t opcode;
  std::string_view mnemonic;
  Operand data1;
  Operand data2;
  std::string_view meaning;  // for the documentation
};

/// The instructions in the order of their opcodes. An opcode that is not in the table is not an instruction.
inline constexpr std::array<Instruction, 115> kInstructions{{
    {0x00, "NOP", Operand::none, Operand::none, "Does nothing"},
    {0x01, "Wait_IO", Operand::input, Operand::logic, "Waits here until the input is ON, or OFF"},
    {0x02, "Delay_mSec", Operand::amount_low, Operand::amount_high,
     "Waits this many milliseconds before the next line, 0 to 65535"},
    {0x03, "Jump", Operand::flag, Operand::none,
     "Continues at the line that has the flag, or at line 0 if none has it"},
    {0x04, "Loop", Operand::flag, Operand::loop_count,
     "Jumps back to the flag until the lines between have run this many times. Has no effect if the flag is "
     "not above it; inside another Loop it ends the program"},
    {0x05, "Out", Operand::output, Operand::logic, "Switches the output ON or OFF"},
    {0x06, "Out_ALL", Operand::logic, Operand::none, "Switches all outputs ON or OFF"},
    {0x07, "Delay_mSec_VAR", Operand::parameter, Operand::none,
     "Waits as many milliseconds as the parameter holds, 0 to 65535"},
    {0x08, "Out_Array", Operand::output_bits, Operand::none, "Switches each output according to its bit"},
    {0x09, "Out_Array_Select", Operand::output_mask, Operand::logic,
     "Switches the outputs whose bit is 1 ON or OFF; the others stay"},
    {0x10, "Jump_IN_ON", Operand::flag, Operand::input, "Jumps to the flag if the input is ON"},
    {0x11, "Jump_IN_OFF", Operand::flag, Operand::input, "Jumps to the flag if the input is OFF"},
    {0x12, "Jump_Counter1_EQ", Operand::flag, Operand::parameter,
     "Jumps to the flag if counter 1 equals the parameter"},
    {0x13, "Jump_Counter1_GT", Operand::flag, Operand::parameter,
     "Jumps to the flag if counter 1 is greater than the parameter"},
    {0x14, "Jump_Counter2_EQ", Operand::flag, Operand::parameter,
     "Jumps to the flag if counter 2 equals the parameter"},
    {0x15, "Jump_Counter2_GT", Operand::flag, Operand::parameter,
     "Jumps to the flag if counter 2 is greater than the parameter"},
    {0x1A, "Jump_Timer1_GE", Operand::flag, Operand::parameter,
     "Jumps to the flag if timer 1 has reached the parameter. Broken up to firmware 1.41"},
    {0x1B, "Jump_Timer2_GE", Operand::flag, Operand::parameter,
     "Jumps to the flag if timer 2 has reached the parameter"},
    {0x1C, "VAR_EQ", Operand::parameter, Operand::parameter,
     "Skips the next line unless the two parameters are equal"},
    {0x1D, "VAR_GT", Operand::parameter, Operand::parameter,
     "Skips the next line unless the first parameter is greater than the second"},
    {0x1E, "VAR_LT", Operand::parameter, Operand::parameter,
     "Skips the next line unless the first parameter is less than the second"},
    {0x1F, "VAR_GT_0", Operand::flag, Operand::parameter,
     "Jumps to the flag if the parameter is greater than 0"},
    {0x20, "Move_INC_A", Operand::parameter, Operand::none, "Starts a move of axis A by this many pulses"},
    {0x21, "Move_ABS_A", Operand::parameter, Operand::none,
     "Starts a move of axis A to this coordinate, in pulses"},
    {0x22, "Move_Speed_A", Operand::parameter, Operand::none,
     "Sets the speed of position moves of axis A, in RPM"},
    {0x23, "Move_AccDec_A", Operand::parameter, Operand::parameter,
     "Sets the acceleration and deceleration times of position moves of axis A, in units of 10 ms"},
    {0x24, "Wait_Move_A", Operand::flag, Operand::none,
     "Jumps to the flag while a position move of axis A is under way. Waits here instead if no line has the "
     "flag, and up to firmware 1.39"},
    {0x25, "Move_INC_A_Wait", Operand::parameter, Operand::none,
     "Moves axis A by this many pulses and waits for the end of the move"},
    {0x26, "Move_ABS_A_Wait", Operand::parameter, Operand::none,
     "Moves axis A to this coordinate, in pulses, and waits for the end of the move"},
    {0x27, "Move_Home_A", Operand::none, Operand::none, "Starts homing of axis A"},
    {0x28, "Move_Home_A_Wait", Operand::none, Operand::none, "Homes axis A and waits until homing ends"},
    {0x2A, "SVON_A", Operand::none, Operand::none,
     "Switches the servo of axis A on; without it no pulses are sent"},
    {0x2B, "SVOFF_A", Operand::none, Operand::none, "Switches the servo of axis A off, which stops the axis"},
    {0x2F, "STOP_A", Operand::none, Operand::none, "Stops axis A"},
    {0x30, "Move_INC_B", Operand::parameter, Operand::none, "Starts a move of axis B by this many pulses"},
    {0x31, "Move_ABS_B", Operand::parameter, Operand::none,
     "Starts a move of axis B to this coordinate, in pulses"},
    {0x32, "Move_Speed_B", Operand::parameter, Operand::none,
     "Sets the speed of position moves of axis B, in RPM"},
    {0x33, "Move_AccDec_B", Operand::parameter, Operand::parameter,
     "Sets the acceleration and deceleration times of position moves of axis B, in units of 10 ms"},
    {0x34, "Wait_Move_B", Operand::flag, Operand::none,
     "Jumps to the flag while a position move of axis B is under way. Waits here instead if no line has the "
     "flag. Up to firmware 1.39 the same as Move_INC_B_Wait"},
    {0x35, "Move_INC_B_Wait", Operand::parameter, Operand::none,
     "Moves axis B by this many pulses and waits for the end of the move"},
    {0x36, "Move_ABS_B_Wait", Operand::parameter, Operand::none,
     "Moves axis B to this coordinate, in pulses, and waits for the end of the move"},
    {0x37, "Move_Home_B", Operand::none, Operand::none, "Starts homing of axis B"},
    {0x38, "Move_Home_B_Wait", Operand::none, Operand::none, "Homes axis B and waits until homing ends"},
    {0x3A, "SVON_B", Operand::none, Operand::none,
     "Switches the servo of axis B on; without it no pulses are sent"},
    {0x3B, "SVOFF_B", Operand::none, Operand::none, "Switches the servo of axis B off, which stops the axis"},
    {0x3F, "STOP_B", Operand::none, Operand::none, "Stops axis B"},
    {0x40, "Move_INC_ALL", Operand::parameter, Operand::parameter,
     "Starts moves of A and B, each by this many pulses"},
    {0x41, "Move_ABS_ALL", Operand::parameter, Operand::parameter,
     "Starts moves of A and B, each to its coordinate, in pulses"},
    {0x42, "Move_Speed_ALL", Operand::parameter, Operand::parameter,
     "Sets the speeds of position moves of A and B, in RPM"},
    {0x43, "Move_AccDec_ALL", Operand::parameter, Operand::parameter,
     "Sets one acceleration and one deceleration time for position moves of both axes, in units of 10 ms"},
    {0x44, "Wait_Move_ALL", Operand::flag, Operand::none,
     "Jumps to the flag while a position move of either axis is under way. Waits here instead if no line has "
     "the flag, and up to firmware 1.39"},
    {0x45, "Move_INC_ALL_Wait", Operand::parameter, Operand::parameter,
     "Moves A and B, each by this many pulses, and waits for the end of both moves"},
    {0x46, "Move_ABS_ALL_Wait", Operand::parameter, Operand::parameter,
     "Moves A and B, each to its coordinate, in pulses, and waits for the end of both moves"},
    {0x47, "Move_Home_ALL", Operand::none, Operand::none, "Starts homing of both axes"},
    {0x48, "Move_Home_ALL_Wait", Operand::none, Operand::none, "Homes both axes and waits until homing ends"},
    {0x4A, "SVON_ALL", Operand::none, Operand::none,
     "Switches both servos on; without them no pulses are sent"},
    {0x4B, "SVOFF_ALL", Operand::none, Operand::none, "Switches both servos off, which stops the axes"},
    {0x4F, "STOP_ALL", Operand::none, Operand::none, "Stops both axes"},
    {0x50, "Counter_Clear", Operand::counter, Operand::none, "Sets the counter to 0"},
    {0x51, "Counter_Increase", Operand::counter, Operand::none, "Adds 1 to the counter"},
    {0x52, "Counter_Decrease", Operand::counter, Operand::none, "Subtracts 1 from the counter"},
    {0x53, "Counter_Value", Operand::counter, Operand::parameter, "Sets the counter to the parameter"},
    {0x54, "Timer_Stop", Operand::timer, Operand::none, "Stops the timer; it keeps its value"},
    {0x55, "Timer_Start", Operand::timer, Operand::none, "Starts the timer, or lets it continue"},
    {0x56, "Timer_Reset", Operand::timer, Operand::none, "Sets the timer to 0; a running timer continues"},
    {0x57, "Timer_Value", Operand::timer, Operand::parameter,
     "Sets the timer to the parameter; a running timer continues"},
    {0x60, "Write_CalcREG", Operand::parameter, Operand::none, "Copies the parameter to CalcREG"},
    {0x61, "Load_CalcREG", Operand::parameter, Operand::none, "Copies CalcREG to the parameter"},
    {0x62, "VAR_Copy", Operand::parameter, Operand::parameter, "Copies the first parameter to the second"},
    {0x63, "VAR_Add", Operand::parameter, Operand::parameter,
     "Sets CalcREG to the sum of the two parameters"},
    {0x64, "VAR_Sub", Operand::parameter, Operand::parameter,
     "Sets CalcREG to the first parameter minus the second"},
    {0x65, "VAR_Mul", Operand::parameter, Operand::parameter,
     "Sets CalcREG to the product of the two parameters"},
    {0x66, "VAR_Div", Operand::parameter, Operand::parameter,
     "Sets CalcREG to the first parameter divided by the second, without the remainder; 0 if the second is "
     "0"},
    {0x67, "VAR_DirectAdd", Operand::parameter, Operand::immediate,
     "Sets CalcREG to the parameter plus the number"},
    {0x68, "VAR_DirectSub", Operand::parameter, Operand::immediate,
     "Sets CalcREG to the parameter minus the number"},
    {0x69, "VAR_DirectMul", Operand::parameter, Operand::immediate,
     "Sets CalcREG to the parameter times the number"},
    {0x6A, "VAR_DirectDiv", Operand::parameter, Operand::immediate,
     "Sets CalcREG to the parameter divided by the number, without the remainder; 0 if the number is 0"},
    {0x6B, "VAR_Inc", Operand::parameter, Operand::none, "Adds 1 to the parameter"},
    {0x6C, "VAR_Dec", Operand::parameter, Operand::none, "Subtracts 1 from the parameter"},
    {0x6D, "VAR_DivR", Operand::parameter, Operand::parameter,
     "Sets CalcREG to the remainder of the first parameter divided by the second; 0 if the second is 0"},
    {0x6E, "VAR_DirectDivR", Operand::parameter, Operand::immediate,
     "Sets CalcREG to the remainder of the parameter divided by the number; 0 if the number is 0"},
    {0x6F, "VAR_Direct", Operand::parameter, Operand::immediate, "Sets the parameter to the number"},
    {0x70, "Cord_ALL_ZERO", Operand::none, Operand::none, "Sets both coordinates to 0"},
    {0x71, "Cord_A_ZERO", Operand::none, Operand::none, "Sets the coordinate of axis A to 0"},
    {0x72, "Cord_B_ZERO", Operand::none, Operand::none, "Sets the coordinate of axis B to 0"},
    {0x73, "Cord_ALL", Operand::parameter, Operand::parameter,
     "Sets the coordinates of A and B to the two parameters, in pulses"},
    {0x74, "Cord_A", Operand::parameter, Operand::none,
     "Sets the coordinate of axis A to the parameter, in pulses"},
    {0x75, "Cord_B", Operand::parameter, Operand::none,
     "Sets the coordinate of axis B to the parameter, in pulses"},
    {0x80, "PWM_A", Operand::parameter, Operand::none,
     "Puts axis A into PWM mode at once, with this duty in percent"},
    {0x81, "PWM_B", Operand::parameter, Operand::none,
     "Puts axis B into PWM mode at once, with this duty in percent"},
    {0x82, "PWM_A_Direct", Operand::percent, Operand::none,
     "Puts axis A into PWM mode at once, with the duty in percent that the line itself gives"},
    {0x83, "PWM_B_Direct", Operand::percent, Operand::none,
     "Puts axis B into PWM mode at once, with the duty in percent that the line itself gives"},
    {0x84, "VelmRPM_A", Operand::parameter, Operand::none,
     "Puts axis A into velocity mode at once, at this speed in mRPM (1/1000 RPM)"},
    {0x85, "VelmRPM_B", Operand::parameter, Operand::none,
     "Puts axis B into velocity mode at once, at this speed in mRPM (1/1000 RPM)"},
    {0x86, "VelRPM_A", Operand::parameter, Operand::none,
     "Puts axis A into velocity mode at once, at this speed in RPM"},
    {0x87, "VelRPM_B", Operand::parameter, Operand::none,
     "Puts axis B into velocity mode at once, at this speed in RPM"},
    {0x88, "VelRPM_A_Direct", Operand::amount_low, Operand::amount_high,
     "Puts axis A into velocity mode at once, at the speed in RPM that the line itself gives, -32768 to "
     "32767"},
    {0x89, "VelRPM_B_Direct", Operand::amount_low, Operand::amount_high,
     "Puts axis B into velocity mode at once, at the speed in RPM that the line itself gives, -32768 to "
     "32767"},
    {0x8A, "SyncMode_A", Operand::none, Operand::none, "Makes axis A follow its encoder (sync mode)"},
    {0x8B, "SyncMode_B", Operand::none, Operand::none, "Makes axis B follow its encoder (sync mode)"},
    {0x90, "VAR_DirectEQ", Operand::parameter, Operand::immediate,
     "Skips the next line unless the parameter equals the number"},
    {0x91, "VAR_DirectGT", Operand::parameter, Operand::immediate,
     "Skips the next line unless the parameter is greater than the number"},
    {0x92, "VAR_DirectLT", Operand::parameter, Operand::immediate,
     "Skips the next line unless the parameter is less than the number"},
    {0x93, "VAR_INV", Operand::parameter, Operand::none, "Changes the sign of the parameter"},
    {0x94, "VAR_INV_To", Operand::parameter, Operand::parameter,
     "Copies the first parameter to the second with the opposite sign"},
    {0x95, "VAR_Inc_To", Operand::parameter, Operand::parameter,
     "Copies the first parameter plus 1 to the second"},
    {0x96, "VAR_Dec_To", Operand::parameter, Operand::parameter,
     "Copies the first parameter minus 1 to the second"},
    {0x97, "VAR_GE_0", Operand::flag, Operand::parameter,
     "Jumps to the flag if the parameter is 0 or greater"},
    {0xB0, "Jump_Counter1_EQ_0", Operand::flag, Operand::none, "Jumps to the flag if counter 1 is 0"},
    {0xB1, "Jump_Counter1_GT_0", Operand::flag, Operand::none,
     "Jumps to the flag if counter 1 is greater than 0"},
    {0xB2, "Jump_Counter2_EQ_0", Operand::flag, Operand::none, "Jumps to the flag if counter 2 is 0"},
    {0xB3, "Jump_Counter2_GT_0", Operand::flag, Operand::none,
     "Jumps to the flag if counter 2 is greater than 0"},
    {0xC0, "Jump_STATUS_ON", Operand::flag, Operand::status_bit,
     "Jumps to the flag if the bit of STATUS is 1"},
    {0xC1, "Jump_STATUS_OFF", Operand::flag, Operand::status_bit,
     "Jumps to the flag if the bit of STATUS is 0"},
    {0xFF, "END", Operand::none, Operand::none, "Ends the program"},
}};

/// Returns null if the manual does not define the opcode.
constexpr const Instruction* find_instruction(std::uint8_t opcode) {
  for (const Instruction& instruction : kInstructions) {
    if (instruction.opcode == opcode) return &instruction;
  }
  return nullptr;
}

/// Returns the opcode of a mnemonic, spelled as in the manual. An unknown mnemonic is a compile error.
consteval std::uint8_t opcode_of(std::string_view mnemonic) {
  for (const Instruction& instruction : kInstructions) {
    if (instruction.mnemonic == mnemonic) return instruction.opcode;
  }
  throw "the manual has no such instruction";
}

inline constexpr int kInputCount = 11;
inline constexpr int kOutputCount = 7;
inline constexpr int kStatusBitCount = 16;

/// Returns true if this input, output, STATUS bit, counter or timer exists. For other operands, all values
/// are valid.
constexpr bool is_defined(Operand operand, std::uint8_t value) {
  switch (operand) {
    case Operand::input: return value < kInputCount;
    case Operand::output: return value < kOutputCount;
    case Operand::status_bit: return value < kStatusBitCount;
    case Operand::counter:
    case Operand::timer: return value == 1 || value == 2;
    case Operand::none:
    case Operand::flag:
    case Operand::parameter:
    case Operand::immediate:
    case Operand::output_bits:
    case Operand::output_mask:
    case Operand::logic:
    case Operand::amount_low:
    case Operand::amount_high:
    case Operand::percent:
    case Operand::loop_count: return true;
  }
  return true;
}

/// Which operand, if any, is the number of a parameter that the instruction writes.
enum class Written : std::uint8_t { nothing, data1, data2 };
constexpr Written written_by(std::uint8_t opcode) {
  switch (opcode) {
    case opcode_of("Load_CalcREG"):
    case opcode_of("VAR_Inc"):
    case opcode_of("VAR_Dec"):
    case opcode_of("VAR_Direct"):
    case opcode_of("VAR_INV"): return Written::data1;
    case opcode_of("VAR_Copy"):
    case opcode_of("VAR_INV_To"):
    case opcode_of("VAR_Inc_To"):
    case opcode_of("VAR_Dec_To"): return Written::data2;
    default: return Written::nothing;
  }
}

/// Returns a description of an operand: "DIN number (0-10)".
std::string_view describe(Operand operand);

}  // namespace understudy::interpreter::simple2
