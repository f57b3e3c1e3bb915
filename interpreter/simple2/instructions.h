// Simple2-R3's program language as data: every opcode with its mnemonic and what its two operands are.
// (Manual, list of program instructions.)
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::simple2 {

enum class Operand : std::uint8_t {
  none,
  flag,         // 1 to 64: the line that carries it in its JMP cell
  parameter,    // a parameter number
  immediate,    // -128 to 127
  input,        // DIN 0 to 10
  output,       // DOUT 0 to 6
  output_bits,  // bit n: DOUT n
  output_mask,  // bit n: whether DOUT n changes
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
};

/// In the order of opcodes. What is not in the table is no instruction.
inline constexpr std::array<Instruction, 115> kInstructions{{
    {0x00, "NOP", Operand::none, Operand::none},
    {0x01, "Wait_IO", Operand::input, Operand::logic},
    {0x02, "Delay_mSec", Operand::amount_low, Operand::amount_high},
    {0x03, "Jump", Operand::flag, Operand::none},
    {0x04, "Loop", Operand::flag, Operand::loop_count},
    {0x05, "Out", Operand::output, Operand::logic},
    {0x06, "Out_ALL", Operand::logic, Operand::none},
    {0x07, "Delay_mSec_VAR", Operand::parameter, Operand::none},
    {0x08, "Out_Array", Operand::output_bits, Operand::none},
    {0x09, "Out_Array_Select", Operand::output_mask, Operand::logic},
    {0x10, "Jump_IN_ON", Operand::flag, Operand::input},
    {0x11, "Jump_IN_OFF", Operand::flag, Operand::input},
    {0x12, "Jump_Counter1_EQ", Operand::flag, Operand::parameter},
    {0x13, "Jump_Counter1_GT", Operand::flag, Operand::parameter},
    {0x14, "Jump_Counter2_EQ", Operand::flag, Operand::parameter},
    {0x15, "Jump_Counter2_GT", Operand::flag, Operand::parameter},
    {0x1A, "Jump_Timer1_GE", Operand::flag, Operand::parameter},
    {0x1B, "Jump_Timer2_GE", Operand::flag, Operand::parameter},
    {0x1C, "VAR_EQ", Operand::parameter, Operand::parameter},
    {0x1D, "VAR_GT", Operand::parameter, Operand::parameter},
    {0x1E, "VAR_LT", Operand::parameter, Operand::parameter},
    {0x1F, "VAR_GT_0", Operand::flag, Operand::parameter},
    {0x20, "Move_INC_A", Operand::parameter, Operand::none},
    {0x21, "Move_ABS_A", Operand::parameter, Operand::none},
    {0x22, "Move_Speed_A", Operand::parameter, Operand::none},
    {0x23, "Move_AccDec_A", Operand::parameter, Operand::parameter},
    {0x24, "Wait_Move_A", Operand::flag, Operand::none},
    {0x25, "Move_INC_A_Wait", Operand::parameter, Operand::none},
    {0x26, "Move_ABS_A_Wait", Operand::parameter, Operand::none},
    {0x27, "Move_Home_A", Operand::none, Operand::none},
    {0x28, "Move_Home_A_Wait", Operand::none, Operand::none},
    {0x2A, "SVON_A", Operand::none, Operand::none},
    {0x2B, "SVOFF_A", Operand::none, Operand::none},
    {0x2F, "STOP_A", Operand::none, Operand::none},
    {0x30, "Move_INC_B", Operand::parameter, Operand::none},
    {0x31, "Move_ABS_B", Operand::parameter, Operand::none},
    {0x32, "Move_Speed_B", Operand::parameter, Operand::none},
    {0x33, "Move_AccDec_B", Operand::parameter, Operand::parameter},
    {0x34, "Wait_Move_B", Operand::flag, Operand::none},
    {0x35, "Move_INC_B_Wait", Operand::parameter, Operand::none},
    {0x36, "Move_ABS_B_Wait", Operand::parameter, Operand::none},
    {0x37, "Move_Home_B", Operand::none, Operand::none},
    {0x38, "Move_Home_B_Wait", Operand::none, Operand::none},
    {0x3A, "SVON_B", Operand::none, Operand::none},
    {0x3B, "SVOFF_B", Operand::none, Operand::none},
    {0x3F, "STOP_B", Operand::none, Operand::none},
    {0x40, "Move_INC_ALL", Operand::parameter, Operand::parameter},
    {0x41, "Move_ABS_ALL", Operand::parameter, Operand::parameter},
    {0x42, "Move_Speed_ALL", Operand::parameter, Operand::parameter},
    {0x43, "Move_AccDec_ALL", Operand::parameter, Operand::parameter},
    {0x44, "Wait_Move_ALL", Operand::flag, Operand::none},
    {0x45, "Move_INC_ALL_Wait", Operand::parameter, Operand::parameter},
    {0x46, "Move_ABS_ALL_Wait", Operand::parameter, Operand::parameter},
    {0x47, "Move_Home_ALL", Operand::none, Operand::none},
    {0x48, "Move_Home_ALL_Wait", Operand::none, Operand::none},
    {0x4A, "SVON_ALL", Operand::none, Operand::none},
    {0x4B, "SVOFF_ALL", Operand::none, Operand::none},
    {0x4F, "STOP_ALL", Operand::none, Operand::none},
    {0x50, "Counter_Clear", Operand::counter, Operand::none},
    {0x51, "Counter_Increase", Operand::counter, Operand::none},
    {0x52, "Counter_Decrease", Operand::counter, Operand::none},
    {0x53, "Counter_Value", Operand::counter, Operand::parameter},
    {0x54, "Timer_Stop", Operand::timer, Operand::none},
    {0x55, "Timer_Start", Operand::timer, Operand::none},
    {0x56, "Timer_Reset", Operand::timer, Operand::none},
    {0x57, "Timer_Value", Operand::timer, Operand::parameter},
    {0x60, "Write_CalcREG", Operand::parameter, Operand::none},
    {0x61, "Load_CalcREG", Operand::parameter, Operand::none},
    {0x62, "VAR_Copy", Operand::parameter, Operand::parameter},
    {0x63, "VAR_Add", Operand::parameter, Operand::parameter},
    {0x64, "VAR_Sub", Operand::parameter, Operand::parameter},
    {0x65, "VAR_Mul", Operand::parameter, Operand::parameter},
    {0x66, "VAR_Div", Operand::parameter, Operand::parameter},
    {0x67, "VAR_DirectAdd", Operand::parameter, Operand::immediate},
    {0x68, "VAR_DirectSub", Operand::parameter, Operand::immediate},
    {0x69, "VAR_DirectMul", Operand::parameter, Operand::immediate},
    {0x6A, "VAR_DirectDiv", Operand::parameter, Operand::immediate},
    {0x6B, "VAR_Inc", Operand::parameter, Operand::none},
    {0x6C, "VAR_Dec", Operand::parameter, Operand::none},
    {0x6D, "VAR_DivR", Operand::parameter, Operand::parameter},
    {0x6E, "VAR_DirectDivR", Operand::parameter, Operand::immediate},
    {0x6F, "VAR_Direct", Operand::parameter, Operand::immediate},
    {0x70, "Cord_ALL_ZERO", Operand::none, Operand::none},
    {0x71, "Cord_A_ZERO", Operand::none, Operand::none},
    {0x72, "Cord_B_ZERO", Operand::none, Operand::none},
    {0x73, "Cord_ALL", Operand::parameter, Operand::parameter},
    {0x74, "Cord_A", Operand::parameter, Operand::none},
    {0x75, "Cord_B", Operand::parameter, Operand::none},
    {0x80, "PWM_A", Operand::parameter, Operand::none},
    {0x81, "PWM_B", Operand::parameter, Operand::none},
    {0x82, "PWM_A_Direct", Operand::percent, Operand::none},
    {0x83, "PWM_B_Direct", Operand::percent, Operand::none},
    {0x84, "VelmRPM_A", Operand::parameter, Operand::none},
    {0x85, "VelmRPM_B", Operand::parameter, Operand::none},
    {0x86, "VelRPM_A", Operand::parameter, Operand::none},
    {0x87, "VelRPM_B", Operand::parameter, Operand::none},
    {0x88, "VelRPM_A_Direct", Operand::amount_low, Operand::amount_high},
    {0x89, "VelRPM_B_Direct", Operand::amount_low, Operand::amount_high},
    {0x8A, "SyncMode_A", Operand::none, Operand::none},
    {0x8B, "SyncMode_B", Operand::none, Operand::none},
    {0x90, "VAR_DirectEQ", Operand::parameter, Operand::immediate},
    {0x91, "VAR_DirectGT", Operand::parameter, Operand::immediate},
    {0x92, "VAR_DirectLT", Operand::parameter, Operand::immediate},
    {0x93, "VAR_INV", Operand::parameter, Operand::none},
    {0x94, "VAR_INV_To", Operand::parameter, Operand::parameter},
    {0x95, "VAR_Inc_To", Operand::parameter, Operand::parameter},
    {0x96, "VAR_Dec_To", Operand::parameter, Operand::parameter},
    {0x97, "VAR_GE_0", Operand::flag, Operand::parameter},
    {0xB0, "Jump_Counter1_EQ_0", Operand::flag, Operand::none},
    {0xB1, "Jump_Counter1_GT_0", Operand::flag, Operand::none},
    {0xB2, "Jump_Counter2_EQ_0", Operand::flag, Operand::none},
    {0xB3, "Jump_Counter2_GT_0", Operand::flag, Operand::none},
    {0xC0, "Jump_STATUS_ON", Operand::flag, Operand::status_bit},
    {0xC1, "Jump_STATUS_OFF", Operand::flag, Operand::status_bit},
    {0xFF, "END", Operand::none, Operand::none},
}};

/// Nothing where the manual lists no instruction.
constexpr const Instruction* find_instruction(std::uint8_t opcode) {
  for (const Instruction& instruction : kInstructions) {
    if (instruction.opcode == opcode) return &instruction;
  }
  return nullptr;
}

/// In the manual's spelling; a compile error if there is no such instruction.
consteval std::uint8_t opcode_of(std::string_view mnemonic) {
  for (const Instruction& instruction : kInstructions) {
    if (instruction.mnemonic == mnemonic) return instruction.opcode;
  }
  throw "the manual has no such instruction";
}

inline constexpr int kInputCount = 11;
inline constexpr int kOutputCount = 7;
inline constexpr int kStatusBitCount = 16;

/// Whether there is such an input, output, STATUS bit, counter or timer. Other operands can be anything.
constexpr bool is_defined(Operand operand, std::uint8_t value) {
  switch (operand) {
    case Operand::input: return value < kInputCount;
    case Operand::output: return value < kOutputCount;
    case Operand::status_bit: return value < kStatusBitCount;
    case Operand::counter:
    case Operand::timer: return value == 1 || value == 2;
    default: return true;
  }
}

/// Which operand names a parameter that the instruction writes.
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

/// What an operand is, for people: "DIN number (0-10)".
std::string_view describe(Operand operand);

}  // namespace understudy::interpreter::simple2
