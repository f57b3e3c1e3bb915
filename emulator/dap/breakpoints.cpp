// Sets the breakpoints of a session: in sources, on data, and on events.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/text_file.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

std::filesystem::path whole_path(const std::string& name) {
  std::error_code error;
  auto canonical = std::filesystem::weakly_canonical(name, error);
  return error ? std::filesystem::path(name) : canonical;
}

std::vector<std::string_view> lines_of(const std::string& text) {
  std::vector<std::string_view> lines;
  for (const TextLine line : TextLines(text)) {
    std::string_view one = line.text;
    while (one.ends_with('\r') || one.ends_with(' ')) one.remove_suffix(1);
    lines.push_back(one);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

/// Returns the first difference between a file and the device's program, or an empty text.
std::string difference(const std::string& device, const std::string& file, const std::string& loaded) {
  const auto in_file = lines_of(file);
  const auto in_device = lines_of(loaded);
  for (std::size_t i = 0; i < std::max(in_file.size(), in_device.size()); ++i) {
    const auto line = [&](const auto& lines) {
      return i < lines.size() ? quoted(lines[i]) : std::string("nothing");
    };
    if (i < in_file.size() && i < in_device.size() && in_file[i] == in_device[i]) continue;
    return "line " + std::to_string(i + 1) + " is " + line(in_file) + " in the file, and " + line(in_device) +
           " in " + device;
  }
  return {};
}

}  // namespace

void add_common_fields(const Json& wanted, Json& message) {
  const std::string condition = text_or(wanted, "condition");
  if (!condition.empty()) message["when"] = condition;
  const std::string hits = text_or(wanted, "hitCondition");
  if (!hits.empty()) {
    std::string_view count = hits;
    if (count.starts_with(">=")) count.remove_prefix(2);
    while (count.starts_with(' ')) count.remove_prefix(1);
    const auto number = parse_integer(count);
    if (!number || *number < 1)
      throw RequestError("hitCondition: " + quoted(hits) + " is not a count; expected a whole number from 1");
    message["nth"] = *number;
  }
  const std::string log = text_or(wanted, "logMessage");
  if (!log.empty()) message["log"] = log;
}

/// Deletes the session's breakpoints from the bench, but not from the session.
void Session::delete_from_bench() {
  for (SetPoint& point : points_) {
    if (point.number == 0) continue;
    try {
      link_->ask({{"do", "break"}, {"delete", point.number}});
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError&) {  // somebody else has deleted it
    }
    point.number = 0;
  }
}

/// Sets all breakpoints again; their hit counts restart.
void Session::set_again() {
  for (SetPoint& point : points_) {
    try {
      point.number = link_->ask(point.message)["breakpoint"]["number"].get<int>();
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError& error) {
      event("breakpoint",
            {{"reason", "changed"},
             {"breakpoint", {{"id", point.id}, {"verified", false}, {"message", error.what()}}}});
    }
  }
}

void Session::delete_those(const std::string& key) {
  std::vector<SetPoint> others;
  std::vector<SetPoint> those;
  for (SetPoint& point : points_) (point.key == key ? those : others).push_back(std::move(point));
  points_ = std::move(those);
  delete_from_bench();
  points_ = std::move(others);
}

/// Sets a breakpoint. The reply reports a refusal, so the other breakpoints of a request are still set.
Json Session::set_one(const std::string& key, int id, Json message) {
  try {
    const Json set = link_->ask(message)["breakpoint"];
    SetPoint point{.id = id, .key = key, .message = std::move(message), .number = set["number"].get<int>()};
    point.line = set.value("line", 0);
    point.device = device_of_name(set.value("device", std::string()));
    points_.push_back(std::move(point));
    Json response{{"id", id}, {"verified", set.value("found", true)}};
    if (set.contains("line")) response["line"] = set["line"].get<int>() - line_offset_;
    if (set.contains("moved_from"))
      response["message"] = "there is no instruction on line " + set["moved_from"].dump() +
                            "; the breakpoint has moved to line " + set["line"].dump();
    return response;
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError& error) {
    return {{"id", id}, {"verified", false}, {"message", error.what()}};
  }
}

/// Returns the devices that run a source. If none does, `why_none` explains why. `what_differs` describes how
/// the file differs from the programs that the devices have loaded.
std::vector<std::size_t> Session::devices_with(const Json& source, std::string& why_none,
                                               std::string& what_differs) {
  if (const auto reference = whole_or(source, "sourceReference", 0); reference > 0)
    return {device_of_source(reference)};
  const std::string path = require_text(source, "path");
  const std::string name = std::filesystem::path(path).filename().string();
  const auto file = read_text_file(path);
  std::vector<std::size_t> found;
  std::string known;
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    if (!devices_[d].has_program) continue;
    const Source has = source_of(d);
    const std::string differs = file ? difference(devices_[d].name, *file, has.text) : std::string();
    if (!has.path.empty() && whole_path(has.path) == whole_path(path)) {
      found.push_back(d);
      if (!differs.empty()) what_differs = name + ": " + differs;
    } else if (has.path.empty() && !has.text.empty() && file && differs.empty()) {
      found.push_back(d);
      devices_[d].mapped = path;
      devices_[d].mapped_text = has.text;
    } else {
      known += "; " + devices_[d].name + " has ";
      if (has.text.empty())
        known += "no program";
      else if (!has.path.empty())
        known += std::filesystem::path(has.path).filename().string();
      else
        known += "a different program: " + (differs.empty() ? "the file cannot be read" : differs);
    }
  }
  if (found.empty()) why_none = "no device runs " + name + known;
  return found;
}

