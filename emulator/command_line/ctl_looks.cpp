#include "emulator/command_line/ctl_looks.h"

#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/ctl_coverage.h"
#include "emulator/command_line/ctl_recording.h"
#include "emulator/command_line/ctl_scope.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

UsageError stray_word(const ControlArguments& arguments, const std::string& word, const char* expected) {
  return UsageError{"ctl " + arguments.verb + ": " + understudy::quoted(word) +
                    " is not understood; expected " + expected};
}

UsageError extra_word(const ControlArguments& arguments) {
  return UsageError{"ctl " + arguments.verb + ": " + understudy::quoted(arguments.operands[1]) +
                    " is one argument too many; expected nothing after " +
                    understudy::quoted(arguments.operands[0])};
}

std::int64_t require_whole(const ControlArguments& arguments, const std::string& word, const char* expected) {
  const auto number = parse_integer(word);
  if (!number || *number < 0) throw stray_word(arguments, word, expected);
  return *number;
}

/// The key and the value of a word such as "find=speed".
struct KeyedWord {
  std::string key;
  std::string value;
};
std::optional<KeyedWord> keyed(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return std::nullopt;
  return KeyedWord{word.substr(0, equals), word.substr(equals + 1)};
}

void add_one_device(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() > 1) throw extra_word(arguments);
  if (!arguments.operands.empty()) message["device"] = arguments.operands[0];
}

void add_coverage_words(const ControlArguments& arguments, Json& message) {
  for (const std::string& word : arguments.operands) {
    const char* const key = word == "again" ? "again" : "device";
    if (message.contains(key)) throw stray_word(arguments, word, "at most one device, and `again`");
    if (word == "again") {
      message["again"] = true;
    } else {
      message["device"] = word;
    }
  }
}

void add_page_words(const ControlArguments& arguments, Json& message) {
  constexpr const char* kExpected = "DEVICE, section=N, find=TEXT or from=N";
  for (const std::string& word : arguments.operands) {
    const auto pair = keyed(word);
    if (!pair) {
      message["device"] = word;
    } else if (pair->key == "find") {
      message["find"] = pair->value;
    } else if (pair->key == "section" || pair->key == "from") {
      message[pair->key] = require_whole(arguments, pair->value, kExpected);
    } else {
      throw stray_word(arguments, word, kExpected);
    }
  }
}

void add_step_words(const ControlArguments& arguments, Json& message) {
  const std::vector<std::string>& words = arguments.operands;
  if (words.empty()) return;
  if (parse_integer(words[0])) {
    if (words.size() > 1) throw extra_word(arguments);
    message["ticks"] = require_whole(arguments, words[0], "a number of ticks, such as 10");
    return;
  }
  message["what"] = words[0];
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto pair = keyed(words[i]);
    if (words[i] == "back") {
      message["back"] = true;
    } else if (!pair) {
      message["device"] = words[i];
    } else if (pair->key == "program" || pair->key == "within") {
      message[pair->key] = pair->value;
    } else {
      throw stray_word(arguments, words[i], "DEVICE, program=NAME or within=1h");
    }
  }
}

void add_variables_words(const ControlArguments& arguments, Json& message) {
  for (const std::string& word : arguments.operands) {
    const auto pair = keyed(word);
    if (pair && pair->key != "scope")
      throw stray_word(arguments, word, "DEVICE or scope=program|axes|terminals");
    message[pair ? "scope" : "device"] = pair ? pair->value : word;
  }
}

void add_break_words(const ControlArguments& arguments, Json& message) {
  constexpr const char* kExpected =
      "DEVICE LINE, instruction=N, program=NAME, write=NAME, by=WHO, on=EVENT, when=CONDITION, nth=N or "
      "log=TEXT";
  const std::vector<std::string>& words = arguments.operands;
  if (!words.empty() && words[0] == "delete") {
    if (words.size() != 2) throw UsageError("ctl break: expected a number after delete, or all");
    message["delete"] = words[1];
    if (words[1] != "all") message["delete"] = require_whole(arguments, words[1], "a number, or all");
    return;
  }
  for (const std::string& word : words) {
    const auto pair = keyed(word);
    if (!pair && parse_integer(word)) {
      if (message.contains("line")) throw stray_word(arguments, word, "one line");
      message["line"] = require_whole(arguments, word, kExpected);
    } else if (!pair) {
      message["device"] = word;
    } else if (pair->key == "instruction" || pair->key == "nth") {
      message[pair->key] = require_whole(arguments, pair->value, kExpected);
    } else if (pair->key == "program" || pair->key == "write" || pair->key == "by" || pair->key == "on" ||
               pair->key == "when" || pair->key == "log") {
      message[pair->key] = pair->value;
    } else {
      throw stray_word(arguments, word, kExpected);
    }
  }
}

