#include "emulator/models/super_40nc/axis/transition_tables.h"

#include <span>
#include <vector>

#include "emulator/device/transition_table.h"
#include "emulator/models/super_40nc/axis/ownership.h"

namespace understudy::emulator::models::super_40nc {

std::span<const TransitionTable> transition_tables() {
  static const std::vector<TransitionTable> tables{{.name = "requests for axes",
                                                    .states = words_of<Activity, kActivities>(),
                                                    .events = words_of<Request, kRequests>()}};
  return tables;
}

}  // namespace understudy::emulator::models::super_40nc
