// Tables of registers, page by page.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/choices.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/daemon.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMostRows = 200;

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

std::string hex4(unsigned number) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", number);
  return text.data();
}

std::string_view access_word(Access access) {
  switch (access) {
    case Access::read: return "R";
    case Access::write: return "W";
    case Access::read_write: return "R/W";
  }
  return {};
}

std::string_view type_word(Type type) {
  switch (type) {
    case Type::u16: return "u16";
    case Type::s16: return "s16";
    case Type::u32: return "u32";
    case Type::s32: return "s32";
    case Type::bit: return "bit";
    case Type::f32: return "f32";
  }
  return {};
}

Json number_json(Value value, Type type) {
  if (type != Type::f32) return value;
  return json_of(std::stod(value_text(value, type)));
}

/// Letters, digits and _ around it do not belong to it.
bool names_word(std::string_view text, std::string_view word) {
  const auto is_letter = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !is_letter(text[at - 1]);
    const std::size_t end = at + word.size();
    if (begins && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

/// "X20", of a parameter with a letter; empty if it has none.
std::string parameter_name(const ParameterRow& parameter, int index) {
  if (parameter.letter.empty()) return {};
  return std::string(parameter.letter) +
         std::to_string(parameter.first + (parameter.of_each_axis ? 0 : index));
}

/// What choices call it: its name, and its number as a parameter. Where a name is a parameter's as well, the
/// choices mean that.
std::vector<std::string> names_in_choices(const Model& model, const RegisterRow& row, int index) {
  std::vector<std::string> names;
  bool is_of_parameter = false;
  const std::string plain = RegisterMap::name_of(row, index);
  for (const ParameterRow& parameter : model.parameters) {
    for (int i = 0; i < (parameter.of_each_axis ? 1 : parameter.count); ++i)
      is_of_parameter = is_of_parameter || parameter_name(parameter, i) == plain;
    if (parameter.register_name == row.name && !parameter.letter.empty())
      names.push_back(parameter_name(parameter, index));
  }
  if (!is_of_parameter) names.push_back(plain);
  return names;
}

/// Those that name it.
Json choices_about(const Model& model, const RegisterRow& register_row, int index) {
  const std::vector<std::string> names = names_in_choices(model, register_row, index);
  Json ids = Json::array();
  for (const ChoiceRow& row : model.choices) {
    const bool is_named = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return names_word(row.question, name) || names_word(row.why, name);
    });
    if (is_named) ids.push_back(row.id);
  }
  return ids;
}

Json json_of_row(const Device& device, const RegisterRow& row, int index, int section) {
  const RegisterBank& bank = *device.register_bank();
  Json entry{{"name", bank.map().unique_name(row, index)},
             {"table", to_string(row.table)},
             {"address", hex4(static_cast<unsigned>(row.address + index * row.stride))},
             {"access", access_word(row.access)},
             {"type", type_word(row.type)},
             {"section", section},
             {"factory", number_json(row.factory, row.type)},
             {"kept", bank.keeps(row)}};
  if (row.ranged) {
    entry["min"] = number_json(row.min, row.type);
    entry["max"] = number_json(row.max, row.type);
  }
  if (!row.unit.empty()) entry["unit"] = row.unit;
  if (!row.fields.empty()) {
    entry["bits"] = Json::array();
    for (const BitField& field : row.fields) {
      entry["bits"].push_back({{"bit", field.bit}, {"width", field.width}, {"name", field.name}});
    }
  }
  if (!row.unmodelled.empty()) entry["not_modelled"] = row.unmodelled;
  if (row.message != nullptr) entry["window"] = true;
  if (Json about = choices_about(device.model(), row, index); !about.empty())
    entry["choices"] = std::move(about);
  return entry;
}

/// A row of the table, or of the parameters of a device without registers, one for each quantity.
struct Listed {
  const RegisterRow* row = nullptr;
  const NamedParameterRow* parameter = nullptr;
  int index = 0;
  int section = 0;
};

/// What a message wants of a device's tables.
struct WantedPage {
  std::size_t device = 0;
  std::optional<std::uint64_t> section{};
  std::string find{};  // in lower case
  std::uint64_t from = 0;
  std::uint64_t count = kMostRows;
};

WantedPage wanted_page(const Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "device", "section", "find", "from", "count"});
  WantedPage wanted{.device = demand_device(daemon, message)};
  if (message.contains("section")) wanted.section = demand_count(message, "section");
  if (message.contains("find")) wanted.find = in_lower_case(demand_text(message, "find"));
  if (message.contains("from")) wanted.from = demand_count(message, "from");
  if (message.contains("count")) wanted.count = demand_count(message, "count", kMostRows);
  return wanted;
}

