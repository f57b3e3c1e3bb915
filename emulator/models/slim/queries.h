// The replies to queries.
#pragma once

#include <optional>
#include <string>

#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"

namespace understudy::emulator::models::slim {

struct Answer {
  std::string name{};
  std::string text{};
  std::optional<double> number{};  // the value, if the query is numeric
  bool has_words = true;           // false: only the number is needed
};

/// Answers a query whose indices are already resolved.
Error query(const State& state, const Setup& setup, const lang::Command& command, Answer& answer);

}  // namespace understudy::emulator::models::slim
