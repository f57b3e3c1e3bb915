#include "emulator/command_line/ctl_recording.h"

#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlaces =
    "a time such as 1.5s, or tick, frame or event, optionally with a number and back";

std::string time_text(const Json& entry, const char* key) {
  return format_duration(SimTime{entry.at(key).get<std::int64_t>()});
}

void print_moment(const std::string& time, const std::string& text) {
  std::printf("%s\n", one_line(time + " " + text).c_str());
}

/// Adds the place of `seek 1.5s`, `seek frame` or `seek tick 5 back`.
void add_place(const ControlArguments& arguments, Json& message) {
  const std::vector<std::string>& words = arguments.operands;
  const auto refuse = [&](const std::string& why) {
    return UsageError("ctl seek: " + why + "; expected " + kPlaces);
  };
  if (words.empty()) throw refuse("the time is missing");
  if (words[0] != "tick" && words[0] != "frame" && words[0] != "event") {
    const auto time = parse_duration(words[0]);
    if (!time) throw refuse(understudy::quoted(words[0]) + " is not understood");
    if (words.size() > 1) throw refuse(understudy::quoted(words[1]) + " is one argument too many");
    message["to_ns"] = time->count();
    return;
  }
  message["by"] = words[0];
  std::int64_t steps = 1;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = parse_integer(words[i]);
    const bool is_back = words[i] == "back" && i + 1 == words.size();
    if (is_back) {
      steps = -steps;
    } else if (number && *number > 0 && i == 1) {
      steps = *number;
    } else {
      throw refuse(understudy::quoted(words[i]) + " is not understood");
    }
  }
  message["steps"] = steps;
}

void add_first_mark(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.empty()) return;
  const std::string& word = arguments.operands.back();
  const auto number = word.starts_with("from=") ? parse_integer(word.substr(5)) : std::nullopt;
  if (arguments.operands.size() > 1 || !number || *number < 0)
    throw UsageError("ctl timeline: " + understudy::quoted(word) + " is not understood; expected from=500");
  message["from"] = *number;
}

}  // namespace

bool add_recording_words(const ControlArguments& arguments, Json& message) {
  if (arguments.verb == "seek") {
    add_place(arguments, message);
    return true;
  }
  if (arguments.verb == "timeline") {
    add_first_mark(arguments, message);
    return true;
  }
  if (arguments.verb != "what-if") return false;
  if (arguments.operands.empty()) return true;
  if (arguments.operands.size() > 1 || arguments.operands[0] != "off")
    throw UsageError("ctl what-if: " + understudy::quoted(arguments.operands.back()) +
                     " is not understood; expected nothing, or off");
  message["off"] = true;
  return true;
}

void print_timeline(const Json& reply) {
  const Json& timeline = reply.at("timeline");
  std::printf("from %s to %s, now at %s%s\n", time_text(timeline, "begin_ns").c_str(),
              time_text(timeline, "end_ns").c_str(), time_text(timeline, "at_ns").c_str(),
              timeline.contains("altered_at_ns") ? ", altered" : "");
  if (timeline.contains("story")) {
    const Json& story = timeline.at("story");
    for (const Json& moment : story.at("moments"))
      print_moment(time_text(moment, "time_ns"), moment.at("text").get<std::string>());
    std::printf("%s\n", one_line(story.at("text").get<std::string>()).c_str());
  }
  for (const Json& mark : timeline.at("marks")) {
    std::string text = mark.at("what").get<std::string>();
    for (const char* key : {"device", "line", "text"}) {
      if (mark.contains(key)) text += " " + mark.at(key).get<std::string>();
    }
    print_moment(time_text(mark, "time_ns"), text);
  }
  if (reply.contains("next")) std::printf("... from=%s continues\n", reply.at("next").dump().c_str());
}

}  // namespace understudy::emulator::command_line
