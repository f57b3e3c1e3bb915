// Returns register tables page by page.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/register_names.h"
#include "emulator/device/register_map/row.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/daemon/daemon.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxRows = 200;

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

/// Returns true if the text contains the word without adjacent letters, digits or _.
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

/// Returns "X20" for a parameter that has a letter, and an empty text for any other parameter.
std::string parameter_name(const ParameterRow& parameter, int index) {
  if (parameter.letter.empty()) return {};
  return std::string(parameter.letter) +
         std::to_string(parameter.first + (parameter.of_each_axis ? 0 : index));
}

/// Returns the names with which choices refer to a register: its own name, and its parameter number. If a
/// parameter has the same name as the register, choices refer to the parameter.
std::vector<std::string> names_in_choices(const Model& model, const RegisterRow& row, int index) {
  std::vector<std::string> names;
  bool is_of_parameter = false;
  const std::string plain = RegisterMap::name_of(row, index);
  for (const ParameterRow& parameter : model.parameters) {
    const bool may_be_it = !parameter.letter.empty() && plain.starts_with(parameter.letter);
    for (int i = 0; may_be_it && i < (parameter.of_each_axis ? 1 : parameter.count); ++i)
      is_of_parameter = is_of_parameter || parameter_name(parameter, i) == plain;
    if (parameter.register_name == row.name && !parameter.letter.empty())
      names.push_back(parameter_name(parameter, index));
  }
  if (!is_of_parameter) names.push_back(plain);
  return names;
}

/// Returns the choices that refer to a register.
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
  if (std::string meaning = meaning_of(row, index); !meaning.empty()) entry["meaning"] = std::move(meaning);
  if (std::string heading = heading_of(row, index); !heading.empty()) entry["heading"] = std::move(heading);
  if (!row.fields.empty()) {
    entry["bits"] = Json::array();
    for (const BitField& field : row.fields) {
      entry["bits"].push_back({{"bit", field.bit}, {"width", field.width}, {"name", field.name}});
    }
  }
  if (!row.not_implemented.empty()) entry["not_modelled"] = row.not_implemented;
  if (row.message != nullptr) entry["window"] = true;
  if (Json about = choices_about(device.model(), row, index); !about.empty())
    entry["choices"] = std::move(about);
  return entry;
}

/// An entry on a page: a register, or a parameter of a device without registers.
struct Listed {
  const RegisterRow* row = nullptr;
  const NamedParameterRow* parameter = nullptr;
  int index = 0;
  int section = 0;
};

/// The requested part of a device's tables.
struct WantedPage {
  std::size_t device = 0;
  std::optional<std::uint64_t> section{};
  std::string find{};  // in lower case
  std::uint64_t from = 0;
  std::uint64_t count = kMaxRows;
};

WantedPage wanted_page(const Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "section", "find", "from", "count"});
  WantedPage wanted{.device = require_device(daemon, message)};
  if (message.contains("section")) wanted.section = require_count(message, "section");
  if (message.contains("find")) wanted.find = in_lower_case(require_text(message, "find"));
  if (message.contains("from")) wanted.from = require_count(message, "from");
  if (message.contains("count")) wanted.count = require_count(message, "count", kMaxRows);
  return wanted;
}

/// Returns true for "0x1002", "4098", and "1002" (as some manuals write it).
bool is_number_of(unsigned address, const std::string& find) {
  const std::string hex = in_lower_case(hex4(address));
  return hex == find || hex.substr(2) == find || std::to_string(address) == find;
}

