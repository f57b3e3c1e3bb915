#include "emulator/model_file/thing_reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_text.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/starter.h"
#include "emulator/model_file/thing_form.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

using world::YamlFields;

namespace {

constexpr std::array<std::string_view, 13> kColumnsOfThings{
    "address", "name", "table", "access",     "type",    "words", "order",
    "min",     "max",  "unit",  "persistent", "default", "bits"};

/// The words that lists use for XML Schema types of a fixed size.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kTypes{{{"boolean", "bool"},
                                                                                {"byte", "int8"},
                                                                                {"short", "s16"},
                                                                                {"int", "s32"},
                                                                                {"long", "int64"},
                                                                                {"unsignedbyte", "uint8"},
                                                                                {"unsignedshort", "u16"},
                                                                                {"unsignedint", "u32"},
                                                                                {"unsignedlong", "uint64"},
                                                                                {"float", "f32"},
                                                                                {"double", "double"},
                                                                                {"string", "string"},
                                                                                {"hexbinary", "rawhex"}}};

std::string text_at(const YamlFields& property, std::string_view key) {
  const auto field = property.find(key);
  return field && field->is_scalar() ? field->text() : "";
}

bool is_true(const YamlFields& property, std::string_view key) {
  const auto field = property.find(key);
  return field && field->on_or_off();
}

