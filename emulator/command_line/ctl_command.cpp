#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/content_kind.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/ctl_coverage.h"
#include "emulator/command_line/ctl_looks.h"
#include "emulator/command_line/ctl_scope.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/more_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/value_text.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

/// Returns "NAME=VALUE" operands as an object. Words that are not numbers are passed on unchanged for the
/// daemon to interpret.
Json assignments(const ControlArguments& arguments) {
  Json values = Json::object();
  for (const std::string& operand : arguments.operands) {
    const std::size_t equals = operand.find('=');
    const std::string name = operand.substr(0, equals);
    const std::string text = equals == std::string::npos ? std::string() : operand.substr(equals + 1);
    if (name.empty() || text.empty())
      throw UsageError("ctl " + arguments.verb + ": " + understudy::quoted(operand) +
                       " is not understood; expected NAME=VALUE");
    if (values.contains(name))
      throw UsageError("ctl " + arguments.verb + ": " + understudy::quoted(name) +
                       " is given twice; expected it only once");
    if (const auto whole = parse_integer(text)) {
      values[name] = *whole;
    } else if (const auto real = parse_real(text)) {
      values[name] = *real;
    } else {
      values[name] = text;
    }
  }
  if (values.empty()) throw UsageError("ctl " + arguments.verb + ": nothing to do; expected NAME=VALUE");
  return values;
}

/// Returns "NAME=LEVEL" operands as an object. A level is a whole number, or a word or voltage for the daemon
/// to interpret.
Json levels(const ControlArguments& arguments) {
  Json values = Json::object();
  for (const std::string& operand : arguments.operands) {
    const std::size_t equals = operand.find('=');
    const std::string name = operand.substr(0, equals);
    if (equals == std::string::npos || name.empty() || equals + 1 == operand.size())
      throw UsageError("ctl input: " + understudy::quoted(operand) +
                       " is not understood; expected NAME=LEVEL");
    if (values.contains(name))
      throw UsageError("ctl input: " + understudy::quoted(name) + " is given twice; expected it only once");
    const std::string level = operand.substr(equals + 1);
    if (const auto number = parse_integer(level)) {
      values[name] = *number;
    } else {
      values[name] = level;
    }
  }
  if (values.empty()) throw UsageError("ctl input: nothing to do; expected NAME=LEVEL");
  return values;
}

/// Returns a fault such as "drop feeder nth=3" as an object that begins with its kind and place.
Json fault_of(const std::vector<std::string>& operands) {
  Json fault{{operands[0], operands[1]}};
  for (std::size_t i = 2; i < operands.size(); ++i) {
    const std::size_t equals = operands[i].find('=');
    const std::string name = operands[i].substr(0, equals);
    if (equals == std::string::npos || name.empty())
      throw UsageError("ctl inject: " + understudy::quoted(operands[i]) +
                       " is not understood; expected NAME=VALUE");
    if (fault.contains(name))
      throw UsageError("ctl inject: " + understudy::quoted(name) + " is given twice; expected it only once");
    fault[name] = operands[i].substr(equals + 1);
  }
  return fault;
}

/// Describes the progress of a fault that waits for its condition.
std::string course_text(const Json& fault) {
  std::string text;
  const auto count = [&](const char* key, const char* word) {
    if (!fault.contains(key)) return;
    text += (text.empty() ? ": " : ", ") + std::string(word) + " " +
            std::to_string(fault.at(key).get<std::int64_t>());
  };
  count("seen", "seen");
  count("matched", "matched");
  count("hits", "hit");
  if (fault.value("in_force", false)) text += ", in force";
  return text;
}

std::string listing_of(const std::string& path) {
  const auto text = read_text_argument(path);
  if (!text) throw UsageError("ctl program: " + path + ": " + text.why + "; expected a listing");
  if (const std::string why = is_another_kind(*text, ContentKind::program); !why.empty())
    throw UsageError("ctl program: " + path + ": " + why);
  // An empty text comes from a failed command before the pipe, or from an unsaved file. It must not delete
  // the program.
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
    throw UsageError("ctl program: " + (path == "-" ? std::string("standard input is") : path + ": is") +
                     " empty; expected a listing");
  return *text;
}

