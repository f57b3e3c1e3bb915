// W3C Thing Models with the Modbus binding, in and out.
#include "emulator/model_file/thing_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emulator/device/describe/describe.h"
#include "emulator/device/describe/thing_model.h"
#include "emulator/device/register_map/row.h"
#include "tests/emulator/model_file/described.h"

namespace understudy::emulator::model_file {
namespace thing_test {

/// The registers of a model as `describe` lists them, without the columns that depend on a model's own
/// settings.
std::string registers_of(const Model& model) {
  Sheet sheet = *describe(model, "registers", SheetFormat::csv);
  for (const char* const column : {"order", "bits", "real"}) {
    const auto found = std::find(sheet.columns.begin(), sheet.columns.end(), column);
    if (found == sheet.columns.end()) continue;
    const auto at = found - sheet.columns.begin();
    sheet.columns.erase(found);
    for (auto& row : sheet.rows) row.erase(row.begin() + at);
  }
  return format_sheet(sheet, SheetFormat::csv);
}

/// What else a host sees: types, the order of words and bytes, and names of bits.
std::string wire_of(const Model& model) {
  std::string text;
  for (const RegisterRow& row : model.registers->rows()) {
    for (int index = 0; index < row.count; ++index) {
      text +=
          std::to_string(row.address + index * row.stride) + " " + std::to_string(static_cast<int>(row.type));
      if (is_32_bit(row.type))
        text += row.swaps_words == model.registers->policy().low_word_first ? " high" : " low";
      if (row.swaps_bytes) text += " swapped";
      for (const BitField& field : row.fields)
        text += " " + std::string(field.name) + ":" + std::to_string(field.bit) + "+" +
                std::to_string(field.width);
      text += "\n";
    }
  }
  return text;
}

const Model& model_of(const ThingList& thing) {
  return described_models().parse(model_with(thing.csv, "list: { addresses: wire }\n"), "m.yaml");
}

TEST(Thing, IsTheSameModelAgain) {
  const std::string list =
      "table,address,name,access,type,min,max,unit,persistent,default,bits,order\n"
      "holding,0,SPEED,R/W,u16,0,500,mm/s,1,50,,\n"
      "holding,1,STATUS,R,u16,,,,0,3,\"0 BUSY, 4-7 STATE\",\n"
      "holding,2,TARGET,R/W,s32,-100000,100000,0.01mm,0,-7,,\n"
      "holding,4,COMMAND,W,u16,0,9,,0,0,,\n"
      "holding,5,Kp,R/W,f32,-0.5,2.5,,0,0.125,,cdab\n"
      "holding,7,LOW,R/W,u32,,,,0,70000,,cdab\n"
      "holding,9,SWAPPED,R/W,s16,-5,5,,0,1,,badc\n"
      "holding,10,\"a \"\"quoted\"\" name, with more\",R/W,u32,,,,0,4294967295,,dcba\n"
      "input,0,TEMPERATURE,R,s16,,,0.1°C,0,200,,\n"
      "coil,0,RUN,R/W,bit,,,,0,1,,\n"
      "discrete,65535,DI1,R,bit,,,,0,0,,\n"
      "input,1,SPEED,R,u16,,,,0,0,,\n";
  for (const char* const map : {"", "map: { first_word: low }\n"}) {
    const Model& model = described_models().parse(model_with(list, map), "m.yaml");
    const ThingList thing = read_thing(thing_model(model), "t.tm.json", {});
    const Model& again = model_of(thing);
    EXPECT_EQ(registers_of(again), registers_of(model));
    EXPECT_EQ(wire_of(again), wire_of(model));
    EXPECT_TRUE(thing.list.remarks.all().empty());
    EXPECT_FALSE(thing.unit);
  }
}

TEST(Thing, IsWrittenForEveryModelWithRegisters) {
  int compared = 0;
  for (const Model* const model : models::all_models()) {
    if (model->registers == nullptr) continue;
    const std::string text = thing_model(*model);
    const nlohmann::json thing = nlohmann::json::parse(text);
    EXPECT_EQ(thing.at("@type"), "tm:ThingModel");
    const Model& again = model_of(read_thing(text, "t.json", {}));
    EXPECT_EQ(registers_of(again), registers_of(*model)) << model->name;
    EXPECT_EQ(wire_of(again), wire_of(*model)) << model->name;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

/// The terms of each form are those of the binding's JSON schema.
TEST(Thing, HasTheTermsOfTheBinding) {
  const Model& model = described_models().parse(
      model_with("address,name,type,min,max,unit,access\n7,A,s32,-5,5,mm,R\n", ""), "m.yaml");
  const nlohmann::json property = nlohmann::json::parse(thing_model(model)).at("properties").at("A");
  EXPECT_EQ(property, nlohmann::json::parse(R"({
    "type": "integer", "minimum": -5, "maximum": 5, "unit": "mm", "default": 0, "readOnly": true,
    "forms": [ { "href": "modbus+tcp://{{HOST}}:{{PORT}}/{{UNIT}}/7?quantity=2", "op": [ "readproperty" ],
                 "contentType": "application/octet-stream", "modv:entity": "HoldingRegister", "modv:address": 7,
                 "modv:quantity": 2, "modv:zeroBasedAddressing": true, "modv:type": "xsd:int",
                 "modv:mostSignificantWord": true, "modv:mostSignificantByte": true } ] })"));
}

/// Reads a Thing with one property, and returns the line of its list without quotes.
std::string line_of(const std::string& property, const std::string& more = "") {
  try {
    const ThingList thing =
        read_thing("{" + more + "\"properties\": {\"P\": {" + property + "}}}", "t.json", {});
    std::string line = thing.csv.substr(thing.csv.find('\n') + 1);
    std::erase(line, '"');
    while (line.ends_with(',') || line.ends_with('\n')) line.pop_back();
    return line + (thing.unit ? " of " + std::to_string(*thing.unit) : "");
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string with_form(const std::string& form, const std::string& facts = "") {
  return facts + (facts.empty() ? "" : ", ") + "\"forms\": [{" + form + "}]";
}

TEST(Thing, MayBeWrittenByOthers) {
  const std::string zero = "\"modv:zeroBasedAddressing\": true";
  struct Written {
    std::string property;
    std::string line;
  };
  const Written kWritten[] = {
      // The address in the URL; addresses count from 1 unless the form says otherwise.
      {with_form("\"href\": \"modbus+tcp://127.0.0.1:502/1/40?quantity=2\", \"modv:function\": "
                 "\"readHoldingRegisters\", \"op\": \"readproperty\""),
       "39,P,holding,R,u32,,,,,,0 of 1"},
      {with_form(
           "\"href\": \"modbus+tcp://127.0.0.1:502/9\", \"modv:entity\": \"Coil\", \"modv:address\": 5, " +
               zero,
           "\"type\": \"boolean\""),
       "5,P,coil,R/W,bit,,,,,,0 of 9"},
      // The prefix and terms of older drafts, and functions by number.
      {with_form("\"href\": \"modbus+tcp://h\", \"modbus:function\": 4, \"modbus:address\": 3, "
                 "\"modbus:quantity\": 1, "
                 "\"modbus:unitID\": 2, \"modbus:zeroBasedAddressing\": true",
                 "\"type\": \"integer\", \"minimum\": -10, \"maximum\": 10"),
       "3,P,input,R,s16,,,-10,10,,0 of 2"},
      {with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, \"modv:quantity\": 2, "
                 "\"contentType\": \"application/octet-stream;length=4;byteSeq=LITTLE_ENDIAN_BYTE_SWAP\", " +
                     zero,
                 "\"type\": \"number\""),
       "3,P,holding,R/W,f32,,cdab,,,,0"},
      {with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, \"modv:quantity\": 5, " + zero,
                 "\"type\": \"string\", \"readOnly\": true"),
       "3,P,holding,R,string,5,,,,,0"},
      {with_form(
           "\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, \"modv:quantity\": 4, \"modv:type\": "
           "\"xsd:float\", " +
               zero,
           "\"type\": \"array\", \"items\": {\"type\": \"number\"}"),
       "3-6,P,holding,R/W,f32,,,,,,0"},
      {with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, \"modv:type\": "
                 "\"xsd:unsignedLong\", " +
                 zero),
       "3,P,holding,R/W,uint64,,,,,,0"},
      {with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, " + zero,
                 "\"type\": \"integer\", \"enum\": [2, 0, 1], \"unit\": \"V\", \"default\": 1"),
       "3,P,holding,R/W,u16,,,0,2,V,0,1"},
      {with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 3, " + zero,
                 "\"type\": \"integer\", \"maximum\": 100"),
       "3,P,holding,R/W,u16,,,0,100,,0"},
      // A form for each operation, and one of another protocol.
      {"\"forms\": [{\"href\": \"http://h/p\"}, {\"modv:function\": \"readCoil\", \"modv:address\": 1}, "
       "{\"modv:function\": \"writeSingleCoil\", \"modv:address\": 1}]",
       "0,P,coil,R/W,bit,,,,,,0"},
  };
  for (const Written& one : kWritten) EXPECT_EQ(line_of(one.property), one.line) << one.property;
  EXPECT_EQ(line_of(with_form("\"href\": \"/8?quantity=1\", \"modv:entity\": \"InputRegister\", " + zero),
                    "\"base\": \"modbus+tcp://h:502/3/\", "),
            "8,P,input,R,u16,,,,,,0 of 3");
}

TEST(Thing, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(line_of(with_form("\"modv:entity\": \"Coils\", \"modv:address\": 1")),
            "t.json:1:49: properties.P.forms[0].modv:entity: 'Coils' is not an entity; expected Coil, "
            "DiscreteInput, "
            "HoldingRegister or InputRegister");
  EXPECT_EQ(
      line_of(with_form("\"modv:function\": \"readAll\", \"modv:address\": 1")),
      "t.json:1:51: properties.P.forms[0].modv:function: 'readAll' is not a function of registers; expected "
      "one such as readHoldingRegisters");
  EXPECT_EQ(line_of(with_form("\"modv:entity\": \"Coil\"")),
            "t.json:1:33: properties.P.forms[0]: has no address; expected modv:address, or one in href: "
            "/UNIT/ADDRESS");
  EXPECT_EQ(line_of(with_form("\"modv:entity\": \"Coil\", \"modv:address\": 0")),
            "t.json:1:22: properties.P: has the address 0, but its form counts from 1; expected "
            "`modv:zeroBasedAddressing: true`, or --addresses wire");
  EXPECT_EQ(line_of("\"type\": \"integer\""),
            "t.json:1:16: properties: has no property with a Modbus form; expected one for each register");
  EXPECT_EQ(
      line_of(with_form("\"modv:entity\": \"HoldingRegister\", \"modv:address\": 1",
                        "\"type\": \"integer\", \"minimum\": 5, \"maximum\": 1")),
      "t.json:1:22: properties.P: max: '1' is below 5; expected a maximum that is not below the minimum");
  EXPECT_EQ(line_of("\"forms\": [{\"modv:function\": 1, \"modv:address\": 1}, {\"modv:function\": 5, "
                    "\"modv:address\": 2}]"),
            "t.json:1:74: properties.P.forms[1]: names a different register than the previous form; expected "
            "one register for each property");
}

TEST(Thing, SaysWhatItPassesOver) {
  const ThingList thing = read_thing(
      "{\"properties\": {\"A\": {\"forms\": [{\"modv:entity\": \"Coil\", \"modv:address\": 3}]}, \"B\": "
      "{\"forms\": "
      "[]}},\n \"actions\": {\"start\": {}}}",
      "t.json", {});
  std::string text;
  for (const FileError::Diagnostic& remark : thing.list.remarks.all()) text += remark.text + "\n";
  EXPECT_EQ(text,
            "t.json:1:22: properties.A: its address 3 counts from 1: it is 2 on the wire (--addresses wire "
            "leaves addresses unchanged)\n"
            "t.json:1:84: properties.B: has no Modbus form; ignored\n"
            "t.json:2:13: actions: ignored; only properties become registers\n");
}

TEST(Thing, IsToldFromAList) {
  EXPECT_TRUE(is_thing(" {\n\"properties\": {}}"));
  EXPECT_FALSE(is_thing("address,name\n0,A\n"));
  EXPECT_FALSE(is_thing("{\"a\": 1}"));
}

TEST(Thing, MayBeInUtf16) {
  const std::string text = "{\"properties\": {}}";
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += std::string{c, '\0'};
  EXPECT_EQ(text_of_thing(wide).value_or(""), text);
  EXPECT_EQ(text_of_thing(text).value_or(""), text);
  EXPECT_EQ(text_of_thing(wide.substr(0, 9)), std::nullopt);
}

TEST(Thing, IsSaidToBeNoJsonIfItIsCutOff) {
  const std::string cut = "{\"properties\": {\"A\": {\"forms\": [";
  try {
    read_thing(cut, "t.json", {});
    ADD_FAILURE() << cut;
  } catch (const FileError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(": Thing Model: is not JSON: "), std::string::npos) << what;
    EXPECT_EQ(what.find("t.json:1:"), 0U) << what;
    EXPECT_EQ(what.find("t.json", 1), std::string::npos) << what;
  }
}

}  // namespace thing_test
}  // namespace understudy::emulator::model_file
