// Reports the values that a session shows: scopes and their variables.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

// The number of references reserved for the scopes and sections of a device.
constexpr std::int64_t kPerDevice = 1'000;
constexpr std::int64_t kState = 1;    // the state of the programs
constexpr std::int64_t kProgram = 2;  // the first of kScopes
constexpr std::int64_t kFirstSection = 10;

constexpr std::array<std::pair<const char*, const char*>, 3> kScopes{
    {{"program", "Program"}, {"axes", "Axes"}, {"terminals", "Terminals"}}};
constexpr std::int64_t kManyRows = 200;  // clients get longer sections piece by piece

std::string text_of_value(const Json& value, bool as_hex) {
  if (value.is_null()) return "no value at the moment";
  if (value.is_string()) return value.get<std::string>();
  if (!as_hex || !value.is_number_integer()) return value.dump();
  std::array<char, 32> text{};
  const std::int64_t number = value.get<std::int64_t>();
  std::snprintf(
      text.data(), text.size(), "%s0x%llX", number < 0 ? "-" : "",
      number < 0 ? 0ULL - static_cast<unsigned long long>(number) : static_cast<unsigned long long>(number));
  return text.data();
}

bool wants_hex(const Json& arguments) {
  return arguments.contains("format") && arguments["format"].is_object() &&
         flag_or(arguments["format"], "hex", false);
}

bool is_plain(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '.';
  });
}

/// Returns the name as it is spelled in expressions.
std::string expression_of(const std::string& device, const std::string& name) {
  return (is_plain(device) ? device : "[\"" + device + "\"]") +
         (is_plain(name) ? "." + name : "[\"" + name + "\"]");
}

std::string unit_of_axis(const std::string& name) { return name.ends_with(".speed") ? "pulses/s" : "pulses"; }

}  // namespace

Json Session::scopes(const Json& arguments) {
  static_cast<void>(require_whole(arguments, "frameId"));
  const std::size_t device = device_of_frame(arguments);
  const std::int64_t base = (static_cast<std::int64_t>(device) + 1) * kPerDevice;
  Json all = Json::array();
  all.push_back({{"name", "State"}, {"variablesReference", base + kState}, {"expensive", false}});
  for (std::size_t i = 0; i < kScopes.size(); ++i) {
    all.push_back({{"name", kScopes.at(i).second},
                   {"variablesReference", base + kProgram + static_cast<std::int64_t>(i)},
                   {"expensive", false}});
  }
  all[1]["presentationHint"] = "locals";
  const auto& sections = devices_[device].sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    all.push_back({{"name", sections[i].second},
                   {"presentationHint", "registers"},
                   {"variablesReference", base + kFirstSection + static_cast<std::int64_t>(i)},
                   {"expensive", true}});
    if (sections[i].first > kManyRows) all.back()["indexedVariables"] = sections[i].first;
  }
  return {{"scopes", std::move(all)}};
}

Json Session::variables(const Json& arguments) {
  const std::int64_t reference = require_whole(arguments, "variablesReference");
  Json all = Json::array();
  if (reference > kFirstBits) {
    add_bits(register_of_reference(reference), all);
    return {{"variables", std::move(all)}};
  }
  const std::size_t device = device_of_reference(reference);
  const std::int64_t which = reference % kPerDevice;
  const std::int64_t section = which - kFirstSection;
  if (which == kState) {
    add_state(device, all);
  } else if (which >= kProgram && which < kProgram + static_cast<std::int64_t>(kScopes.size())) {
    add_scope(device, kScopes.at(static_cast<std::size_t>(which - kProgram)).first, wants_hex(arguments),
              all);
  } else if (section >= 0 && section < static_cast<std::int64_t>(devices_[device].sections.size())) {
    add_section(device, section, arguments, all);
  } else {
    throw RequestError("variablesReference: there is no reference " + std::to_string(reference) +
                       "; expected one from `scopes`");
  }
  return {{"variables", std::move(all)}};
}

std::size_t Session::device_of_reference(std::int64_t reference) const {
  const std::int64_t number = reference / kPerDevice - 1;
  if (reference > kFirstBits) return device_of_name(register_of_reference(reference));
  if (number < 0 || number >= static_cast<std::int64_t>(devices_.size()))
    throw RequestError("variablesReference: there is no reference " + std::to_string(reference) +
                       "; expected one from `scopes`");
  return static_cast<std::size_t>(number);
}

const std::string& Session::register_of_reference(std::int64_t reference) const {
  const std::int64_t number = reference - kFirstBits;
  if (number < 1 || number > static_cast<std::int64_t>(with_bits_.size()))
    throw RequestError("variablesReference: there is no reference " + std::to_string(reference) +
                       "; expected one from `variables`");
  return with_bits_[static_cast<std::size_t>(number) - 1];
}