std::int64_t require_number(const ControlArguments& arguments) {
  const auto number = parse_integer(arguments.operands[0]);
  if (!number) {
    throw UsageError("ctl clear: " + understudy::quoted(arguments.operands[0]) +
                     " is not understood; expected the number of a fault, or all");
  }
  return *number;
}

void add_names(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.empty())
    throw UsageError("ctl get: nothing to read; expected a name such as feeder.Cord_A");
  message["names"] = arguments.operands;
}

void add_expression(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() != 1) {
    throw UsageError("ctl eval: expected one expression, such as 'feeder.Cord_A / 3200'");
  }
  message["expression"] = arguments.operands[0];
}

void add_assignments(const ControlArguments& arguments, Json& message) {
  message["values"] = assignments(arguments);
}

void add_levels(const ControlArguments& arguments, Json& message) { message["values"] = levels(arguments); }

void add_turns(const ControlArguments& arguments, Json& message) {
  ControlArguments turns = arguments;
  std::erase_if(turns.operands, [&](const std::string& operand) {
    if (!operand.starts_with("in=")) return false;
    message["in"] = operand.substr(3);
    return true;
  });
  message["values"] = assignments(turns);
}

void add_power(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.empty() || arguments.operands.size() > 2) {
    throw UsageError("ctl power: expected a device, and on, off or cycle");
  }
  if (arguments.operands.size() == 2) message["device"] = arguments.operands.front();
  message["to"] = arguments.operands.back();
}

void add_program(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() > 2) throw UsageError("ctl program: expected a device and a listing");
  if (!arguments.operands.empty()) message["device"] = arguments.operands.front();
  if (arguments.operands.size() == 2) message["text"] = listing_of(arguments.operands.back());
}

void add_command(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.empty() || arguments.operands.size() > 2)
    throw UsageError("ctl command: expected a device and a command in quotes, such as cell 'MOVE X 1000'");
  if (arguments.operands.size() == 2) message["device"] = arguments.operands.front();
  message["text"] = arguments.operands.back();
}

void add_fault(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() < 2) throw UsageError("ctl inject: expected a fault and its place");
  message["fault"] = fault_of(arguments.operands);
}

void add_fault_number(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() != 1) throw UsageError("ctl clear: expected the number of a fault, or all");
  if (arguments.operands[0] != "all") message["number"] = require_number(arguments);
}

void add_file(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() != 1 || arguments.operands[0].empty()) {
    throw UsageError("ctl " + arguments.verb + ": expected one file");
  }
  message["file"] = std::filesystem::absolute(arguments.operands[0]).string();
}

void add_duration(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() != 1 || !parse_duration(arguments.operands[0])) {
    throw UsageError("ctl advance: expected one duration with a unit, such as 250ms");
  }
  message["by"] = arguments.operands[0];
}

void add_condition(const ControlArguments& arguments, Json& message) {
  if (arguments.operands.size() != 1) {
    throw UsageError("ctl run-until: expected one condition, such as 'feeder.STATUS.4 == 0'");
  }
  message["condition"] = arguments.operands[0];
  message["within"] = arguments.within;
}

struct VerbRow {
  std::string_view verb;
  void (*add_operands)(const ControlArguments& arguments, Json& message);
};

/// The verbs with their own operands. Other verbs only display something, or have no operands.
constexpr VerbRow kVerbs[] = {
    {"get", add_names},          {"eval", add_expression},     {"set", add_assignments},
    {"input", add_levels},       {"turn", add_turns},          {"power", add_power},
    {"program", add_program},    {"command", add_command},     {"inject", add_fault},
    {"clear", add_fault_number}, {"snapshot", add_file},       {"restore", add_file},
    {"advance", add_duration},   {"run-until", add_condition},
};

