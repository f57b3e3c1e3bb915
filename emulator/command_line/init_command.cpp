// Implements `init`: writes files for a new user to start with.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/files/growing_file.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/new_files.h"
#include "emulator/device/model.h"
#include "emulator/play/schema/json_schema.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::string_view kBenchHead = "# yaml-language-server: $schema=./bench.schema.json\n";
constexpr std::string_view kScenarioHead =
    "# yaml-language-server: $schema=./scenario.schema.json\n# A first move: what the host sends, and what "
    "must be true afterwards. Run it: `understudy run first_move.yaml`.\nunderstudy: 1\nname: a first "
    "move\nbench: bench.yaml\nsteps:\n";

}  // namespace

int write_first_files(ModelList models, const InitArguments& arguments) {
  const Model& model = require_model(models, arguments.model);
  if (model.first_files == nullptr)
    throw UsageError("init: " + quoted(model.name) + " has no starter files; expected another model");
  const std::filesystem::path folder(arguments.folder);
  const auto in_folder = [&folder](const char* name) { return (folder / name).string(); };
  const std::string bench = std::string(kBenchHead) + std::string(model.first_files->bench);
  const std::vector<NewFile> files{
      {in_folder("bench.yaml"), bench},
      {in_folder("first_move.yaml"), std::string(kScenarioHead) + std::string(model.first_files->steps)},
      {in_folder("bench.schema.json"), play::bench_schema(models)},
      {in_folder("scenario.schema.json"),
       play::scenario_schema(models,
                             world::parse_bench(models, bench, in_folder("bench.yaml"), arguments.folder))},
  };
  require_new(files);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw GrowingFileError(folder.string() + ": folder: cannot be created (" + error.message() +
                           "); expected another folder");
  write_all(files);
  for (const NewFile& file : files) std::printf("%s\n", file.path.c_str());
  std::printf("next: understudy run %s\n", files[1].path.c_str());
  std::printf("      understudy serve %s\n", files[0].path.c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
