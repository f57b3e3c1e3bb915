#include "emulator/model_file/thing_form.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_words.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

using world::YamlFields;

namespace {

constexpr std::string_view kScheme = "modbus+";

struct FunctionName {
  std::string_view name;
  int code;
  Table table;
  bool writes;
};
/// Some names are from older drafts, with or without their last letter.
constexpr std::array kFunctionNames{
    FunctionName{"readCoil", 1, Table::coil, false},
    FunctionName{"readDiscreteInput", 2, Table::discrete, false},
    FunctionName{"readHoldingRegister", 3, Table::holding, false},
    FunctionName{"readInputRegister", 4, Table::input, false},
    FunctionName{"writeSingleCoil", 5, Table::coil, true},
    FunctionName{"writeSingleHoldingRegister", 6, Table::holding, true},
    FunctionName{"writeMultipleCoils", 15, Table::coil, true},
    FunctionName{"writeMultipleHoldingRegister", 16, Table::holding, true},
};
constexpr std::array<std::pair<std::string_view, Table>, 4> kEntities{{{"Coil", Table::coil},
                                                                       {"DiscreteInput", Table::discrete},
                                                                       {"HoldingRegister", Table::holding},
                                                                       {"InputRegister", Table::input}}};

/// Returns a term of the binding. Its prefix is `modv` or, in older drafts, `modbus`.
std::optional<YamlFields> term(const YamlFields& form, std::string_view name) {
  for (const std::string_view prefix : {"modv:", "modbus:"}) {
    if (auto field = form.find(std::string(prefix) + std::string(name))) return field;
  }
  return std::nullopt;
}

bool is_placeholder(std::string_view text) { return text.find("{{") != std::string_view::npos; }

/// The parts of an address such as modbus+tcp://host:502/1/40?quantity=2.
struct Href {
  std::optional<std::int64_t> unit{};
  std::optional<std::int64_t> address{};
  std::optional<std::int64_t> quantity{};
};

std::optional<std::int64_t> in_query(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view entry = query.substr(0, end);
    if (entry.starts_with(name) && entry.substr(name.size()).starts_with('='))
      return parse_integer(entry.substr(name.size() + 1));
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return std::nullopt;
}

Href parts_of(std::string_view href) {
  const std::size_t question = std::min(href.find('?'), href.size());
  const std::string_view query = href.substr(std::min(question + 1, href.size()));
  std::string_view path = href.substr(0, question);
  const std::size_t host = path.find("://");
  if (host != std::string_view::npos) path = path.substr(std::min(path.find('/', host + 3), path.size()));
  std::vector<std::string_view> segments;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    if (end > 0) segments.push_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  Href parts;
  if (!segments.empty()) parts.unit = parse_integer(segments[0]);
  if (segments.size() > 1) parts.address = parse_integer(segments[1]);
  if (!parts.address) parts.address = in_query(query, "address");
  parts.quantity = in_query(query, "quantity");
  return parts;
}

const FunctionName* function_of(const YamlFields& form) {
  const auto field = term(form, "function");
  if (!field) return nullptr;
  std::string name = field->text();
  const auto code = parse_integer(name);
  if (name.ends_with("Registers")) name.pop_back();
  const auto found = std::find_if(kFunctionNames.begin(), kFunctionNames.end(), [&](const FunctionName& row) {
    return code ? row.code == *code : row.name == name;
  });
  if (found != kFunctionNames.end()) return found;
  field->fail(understudy::quoted(field->text()) +
              " is not a function of registers; expected one such as readHoldingRegisters");
}

std::optional<Table> entity_of(const YamlFields& form) {
  const auto field = term(form, "entity");
  if (!field) return std::nullopt;
  for (const auto& [name, table] : kEntities) {
    if (name == field->text()) return table;
  }
  field->fail(understudy::quoted(field->text()) +
              " is not an entity; expected Coil, DiscreteInput, HoldingRegister or InputRegister");
}

std::vector<std::string> operations_of(const YamlFields& form) {
  const auto field = form.find("op");
  if (!field) return {};
  if (field->is_scalar()) return {field->text()};
  std::vector<std::string> all;
  for (const YamlFields& one : field->elements()) all.push_back(one.text());
  return all;
}

/// Returns the order of words and bytes, from terms or from node-wot's content type (`byteSeq`).
std::optional<WordOrder> order_of(const YamlFields& form) {
  WordOrder order;
  const auto word = term(form, "mostSignificantWord");
  const auto byte = term(form, "mostSignificantByte");
  if (word || byte) {
    if (word) order.words = word->on_or_off() ? WordOrder::Words::high_first : WordOrder::Words::low_first;
    order.low_byte_first = byte && !byte->on_or_off();
    return order;
  }
  const auto content = form.find("contentType");
  if (!content) return std::nullopt;
  const std::string text = lower(content->text());
  const std::size_t at = text.find("byteseq=");
  if (at == std::string::npos) return std::nullopt;
  constexpr std::size_t kKey = 8;
  const std::string name = text.substr(at + kKey, text.find(';', at) - at - kKey);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kSequences{
      {{"big_endian", "abcd"},
       {"little_endian", "dcba"},
       {"big_endian_byte_swap", "badc"},
       {"little_endian_byte_swap", "cdab"}}};
  for (const auto& [sequence, letters] : kSequences) {
    if (sequence == name) return order_called(letters);
  }
  return std::nullopt;
}

/// Returns a number from its term or from the address of the form. Placeholders in a Thing Model do not
/// count.
std::optional<std::int64_t> number_of(const YamlFields& form, std::string_view name,
                                      std::optional<std::int64_t> in_href, std::int64_t lowest,
                                      std::int64_t highest) {
  const auto field = term(form, name);
  if (field && !is_placeholder(field->text())) return field->integer(lowest, highest);
  return in_href;
}

/// Returns nothing for a form that belongs to another protocol.
std::optional<ThingForm> read_form(const YamlFields& form, const std::string& base) {
  const auto href = form.find("href");
  const std::string written = href ? href->text() : "";
  const bool is_whole = written.find("://") != std::string::npos;
  const std::string whole = is_whole ? written : base + (written.starts_with('/') ? "" : "/") + written;
  const FunctionName* const function = function_of(form);
  const auto entity = entity_of(form);
  const bool is_modbus = whole.starts_with(kScheme) || function != nullptr || entity;
  if (!is_modbus || (is_whole && !written.starts_with(kScheme))) return std::nullopt;
  if (function == nullptr && !entity)
    form.fail("has neither modv:entity nor modv:function; expected one of them");
  ThingForm made;
  made.table = entity ? *entity : function->table;
  const Href parts = parts_of(whole);
  const auto address = number_of(form, "address", parts.address, 0, 65536);
  if (!address) form.fail("has no address; expected modv:address, or one in href: /UNIT/ADDRESS");
  if (*address < 0 || *address > 65536)
    form.fail(std::to_string(*address) + " is not an address; expected 0 to 65536");
  made.address = *address;
  if (const auto field = term(form, "zeroBasedAddressing")) made.counts_from_zero = field->on_or_off();
  if (const auto quantity = number_of(form, "quantity", parts.quantity, 1, 2000))
    made.quantity = static_cast<int>(*quantity);
  if (const auto field = term(form, "type")) {
    made.type = lower(field->text());
    made.type.erase(0, made.type.rfind(':') + 1);
  }
  made.order = order_of(form);
  const auto unit = number_of(form, "unitID", parts.unit, 0, 255);
  if (unit && *unit >= 1 && *unit <= 247) made.unit = static_cast<int>(*unit);
  const std::vector<std::string> operations = operations_of(form);
  const auto does = [&](std::string_view what) {
    return std::any_of(operations.begin(), operations.end(),
                       [&](const std::string& one) { return one == what; });
  };
  const bool is_any = operations.empty();
  const bool may_read = function == nullptr || entity || !function->writes;
  const bool may_write = function == nullptr || entity || function->writes;
  made.is_read = may_read && (is_any || does("readproperty") || does("observeproperty"));
  made.is_written = may_write && (is_any || does("writeproperty"));
  return made;
}

}  // namespace

std::optional<ThingForm> thing_form(const YamlFields& property, const std::string& base) {
  const auto forms = property.find("forms");
  if (!forms) return std::nullopt;
  std::optional<ThingForm> joined;
  for (const YamlFields& field : forms->elements()) {
    const auto form = read_form(field, base);
    if (!form) continue;
    if (!joined) {
      joined = form;
      continue;
    }
    const bool is_same = joined->table == form->table && joined->address == form->address &&
                         joined->counts_from_zero == form->counts_from_zero;
    if (!is_same)
      field.fail(
          "names a different register than the previous form; expected one register for each property");
    joined->is_read |= form->is_read;
    joined->is_written |= form->is_written;
    if (!joined->quantity) joined->quantity = form->quantity;
    if (joined->type.empty()) joined->type = form->type;
    if (!joined->order) joined->order = form->order;
  }
  return joined;
}

}  // namespace understudy::emulator::model_file
