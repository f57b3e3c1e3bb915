// Queries and assignments that bypass the line, for scenarios, traces and the control socket.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/machine.h"

namespace understudy::emulator::models::slim {

/// Answers queries by name. It parses each name only once, because conditions and traces repeat their queries
/// at every tick.
class QueriesByName {
 public:
  std::optional<double> value(const State& state, const Setup& setup, const lang::Machine& machine,
                              std::string_view name);

 private:
  const std::optional<lang::Command>& query_of(const Setup& setup, std::string_view name);

  std::map<std::string, std::optional<lang::Command>, std::less<>> queries_{};
};

/// Returns the first tick after `done` in which a clock of the device shows a new second.
Tick next_second(const State& state, Tick done);
/// Assigns a value as a program line would. Returns nothing, or why the value is refused.
std::optional<std::string> assign_by_name(State& state, const Setup& setup, const lang::Machine& machine,
                                          std::string_view name, double value);
std::vector<std::string> common_names(const State& state, const Setup& setup);

}  // namespace understudy::emulator::models::slim