void add_scope_words(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.empty()) return;
  if (arguments.operands[0] == "off") {
    message["off"] = true;
    return;
  }
  message["names"] = Json::array();
  for (const std::string& word : arguments.operands) {
    const auto pair = keyed(word);
    if (word.starts_with("when=")) {
      message["condition"] = word.substr(5);
    } else if (pair && (pair->key == "before" || pair->key == "after")) {
      message[pair->key] = pair->value;
    } else {
      message["names"].push_back(word);
    }
  }
}

void add_spans_words(const ControlArguments& arguments, Json& message) {
  constexpr const char* kExpected = "from=1s or to=2s";
  constexpr int kFine = 4'000;  // dots: large enough to merge as few spans as possible
  message["dots"] = kFine;
  for (const std::string& word : arguments.operands) {
    const auto pair = keyed(word);
    if (!pair || (pair->key != "from" && pair->key != "to")) throw stray_word(arguments, word, kExpected);
    const auto time = parse_duration(pair->value);
    if (!time) throw stray_word(arguments, word, kExpected);
    message[pair->key + "_ns"] = time->count();
  }
}

void add_send_words(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() > 2) {
    throw UsageError("ctl send: " + understudy::quoted(arguments.operands[2]) +
                     " is one argument too many; expected the bytes in quotes, such as '01 03 00 00 00 01'");
  }
  if (arguments.operands.empty())
    throw UsageError("ctl send: expected a line, and bytes in hexadecimal digits or text=TEXT");
  if (arguments.operands.size() == 2) message["line"] = arguments.operands[0];
  const std::string& what = arguments.operands.back();
  if (what.starts_with("text=")) {
    message["text"] = what.substr(5) + "\r";
  } else {
    message["bytes"] = what;
    message["checksum"] = true;
  }
}

std::string time_text(const Json& entry) {
  return format_duration(SimTime{entry.at("time_ns").get<std::int64_t>()});
}

std::string event_text(const Json& event) {
  std::string text = event.at("what").get<std::string>();
  for (const char* key : {"name", "device", "line"}) {
    if (!event.contains(key)) continue;
    text += " " + event.at(key).get<std::string>();
    break;
  }
  if (event.contains("value")) {
    const Json& value = event.at("value");  // spans contain it as a text
    text += " = " + (value.is_string() ? value.get<std::string>() : value.dump());
  }
  if (event.contains("text")) text += ": " + event.at("text").get<std::string>();
  if (event.contains("by")) text += "  (" + event.at("by").get<std::string>() + ")";
  return text;
}

void print_events(const Json& events) {
  for (const Json& event : events)
    std::printf("%s\n", one_line(time_text(event) + " " + event_text(event)).c_str());
}

std::string span_text(const Json& span) {
  if (span.at("kind") == "event") return event_text(span);
  std::string text = span.value("text", std::string());
  if (span.contains("line")) text = "line " + span.at("line").dump() + ": " + text;
  if (span.contains("reply")) text += " -> " + span.at("reply").get<std::string>();
  if (span.contains("remark")) text += " (" + span.at("remark").get<std::string>() + ")";
  if (span.contains("waits_for")) text += "; waits for " + span.at("waits_for").get<std::string>();
  return text;
}

void print_spans(const Json& reply) {
  const auto time_of = [](const Json& span, const char* key) {
    return SimTime{span.at(key).get<std::int64_t>()};
  };
  for (const Json& span : reply.at("spans")) {
    const SimTime begin = time_of(span, "begin_ns");
    const SimTime length = time_of(span, "end_ns") - begin;
    std::string text =
        format_duration(begin) + " " + span.at("lane").get<std::string>() + ": " + span_text(span);
    if (length > SimTime{0}) text += ", " + format_duration(length);
    if (span.contains("count")) text += ", " + span.at("count").dump() + " of them";
    std::printf("%s\n", one_line(text).c_str());
  }
  if (reply.contains("next")) {
    std::printf("... of %s; from=%s continues\n", reply.at("of").dump().c_str(),
                format_duration(time_of(reply.at("spans").back(), "begin_ns")).c_str());
  }
}

void print_programs(const Json& programs) {
  for (const Json& place : programs) {
    std::string text = place.value("program", std::string());
    text += (text.empty() ? "" : " ") + place.at("state").get<std::string>();
    if (place.contains("line")) text += ", line " + place.at("line").dump();
    if (place.contains("text")) text += ": " + place.at("text").get<std::string>();
    if (place.contains("waits_for")) text += "; waits for " + place.at("waits_for").get<std::string>();
    if (place.contains("why")) text += "; " + place.at("why").get<std::string>();
    std::printf("%s\n", one_line(text).c_str());
  }
}

void print_breakpoint(const Json& breakpoint) {
  std::string text = breakpoint.at("number").dump();
  for (const auto& [key, value] : breakpoint.items()) {
    if (key == "number" || key == "kind") continue;
    text += " " + key + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
  }
  std::printf("%s\n", one_line(text).c_str());
}

