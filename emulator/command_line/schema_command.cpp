#include <cstdio>

#include "emulator/command_line/commands.h"
#include "emulator/forms/json_schema.h"
#include "emulator/one_line.h"

namespace understudy::emulator {

int print_schema(const std::string& what) {
  if (what != "bench" && what != "scenario") {
    throw UsageError(quoted(what) + " has no schema; expected bench or scenario");
  }
  std::fputs((what == "bench" ? bench_schema() : scenario_schema()).c_str(), stdout);
  return kExitWell;
}

}  // namespace understudy::emulator
