// Evaluates expressions, sets values, and completes names.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

constexpr std::size_t kMaxProposals = 100;

bool is_of_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '.';
}

std::string trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return std::string(text);
}

/// Returns the position of the equals sign in "NAME = VALUE", or npos.
std::size_t assignment_in(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) return std::string::npos;
  const bool compares = text.find_first_of("<>!=", at - 1) == at - 1 || text.substr(at + 1, 1) == "=";
  return compares ? std::string::npos : at;
}

std::string value_text(const Json& reply) {
  const Json& value = reply["value"];
  return (value.is_string() ? value.get<std::string>() : value.dump()) +
         (reply.contains("unit") ? " " + text_or(reply, "unit") : "");
}

}  // namespace

/// Returns the device with whose name the text begins, or the first device.
std::size_t Session::device_of_name(const std::string& whole) const {
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    if (whole == devices_[d].name || whole.starts_with(devices_[d].name + ".")) return d;
  }
  return 0;
}

/// Returns the name with its device. A name without one belongs to the frame's device.
std::string Session::whole_name(const std::string& name, std::size_t device) const {
  for (const DeviceInfo& one : devices_) {
    if (name.starts_with(one.name + ".")) return name;
  }
  if (devices_.empty()) return name;
  const std::string& of = devices_[device].name;
  const Json words = words_of(device);
  return words.contains(name) ? words[name].get<std::string>() : of + "." + name;
}

/// Returns the names that a program spells in its own way: "VAR32" is the register PROG_VAR0.
Json Session::words_of(std::size_t device) const {
  try {
    const Json reported =
        link_->ask({{"do", "variables"}, {"device", devices_[device].name}, {"scope", "program"}});
    return reported["scopes"][0].value("words", Json::object());
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError&) {  // it has no program, or no power
    return Json::object();
  }
}

/// Evaluates an expression. A name without a device may be one of the frame's device, or of its program.
Json Session::value_of(const std::string& expression, std::size_t device) const {
  try {
    return link_->ask({{"do", "eval"}, {"expression", expression}});
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError&) {
    if (!std::all_of(expression.begin(), expression.end(), is_of_name)) throw;
    const std::string whole = whole_name(expression, device);
    const bool is_another = whole != expression;
    if (!is_another) throw;
    try {
      return link_->ask({{"do", "eval"}, {"expression", whole}});
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError&) {  // the first refusal is more informative
    }
    throw;
  }
}

Json Session::evaluate(const Json& arguments) {
  const std::string text = trimmed(require_text(arguments, "expression"));
  const std::size_t device = device_of_frame(arguments);
  if (text_or(arguments, "context") == "repl") {
    constexpr std::string_view kCommand = "command ";
    if (text.starts_with(kCommand) && !devices_.empty()) {
      link_->ask({{"do", "command"},
                  {"device", devices_[device].name},
                  {"text", trimmed(std::string_view(text).substr(kCommand.size()))}});
      return {{"result", "accepted"}, {"variablesReference", 0}};
    }
    if (const std::size_t sign = assignment_in(text); sign != std::string::npos) {
      const Json set = set_value(whole_name(trimmed(text.substr(0, sign)), device), text.substr(sign + 1));
      return {{"result", value_text(set)}, {"variablesReference", 0}};
    }
  }
  return {{"result", value_text(value_of(text, device))}, {"variablesReference", 0}};
}

/// Sets a register, a value or an input to the value of an expression. Returns its new value.
Json Session::set_value(const std::string& whole, const std::string& value) const {
  const std::size_t device = device_of_name(whole);
  const Json to = value_of(trimmed(value), device)["value"];
  try {
    link_->ask({{"do", "set"}, {"values", {{whole, to}}}});
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError&) {
    // A name that is not a register may be an input; if it is neither, the first refusal is more informative.
    bool is_input = false;
    try {
      link_->ask({{"do", "input"}, {"values", {{whole, to}}}});
      is_input = true;
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError&) {
    }
    if (!is_input) throw;
    return {{"value", to}};  // the device reads it in the next tick
  }
  const Json now = link_->ask({{"do", "get"}, {"names", {whole}}});
  Json reported{{"value", now["values"][whole]}};
  if (now.contains("units") && now["units"].contains(whole)) reported["unit"] = now["units"][whole];
  return reported;
}