void Session::add_state(std::size_t device, Json& all) {
  const auto add = [&](const std::string& name, const std::string& value) {
    all.push_back({{"name", name}, {"value", value}, {"variablesReference", 0}});
  };
  const auto time = [](const Json& value) { return format_duration(SimTime{value.get<std::int64_t>()}); };
  const Json reply = link_->ask({{"do", "where"}, {"device", devices_[device].name}});
  add("time", time(reply["simulated_time_ns"]));
  for (const Json& program : reply["programs"]) {
    const std::string name = program.value("program", std::string());
    const std::string before = name.empty() ? "" : name + " ";
    add(before + "state", program.value("state", std::string()));
    if (program.contains("waits_for")) add(before + "waits for", program["waits_for"].get<std::string>());
    if (program.contains("until_ns")) add(before + "until", time(program["until_ns"]));
    if (program.contains("why")) add(before + "why", program["why"].get<std::string>());
  }
}

void Session::add_scope(std::size_t device, const std::string& scope, bool as_hex, Json& all) {
  const std::string& name = devices_[device].name;
  const Json message{{"do", "variables"}, {"device", name}, {"scope", scope}};
  for (const Json& reply : link_->ask_for("scopes", message)) {
    const Json words = reply.value("words", Json::object());  // as the program spells them
    for (const auto& [whole, value] : reply["values"].items()) {
      const std::string own = whole.substr(name.size() + 1);
      Json one = entry(device, own, value, as_hex, scope == "program");
      if (scope == "axes") one["value"] = one["value"].get<std::string>() + " " + unit_of_axis(own);
      for (const auto& [word, meant] : words.items()) {
        if (meant == whole) one["name"] = word;
      }
      all.push_back(std::move(one));
    }
  }
}

/// Adds a section's registers: `count` of them from `start` on, or all of them.
void Session::add_section(std::size_t device, std::int64_t section, const Json& arguments, Json& all) {
  const std::string& name = devices_[device].name;
  const std::int64_t start = std::max<std::int64_t>(0, whole_or(arguments, "start", 0));
  const std::int64_t count = whole_or(arguments, "count", 0);
  const bool as_hex = wants_hex(arguments);
  const auto is_enough = [&] { return count > 0 && static_cast<std::int64_t>(all.size()) >= count; };
  Json rest{{"do", "get"}, {"device", name}, {"section", section}, {"from", start}};
  for (bool is_more = true; is_more && !is_enough();) {
    Json rows = rest;
    rows["do"] = "registers";
    for (Json& row : link_->ask_for("registers", rows)) {
      const std::string own = row["name"].get<std::string>();
      devices_[device].registers[own] = std::move(row);
    }
    const Json page = link_->ask(rest);
    for (const auto& [whole, value] : page["values"].items()) {
      if (!is_enough()) all.push_back(entry(device, whole.substr(name.size() + 1), value, as_hex, true));
    }
    is_more = page.contains("next");
    if (is_more) rest["from"] = page["next"];
  }
}

void Session::add_bits(const std::string& whole, Json& all) {
  const std::size_t device = device_of_name(whole);
  const std::string own = whole.substr(devices_[device].name.size() + 1);
  const Json* const row = known_register(device, own);
  if (row == nullptr) return;
  const auto value = static_cast<std::uint64_t>(
      link_->ask({{"do", "get"}, {"names", {whole}}})["values"][whole].get<std::int64_t>());
  for (const Json& bit : (*row)["bits"]) {
    const auto place = bit["bit"].get<unsigned>();
    const std::uint64_t mask = (std::uint64_t{1} << bit["width"].get<unsigned>()) - 1;
    const std::string name = bit["name"].get<std::string>();
    all.push_back({{"name", name},
                   {"value", std::to_string(value >> place & mask)},
                   {"evaluateName", expression_of(devices_[device].name, own + "." + name)},
                   {"variablesReference", 0}});
  }
}

/// Returns the row of a register, or null if no register has that name.
const Json* Session::known_register(std::size_t device, const std::string& name) {
  DeviceInfo& info = devices_[device];
  auto found = info.registers.find(name);
  if (found == info.registers.end()) {
    Json own;
    const Json reply = link_->ask({{"do", "registers"}, {"device", info.name}, {"find", name}});
    for (const Json& row : reply["registers"]) {
      if (row["name"] == name) own = row;
    }
    found = info.registers.emplace(name, std::move(own)).first;
  }
  return found->second.is_null() ? nullptr : &found->second;
}

/// Returns a variable. Registers have units, and their bits as children.
Json Session::entry(std::size_t device, const std::string& name, const Json& value, bool as_hex,
                    bool is_register) {
  const std::string& of = devices_[device].name;
  Json made{{"name", name},
            {"value", text_of_value(value, as_hex)},
            {"evaluateName", expression_of(of, name)},
            {"variablesReference", 0}};
  const Json* const row = is_register ? known_register(device, name) : nullptr;
  if (row == nullptr || value.is_null()) return made;
  if (row->contains("unit")) made["value"] = made["value"].get<std::string>() + " " + text_or(*row, "unit");
  if (row->contains("type")) made["type"] = (*row)["type"];
  if (row->contains("bits") && value.is_number_integer()) {
    const std::string whole = of + "." + name;
    auto at = std::find(with_bits_.begin(), with_bits_.end(), whole);
    if (at == with_bits_.end()) at = with_bits_.insert(at, whole);
    made["variablesReference"] = kFirstBits + 1 + (at - with_bits_.begin());
  }
  return made;
}

}  // namespace understudy::emulator::dap
