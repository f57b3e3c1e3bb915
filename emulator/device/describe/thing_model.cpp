#include "emulator/device/describe/thing_model.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string_view entity_of(Table table) {
  switch (table) {
    case Table::coil: return "Coil";
    case Table::discrete: return "DiscreteInput";
    case Table::input: return "InputRegister";
    case Table::holding: break;
  }
  return "HoldingRegister";
}

std::string_view xsd_of(Type type) {
  switch (type) {
    case Type::bit: return "xsd:boolean";
    case Type::s16: return "xsd:short";
    case Type::u32: return "xsd:unsignedInt";
    case Type::s32: return "xsd:int";
    case Type::f32: return "xsd:float";
    case Type::u16: break;
  }
  return "xsd:unsignedShort";
}

std::string_view json_of(Type type) {
  return type == Type::bit ? "boolean" : type == Type::f32 ? "number" : "integer";
}

OrderedJson number(Value value, Type type) {
  if (type == Type::bit) return value != 0;
  return OrderedJson::parse(value_text(value, type));
}

std::string bits_of(const RegisterRow& row) {
  std::string text;
  for (const BitField& field : row.fields) {
    text += (text.empty() ? "" : ", ") + std::to_string(field.bit);
    if (field.width > 1) text += "-" + std::to_string(field.bit + field.width - 1);
    text += " " + std::string(field.name);
  }
  return text;
}

OrderedJson form_of(const RegisterRow& row, int address, const MapPolicy& policy) {
  const int quantity = is_32_bit(row.type) ? 2 : 1;
  OrderedJson operations = OrderedJson::array();
  if (row.access != Access::write) operations.push_back("readproperty");
  if (row.access != Access::read) operations.push_back("writeproperty");
  OrderedJson form{{"href", "modbus+tcp://{{HOST}}:{{PORT}}/{{UNIT}}/" + std::to_string(address) +
                                "?quantity=" + std::to_string(quantity)},
                   {"op", operations},
                   {"contentType", "application/octet-stream"},
                   {"modv:entity", entity_of(row.table)},
                   {"modv:address", address},
                   {"modv:quantity", quantity},
                   {"modv:zeroBasedAddressing", true},
                   {"modv:type", xsd_of(row.type)}};
  if (is_32_bit(row.type)) form["modv:mostSignificantWord"] = row.swaps_words == policy.low_word_first;
  if (!is_table_of_bits(row.table)) form["modv:mostSignificantByte"] = !row.swaps_bytes;
  return form;
}

OrderedJson property_of(const RegisterRow& row, int index, const MapPolicy& policy) {
  const int address = row.address + index * row.stride;
  OrderedJson property{{"type", json_of(row.type)}};
  if (row.ranged && row.type != Type::bit) {
    property["minimum"] = number(row.min, row.type);
    property["maximum"] = number(row.max, row.type);
  }
  if (!row.unit.empty()) property["unit"] = row.unit;
  property["default"] = number(row.factory, row.type);
  if (row.access == Access::read) property["readOnly"] = true;
  if (row.access == Access::write) property["writeOnly"] = true;
  if (row.persistent) property["understudy:persistent"] = true;
  if (!row.fields.empty()) property["understudy:bits"] = bits_of(row);
  property["forms"] = OrderedJson::array({form_of(row, address, policy)});
  return property;
}

}  // namespace

std::string thing_model(const Model& model) {
  OrderedJson thing{
      {"@context", OrderedJson::array({"https://www.w3.org/2022/wot/td/v1.1",
                                       OrderedJson{{"modv", "https://www.w3.org/2019/wot/modbus#"},
                                                   {"xsd", "http://www.w3.org/2001/XMLSchema#"},
                                                   {"understudy", "urn:understudy:"}}})},
      {"@type", "tm:ThingModel"},
      {"title", model.name},
      {"description", model.title},
      {"version", {{"model", version_text(model.firmwares.back())}}},
      {"securityDefinitions", {{"nosec_sc", {{"scheme", "nosec"}}}}},
      {"security", "nosec_sc"},
      {"properties", OrderedJson::object()}};
  OrderedJson& properties = thing["properties"];
  std::set<std::string> taken;
  for (const RegisterRow& row : register_rows(model)) {
    for (int index = 0; index < row.count; ++index) {
      const std::string name = RegisterMap::name_of(row, index);
      OrderedJson property = property_of(row, index, model.registers->policy());
      // Names are unique only within a table, but keys must be unique within a Thing.
      const bool is_free = taken.insert(name).second;
      if (!is_free) property["understudy:name"] = name;
      properties.push_back(
          {is_free ? name : name + " (" + std::string(to_string(row.table)) + ")", std::move(property)});
    }
  }
  return thing.dump(2) + "\n";
}

}  // namespace understudy::emulator
