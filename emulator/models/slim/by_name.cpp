#include "emulator/models/slim/by_name.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/queries.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/parse.h"

namespace understudy::emulator::models::slim {

const std::optional<lang::Command>& QueriesByName::query_of(const Setup& setup, std::string_view name) {
  constexpr std::size_t kMax = 256;  // limits the cache, because clients can query arbitrary names
  if (const auto known = queries_.find(name); known != queries_.end()) return known->second;
  if (queries_.size() >= kMax) queries_.clear();
  std::optional<lang::Command>& query = queries_[std::string(name)];
  lang::ParseResult parsed = lang::parse_line("?" + std::string(name), setup.language);
  if (parsed.error != Error::none || !parsed.line.command) return query;
  const auto row = static_cast<std::size_t>(parsed.line.command->row);
  if (lang::kCommands[row].is_query()) query = std::move(parsed.line.command);
  return query;
}

std::optional<double> QueriesByName::value(const State& state, const Setup& setup,
                                           const lang::Machine& machine, std::string_view name) {
  if (!setup.device.powered()) return std::nullopt;
  const std::optional<lang::Command>& query_of_name = query_of(setup, name);
  if (!query_of_name) return std::nullopt;
  lang::Command command = *query_of_name;
  Answer answer{.has_words = false};
  if (resolve_indices(command, machine) != Error::none) return std::nullopt;
  if (query(state, setup, command, answer) != Error::none) return std::nullopt;
  return answer.number;
}

Tick next_second(const State& state, Tick done) {
  constexpr Tick kSecond = 1000;
  const auto next_second_since = [&](Tick since) {
    return done + kSecond - ((done - since) % kSecond + kSecond) % kSecond;
  };
  return std::min(next_second_since(state.powered_at), next_second_since(state.clock_zero));
}

std::optional<std::string> assign_by_name(State& state, const Setup& setup, const lang::Machine& machine,
                                          std::string_view name, double value) {
  if (!(std::abs(value) <= std::numeric_limits<float>::max())) return "is out of range";
  const bool is_whole = value == std::trunc(value) && std::abs(value) < 1e15;
  const std::string beginning = std::string(name) + "=";
  lang::ParseResult parsed =
      lang::parse_line(beginning + (is_whole ? text_of_integer(value) : text_of_real(value)), setup.language);
  if (parsed.error == Error::none && parsed.line.command) {
    lang::Command& command = *parsed.line.command;
    if (!lang::kCommands[static_cast<std::size_t>(command.row)].is_assignment()) {
      return "is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
    }
    parsed.error = resolve_indices(command, machine);
    if (parsed.error == Error::none) {
      Order order = order_of(state, setup, machine, command);
      parsed.error = perform(order, actions_of(command.verb).stored);
    }
  }
  switch (parsed.error) {
    case Error::none: return std::nullopt;
    case Error::syntax:
      if (!is_whole && lang::parse_line(beginning + "0").error == Error::none) {
        return "cannot be " + text_of_real(value) + "; expected a whole number within its range";
      }
      return "is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
    case Error::range: return "is out of range";
    case Error::not_linked: return "belongs to a module that is not linked; expected one of those in PN50";
    case Error::not_allowed:
    case Error::axis:
    case Error::paused:
    case Error::unequal_speeds:
    case Error::buffer_full:
    case Error::servo_off:
    case Error::following_error:
    case Error::overload:
    case Error::over_temperature:
    case Error::address: break;
  }
  return "is refused with ERR " + std::to_string(setup.code_of(parsed.error));
}

std::vector<std::string> common_names(const State& state, const Setup& setup) {
  std::vector<std::string> all{"PE", "ST", "MD", "ERR", "IN", "AIN", "TM", "N0", "R0"};
  if (!setup.has_input_mask()) std::erase(all, "IN");
  for (const ParameterDefinition& row : kParameters)
    all.emplace_back(row.alias.empty() ? row.name : row.alias);
  for (int m = 1; m < kModules; ++m) {
    if (state.chain.linked(m)) all.push_back("T" + std::to_string(m) + "PE");
  }
  return all;
}

}  // namespace understudy::emulator::models::slim