/// Sets a line's breakpoint in all devices. Returns the breakpoint of the first device.
Json Session::set_line(const std::string& key, const Json& wanted, const std::vector<std::size_t>& devices) {
  const int id = ++last_id_;
  Json response;
  try {
    const std::int64_t line = require_whole(wanted, "line") + line_offset_;
    for (const std::size_t device : devices) {
      Json message{{"do", "break"}, {"device", devices_[device].name}, {"line", line}};
      add_common_fields(wanted, message);
      Json one = set_one(key, id, std::move(message));
      if (response.is_null()) response = std::move(one);
    }
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError& error) {
    response = {{"id", id}, {"verified", false}, {"message", error.what()}};
  }
  return response;
}

Json Session::set_breakpoints(const Json& arguments) {
  const Json& source = require(arguments, "source");
  if (!source.is_object()) throw RequestError("source: expected an object");
  const std::int64_t reference = whole_or(source, "sourceReference", 0);
  const std::string key =
      reference > 0 ? "read back " + std::to_string(reference) : "file " + require_text(source, "path");
  const Json wanted =
      arguments.contains("breakpoints") ? require_list(arguments, "breakpoints") : Json::array();
  delete_those(key);
  std::string why_none;
  std::string what_differs;
  const std::vector<std::size_t> devices = devices_with(source, why_none, what_differs);
  if (!what_differs.empty() && !wanted.empty()) print(what_differs + "\n");
  Json all = Json::array();
  for (const Json& one : wanted) {
    Json response = set_line(key, one, devices);
    if (response.is_null()) response = {{"id", last_id_}, {"verified", false}, {"message", why_none}};
    if (!what_differs.empty() && !response.contains("message")) response["message"] = what_differs;
    all.push_back(std::move(response));
  }
  return {{"breakpoints", std::move(all)}};
}

/// Returns the lines that have an instruction.
Json Session::breakpoint_locations(const Json& arguments) {
  const Json& source = require(arguments, "source");
  const std::int64_t first = require_whole(arguments, "line") + line_offset_;
  const std::int64_t last = whole_or(arguments, "endLine", first - line_offset_) + line_offset_;
  std::string why_none;
  std::string what_differs;
  const std::vector<std::size_t> devices = devices_with(source, why_none, what_differs);
  Json all = Json::array();
  if (devices.empty()) return {{"breakpoints", std::move(all)}};
  for (const Json& line : source_of(devices.front()).lines) {
    if (line >= first && line <= last) all.push_back({{"line", line.get<std::int64_t>() - line_offset_}});
  }
  return {{"breakpoints", std::move(all)}};
}

Json Session::set_exception_breakpoints(const Json& arguments) {
  Json wanted = Json::array();
  if (arguments.contains("filters")) {
    for (const Json& filter : require_list(arguments, "filters")) wanted.push_back({{"filterId", filter}});
  }
  if (arguments.contains("filterOptions")) {
    for (const Json& option : require_list(arguments, "filterOptions")) wanted.push_back(option);
  }
  delete_those(kEvents);
  Json all = Json::array();
  for (const Json& option : wanted) {
    const int id = ++last_id_;
    Json message{{"do", "break"}, {"on", require_text(option, "filterId")}};
    add_common_fields(option, message);
    all.push_back(set_one(kEvents, id, std::move(message)));
  }
  return {{"breakpoints", std::move(all)}};
}

Json Session::data_breakpoint_info(const Json& arguments) {
  const std::string name = require_text(arguments, "name");
  const std::int64_t reference = whole_or(arguments, "variablesReference", 0);
  const std::string whole =
      whole_name(name, reference > 0 ? device_of_reference(reference) : device_of_frame(arguments));
  try {
    link_->ask({{"do", "get"}, {"names", {whole}}});
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError& error) {
    return {{"dataId", nullptr}, {"description", error.what()}};
  }
  return {{"dataId", whole}, {"description", whole}, {"accessTypes", {"write"}}, {"canPersist", true}};
}

Json Session::set_data_breakpoints(const Json& arguments) {
  const Json& wanted = require_list(arguments, "breakpoints");
  delete_those(kData);
  Json all = Json::array();
  for (const Json& one : wanted) {
    const int id = ++last_id_;
    try {
      Json message{{"do", "break"}, {"write", require_text(one, "dataId")}};
      add_common_fields(one, message);
      all.push_back(set_one(kData, id, std::move(message)));
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError& error) {
      all.push_back({{"id", id}, {"verified", false}, {"message", error.what()}});
    }
  }
  return {{"breakpoints", std::move(all)}};
}

}  // namespace understudy::emulator::dap