std::string csv_cell(const std::string& text) {
  std::string cell = "\"";
  for (const char c : one_line(text)) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

/// The list type for a property, and how many registers or bits it has.
struct ThingType {
  std::string word;
  int words = 1;             // words per quantity
  int count = 1;             // number of quantities
  bool takes_words = false;  // the list must specify the number of words
};

ThingType type_of(const YamlFields& property, const ThingForm& form) {
  std::string json = text_at(property, "type");
  const auto items = property.find("items");
  const bool is_array = json == "array";
  if (is_array && items && items->is_map()) json = text_at(*items, "type");
  if (is_table_of_bits(form.table)) return {.word = "bit", .count = form.quantity.value_or(1)};
  ThingType made;
  for (const auto& [name, word] : kTypes) {
    if (name == form.type) made.word = word;
  }
  const int quantity = form.quantity.value_or(1);
  const auto minimum = parse_real(text_at(property, "minimum"));
  const std::string sign = minimum && *minimum < 0 ? "s" : "u";
  if (made.word.empty() && (json == "string" || json == "object"))
    made.word = json == "string" ? "string" : "rawhex";
  if (made.word.empty() && json == "boolean") made.word = "bool";
  if (made.word.empty() && json == "number" && quantity == 4) made.word = "double";
  if (made.word.empty() && json == "number" && quantity == 2) made.word = "f32";
  if (made.word.empty() && quantity == 4 && !is_array) made.word = sign == "s" ? "int64" : "uint64";
  if (made.word.empty()) made.word = sign + (quantity == 2 && !is_array ? "32" : "16");
  const auto meaning = type_called(made.word);
  made.words = std::max(meaning->words, 1);
  made.takes_words = meaning->words == 0;
  if (made.takes_words) made.words = quantity;
  if (quantity > made.words) made.count = (quantity + made.words - 1) / made.words;
  return made;
}

/// Returns the two ends of a property's range, or nothing.
std::pair<std::string, std::string> range_of(const YamlFields& property, const ThingType& type) {
  std::string min = text_at(property, "minimum");
  std::string max = text_at(property, "maximum");
  const auto values = property.find("enum");
  if (values && min.empty() && max.empty()) {
    std::vector<std::int64_t> all;
    for (const YamlFields& one : values->elements()) {
      const auto number = one.is_scalar() ? parse_integer(one.text()) : std::nullopt;
      if (!number) return {};
      all.push_back(*number);
    }
    if (all.empty()) return {};
    const auto [lowest, highest] = std::minmax_element(all.begin(), all.end());
    return {std::to_string(*lowest), std::to_string(*highest)};
  }
  const auto meaning = type_called(type.word);
  const bool is_number = meaning->kind == TypeMeaning::Kind::number && meaning->type != Type::bit;
  if (!is_number || type.word == "bool" || (min.empty() && max.empty())) return {};
  if (meaning->type == Type::f32) {
    constexpr std::string_view kGreatest = "3.4028235e38";
    if (min.empty()) min = "-" + std::string(kGreatest);
    if (max.empty()) max = kGreatest;
    return {min, max};
  }
  const TypeLimits limits = limits_of(meaning->type);
  if (min.empty()) min = std::to_string(limits.lowest);
  if (max.empty()) max = std::to_string(limits.highest);
  return {min, max};
}

std::string default_of(const YamlFields& property) {
  const std::string text = text_at(property, "default");
  return text == "true" ? "1" : text == "false" ? "0" : text;
}

std::string order_text(const std::optional<WordOrder>& order) {
  if (!order) return "";
  const bool low_first = order->words == WordOrder::Words::low_first;
  if (order->low_byte_first) return low_first ? "dcba" : "badc";
  return low_first ? "cdab" : "abcd";
}

/// Converts a Thing to the lines of a list.
class ThingReader {
 public:
  ThingReader(const YamlFields& thing, std::optional<AddressReading> addresses, ThingList& made)
      : thing_(thing), addresses_(addresses), made_(made) {}

  void read(world::Diagnostics& diagnostics) {
    for (const std::string_view column : kColumnsOfThings)
      made_.csv += (made_.csv.empty() ? "" : ",") + std::string(column);
    made_.csv += "\n";
    base_ = text_at(thing_, "base");
    while (base_.ends_with('/')) base_.pop_back();
    for (const auto& [name, property] : thing_.at("properties").entries())
      diagnostics.attempt([&, &name = name, &property = property] { read_property(name, property); });
    for (const std::string_view other : {"actions", "events", "tm:extends", "extends"}) {
      const auto field = thing_.find(other);
      const bool has_some = field && (!field->is_map() || !field->entries().empty());
      if (has_some) remark(other, *field, "ignored; only properties become registers");
    }
  }
  const std::vector<YamlFields>& rows() const { return rows_; }

 private:
  void read_property(const std::string& name, const YamlFields& property) {
    property.require_map();
    const auto form = thing_form(property, base_);
    if (!form) return remark("no form", property, "has no Modbus form; ignored");
    if (form->unit) {
      if (made_.unit && *made_.unit != *form->unit)
        property.fail("belongs to unit " + std::to_string(*form->unit) + ", and another property to unit " +
                      std::to_string(*made_.unit) + "; expected a Thing for each unit");
      made_.unit = form->unit;
    }
    const ThingType type = type_of(property, *form);
    const auto [min, max] = range_of(property, type);
    const std::int64_t address = address_of(property, *form);
    const int all_words = type.words * type.count;
    const std::string own_name = text_at(property, "understudy:name");
    const std::array<std::string, kColumnsOfThings.size()> cells{
        all_words > 1 && type.count > 1
            ? std::to_string(address) + "-" + std::to_string(address + all_words - 1)
            : std::to_string(address),
        own_name.empty() ? name : own_name,
        std::string(to_string(form->table)),
        access_of(property, *form),
        type.word,
        type.takes_words ? std::to_string(type.words) : "",
        order_text(form->order),
        min,
        max,
        text_at(property, "unit"),
        is_true(property, "understudy:persistent") ? "1" : "0",
        default_of(property),
        text_at(property, "understudy:bits")};
    std::string line;
    for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_cell(cell);
    made_.csv += line + "\n";
    rows_.push_back(property);
  }

  std::int64_t address_of(const YamlFields& property, const ThingForm& form) {
    const bool is_from_one = addresses_ ? *addresses_ == AddressReading::from_one : !form.counts_from_zero;
    if (!is_from_one) return form.address;
    if (form.address == 0) {
      property.fail(
          "has the address 0, but its form counts from 1; expected `modv:zeroBasedAddressing: true`, "
          "or --addresses wire");
    }
    if (!addresses_)
      remark("counts", property,
             "its address " + std::to_string(form.address) + " counts from 1: it is " +
                 std::to_string(form.address - 1) +
                 " on the wire (--addresses wire leaves addresses unchanged)");
    return form.address - 1;
  }

  static std::string access_of(const YamlFields& property, const ThingForm& form) {
    const bool is_input = form.table == Table::input || form.table == Table::discrete;
    if (is_input || is_true(property, "readOnly")) return "R";
    if (is_true(property, "writeOnly")) return "W";
    return form.is_written ? form.is_read ? "R/W" : "W" : "R";
  }

  void remark(std::string_view kind, const YamlFields& field, const std::string& what) {
    made_.list.remarks.add(std::string(kind), field.place(), field.field() + ": " + what);
  }

  const YamlFields& thing_;
  std::optional<AddressReading> addresses_;
  ThingList& made_;
  std::string base_;
  std::vector<YamlFields> rows_;  // for each line of the list, its property
};

/// Converts a message about a line of the list to a message about the corresponding property.
FileError::Diagnostic at_property(const FileError::Diagnostic& about, const std::vector<YamlFields>& rows) {
  const auto row = static_cast<std::size_t>(std::max(about.place.line - 2, 0));
  const std::size_t colon = about.text.find(": ");
  if (row >= rows.size() || colon == std::string::npos) return about;
  return {rows[row].place(), rows[row].field() + about.text.substr(colon)};
}

}  // namespace

