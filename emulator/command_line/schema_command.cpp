#include <cstdio>
#include <string>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/play/schema/json_schema.h"

namespace understudy::emulator::command_line {

int print_schema(const std::string& what) {
  if (what != "bench" && what != "scenario") {
    throw UsageError(quoted(what) + " has no schema; expected bench or scenario");
  }
  std::fputs((what == "bench" ? play::bench_schema() : play::scenario_schema()).c_str(), stdout);
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
