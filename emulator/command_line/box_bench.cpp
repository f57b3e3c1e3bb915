#include "emulator/command_line/box_bench.h"

#include <chrono>
#include <cstddef>
#include <fstream>
#include <ios>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::command_line {

namespace {

std::size_t require_line(const world::Bench& bench, const std::string& command, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    if (bench.lines[i].name == name || (name.empty() && bench.lines.size() == 1)) return i;
    names += (names.empty() ? "" : ", ") + bench.lines[i].name;
  }
  if (name.empty())
    throw UsageError(command + ": the bench has several lines; expected --line with one of " + names);
  throw UsageError("--line: the bench has no line called " + quoted(name) + "; expected one of " + names);
}

/// Reads the devices' memories: the file of `--from`, or those that the bench names.
void read_memories(world::Bench& bench, std::size_t line, const std::string& from) {
  for (world::DeviceSetup& device : bench.devices) {
    if (device.nv_path.empty()) continue;
    if (auto image = read_nv_file(device.nv_path)) device.settings.nv = std::move(image);
  }
  if (from.empty()) return;
  const auto image = read_nv_file(from);
  if (!image) throw UsageError("--from: " + from + ": does not exist; expected an NV image");
  for (const world::StationSetup& station : bench.lines[line].stations) {
    world::DeviceSetup& device = bench.devices[station.device];
    if (device.model->name != image->model) continue;
    device.settings.nv = image;
    return;
  }
  throw UsageError("--from: " + from + ": is for " + quoted(image->model) +
                   ", but the line has no device of that model; expected an image of one of them");
}

box::Capture read_one(const std::string& path, const std::string& line) {
  if (const std::string why = why_not_readable(path); !why.empty())
    throw FileError(path + ": capture: " + why + "; expected a capture");
  if (const std::string why = is_another_kind(head_of_file(path), ContentKind::capture); !why.empty())
    throw FileError({path, 1, 1}, "capture: " + why);
  std::ifstream file(path, std::ios::binary);
  return box::read_capture(file, path, line);
}

}  // namespace

BoxBench read_box_bench(ModelList models, const std::string& command, const CompareArguments& arguments) {
  BoxBench box;
  const auto tolerance = parse_duration(arguments.tolerance);
  if (!tolerance || *tolerance > std::chrono::seconds(10))
    throw UsageError("--tolerance: " + quoted(arguments.tolerance) +
                     " is not a duration; expected one like 1ms");
  box.bench = world::load_bench(models, arguments.bench);
  box.settings.line = require_line(box.bench, command, arguments.line);
  box.settings.tolerance = *tolerance;
  box.settings.from_power_up = arguments.power_up;
  read_memories(box.bench, box.settings.line, arguments.from);
  for (const std::string& path : arguments.captures) box.captures.push_back(read_one(path, arguments.line));
  return box;
}

std::string choice_text(const world::Bench& bench, std::size_t device, const std::string& id) {
  return bench.devices[device].settings.name + "." + id;
}

}  // namespace understudy::emulator::command_line