bool is_thing(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text[begin] == '{' &&
         text.find("\"properties\"") != std::string_view::npos;
}

std::optional<std::string> text_of_thing(const std::string& bytes) {
  if (!has_utf16_mark(bytes)) return is_thing(bytes) ? std::optional(bytes) : std::nullopt;
  try {
    Remarks none;
    std::string text = decode_list(bytes, "utf-16", {}, none);
    return is_thing(text) ? std::optional(std::move(text)) : std::nullopt;
  } catch (const FileError&) {
    return std::nullopt;  // the reader of lists says what is wrong
  }
}

namespace {

/// Things are written in JSON, so a broken one is reported as such, although the reader knows YAML too.
YamlFields parse_thing(const std::string& text, const std::string& path) {
  try {
    return YamlFields::parse(text, path, "Thing Model",
                             "a Thing Model with properties that have Modbus forms");
  } catch (const FileError& error) {
    constexpr std::string_view kNotYaml = ": is not YAML: ";
    const FileError::Diagnostic& first = error.diagnostics().front();
    const std::size_t at = first.text.find(kNotYaml);
    if (at == std::string::npos) throw;
    std::string what = first.text;
    what.replace(at, kNotYaml.size(), ": is not JSON: ");
    const std::size_t begin = what.find("Thing Model: ");
    throw FileError(first.place, what.substr(begin == std::string::npos ? 0 : begin));
  }
}

}  // namespace

ThingList read_thing(const std::string& text, const std::string& path,
                     std::optional<AddressReading> addresses) {
  const YamlFields thing = parse_thing(text, path);
  ThingList made;
  world::Diagnostics diagnostics;
  ThingReader reader(thing, addresses, made);
  diagnostics.require([&] { reader.read(diagnostics); });
  if (reader.rows().empty())
    thing.at("properties").fail("has no property with a Modbus form; expected one for each register");
  const ListReading reading{.addresses = AddressReading::wire};
  const Remarks own = made.list.remarks;
  try {
    made.list = read_list_file(made.csv, path, reading);
  } catch (const FileError& error) {
    for (const FileError::Diagnostic& one : error.diagnostics()) {
      const FileError::Diagnostic moved = at_property(one, reader.rows());
      diagnostics.add(FileError(moved.place, moved.text));
    }
    diagnostics.throw_if_any();
  }
  Remarks remarks = own;
  int number = 0;
  for (const FileError::Diagnostic& one : made.list.remarks.all()) {
    const FileError::Diagnostic moved = at_property(one, reader.rows());
    remarks.add("list " + std::to_string(++number), moved.place, moved.text);
  }
  made.list.remarks = remarks;
  return made;
}

}  // namespace understudy::emulator::model_file
