// Problems in how a host uses the line, with their counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

enum class LintRule : std::uint8_t {
  too_soon,     // a request began before the line was silent long enough
  not_waited,   // a request began before the reply to the previous one
  gap,          // a pause within a frame
  absent,       // a request to a station that does not exist
  read_only,    // a write to a read-only register
  eeprom_wear,  // a register that is stored in EEPROM changed again and again
};

struct Finding {
  std::uint64_t count = 0;
  SimTime first{0};
  SimTime last{0};
  SimTime extreme{0};     // the shortest silence, or the longest gap
  std::string command{};  // the name of the command in the first such request, if any

  void add(SimTime at, const std::string& its_command = {}) {
    if (count == 0) {
      first = at;
      command = its_command;
    }
    ++count;
    last = at;
  }
};

/// Findings by rule and subject, which is a station number or a register name, or empty for the whole line.
using Findings = std::map<std::pair<LintRule, std::string>, Finding>;

}  // namespace understudy::emulator::play
