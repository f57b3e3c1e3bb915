// A program as its observers count it (base/program_watch.h): its parts, and the instructions of each.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator {

struct ProgramLine {
  int text_line = 0;  // in the text that it was read from, from 1; 0: nowhere
  std::string code;   // in one spelling: equal instructions have equal codes
  bool decides = false;

  bool operator==(const ProgramLine& other) const { return code == other.code; }
};

struct ProgramPart {
  int number = 0;    // as observers are told
  std::string name;  // "PLC", "MP21"; empty if there is only one
  std::vector<ProgramLine> lines = {};
};

}  // namespace understudy::emulator
