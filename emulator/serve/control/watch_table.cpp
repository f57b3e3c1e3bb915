#include "emulator/serve/control/watch_table.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/value_text.h"

namespace understudy::emulator::serve {

namespace {

constexpr const char* kNoUnderstudy =
    "ctl watch: this is not an Understudy socket; expected the control socket of `understudy serve`";

__attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

/// Writes words side by side, on as many lines as necessary.
class Words {
 public:
  Words(const std::string& title, std::size_t columns)
      : columns_(columns), line_(formatted("  %-11s", title.c_str())) {}
  void add(const std::string& word) {
    if (line_.size() + 2 + word.size() > columns_ && !is_empty_) {
      lines_.push_back(line_);
      line_ = std::string(13, ' ');
      is_empty_ = true;
    }
    line_ += (is_empty_ ? "" : "  ") + word;
    is_empty_ = false;
  }
  void finish(std::vector<std::string>& onto) {
    lines_.push_back(line_ + (is_empty_ ? "-" : ""));
    onto.insert(onto.end(), lines_.begin(), lines_.end());
  }

 private:
  std::size_t columns_;
  std::string line_;
  std::vector<std::string> lines_;
  bool is_empty_ = true;
};

std::uint64_t frames_of(const Json& line) {
  std::uint64_t frames = 0;
  for (const Json& station : line.at("stations")) {
    frames += station.at("requests").get<std::uint64_t>() + station.at("replies").get<std::uint64_t>();
  }
  return frames;
}

std::string line_text(const Json& line, const Json* before, double between_s) {
  std::string text =
      formatted("%-13s%s, host %s", line.at("name").get<std::string>().c_str(),
                line.at("settings").get<std::string>().c_str(), line.at("host").get<std::string>().c_str());
  if (before != nullptr && between_s > 0) {
    // After a restore, the count may be smaller than before.
    const auto more = static_cast<std::int64_t>(frames_of(line) - frames_of(*before));
    text += formatted(", %.1f frames/s", static_cast<double>(std::max<std::int64_t>(more, 0)) / between_s);
  }
  return text + formatted(", %llu bytes in, %llu out", line.at("bytes_in").get<unsigned long long>(),
                          line.at("bytes_out").get<unsigned long long>());
}

void add_levels(const char* title, const Json& levels, std::size_t columns, std::vector<std::string>& lines) {
  Words words(title, columns);
  for (const auto& [name, level] : levels.items()) {
    const auto value = level.get<std::int64_t>();
    if (value != 0) words.add(value == 1 ? name : name + " " + std::to_string(value) + " mV");
  }
  words.finish(lines);
}

void add_device(const Json& device, std::size_t columns, std::vector<std::string>& lines) {
  lines.push_back(formatted("%-13s%s, firmware %s%s", device.at("name").get<std::string>().c_str(),
                            device.at("model").get<std::string>().c_str(),
                            device.at("firmware").get<std::string>().c_str(),
                            device.at("power") == "on" ? "" : ", without power"));
  for (const auto& [name, axis] : device.at("axes").items()) {
    const Json& machine = device.at("machines").at(name);
    lines.push_back(formatted("  %-11s%12lld pulses %12.1f pulses/s   machine at %lld", name.c_str(),
                              axis.at("pulses").get<long long>(), axis.at("speed_pps").get<double>(),
                              machine.at("position_pulses").get<long long>()) +
                    (axis.value("pwm_percent", 0) != 0
                         ? formatted(", PWM %d %%", axis.at("pwm_percent").get<int>())
                         : std::string()) +
                    (machine.contains("drive") ? ", drive " + machine.at("drive").get<std::string>() : ""));
  }
  if (device.contains("registers")) {
    Words words("registers", columns);
    for (const auto& [name, value] : device.at("registers").items()) {
      words.add(name + " " + value.dump());
    }
    words.finish(lines);
  }
  add_levels("inputs", device.at("inputs"), columns, lines);
  add_levels("outputs", device.at("outputs"), columns, lines);
  if (device.contains("groups")) {
    Words words("groups", columns);
    for (const auto& [name, word] : device.at("groups").items()) {
      if (word != 0) words.add(name + formatted(" 0x%X", word.get<unsigned>()));
    }
    words.finish(lines);
  }
  if (device.contains("counts")) {
    Words words("counts", columns);
    for (const auto& [name, count] : device.at("counts").items()) words.add(name + " " + count.dump());
    words.finish(lines);
  }
}

}  // namespace

std::vector<std::string> watch_table(const std::string& status, const std::string& before, double between_s,
                                     std::size_t columns) {
  try {
    const Json now = Json::parse(status).at("status");
    const Json then = before.empty() ? Json() : Json::parse(before).at("status");
    std::vector<std::string> lines;
    lines.push_back(formatted(
        "%-13s%s, speed %s%s", "time", now.at("simulated_time").get<std::string>().c_str(),
        now.at("speed").get<std::string>().c_str(), now.at("paused").get<bool>() ? ", paused" : ""));
    const Json& lateness = now.at("lateness");
    lines.push_back(formatted("%-13sp50 %.0f us, p99 %.0f us, max %.0f us, %llu slips", "lateness",
                              lateness.at("p50_us").get<double>(), lateness.at("p99_us").get<double>(),
                              lateness.at("max_us").get<double>(),
                              lateness.at("slips").get<unsigned long long>()));
    for (std::size_t i = 0; i < now.at("lines").size(); ++i) {
      const bool has_before = then.is_object() && then.at("lines").size() > i;
      lines.push_back(line_text(now.at("lines")[i], has_before ? &then.at("lines")[i] : nullptr, between_s));
    }
    for (const Json& device : now.at("devices")) {
      lines.emplace_back();
      add_device(device, columns, lines);
    }
    return lines;
  } catch (const Json::exception&) {
    throw ControlError(kNoUnderstudy);
  }
}

std::string get_message(const std::vector<std::string>& names) {
  Json asked = Json::array();
  if (std::find(names.begin(), names.end(), "time") == names.end()) asked.push_back("time");
  for (const std::string& name : names) asked.push_back(name);
  return Json{{"do", "get"}, {"names", asked}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string why_refused(const std::string& reply) {
  try {
    const Json parsed = Json::parse(reply);
    return parsed.at("ok").get<bool>() ? std::string() : parsed.at("error").get<std::string>();
  } catch (const Json::exception&) {
    throw ControlError(kNoUnderstudy);
  }
}

std::vector<std::string> watch_values(const std::string& reply) {
  if (const std::string why = why_refused(reply); !why.empty()) return {one_line(why)};
  std::vector<std::string> lines;
  std::size_t widest = 0;
  const std::vector<std::string> values = value_lines(reply);
  for (const std::string& value : values) widest = std::max(widest, value.rfind(' '));
  for (const std::string& value : values) {
    const std::size_t space = value.rfind(' ');
    lines.push_back(value.substr(0, space) + std::string(widest - space, ' ') + "  " +
                    value.substr(space + 1));
  }
  return lines;
}

}  // namespace understudy::emulator::serve