Json message_for(const ControlArguments& arguments) {
  Json message{{"do", arguments.verb}};
  for (const VerbRow& row : kVerbs) {
    if (row.verb != arguments.verb) continue;
    row.add_operands(arguments, message);
    return message;
  }
  if (!add_look_words(arguments, message) && !arguments.operands.empty()) {
    throw UsageError("ctl " + arguments.verb + ": " + understudy::quoted(arguments.operands[0]) +
                     " is one argument too many; expected nothing after it");
  }
  return message;
}

void print_status(const Json& status) {
  const Json& lateness = status.at("lateness");
  std::printf("simulated time %s, speed %s%s\n", status.at("simulated_time").get<std::string>().c_str(),
              status.at("speed").get<std::string>().c_str(),
              status.at("paused").get<bool>() ? ", paused" : "");
  std::printf("lateness p50 %.1f us, p99 %.1f us, max %.1f us over %llu wake-ups, %llu slips\n",
              lateness.at("p50_us").get<double>(), lateness.at("p99_us").get<double>(),
              lateness.at("max_us").get<double>(), lateness.at("wakes").get<unsigned long long>(),
              lateness.at("slips").get<unsigned long long>());
  std::printf("ticks %llu stepped, %llu fast-forwarded\n",
              status.at("ticks").at("stepped").get<unsigned long long>(),
              status.at("ticks").at("crossed").get<unsigned long long>());
  for (const Json& line : status.at("lines")) {
    std::printf("line %s: %s -> %s, %s, %s, host %s", line.at("name").get<std::string>().c_str(),
                line.at("link").get<std::string>().c_str(), line.at("pty").get<std::string>().c_str(),
                line.at("settings").get<std::string>().c_str(), line.at("timing").get<std::string>().c_str(),
                line.at("host").get<std::string>().c_str());
    if (line.contains("host_baud")) std::printf(" at %d baud", line.at("host_baud").get<int>());
    std::printf("; %llu bytes in, %llu out, %llu unheard, %llu discarded\n",
                line.at("bytes_in").get<unsigned long long>(), line.at("bytes_out").get<unsigned long long>(),
                line.at("bytes_unheard").get<unsigned long long>(),
                line.at("bytes_discarded").get<unsigned long long>());
    for (const Json& station : line.at("stations")) {
      const std::string port =
          station.contains("port") ? " (" + station.at("port").get<std::string>() + ")" : "";
      if (!station.contains("address")) {  // a device with a text protocol
        std::printf("  %s%s: %llu requests, %llu replies\n", station.at("device").get<std::string>().c_str(),
                    port.c_str(), station.at("requests").get<unsigned long long>(),
                    station.at("replies").get<unsigned long long>());
        continue;
      }
      std::printf("  station %d %s%s: %llu requests, %llu replies, %llu of them exceptions\n",
                  station.at("address").get<int>(), station.at("device").get<std::string>().c_str(),
                  port.c_str(), station.at("requests").get<unsigned long long>(),
                  station.at("replies").get<unsigned long long>(),
                  station.at("exceptions").get<unsigned long long>());
    }
  }
  for (const Json& device : status.at("devices")) {
    std::printf(
        "device %s: %s, firmware %s%s%s%s\n", device.at("name").get<std::string>().c_str(),
        device.at("model").get<std::string>().c_str(), device.at("firmware").get<std::string>().c_str(),
        device.contains("pulse_format") ? ", pulses " : "",
        device.value("pulse_format", std::string()).c_str(), device.at("power") == "on" ? "" : ", no power");
    for (const auto& [axis, machine] : device.at("machines").items()) {
      std::printf("  machine %s: at %lld pulses, %lld lost", axis.c_str(),
                  machine.at("position_pulses").get<long long>(), machine.at("lost_pulses").get<long long>());
      if (const int duty = device.at("axes").at(axis).value("pwm_percent", 0); duty != 0)
        std::printf(", PWM %d %%", duty);
      if (machine.contains("drive"))
        std::printf(", drive %s", machine.at("drive").get<std::string>().c_str());
      std::printf("\n");
    }
  }
  for (const Json& fault : status.at("faults")) {
    std::printf("fault %lld %s%s\n", fault.at("number").get<long long>(),
                fault.at("fault").get<std::string>().c_str(), course_text(fault).c_str());
  }
}

}  // namespace

