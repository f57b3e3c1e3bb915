#include "emulator/world/bench_file/bench_names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

bool BenchNames::names_lost(std::string_view text) const {
  const auto is_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  const auto is_named = [&](const std::string& name) {
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end])))
        return true;
    }
    return false;
  };
  return std::any_of(lost_devices_.begin(), lost_devices_.end(), is_named) ||
         std::any_of(lost_parts_.begin(), lost_parts_.end(), is_named);
}

bool BenchNames::has_lost(const YamlFields& map) const {
  if (!map.is_map()) return false;
  const auto entries = map.entries();
  return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
    return entry.second.is_scalar() && names_lost(entry.second.text());
  });
}

int BenchNames::find_device(const std::string& name) const {
  for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
    if (bench_.devices[i].settings.name == name) return static_cast<int>(i);
  }
  return -1;
}

std::size_t BenchNames::require_device(const YamlFields& field, const std::string& name) const {
  const int found = find_device(name);
  if (found >= 0) return static_cast<std::size_t>(found);
  if (lost_devices_.contains(name)) throw AlreadyReported();
  std::vector<std::string> names;
  for (const DeviceSetup& device : bench_.devices) {
    if (!device.settings.name.empty()) names.push_back(device.settings.name);
  }
  field.fail("no device is called " + quoted(name) + suggestion(name, names));
}

std::pair<std::size_t, std::string> BenchNames::split(const YamlFields& field, const std::string& name,
                                                      const char* example) const {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos)
    field.fail(quoted(name) + " does not name a device; expected a name like " + example);
  return {require_device(field, name.substr(0, dot)), name.substr(dot + 1)};
}

std::pair<std::size_t, int> BenchNames::require_terminal(const YamlFields& field, const std::string& name,
                                                         TerminalRow::Kind kind, const char* example) const {
  const auto [device, terminal_name] = split(field, name, example);
  const Model& model = *bench_.devices[device].model;
  const int terminal = find_terminal(model, terminal_name);
  if (terminal >= 0 && model.terminals[static_cast<std::size_t>(terminal)].kind == kind)
    return {device, terminal};
  std::vector<std::string> names;
  for (const TerminalRow& row : model.terminals) {
    if (row.kind == kind) names.emplace_back(row.name);
  }
  field.fail(quoted(terminal_name) + " is not an " +
             (kind == TerminalRow::Kind::digital_in ? "input" : "output") + " of " + std::string(model.name) +
             suggestion(terminal_name, names));
}

}  // namespace understudy::emulator::world
