// The parts of a program and their instructions, as observers count them (base/program_watch.h).
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator {

struct ProgramLine {
  int text_line = 0;  // the text line from which it was read, counted from 1; 0: none
  std::string code;   // normalized, so that equal instructions have equal codes
  bool decides = false;

  bool operator==(const ProgramLine& other) const { return code == other.code; }
};

struct ProgramPart {
  int number = 0;    // the number that observers receive (ProgramWatch)
  std::string name;  // "PLC", "MP21"; empty if there is only one
  std::vector<ProgramLine> lines = {};
};

}  // namespace understudy::emulator