/// Changes one bit of a register, and writes the register.
Json Session::set_bit(const std::string& whole, const std::string& bit, const std::string& value) {
  const std::size_t device = device_of_name(whole);
  const Json* const row = known_register(device, whole.substr(devices_[device].name.size() + 1));
  const Json to = value_of(trimmed(value), device)["value"];
  for (const Json& one : row == nullptr ? Json::array() : (*row)["bits"]) {
    if (one["name"] != bit) continue;
    const auto place = one["bit"].get<unsigned>();
    const std::int64_t max = (std::int64_t{1} << one["width"].get<unsigned>()) - 1;
    if (!to.is_number_integer() || to < 0 || to > max)
      throw RequestError(bit + ": " + to.dump() + " is out of range; expected 0 to " + std::to_string(max));
    const auto now = link_->ask({{"do", "get"}, {"names", {whole}}})["values"][whole].get<std::int64_t>();
    const std::int64_t all = (now & ~(max << place)) | (to.get<std::int64_t>() << place);
    link_->ask({{"do", "set"}, {"values", {{whole, all}}}});
    const auto then = link_->ask({{"do", "get"}, {"names", {whole}}})["values"][whole].get<std::int64_t>();
    return {{"value", then >> place & max}};
  }
  throw RequestError("name: " + quoted(bit) + " is not a bit of " + whole);
}

Json Session::set_variable(const Json& arguments) {
  const std::int64_t reference = require_whole(arguments, "variablesReference");
  const std::string name = require_text(arguments, "name");
  const std::string value = require_text(arguments, "value");
  const std::size_t device = device_of_reference(reference);
  if (reference > kFirstBits)
    return {{"value", value_text(set_bit(register_of_reference(reference), name, value))}};
  return {{"value", value_text(set_value(whole_name(name, device), value))}};
}

Json Session::set_expression(const Json& arguments) {
  const std::string name = trimmed(require_text(arguments, "expression"));
  const std::size_t device = device_of_frame(arguments);
  return {{"value", value_text(set_value(whole_name(name, device), require_text(arguments, "value")))}};
}

/// Returns names that contain the part: the names that the device's program uses come first.
std::vector<std::string> Session::names_of(const DeviceInfo& device, const std::string& part) const {
  std::vector<std::string> names;
  const auto add = [&](const Json& message, const char* list, const auto& take) {
    try {
      for (const Json& one : link_->ask_for(list, message)) take(one);
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError&) {  // it has no power, no program, or no registers
    }
  };
  add({{"do", "variables"}, {"device", device.name}}, "scopes", [&](const Json& scope) {
    if (scope.contains("words")) {
      for (const auto& [word, whole] : scope["words"].items()) names.push_back(word);
    }
    for (const auto& [whole, value] : scope["values"].items())
      names.push_back(whole.substr(device.name.size() + 1));
  });
  add({{"do", "registers"}, {"device", device.name}, {"find", part}}, "registers",
      [&](const Json& row) { names.push_back(row["name"].get<std::string>()); });
  return names;
}

/// Suggests names that begin with the word before the cursor: devices, axes' values, registers.
Json Session::completions(const Json& arguments) {
  const std::string text = require_text(arguments, "text");
  const auto column = static_cast<std::size_t>(std::clamp<std::int64_t>(
      require_whole(arguments, "column") - 1 + column_offset_, 0, static_cast<std::int64_t>(text.size())));
  std::size_t begin = column;
  while (begin > 0 && is_of_name(text[begin - 1])) --begin;
  const std::string word = text.substr(begin, column - begin);
  Json targets = Json::array();
  std::set<std::string> proposed;
  const auto propose = [&](const std::string& name) {
    if (!name.starts_with(word) || name == word || targets.size() >= kMaxProposals) return;
    if (!proposed.insert(name).second) return;
    targets.push_back({{"label", name},
                       {"start", begin + 1 - static_cast<std::size_t>(column_offset_)},
                       {"length", word.size()}});
  };
  propose("time");
  for (const DeviceInfo& device : devices_) {
    const bool is_meant = word.starts_with(device.name + ".");
    const std::string before = devices_.size() > 1 || is_meant ? device.name + "." : "";
    if (!word.starts_with(before)) {
      propose(before);
      continue;
    }
    if (before.empty()) propose(device.name + ".");
    for (const std::string& name : names_of(device, word.substr(before.size()))) propose(before + name);
  }
  return {{"targets", std::move(targets)}};
}

}  // namespace understudy::emulator::dap
