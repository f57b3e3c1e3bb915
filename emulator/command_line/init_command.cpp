// `init`: the files that somebody begins with.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/device/model.h"
#include "emulator/play/schema/json_schema.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::string_view kBenchHead = "# yaml-language-server: $schema=./bench.schema.json\n";
constexpr std::string_view kScenarioHead =
    "# yaml-language-server: $schema=./scenario.schema.json\n"
    "# A first move: what a host sends, and what must then be true. `understudy run first_move.yaml` plays "
    "it.\n"
    "understudy: 1\n"
    "name: a first move\n"
    "bench: bench.yaml\n"
    "steps:\n";

struct NewFile {
  std::string path;
  std::string text;
};

/// Throws FileError, also where something of that name is there already: nothing is ever overwritten.
void write_new(const NewFile& file) {
  const Descriptor made(::open(file.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const auto refuse = [&file](int error) {
    throw FileError(file.path + ": file: cannot be written (" + std::strerror(error) +
                    "); expected a new file");
  };
  if (!made) refuse(errno);
  for (std::string_view rest = file.text; !rest.empty();) {
    const ssize_t size = ::write(made.get(), rest.data(), rest.size());
    if (size < 0 && errno != EINTR) {
      const int error = errno;
      ::unlink(file.path.c_str());
      refuse(error);
    }
    if (size > 0) rest.remove_prefix(static_cast<std::size_t>(size));
  }
}

/// All of them, or none: what was written before one failed is taken away again.
void write_all(const std::vector<NewFile>& files) {
  std::size_t written = 0;
  try {
    for (; written < files.size(); ++written) write_new(files[written]);
  } catch (const FileError&) {
    for (std::size_t i = 0; i < written; ++i) ::unlink(files[i].path.c_str());
    throw;
  }
}

bool is_there(const std::string& path) {
  std::error_code error;
  return std::filesystem::symlink_status(path, error).type() != std::filesystem::file_type::not_found;
}

}  // namespace

int write_first_files(ModelList models, const InitArguments& arguments) {
  const Model& model = demand_model(models, arguments.model);
  if (model.first_files == nullptr)
    throw UsageError("init: " + quoted(model.name) + " has no files to begin with; expected another model");
  const std::filesystem::path folder(arguments.folder);
  const auto in_folder = [&folder](const char* name) { return (folder / name).string(); };
  const std::string bench = std::string(kBenchHead) + std::string(model.first_files->bench);
  const std::vector<NewFile> files{
      {in_folder("bench.yaml"), bench},
      {in_folder("first_move.yaml"), std::string(kScenarioHead) + std::string(model.first_files->steps)},
      {in_folder("bench.schema.json"), play::bench_schema()},
      {in_folder("scenario.schema.json"),
       play::scenario_schema(world::parse_bench(models, bench, in_folder("bench.yaml"), arguments.folder))},
  };
  for (const NewFile& file : files) {
    if (is_there(file.path))
      throw FileError(file.path + ": file: is there already; expected a folder without it");
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw FileError(folder.string() + ": folder: cannot be made (" + error.message() + "); expected one");
  write_all(files);
  for (const NewFile& file : files) std::printf("%s\n", file.path.c_str());
  std::printf("next: understudy run %s\n", files[1].path.c_str());
  std::printf("      understudy serve %s\n", files[0].path.c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
