// Compares the whole course of a program with the one worked out by hand.
//
// A course is everything that is visible from outside, ms by ms, from the slot of the first line (ms 0) on:
//
//   run  stop          PROG_MAIN_RunTime_Status          +D3  -D3        DOUT_3
//   L7                 PROG_MAIN_NowLine                 C1=5            Counter1_Value
//   +moveA@0           STATUS.4, and where the axis is   modeA=1         Aaxis_Mode
//   +alarmA +readyA +homingA +homeA +servoA +upperA +lowerA              the other bits of STATUS
//   cordA=0            Cord_A changed with the axis at rest
//
// and, if the expected course asks for them,
//
//   A=1600             Cord_A at this ms, on the way
//   PROG_MEM3=-5       any register by its name; from then on every change of it is reported
//
// An entry for ms t shows the device at the end of tick t; an input at ms t is present when tick t begins. A
// table of expectations has one line for each ms, and remarks after ';':
//
//   1004   L6 -D1      ; ms since the start
//   +84    L9 +moveA@0 ; ms after the last line without '+': 1088
//   10..50 L5 L6       ; one of these in each slot of 2 ms, over again: L5 at 10, L6 at 12, L5 at 14, ..., 50
//   0..510 L0-L255     ; L0 L1 L2 ...
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {

/// An event from outside at ms `at`: from the machine, an operator or the host.
struct Deed {
  Tick at = 0;
  std::function<void(OneSimple2&)> does;
};

Deed input_goes(Tick at, int number, bool on);
/// DIN `number` is on from ms `from` to before `to`.
std::vector<Deed> input_is_on(Tick from, Tick to, int number);
/// Writes a register with a Modbus frame.
Deed host_writes(Tick at, std::string_view name, Value value);

struct Play {
  std::string listing;                                // a file of this folder
  Given given{};                                      // the device and the machine around it
  std::vector<std::pair<std::string, Value>> host{};  // values that it writes first
  std::vector<std::vector<Deed>> deeds{};
  std::function<std::int64_t(Tick ms)> encoder_a{};  // the encoder's count in each tick
  Value first_line = 0;
  Tick until = 0;  // the last ms that is checked
};

/// Loads the listing over Modbus, starts it, and compares everything that happens with the table. Then runs
/// it again with fast-forward and without observers, and expects the same final state.
void expect_course(const Play& play, std::string_view wanted);

}  // namespace understudy::emulator::models::simple2_r3
