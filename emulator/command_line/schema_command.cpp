#include <cstdio>
#include <string>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/play/schema/json_schema.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::command_line {

int print_schema(ModelList models, const SchemaArguments& arguments) {
  const bool is_bench = arguments.what == "bench";
  const bool is_model = arguments.what == "model";
  if (!is_bench && !is_model && arguments.what != "scenario") {
    throw UsageError(quoted(arguments.what) + " has no schema; expected bench, scenario or model");
  }
  if ((is_bench || is_model) && !arguments.bench.empty()) {
    throw UsageError("schema: --bench needs the format `scenario`, which uses the bench's names");
  }
  const std::string schema = is_bench   ? play::bench_schema(models)
                             : is_model ? play::file_schema("Understudy model", model_file::kModelKeys)
                             : arguments.bench.empty()
                                 ? play::scenario_schema(models)
                                 : play::scenario_schema(models, world::load_bench(models, arguments.bench));
  std::fputs(schema.c_str(), stdout);
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
