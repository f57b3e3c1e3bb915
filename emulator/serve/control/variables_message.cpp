// Returns the values that a debugger shows: names in a program, axes, and terminals.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/probe/probes.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxWords = 1'000;  // the most words of a program that are looked up

/// Returns the register for a parameter of a program, such as "VAR32". Returns other words unchanged.
std::string register_of(const Device& device, const std::string& word) {
  const std::int64_t number = word.starts_with("VAR") ? parse_integer(word.substr(3)).value_or(-1) : -1;
  for (const ParameterRow& row : device.model().parameters) {
    const bool is_in = row.letter.empty() && number >= row.first && number < row.first + row.count;
    if (!is_in) continue;
    std::string name(row.register_name);
    if (const std::size_t place = name.find("{}"); place != std::string::npos)
      name.replace(place, 2, std::to_string(number - row.first));
    return name;
  }
  return word;
}

/// Adds the value of the register with this name, or the named value of a device without registers.
void add_value(const Device& device, const std::string& word, Json& values) {
  if (device.named_values() != nullptr) {
    if (const auto value = device.named_values()->value_named(word))
      values[device.name() + "." + word] = json_of(*value);
    return;
  }
  const std::string name = register_of(device, word);
  const RegisterBank* const bank = device.register_bank();
  const auto place = bank == nullptr ? std::nullopt : bank->find(name);
  if (!place || place->place.row->message != nullptr) return;
  values[device.name() + "." + name] = json_of(number_of(*place, read_value(*bank, *place)));
}

/// Returns the words of the device's program that may be names of registers or values, without duplicates.
std::vector<std::string> words_of_program(const Device& device) {
  const std::string text = device.user_program()->program_text();
  std::vector<std::string> words;
  std::set<std::string> seen;
  const auto is_of_word = [](char letter) {
    return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z') || letter == '_';
  };
  for (std::size_t at = 0; at < text.size() && words.size() < kMaxWords;) {
    const std::size_t begin = at;
    while (at < text.size() && is_of_word(text[at])) ++at;
    const std::string word = text.substr(begin, at - begin);
    if (word.empty()) ++at;
    const bool is_number = !word.empty() && word[0] >= '0' && word[0] <= '9';
    if (word.empty() || is_number || !seen.insert(word).second) continue;
    words.push_back(word);
  }
  return words;
}

Json values_of_program(const Daemon& /*daemon*/, const Device& device) {
  Json values = Json::object();
  for (const std::string& word : words_of_program(device)) add_value(device, word, values);
  return values;
}

/// Returns the full names of words that are spelled differently in programs.
Json spelled_otherwise(const Device& device) {
  Json names = Json::object();
  if (device.register_bank() == nullptr) return names;
  for (const std::string& word : words_of_program(device)) {
    const std::string name = register_of(device, word);
    if (name != word && device.register_bank()->find(name)) names[word] = device.name() + "." + name;
  }
  return names;
}

Json values_of_axes(const Daemon& daemon, const Device& device) {
  Json values = Json::object();
  const world::Probes probes(daemon.world());
  for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
    if (device.axes() == nullptr || !device.axes()->has_axis(static_cast<int>(a))) continue;
    for (const char* what : {"position", "pulses", "target", "speed"}) {
      const std::string name = device.name() + "." + std::string(device.model().axes[a].name) + "." + what;
      values[name] = json_of(probes.value(probes.resolve(name).handle).real());
    }
  }
  return values;
}

Json values_of_terminals(const Daemon& /*daemon*/, const Device& device) {
  Json values = Json::object();
  for (const TerminalView& view : terminal_views(device))
    values[device.name() + "." + view.name] = value_of(device, view);
  return values;
}

struct ScopeRow {
  std::string_view name;
  Json (*values)(const Daemon& daemon, const Device& device);
};
constexpr std::array<ScopeRow, 3> kScopes{
    {{"program", values_of_program}, {"axes", values_of_axes}, {"terminals", values_of_terminals}}};

}  // namespace

Json variables_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "scope"});
  const std::string wanted = message.contains("scope") ? require_text(message, "scope") : std::string();
  const auto is_wanted = [&](const ScopeRow& row) { return wanted.empty() || row.name == wanted; };
  if (std::none_of(kScopes.begin(), kScopes.end(), is_wanted))
    throw MessageError("scope: " + understudy::quoted(wanted) +
                       " is unknown; expected program, axes or terminals");
  daemon.catch_up();
  const Device& device = require_program(daemon, message);
  Json scopes = Json::array();
  for (const ScopeRow& row : kScopes) {
    if (!is_wanted(row)) continue;
    scopes.push_back({{"name", row.name}, {"values", row.values(daemon, device)}});
    Json words = row.values == values_of_program ? spelled_otherwise(device) : Json::object();
    if (!words.empty()) scopes.back()["words"] = std::move(words);
  }
  Json reply = time_and_stop(daemon);
  reply["scopes"] = std::move(scopes);
  return reply;
}

}  // namespace understudy::emulator::serve
