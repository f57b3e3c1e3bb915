// The whole state of a SLIM, as a value.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/program.h"

namespace understudy::emulator::models::slim {

namespace lang = interpreter::slim;

/// ?ERR and ?ERC of a module.
struct Errors {
  Error present = Error::none;
  std::vector<std::uint8_t> history{};  // the latest first

  bool operator==(const Errors&) const = default;
};

struct State {
  Memory ram;
  Memory kept;
  std::vector<std::string> kept_program{};
  std::uint64_t memory_revision = 0;
  Chain chain{};
  lang::Program program{};
  lang::Editor editor{};
  lang::Execution execution{};
  std::array<Errors, kModules> errors{};
  std::array<std::uint8_t, kModules> inputs{};  // bit n: input n + 1 as sampled in this tick
  Tick powered_at = 0;                          // the tick from which ?time counts
  Tick clock_zero = 0;                          // the tick from which TM counts
  std::string output{};                         // not read by the line yet
  bool touched = true;                          // an outside event has occurred since the last tick

  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::slim