bool is_found(const Listed& listed, const std::string& find) {
  if (find.empty()) return true;
  if (listed.parameter != nullptr) {
    return in_lower_case(listed.parameter->name).find(find) != std::string::npos ||
           in_lower_case(listed.parameter->number) == find ||
           in_lower_case(listed.parameter->meaning).find(find) != std::string::npos;
  }
  const RegisterRow& row = *listed.row;
  const int address = row.address + listed.index * row.stride;
  return in_lower_case(RegisterMap::name_of(row, listed.index)).find(find) != std::string::npos ||
         in_lower_case(hex4(static_cast<unsigned>(address))) == find || std::to_string(address) == find;
}

/// Calls `take` for those of the page, and returns how many there are in all.
std::uint64_t for_page(const Device& device, const WantedPage& wanted,
                       const std::function<void(const Listed&)>& take) {
  std::uint64_t place = 0;
  const auto look = [&](const Listed& listed) {
    if (wanted.section && *wanted.section != static_cast<std::uint64_t>(listed.section)) return;
    if (!is_found(listed, wanted.find)) return;
    if (place >= wanted.from && place < wanted.from + wanted.count) take(listed);
    ++place;
  };
  int section = -1;
  std::string_view last = "\n";
  for (const RegisterRow& row : register_rows(device.model())) {
    if (row.section != last) {
      last = row.section;
      ++section;
    }
    if (!device.register_bank()->has_row(row)) continue;
    if (wanted.section && *wanted.section != static_cast<std::uint64_t>(section)) continue;
    for (int index = 0; index < row.count; ++index) look({.row = &row, .index = index, .section = section});
  }
  if (register_rows(device.model()).empty()) {
    for (const NamedParameterRow& row : device.model().named_parameters) look({.parameter = &row});
  }
  return place;
}

Json page_reply(const WantedPage& wanted, std::uint64_t all) {
  Json reply{{"ok", true}, {"of", all}};
  if (wanted.from + wanted.count < all) reply["next"] = wanted.from + wanted.count;
  return reply;
}

}  // namespace

Json registers_message(Daemon& daemon, const Json& message) {
  const WantedPage wanted = wanted_page(daemon, message);
  const Device& device = daemon.world().device(wanted.device);
  Json rows = Json::array();
  const std::uint64_t all = for_page(device, wanted, [&](const Listed& listed) {
    if (listed.row != nullptr) {
      rows.push_back(json_of_row(device, *listed.row, listed.index, listed.section));
      return;
    }
    const NamedParameterRow& row = *listed.parameter;
    rows.push_back({{"name", row.name},
                    {"number", row.number},
                    {"access", "R/W"},
                    {"section", 0},
                    {"kept", row.persistent},
                    {"min", row.least},
                    {"max", row.most},
                    {"unit", row.unit},
                    {"factory", row.factory},
                    {"meaning", row.meaning}});
    if (!row.unmodelled.empty()) rows.back()["not_modelled"] = row.unmodelled;
  });
  Json reply = page_reply(wanted, all);
  reply["registers"] = std::move(rows);
  return reply;
}

Json get_page_message(Daemon& daemon, const Json& message) {
  const WantedPage wanted = wanted_page(daemon, message);
  daemon.catch_up();
  const Device& device = daemon.world().device(wanted.device);
  if (!device.powered()) throw MessageError(device.name() + " has no power; expected it switched on");
  Json values = Json::object();
  const std::uint64_t all = for_page(device, wanted, [&](const Listed& listed) {
    if (listed.row == nullptr) {
      const auto value = device.named_values()->value_named(listed.parameter->name);
      values[device.name() + "." + std::string(listed.parameter->name)] = value ? json_of(*value) : Json();
      return;
    }
    const RegisterBank& bank = *device.register_bank();
    const std::string name = bank.map().unique_name(*listed.row, listed.index);
    if (listed.row->message != nullptr) return;
    if (const auto place = bank.find(name)) {
      const Value value = read_value(bank, *place);
      values[device.name() + "." + name] = place->is_real() ? json_of(number_of(*place, value)) : Json(value);
    }
  });
  Json reply = page_reply(wanted, all);
  reply["values"] = std::move(values);
  return reply;
}

Json choices_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "device", "from"});
  const std::size_t from = message.contains("from") ? demand_count(message, "from") : 0;
  const Device& device = daemon.world().device(demand_device(daemon, message));
  const auto rows = device.model().choices;
  constexpr std::size_t kAtOnce = 100;
  Json choices = Json::array();
  for (std::size_t i = from; i < std::min(rows.size(), from + kAtOnce); ++i) {
    const ChoiceRow& row = rows[i];
    const auto options = options_of(row);
    Json all = Json::array();
    for (const std::string_view option : options) all.push_back(option);
    choices.push_back({{"id", row.id},
                       {"section", row.section},
                       {"question", row.question},
                       {"chosen", options[device.choice(i)]},
                       {"options", std::move(all)},
                       {"confidence", to_string(row.confidence)},
                       {"why", row.why}});
  }
  Json reply{{"ok", true}, {"choices", std::move(choices)}, {"of", rows.size()}};
  if (from + kAtOnce < rows.size()) reply["next"] = from + kAtOnce;
  return reply;
}

}  // namespace understudy::emulator::serve
