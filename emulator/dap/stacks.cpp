// Reports threads, which are the programs of devices, with their stacks and sources.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

constexpr std::int64_t kPerThread = 1'000;  // frames

}  // namespace

int Session::thread_number(std::size_t device, const std::string& program) {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (threads_[i].device == device && threads_[i].program == program) return static_cast<int>(i) + 1;
  }
  threads_.push_back({device, program});
  return static_cast<int>(threads_.size());
}

std::string Session::thread_name(const Thread& thread) const {
  return devices_[thread.device].name + (thread.program.empty() ? "" : " " + thread.program);
}

/// Returns the stacks of a device's programs; none if it has no power.
Json Session::stack_of(std::size_t device) const {
  try {
    return link_->ask({{"do", "stack"}, {"device", devices_[device].name}});
  } catch (const RequestError&) {
    link_->ask({{"do", "look"}});  // throws if the bench has ended
    return {{"stacks", Json::array()}};
  }
}

/// Returns the names of a device's programs. A device that has one program at a time has one thread, without
/// a name, because asking each of many stations for its program would take too long.
std::vector<std::string> Session::programs_of(std::size_t device) const {
  std::vector<std::string> names;
  if (devices_[device].has_many) {
    const Json programs = link_->ask_for("programs", {{"do", "where"}, {"device", devices_[device].name}});
    for (const Json& program : programs) names.push_back(text_or(program, "program"));
  }
  if (names.empty()) names.emplace_back();
  return names;
}

/// Returns nothing if the device has no power, or no program.
Session::Source Session::source_of(std::size_t device) const {
  try {
    Json reply = link_->ask({{"do", "source"}, {"device", devices_[device].name}});
    return {.path = reply.value("path", std::string()),
            .text = reply.value("text", std::string()),
            .lines = std::move(reply["lines"])};
  } catch (const RequestError&) {
    return {};
  }
}

Json Session::threads(const Json& /*arguments*/) {
  Json all = Json::array();
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    if (!devices_[d].has_program) continue;
    for (const std::string& program : programs_of(d)) {
      const int number = thread_number(d, program);
      all.push_back({{"id", number}, {"name", thread_name(threads_[static_cast<std::size_t>(number) - 1])}});
    }
  }
  // Without a program, the bench itself is a thread: clients need one to stop and continue.
  if (all.empty() && !devices_.empty()) {
    const int number = thread_number(0, {});
    all.push_back({{"id", number}, {"name", devices_[0].name}});
  }
  return {{"threads", std::move(all)}};
}

const Session::Thread& Session::thread_of(const Json& arguments) const {
  const std::int64_t number = require_whole(arguments, "threadId");
  if (number < 1 || number > static_cast<std::int64_t>(threads_.size()))
    throw RequestError("threadId: there is no thread " + std::to_string(number) +
                       "; expected one from `threads`");
  return threads_[static_cast<std::size_t>(number) - 1];
}

/// Returns the source as clients open it: the file, or the text that the device has.
Json Session::source_json(std::size_t device) const {
  const DeviceInfo& info = devices_[device];
  const Source source = source_of(device);
  const bool is_mapped = source.path.empty() && !info.mapped.empty() && source.text == info.mapped_text;
  const std::string path = is_mapped ? info.mapped : source.path;
  if (!path.empty()) return {{"name", std::filesystem::path(path).filename().string()}, {"path", path}};
  return {{"name", info.name + " (read back)"}, {"sourceReference", static_cast<int>(device) + 1}};
}

Json Session::stack_trace(const Json& arguments) {
  const Thread& thread = thread_of(arguments);
  const bool has_many = devices_[thread.device].has_many;
  const Json reply = stack_of(thread.device);
  std::vector<Json> lines;
  for (const Json& stack : reply["stacks"]) {
    if (has_many && text_or(stack, "program") != thread.program) continue;
    for (const Json& frame : stack["frames"]) lines.push_back(frame);
    break;
  }
  const bool has_stopped = stop_.is_object() && stop_.contains("line") &&
                           stop_.value("device", std::string()) == devices_[thread.device].name &&
                           (!has_many || text_or(stop_, "program") == thread.program);
  if (has_stopped) {
    // The program may have continued within the tick, but users expect the line at which it stopped.
    const auto callers = stop_.value("callers", std::size_t{0});
    if (lines.size() > callers)
      lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(callers));
    lines.insert(lines.begin(), stop_);
    lines.front()["text"] = stop_.value("code", std::string());
  }
  const Json source = lines.empty() ? Json() : source_json(thread.device);
  Json frames = Json::array();
  const auto count = static_cast<std::int64_t>(std::min(lines.size(), static_cast<std::size_t>(kPerThread)));
  const std::int64_t first = std::max<std::int64_t>(0, whole_or(arguments, "startFrame", 0));
  const std::int64_t max = whole_or(arguments, "levels", 0);
  for (std::int64_t i = first; i < count && (max <= 0 || i - first < max); ++i) {
    const Json& one = lines[static_cast<std::size_t>(i)];
    const int line = one.value("line", 0);
    const std::string text = text_or(one, "text");
    frames.push_back({{"id", require_whole(arguments, "threadId") * kPerThread + i},
                      {"name", text.empty() ? thread_name(thread) : text},
                      {"line", std::max(0, line - line_offset_)},
                      {"column", line > 0 ? 1 - column_offset_ : 0}});
    if (line > 0) frames.back()["source"] = source;
    if (one.contains("instruction"))
      frames.back()["instructionPointerReference"] =
          address_of(thread.device, text_or(one, "program"), one["instruction"].get<std::int64_t>());
  }
  return {{"stackFrames", std::move(frames)}, {"totalFrames", count}};
}

std::size_t Session::device_of_source(std::int64_t reference) const {
  if (reference < 1 || reference > static_cast<std::int64_t>(devices_.size()))
    throw RequestError("sourceReference: there is no source " + std::to_string(reference) +
                       "; expected one from `stackTrace`");
  return static_cast<std::size_t>(reference) - 1;
}

Json Session::source(const Json& arguments) {
  const std::int64_t reference = arguments.contains("sourceReference")
                                     ? require_whole(arguments, "sourceReference")
                                     : require_whole(require(arguments, "source"), "sourceReference");
  return {{"content",
           link_->ask({{"do", "source"}, {"device", devices_[device_of_source(reference)].name}})["text"]}};
}

std::size_t Session::device_of_frame(const Json& arguments) const {
  if (!arguments.contains("frameId") || arguments["frameId"].is_null()) return 0;
  const std::int64_t thread = require_whole(arguments, "frameId") / kPerThread;
  if (thread < 1 || thread > static_cast<std::int64_t>(threads_.size()))
    throw RequestError("frameId: there is no such frame; expected one from `stackTrace`");
  return threads_[static_cast<std::size_t>(thread) - 1].device;
}

}  // namespace understudy::emulator::dap
