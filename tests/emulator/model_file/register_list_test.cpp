#include "emulator/model_file/register_list.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/device/describe/describe.h"
#include "emulator/model_file/starter.h"
#include "tests/emulator/model_file/described.h"

namespace understudy::emulator::model_file {
namespace register_list_test {

std::vector<models::imported::ListedRegister> registers_in(const std::string& list) {
  return read_list_file(list, "l.csv", {}).registers;
}

std::string diagnostic_about_list(const std::string& list) {
  try {
    read_list_file(list, "l.csv", {});
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

struct WrongList {
  const char* list;
  const char* diagnostic;
};

TEST(RegisterList, SaysWhatIsWrongAndWhere) {
  const WrongList kWrong[] = {
      {"",
       "l.csv:1:1: registers: the list is empty; expected a line of headings, and a line for each register"},
      {"address,name\n",
       "l.csv:1:1: registers: the list is empty; expected a line of headings, and a line for each register"},
      {"address,name\n,\n",
       "l.csv:1:1: registers: the list is empty; expected a line for each register below the headings"},
      {"adress,name\n0,A\n",
       "l.csv:1:1: columns: there is no column address, but 'adress'; expected a first line such as "
       "address,name,access,width,unit,min,max,default, or --columns address=HEADING"},
      {"address,name,Address\n0,A,1\n",
       "l.csv:1:14: columns: 'Address' appears twice; expected it only once"},
      {"address,name\n0\n", "l.csv:2:1: name: is missing; expected a name in every row"},
      {"address,name\n,A\n", "l.csv:2:1: address: is missing; expected an address in every row"},
      {"address,name\n65536,A\n",
       "l.csv:2:1: address: '65536' is not an address; expected 0 to 65535, or 0x0000 to 0xFFFF"},
      {"address,name\n0,A,B\n",
       "l.csv:2:5: columns: the row has 3 cells; expected 2, and quotes around a cell with a separator in "
       "it"},
      {"address,name,unit\n0,A,V\n0,B,mV\n",
       "l.csv:3:1: address: '0' is taken by A in line 2, which has another unit (V, here mV); expected rows "
       "that "
       "agree, or a free address"},
      {"address,name,width\n0,A,32\n1,B,16\n",
       "l.csv:3:1: address: '1' is taken by A in line 2; expected a free address in the table holding"},
      {"address,name,table\n0,A,holdings\n",
       "l.csv:2:5: table: 'holdings' is not a table; expected holding, input, coil or discrete"},
      {"address,name,access\n0,A,RX\n", "l.csv:2:5: access: 'RX' is unknown; expected R, W or R/W"},
      {"address,name,table,access\n0,A,input,R/W\n",
       "l.csv:2:11: access: hosts cannot write the table input; expected R"},
      {"address,name,width\n0,A,8\n",
       "l.csv:2:5: width: '8' is not valid; expected 16 or 32, and 1 in coil and discrete"},
      {"address,name,table,width\n0,A,coil,16\n",
       "l.csv:2:10: width: '16' is not valid in this table; expected 1"},
      {"address,name,type\n0,A,u12\n",
       "l.csv:2:5: type: 'u12' is not a type; expected u16, s16, u32, s32, f32 or bit, or another type "
       "in docs/import.md"},
      {"address,name,type\n0,A,bit\n",
       "l.csv:2:5: type: is not as wide as its table; expected bit in coil and discrete, and only there"},
      {"address,name,signed\n0,A,maybe\n",
       "l.csv:2:5: signed: 'maybe' is neither yes nor no; expected 1 or 0"},
      {"address,name,min,max\n0,A,5,1\n",
       "l.csv:2:7: max: '1' is below 5; expected a maximum that is not below the minimum"},
      {"address,name,min,max\n0,A,0,65536\n",
       "l.csv:2:7: max: '65536' is not valid; expected a whole number from 0 to 65535"},
      {"address,name,range\n0,A,many\n", "l.csv:2:5: range: 'many' is not a range; expected 0..3000"},
      {"address,name,range,min\n0,A,0..3,0\n",
       "l.csv:2:5: range: cannot be combined with min and max; expected one of the two"},
      {"address,name,default\n0,A,x\n",
       "l.csv:2:5: default: 'x' is not valid; expected a whole number from 0 to 65535"},
      {"address,name,width,real\n0,A,16,1\n",
       "l.csv:2:8: real: a real number has 32 bits; expected the width 32"},
      {"address,name,type,default\n0,A,f32,x\n", "l.csv:2:9: default: 'x' is not a number; expected one"},
      {"address,name,bits\n0,A,0 X 1\n",
       "l.csv:2:5: bits: 'X 1' cannot be used as a bit's name; expected a word"},
      {"address,name,bits\n0,A,16 X\n",
       "l.csv:2:5: bits: '16' is not a bit; expected 0 to 15, or a range such as 4-7"},
      {"address,name,bits\n0,A,\"0-3 X, 2 Y\"\n",
       "l.csv:2:5: bits: Y shares a bit with another name; expected separate bits"},
      {"address,name,bits\n0,A,\"0 X, 1 X\"\n", "l.csv:2:5: bits: 'X' appears twice; expected it only once"},
      {"address,name,width\n65535,A,32\n",
       "l.csv:2:1: address: has no room for 32 bits; expected 0xFFFE or below"},
      {"address,name\n0,\"A\n", "l.csv:2:3: registers: a quoted cell is not closed; expected a second \""},
      {"address,name,unit\n0,\"A\" B,mm\n",
       "l.csv:2:6: registers: 'B' follows a quoted cell; expected a separator"},
      {"address,name,type,width\n0,A,u16,32\n",
       "l.csv:2:9: width: '32' contradicts the type 'u16'; expected columns that agree, or only one of them"},
      {"address,name,type,signed\n0,A,u16,1\n",
       "l.csv:2:9: signed: '1' contradicts the type 'u16'; expected columns that agree, or only one of them"},
      {"address,name,type,real\n0,A,u32,1\n",
       "l.csv:2:9: real: '1' contradicts the type 'u32'; expected columns that agree, or only one of them"},
      {"PK\x03\x04 xl/worksheets",
       "l.csv:1:1: registers: is a spreadsheet (.xlsx, .ods) or an archive; expected a list saved as CSV"},
      {"\xD0\xCF\x11\xE0 Workbook",
       "l.csv:1:1: registers: is a spreadsheet (.xls); expected a list saved as CSV"},
      {"<html><table><tr><td>address</td></tr></table>",
       "l.csv:1:1: registers: is HTML or XML; expected a list saved as CSV"},
      {"%PDF-1.7", "l.csv:1:1: registers: is a PDF; expected a list saved as CSV"},
      {" {bad",
       "l.csv:1:1: registers: is JSON, but no Thing with \"properties\"; expected a list saved as CSV"},
      {"address,name,type,words\n0,A,u32,1\n1,B,u16,1\n",
       "l.csv:3:1: address: '1' is taken by A in line 2; expected a free address in the table holding (A has "
       "the "
       "words '1', but 32 bits)"},
      {"address,name,min,max,unit,default\n0,A,0,\"65,535\",V,0\n",
       "l.csv:2:7: max: '65,535' is in the unit, but the row has no step; expected counts such as 65535, or "
       "a "
       "unit such as 0.01Hz"},
      {"address,name,range,default\n0,A,0 - 3000,\"1,500\"\n",
       "l.csv:2:14: default: '1,500' is in the unit, but the row has no step; expected counts such as 1500, "
       "or "
       "a unit such as 0.01Hz"},
      {"address,name,default\n10.0,A,2\n",
       "l.csv:2:8: default: '2' does not fit into 1 bit; expected 0 to 1"},
      {"address,name,default\n10,A,2\n10.0,B,1\n",
       "l.csv:3:8: default: '1' contradicts the default of 'A' in line 2; expected rows that agree"},
      {"address,name\n0,A\xC4\xE3\xBA\xC3\n",
       "l.csv:2:1: registers: the line is not UTF-8; expected --encoding big5, gbk, or another encoding"},
  };
  for (const WrongList& wrong : kWrong)
    EXPECT_EQ(diagnostic_about_list(wrong.list), wrong.diagnostic) << wrong.list;
}

TEST(RegisterList, ReportsAllErrorsAtOnce) {
  EXPECT_EQ(diagnostic_about_list("address,name,access,default\nx,A,R,0\n1,B,Q,y\n2,C,R,0\n"),
            "l.csv:2:1: address: 'x' is not an address; expected 0 to 65535, or 0x0000 to 0xFFFF\n"
            "l.csv:3:5: access: 'Q' is unknown; expected R, W or R/W\n"
            "l.csv:3:7: default: 'y' is not valid; expected a whole number from 0 to 65535");
  EXPECT_EQ(diagnostic_about_list("address,name,min,max,default\n0,a,x,y,z\n"),
            "l.csv:2:5: min: 'x' is not valid; expected a whole number from 0 to 65535\n"
            "l.csv:2:7: max: 'y' is not valid; expected a whole number from 0 to 65535\n"
            "l.csv:2:9: default: 'z' is not valid; expected a whole number from 0 to 65535");
  EXPECT_EQ(
      diagnostic_about_list("address,name,type,min,max,default\n0,a,u12,x,9,z\n"),
      "l.csv:2:5: type: 'u12' is not a type; expected u16, s16, u32, s32, f32 or bit, or another type in "
      "docs/import.md\n"
      "l.csv:2:9: min: 'x' is not a number; expected one\n"
      "l.csv:2:13: default: 'z' is not a number; expected one");
  EXPECT_EQ(diagnostic_about_list("address,name,range,default\n0,a,many,z\n"),
            "l.csv:2:5: range: 'many' is not a range; expected 0..3000\n"
            "l.csv:2:10: default: 'z' is not valid; expected a whole number from 0 to 65535");
}

TEST(RegisterList, MayBeWrittenInSeveralWays) {
  const std::string kSame[] = {
      "address,name,min,max,default\n0x10,A,-5,5,1\n",
      "\xEF\xBB\xBF"
      "Address;Name;Min;Max;Default\r\n16;A;-5;5;1\r\n",
      "address,name,min,max,default\r0x10,A,-5,5,1\r",
      "address,name,min,max,default\r0x10,A,-5,5,1\n",
      "# a list\n\naddress\tname\trange\tdefault\n16\t A \t-5..5\t1\n",
      "address,name,range,default,comment\n16,\"A\",-5 to 5,1,\"what, ever\"",
      "name,type,address,min,max,default\nA,int16,16,-5,5,1\n",
      "table,address,name,access,width,signed,min,max,unit,persistent,default\nholding,0x0010,A,rw,16,yes,-5,"
      "5,,no,1\n",
  };
  for (const std::string& list : kSame) {
    const auto registers = registers_in(list);
    ASSERT_EQ(registers.size(), 1U) << list;
    const auto& only = registers.front();
    EXPECT_EQ(only.table, Table::holding) << list;
    EXPECT_EQ(only.address, 16) << list;
    EXPECT_EQ(only.name, "A") << list;
    EXPECT_EQ(only.type, Type::s16) << list;
    EXPECT_EQ(only.access, Access::read_write) << list;
    EXPECT_TRUE(only.ranged && only.min == -5 && only.max == 5) << list;
    EXPECT_EQ(only.factory, 1) << list;
  }
}

TEST(RegisterList, MaySayATypeTwice) {
  const auto registers =
      registers_in("address,name,type,width,signed,real\n0,A,s32,32,1,0\n2,B,f32,32,0,yes\n4,C,u16,,,\n");
  EXPECT_EQ(registers[0].type, Type::s32);
  EXPECT_EQ(registers[1].type, Type::f32);
  EXPECT_EQ(registers[2].type, Type::u16);
}

TEST(RegisterList, KnowsSeveralWordsForYes) {
  for (const char* const word : {"1", "yes", "Y", "true", "X"})
    EXPECT_TRUE(registers_in(std::string("address,name,persistent\n0,A,") + word + "\n")[0].persistent)
        << word;
  for (const char* const word : {"0", "no", "N", "false", ""})
    EXPECT_FALSE(registers_in(std::string("address,name,persistent\n0,A,") + word + "\n")[0].persistent)
        << word;
}

TEST(RegisterList, ARangeMayBeOneValue) {
  const auto registers =
      registers_in("address,name,type,min,max\n0,A,f32,1.5,1.5\n2,B,f32,-2.5,-1.5\n4,C,u16,3,3\n");
  EXPECT_EQ(real_of(registers[0].factory), 1.5F);
  EXPECT_EQ(real_of(registers[1].factory), -2.5F) << "the lower end, if 0 is beyond it";
  EXPECT_EQ(registers[2].factory, 3);
}

TEST(RegisterList, TakesTheNearestToZeroForAMissingDefault) {
  const auto registers = registers_in("address,name,min,max\n0,A,1,247\n1,B,0,9\n");
  EXPECT_EQ(registers[0].factory, 1);
  EXPECT_EQ(registers[1].factory, 0);
}

/// The output of `describe` for a model is a list of the same registers.
TEST(RegisterList, IsWhatDescribePrints) {
  int compared = 0;
  for (const Model* const model : models::all_models()) {
    if (model->registers == nullptr) continue;
    const std::string list = format_sheet(*describe(*model, "registers", SheetFormat::csv), SheetFormat::csv);
    const Model& again = described_models().parse(model_with(list, ""), "m.yaml");
    EXPECT_EQ(format_sheet(*describe(again, "registers", SheetFormat::csv), SheetFormat::csv), list)
        << model->name;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

/// Lines of a list inside a model file are counted in that file.
TEST(RegisterList, InsideOfAModelFileIsSaidToBeThere) {
  EXPECT_EQ(diagnostic_about(model_with("address,name,width\n0,A,32\n1,B,16\n", "")),
            "m.yaml:6:1: address: '1' is taken by A in line 5; expected a free address in the table holding");
}

TEST(Starter, IsAModelThatCanBeReadAndEdited) {
  const std::string list =
      "address,name,access\n0,CONTROL,R/W\n1,STATUS,R\n2,TARGET_POS,R/W\n3,SPEED,R/"
      "W\n4,POS,R\n5,NOW_SPEED,R\n";
  std::string text = starter_model(read_list_file(list, "l.csv", {}), {}, "mine", "l.csv");
  EXPECT_NE(text.find("#    target: TARGET_POS"), std::string::npos) << text;
  EXPECT_NE(text.find("#    busy: STATUS.0"), std::string::npos) << text;
  const auto put_list_in = [&list](std::string model) {
    const std::string key = "registers: l.csv";
    return model.replace(model.find(key), key.size(), "registers: " + quoted_scalar(list));
  };
  EXPECT_EQ(diagnostic_about(put_list_in(text)), "");
  // If the comment marks of the axis are removed, the guessed text is a whole axis, except for two bits
  // without a value.
  const std::size_t axes = text.find("#axes:");
  for (std::size_t at = axes; at < text.find("# A value that"); ++at) {
    if (text[at] == '#' && (at == axes || text[at - 1] == '\n')) text.erase(at, 1);
  }
  EXPECT_EQ(diagnostic_about(put_list_in(text)), "");
}

}  // namespace register_list_test
}  // namespace understudy::emulator::model_file