void print_stacks(const Json& reply) {
  for (const Json& stack : reply.at("stacks")) {
    const std::string program = stack.value("program", std::string());
    std::printf(
        "%s\n",
        one_line(program + (program.empty() ? "" : " ") + stack.at("state").get<std::string>()).c_str());
    for (const Json& frame : stack.at("frames")) {
      std::printf("  line %s %s\n", frame.at("line").dump().c_str(),
                  one_line(frame.value("text", std::string())).c_str());
    }
  }
}

void print_scopes(const Json& reply) {
  for (const Json& scope : reply.at("scopes")) {
    for (const auto& [name, value] : scope.at("values").items())
      std::printf("%s %s\n", one_line(name).c_str(), value.dump().c_str());
  }
}

void print_registers(const Json& reply) {
  for (const Json& row : reply.at("registers")) {
    std::string text =
        row.contains("address") ? row.at("address").get<std::string>() : row.at("number").get<std::string>();
    text += " " + row.at("name").get<std::string>() + " " + row.at("access").get<std::string>();
    if (row.contains("min")) text += " " + row.at("min").dump() + " to " + row.at("max").dump();
    if (row.contains("unit")) text += " " + row.at("unit").get<std::string>();
    if (row.at("kept").get<bool>()) text += ", kept";
    std::printf("%s\n", one_line(text).c_str());
  }
  if (reply.contains("next")) {
    std::printf("... of %s; from=%s continues\n", reply.at("of").dump().c_str(),
                reply.at("next").dump().c_str());
  }
}

}  // namespace

bool add_look_words(const ControlArguments& arguments, Json& message) {
  const std::string& verb = arguments.verb;
  if (verb == "bench" || verb == "where" || verb == "stack" || verb == "source" || verb == "choices") {
    add_one_device(arguments, message);
  } else if (verb == "coverage") {
    add_coverage_words(arguments, message);
  } else if (verb == "registers") {
    add_page_words(arguments, message);
  } else if (verb == "events") {
    if (arguments.operands.size() > 1) throw extra_word(arguments);
    if (!arguments.operands.empty())
      message["last"] = require_whole(arguments, arguments.operands[0], "a number of events, such as 10");
  } else if (verb == "variables") {
    add_variables_words(arguments, message);
  } else if (verb == "step") {
    add_step_words(arguments, message);
  } else if (verb == "break") {
    add_break_words(arguments, message);
  } else if (verb == "continue") {
    if (arguments.operands.size() > 1) throw extra_word(arguments);
    if (!arguments.operands.empty() && arguments.operands[0] == "back") {
      message["back"] = true;
    } else if (!arguments.operands.empty()) {
      const auto pair = keyed(arguments.operands[0]);
      if (!pair || pair->key != "within")
        throw stray_word(arguments, arguments.operands[0], "within=10s or back");
      message["within"] = pair->value;
    }
  } else if (verb == "speed") {
    if (arguments.operands.size() != 1)
      throw UsageError("ctl speed: expected real, free, manual or a factor");
    message["to"] = arguments.operands[0];
  } else if (verb == "scope") {
    add_scope_words(arguments, message);
  } else if (verb == "spans") {
    add_spans_words(arguments, message);
  } else if (verb == "send") {
    add_send_words(arguments, message);
  } else {
    return add_recording_words(arguments, message);
  }
  return true;
}

bool print_look(const Json& reply) {
  if (reply.contains("events")) {
    print_events(reply.at("events"));
  } else if (reply.contains("spans")) {
    print_spans(reply);
  } else if (reply.contains("timeline")) {
    print_timeline(reply);
  } else if (reply.contains("breakpoints")) {
    for (const Json& breakpoint : reply.at("breakpoints")) print_breakpoint(breakpoint);
  } else if (reply.contains("breakpoint")) {
    print_breakpoint(reply.at("breakpoint"));
  } else if (reply.contains("stacks")) {
    print_stacks(reply);
  } else if (reply.contains("scopes")) {
    print_scopes(reply);
  } else if (reply.contains("stop")) {
    std::printf("%s\n", one_line(reply.at("stop").at("text").get<std::string>()).c_str());
  } else if (reply.contains("programs")) {
    print_programs(reply.at("programs"));
  } else if (reply.contains("registers")) {
    print_registers(reply);
  } else if (reply.contains("covered")) {
    print_coverage(reply);
  } else if (reply.contains("next_frame")) {
    std::printf("frame %s\n", reply.at("next_frame").dump().c_str());
  } else {
    if (reply.contains("scope")) {
      print_scope(reply.at("scope"));
      return true;
    }
    for (const char* key : {"bench", "device", "choices"}) {
      if (!reply.contains(key)) continue;
      std::printf("%s\n", reply.at(key).dump(2, ' ', false, Json::error_handler_t::replace).c_str());
      return true;
    }
    return false;
  }
  return true;
}

}  // namespace understudy::emulator::command_line