/// Returns true if the text is the address of the register, or is part of one of its names or of its meaning.
/// A 32-bit register has two names and two addresses.
bool is_row_found(const RegisterRow& row, int index, const std::string& find) {
  const auto address = static_cast<unsigned>(row.address + index * row.stride);
  if (is_number_of(address, find) || (is_32_bit(row.type) && is_number_of(address + 1, find))) return true;
  for (const std::string_view pattern : {row.name, row.alias}) {
    if (pattern.empty()) continue;
    const std::string name = in_lower_case(RegisterMap::name_of(row, index, pattern));
    if (name.find(find) != std::string::npos) return true;
    if (!is_32_bit(row.type)) continue;
    for (const std::string_view half : {row.low_half, row.high_half}) {
      if (name + in_lower_case(half) == find) return true;
    }
  }
  return in_lower_case(meaning_of(row, index)).find(find) != std::string::npos ||
         in_lower_case(heading_of(row, index)).find(find) != std::string::npos;
}

bool is_found(const Listed& listed, const std::string& find) {
  if (find.empty()) return true;
  if (listed.parameter != nullptr) {
    return in_lower_case(listed.parameter->name).find(find) != std::string::npos ||
           in_lower_case(listed.parameter->number) == find ||
           in_lower_case(listed.parameter->meaning).find(find) != std::string::npos;
  }
  return is_row_found(*listed.row, listed.index, find);
}

/// Returns all registers or parameters of the device, or those in one section.
std::vector<Listed> all_listed(const Device& device, const WantedPage& wanted) {
  std::vector<Listed> all;
  int section = -1;
  std::string_view last = "\n";
  for (const RegisterRow& row : register_rows(device.model())) {
    if (row.section != last) {
      last = row.section;
      ++section;
    }
    if (wanted.section && *wanted.section != static_cast<std::uint64_t>(section)) continue;
    if (!device.register_bank()->has_row(row)) continue;
    for (int index = 0; index < row.count; ++index)
      all.push_back({.row = &row, .index = index, .section = section});
  }
  if (register_rows(device.model()).empty() && wanted.section.value_or(0) == 0) {
    for (const NamedParameterRow& row : device.model().named_parameters) all.push_back({.parameter = &row});
  }
  return all;
}

/// Finds the entries on a page step by step; each step examines one entry.
class PageWalk {
 public:
  PageWalk(const Device& device, WantedPage wanted)
      : wanted_(std::move(wanted)), all_(all_listed(device, wanted_)) {}

  /// Examines the next entry. Returns false if there is none.
  bool step() {
    is_on_page_ = false;
    if (next_ == all_.size()) return false;
    current_ = all_[next_++];
    if (!is_found(current_, wanted_.find)) return true;
    is_on_page_ = found_ >= wanted_.from && found_ < wanted_.from + wanted_.count;
    ++found_;
    return true;
  }
  /// Returns the entry of the last step, or null if it is not on the page.
  const Listed* current() const { return is_on_page_ ? &current_ : nullptr; }
  /// Adds the total count, and the number of the entry with which the next page begins.
  void add_end(ReplyText& text) const {
    text.member("of", found_);
    if (wanted_.from + wanted_.count < found_) text.member("next", wanted_.from + wanted_.count);
  }

 private:
  WantedPage wanted_;
  std::vector<Listed> all_;
  std::size_t next_ = 0;
  Listed current_;
  bool is_on_page_ = false;
  std::uint64_t found_ = 0;
};

Json json_of_parameter(const NamedParameterRow& row) {
  Json entry{{"name", row.name},       {"number", row.number},  {"access", "R/W"}, {"section", 0},
             {"kept", row.persistent}, {"min", row.min},        {"max", row.max},  {"unit", row.unit},
             {"factory", row.factory}, {"meaning", row.meaning}};
  if (!row.not_implemented.empty()) entry["not_modelled"] = row.not_implemented;
  return entry;
}

/// A value on a page.
struct PageValue {
  std::string name;                 // the full name
  std::optional<NamedPlace> place;  // nothing for a parameter of a device without registers
  std::string_view parameter{};
  Value raw = 0;                   // the value, for a register
  std::optional<double> number{};  // the value, for a parameter that has a value now
};