namespace {

/// Returns the position of the mistake in a rejected listing.
ProgramMistake mistake_of(const Json& reported, const std::string& before = "") {
  return {reported.at("line").get<int>(), reported.at("column").get<int>(),
          before + one_line(reported.at("what").get<std::string>())};
}

/// Returns the reason why a request failed. For a rejected program, the text begins with the file's name, as
/// editors expect.
std::string why_refused(const ControlArguments& arguments, const Json& reply) {
  if (!reply.contains("mistakes") || arguments.operands.size() != 2) return reply.at("error");
  std::vector<ProgramMistake> mistakes;
  for (const Json& reported : reply.at("mistakes")) mistakes.push_back(mistake_of(reported));
  return in_file(mistakes.at(0), arguments.operands[1]) + and_more(mistakes);
}

/// Prints the warnings about an accepted program.
void print_warnings(const ControlArguments& arguments, const Json& reply) {
  if (!reply.contains("warnings")) return;
  for (const Json& odd : reply.at("warnings")) {
    const std::string warning = in_file(mistake_of(odd, "warning: "), arguments.operands.back());
    std::fprintf(stderr, "understudy: ctl program: %s\n", one_line(warning).c_str());
  }
}

}  // namespace

int control(const ControlArguments& arguments) {
  const Json message = message_for(arguments);
  const std::string path = choose_daemon(arguments.which);
  if (!arguments.trace.empty()) {
    if (!arguments.operands.empty())
      throw UsageError("ctl scope: --trace writes the recorded values; expected no names with it");
    write_scope(path, arguments.trace);
    return kExitWell;
  }
  const std::string line =
      serve::ask_control(path, message.dump(-1, ' ', false, Json::error_handler_t::replace));
  try {
    const Json reply = Json::parse(line);
    const bool accepted = reply.at("ok").get<bool>();
    if (arguments.json) {
      std::printf("%s\n", line.c_str());
    } else if (!accepted) {
      std::fprintf(stderr, "understudy: ctl %s: %s\n", arguments.verb.c_str(),
                   one_line(why_refused(arguments, reply)).c_str());
    } else if (!arguments.output.empty()) {
      write_coverage(reply, arguments);
    } else if (print_look(reply)) {
    } else if (reply.contains("status")) {
      print_status(reply.at("status"));
    } else if (reply.contains("values")) {
      for (const std::string& text : serve::value_lines(line)) std::printf("%s\n", text.c_str());
    } else if (reply.contains("value")) {
      std::printf("%s\n", serve::value_text(line).c_str());
    } else if (reply.contains("text")) {
      std::printf("%s", reply.at("text").get<std::string>().c_str());
    } else if (reply.contains("number")) {
      std::printf("fault %lld\n", reply.at("number").get<long long>());
    } else if (reply.contains("faults")) {
      for (const Json& fault : reply.at("faults")) {
        std::printf("%lld %s%s\n", fault.at("number").get<long long>(),
                    fault.at("fault").get<std::string>().c_str(), course_text(fault).c_str());
      }
    } else if (reply.contains("simulated_time_ns")) {
      std::printf("simulated time %s\n",
                  format_duration(SimTime{reply.at("simulated_time_ns").get<std::int64_t>()}).c_str());
    }
    if (accepted && !arguments.json) print_warnings(arguments, reply);
    if (accepted && !reply.value("reached", true)) {
      if (!arguments.json) {
        const std::string until = reply.contains("stop") ? "before a stop" : "within " + arguments.within;
        std::fprintf(stderr, "understudy: ctl run-until: '%s' did not become true %s\n",
                     one_line(arguments.operands[0]).c_str(), until.c_str());
      }
      return kExitFailed;
    }
    return accepted ? kExitWell : kExitBadInput;
  } catch (const Json::exception&) {
    throw serve::ControlError(
        path + ": this is not an Understudy socket; expected the control socket of `understudy serve`");
  }
}

}  // namespace understudy::emulator::command_line
