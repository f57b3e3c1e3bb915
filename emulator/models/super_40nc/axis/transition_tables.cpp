#include "emulator/models/super_40nc/axis/transition_tables.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/transition_table.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "interpreter/super_40nc/error.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Returns the names of the errors that D8094 shows, in the order of their numbers, from 1.
std::vector<std::string> error_names() {
  using interpreter::super_40nc::Code;
  std::vector<std::string> names = words_of<Code, static_cast<std::size_t>(Code::comparator) + 1>();
  names.erase(names.begin());  // none
  return names;
}

}  // namespace

std::span<const TransitionTable> transition_tables() {
  static const std::vector<TransitionTable> tables{
      {.name = "requests for axes",
       .states = words_of<Activity, kActivities>(),
       .events = words_of<Request, kRequests>()},
      {.name = "errors", .states = error_names(), .events = {"outside step programs", "in a step program"}}};
  return tables;
}

}  // namespace understudy::emulator::models::super_40nc