/// Returns nothing for a window, which accepts only messages.
std::optional<PageValue> place_of(const Device& device, const Listed& listed) {
  if (listed.row == nullptr) {
    const std::string_view name = listed.parameter->name;
    return PageValue{.name = device.name() + "." + std::string(name), .place = {}, .parameter = name};
  }
  const RegisterBank& bank = *device.register_bank();
  const std::string name = bank.map().unique_name(*listed.row, listed.index);
  const auto place = listed.row->message != nullptr ? std::nullopt : bank.find(name);
  if (!place) return std::nullopt;
  return PageValue{.name = device.name() + "." + name, .place = place};
}

void read_page_value(PageValue& value, const Device& device) {
  if (value.place) {
    value.raw = read_value(*device.register_bank(), *value.place);
  } else {
    value.number = device.named_values()->value_named(value.parameter);
  }
}

Json json_of_page_value(const PageValue& value) {
  if (!value.place) return value.number ? json_of(*value.number) : Json();
  return value.place->is_real() ? json_of(number_of(*value.place, value.raw)) : Json(value.raw);
}

ReplyTask tell_rows(Daemon& daemon, WantedPage wanted) {
  const Device& device = daemon.world().device(wanted.device);
  const Pause pause(daemon);
  PageWalk walk(device, wanted);
  ReplyText text;
  text.open_list("registers");
  while (walk.step()) {
    if (const Listed* const listed = walk.current()) {
      text.element(listed->row != nullptr ? json_of_row(device, *listed->row, listed->index, listed->section)
                                          : json_of_parameter(*listed->parameter));
    }
    co_await pause;
  }
  text.close_list();
  walk.add_end(text);
  co_return text.take();
}

ReplyTask tell_values(Daemon& daemon, WantedPage wanted) {
  const Pause pause(daemon);
  const Device& device = daemon.world().device(wanted.device);
  // Finding the names takes a long time, so it is done first. All values are then read at the same moment.
  std::vector<PageValue> page;
  PageWalk walk(device, wanted);
  while (walk.step()) {
    const Listed* const listed = walk.current();
    auto value = listed != nullptr ? place_of(device, *listed) : std::nullopt;
    if (value) page.push_back(std::move(*value));
    co_await pause;
  }
  daemon.catch_up();
  require_power(device);
  for (PageValue& value : page) read_page_value(value, device);
  ReplyText text;
  text.member("simulated_time_ns", daemon.world().now().count());
  text.open_object("values");
  for (const PageValue& value : page) {
    text.member(value.name, json_of_page_value(value));
    co_await pause;
  }
  text.close_object();
  walk.add_end(text);
  co_return text.take();
}

}  // namespace

ReplyTask registers_message(Daemon& daemon, Json message) {
  return tell_rows(daemon, wanted_page(daemon, message));
}

ReplyTask get_page_message(Daemon& daemon, Json message) {
  return tell_values(daemon, wanted_page(daemon, message));
}

ReplyTask choices_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "device", "from"});
  const std::size_t from = message.contains("from") ? require_count(message, "from") : 0;
  const Device& device = daemon.world().device(require_device(daemon, message));
  const auto rows = device.model().choices;
  constexpr std::size_t kAtOnce = 100;
  const Pause pause(daemon);
  ReplyText text;
  text.open_list("choices");
  for (std::size_t i = from; i < rows.size() && i - from < kAtOnce; ++i) {
    const ChoiceRow& row = rows[i];
    const auto options = options_of(row);
    Json all = Json::array();
    for (const std::string_view option : options) all.push_back(option);
    text.element(Json{{"id", row.id},
                      {"section", row.section},
                      {"question", row.question},
                      {"chosen", options[device.choice(i)]},
                      {"options", std::move(all)},
                      {"confidence", to_string(row.confidence)},
                      {"why", row.why}});
    co_await pause;
  }
  text.close_list();
  text.member("of", rows.size());
  if (from < rows.size() && rows.size() - from > kAtOnce) text.member("next", from + kAtOnce);
  co_return text.take();
}

}  // namespace understudy::emulator::serve
