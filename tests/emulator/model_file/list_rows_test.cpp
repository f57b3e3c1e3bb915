// What rows of a list mean, and what its reader says about the parts of a row that it guesses or ignores. The
// expected registers are what a person reads in the same row.
#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>

#include "tests/emulator/model_file/listed_lines.h"

namespace understudy::emulator::model_file {
namespace list_rows_test {

struct Row {
  const char* cells;
  const char* registers;  // what lines_in() makes of them
  const char* remarks;    // without the place and the column; empty: none
};

/// Returns the remarks without the file, line, column and field in front of them.
std::string plain_remarks(const std::string& list) {
  std::string text;
  for (const FileError::Diagnostic& remark : imported(list).remarks.all()) {
    const std::size_t place = remark.text.find(": ");
    text += remark.text.substr(remark.text.find(": ", place + 2) + 2) + "\n";
  }
  return text;
}

void expect_rows(const std::string& columns, std::span<const Row> rows) {
  for (const Row& row : rows) {
    const std::string list = columns + "\n" + row.cells + "\n";
    EXPECT_EQ(lines_in(list), std::string(row.registers) + "\n") << list;
    const std::string remarks = row.remarks;
    EXPECT_EQ(plain_remarks(list), remarks.empty() ? "" : remarks + "\n") << list;
  }
}

TEST(ListRow, HasMeaningsOfValuesInManyShapes) {
  constexpr Row kRows[] = {
      {"0,X,,\"0:stop/1:run\"", "0 X u16 0..1", ""},
      {"0,X,,\"0 = stop / 1 = run\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: stop\n1: run\n2: jog\"", "0 X u16 0..2", ""},
      {"0,X,,\"0: 9600\n1: 19200\"", "0 X u16 0..1", ""},
      {"0,X,,0:9600 1:19200 2:38400", "0 X u16 0..2", ""},
      {"0,X,,0:stop 1:run 2:jog", "0 X u16 0..2", ""},
      {"0,X,,\"0 - stop, 1 - run\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: on/off, 1: both\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: off, slow, 1: on\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: off, 1: on, 10-20: level\"", "0 X u16 0..20", ""},
      {"0,X,,\"1: 2-wire, 2: 4-wire\"", "0 X u16 1..2 =1", ""},
      {"0,X,,\"0: type 5-wire, 1: 9600 - low\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: ratio 8:1, 1: off\"", "0 X u16 0..1", ""},
      {"0,X,,\"0: stop, 1: run 2: jog\"", "0 X u16 0..2", ""},
      {"0,X,,\"0: from 12:30 to 14:00, 1: always\"", "0 X u16 0..1", ""},
      {"0,X,,\"0x00: off | 0x10: on\"", "0 X u16 0..16", ""},
      {"0,X,,0：停止，1：运行", "0 X u16 0..1", ""},
      {"0,X,,0：停止；1：运行、2：点动", "0 X u16 0..2", ""},
      {"0,X,,\"-1: back, 0: stop, 1: fwd\"", "0 X s16 -1..1", ""},
      {"0,X,,\"0: stop, -1: back\"", "0 X s16 -1..0", ""},
      {"0,X,s16,\"-1: back, 0: stop, 1: fwd\"", "0 X s16 -1..1", ""},
      {"0,X,,-100..100", "0 X s16 -100..100", ""},
      {"0,X,,Bit 0: ready; Bit 1: run", "0 X u16 ready:0 run:1", ""},
      {"0,X,,b0: ready b1-3: state", "0 X u16 ready:0 state:1+3", ""},
      {"0,X,,b0: reserved b1: reserved b2: run", "0 X u16 reserved:0 run:2", ""},
      {"0,X,uint8,b0: a b7: b", "0 X u16 a:0 b:7", ""},
      {"0,X,bcd,\"0: off, 25: on\"", "0 X bcd16 0..37",
       "'bcd' is binary-coded: tools write and show its code, so 25 is 0x25, or 37"},
  };
  expect_rows("address,name,type,values", kRows);
}

TEST(ListRow, HasNamesOfBitsBesideItsRange) {
  constexpr Row kRows[] = {
      {"0,X,0,9,\"b0: a, b3: b\"", "0 X u16 0..9 a:0 b:3", ""},
      {"0,X,0,9,\"0: a, 20: b\"", "0 X u16 0..9", ""},
  };
  expect_rows("address,name,min,max,values", kRows);
}

TEST(ListRow, SaysWhichValuesItIgnores) {
  constexpr Row kRows[] = {
      {"0,X,,1:Slave 1-247", "0 X u16", "'1:Slave 1-247' names only one value; it is ignored"},
      {"0,X,,12:30 to 14:00", "0 X u16",
       "'12:30 to 14:00' is neither a range nor an enumeration; it is ignored"},
      {"0,X,,\"0: off, 1: on, 2 auto\"", "0 X u16",
       "'0: off, 1: on, 2 auto' is neither a range nor an enumeration; it is ignored"},
      {"0,X,u16,\"-1: back, 1: fwd\"", "0 X u16", "'-1: back, 1: fwd' goes beyond the type; it is ignored"},
      {"0,X,,\"b0: a, b0: b\"", "0 X u16 a:0",
       "bit 0 has no name here: b shares a bit with another name; expected separate bits"},
      {"0,X,,\"b0: a, 1: b\"", "0 X u16",
       "'b0: a, 1: b' is neither a range nor an enumeration; it is ignored"},
      {"0,X,uint64,0..5", "0 X_1 u16\n1 X_2 u16\n2 X_3 u16\n3 X_4 u16",
       "'0..5' is ignored, because the type only stores words"},
  };
  expect_rows("address,name,type,values", kRows);
}

TEST(ListRow, MayHaveNumbersInTypographicShapes) {
  constexpr Row kRows[] = {
      {"0,X,,-,–,n/a", "0 X u16", ""},
      {"0,X,,－,—,--", "0 X u16", ""},
      {"0,X,,\xE2\x88\x92"
       "5,+100,+7",
       "0 X s16 -5..100 =7", ""},
      {"0,X,s16,0x8000,0x7FFF,0xFFFF", "0 X s16 -32768..32767 =-1",
       "'0x8000' is read as -32768, because the type has a sign (and 1 more)"},
      {"0,X,bool,,,true", "0 X u16 0..1 =1", ""},
      {"0,X,bool,,,OFF", "0 X u16 0..1", ""},
      {"0,X,,5,,", "0 X u16 5..65535 =5",
       "'5' is given alone; the range ends at 65535, the limit of the type"},
      {"0,X,,,9,", "0 X u16 0..9", "'9' is given alone; the range begins at 0, the limit of the type"},
      {"0,X,s16,,9,", "0 X s16 -32768..9",
       "'9' is given alone; the range begins at -32768, the limit of the type"},
      {"0,X,uint8,5,,", "0 X u16 5..255 =5",
       "'5' is given alone; the range ends at 255, the limit of the type"},
      {"0,X,string2,,,-", "0 X u16 =11520", ""},
      {"0,X,f32,,,\"1,500\"", "0 X f32 =1.5", "'1,500' is read as 1.500; its comma separates decimals"},
  };
  expect_rows("address,name,type,min,max,default", kRows);
  constexpr Row kRanges[] = {
      {"0,X,0…100", "0 X u16 0..100", ""},
      {"0,X,0 bis 100", "0 X u16 0..100", ""},
      {"0,X,(0..100)", "0 X u16 0..100", ""},
      {"0,X,\xE2\x88\x92"
       "5 - 5",
       "0 X s16 -5..5", ""},
      {"0,X,（0～100）", "0 X u16 0..100", ""},
      {"0,X,(-5..5)", "0 X s16 -5..5", ""},
      {"0,X,-", "0 X u16", ""},
  };
  expect_rows("address,name,range", kRanges);
  constexpr Row kKept[] = {{"0,X,–", "0 X u16", ""}, {"0,X,1", "0 X u16 kept", ""}};
  expect_rows("address,name,persistent", kKept);
}

TEST(ListRow, SaysWhichStepItTakes) {
  constexpr Row kRows[] = {
      {"0,a,0.01Hz,0.1,0.00,400.00,50.00", "0 a u16 0..40000 =5000 0.01Hz",
       "'0.1' is ignored, because the unit '0.01Hz' has a step of its own"},
      {"0,a,0.1Hz,/10,0.0,40.0,5.0", "0 a u16 0..400 =50 0.1Hz", ""},
      {"0,a,A,10,0.0,10.0,", "0 a u16 0..100 A", "'10' is read as 10 counts for one of the unit, as /10 is"},
      {"0,a,A,/10,0.0,10.0,", "0 a u16 0..100 A", ""},
      {"0,a,4-20mA,0.1,4.0,20.0,", "0 a u16 40..200 =40 4-20mA", ""},
  };
  expect_rows("address,name,unit,scale,min,max,default", kRows);
}

TEST(ListRow, MayDescribeSomeBitsOfARegister) {
  constexpr Row kRows[] = {
      {"10.0,Ready,R,\n10.1,Run,R/W,", "10 Register_10 u16 Ready:0 Run:1",
       "'R/W' differs from other rows of the register: register 10 is R/W as a whole"},
      {"10.1,Run,R/W,\n10.0,Ready,R,", "10 Register_10 u16 Run:1 Ready:0",
       "'R' differs from other rows of the register: register 10 is R/W as a whole"},
      {"10,Ctrl,W,\n10.1,Run,R,", "10 Ctrl u16 Run:1",
       "'R' differs from other rows of the register: register 10 is R/W as a whole"},
      {"10,Status,R,\n10.1,Run,R/W,", "10 Status u16 Run:1",
       "'R/W' differs from other rows of the register: register 10 is R/W as a whole"},
      {"10.0,A,R,\n10.1,B,R,", "10 Register_10 u16 r A:0 B:1", ""},
      {"10,Status,R,\n10.1,Run,,", "10 Status u16 r Run:1", ""},
      {"10.0,A,,1\n10.3,X,,1\n10.4,Y,,0", "10 Register_10 u16 =9 A:0 X:3 Y:4", ""},
      {"10,A,,\n10.3,X,,1", "10 A u16 =8 X:3", ""},
      {"10,A,,8\n10.3,X,,1", "10 A u16 =8 X:3", ""},
  };
  expect_rows("address,name,access,default", kRows);
  constexpr Row kMore[] = {
      {"10.0,A,,1,\n10.1,B,,0,", "10 Register_10 u16 kept A:0 B:1",
       "'0' differs from other rows of the register: register 10 is persistent as a whole"},
      {"10,A,u32,,\n10.3,B,,,\n11.3,C,,,", "10 A u32 B:19 C:3",
       "'10.3' is bit 19 of 'A', because the high word comes first (and 1 more)"},
      {"10,A,uint32sw,,\n10.3,B,,,\n11.3,C,,,", "10 A u32lo B:3 C:19", ""},
      {"10.b8,A,4bit,,0..9", "10 Register_10 u16 A:8+4",
       "the range of 'A' is ignored, because only whole registers have a range"},
      {"10.0,A,,,\"0: off, 1: on\"", "10 Register_10 u16 A:0", ""},
  };
  expect_rows("address,name,type,persistent,values", kMore);
}

TEST(ListRow, MayHaveTypesOfOtherPrograms) {
  constexpr Row kRows[] = {
      {"0,X,U_WORD", "0 X u16", ""},
      {"0,X,S_WORD", "0 X s16", ""},
      {"0,X,U_DWORD", "0 X u32", ""},
      {"0,X,S_DWORD", "0 X s32", ""},
      {"0,X,S_DWORD_R", "0 X s32lo", ""},
      {"0,X,FP32", "0 X f32", ""},
      {"0,X,FP32_R", "0 X f32lo", ""},
      {"0,X,U_QWORD", "0 X_1 u16\n1 X_2 u16\n2 X_3 u16\n3 X_4 u16", ""},
      {"0,X,16-bit unsigned", "0 X u16", ""},
      {"0,X,Unsigned 32 bit", "0 X u32", ""},
      {"0,X,16 bit signed integer", "0 X s16", ""},
      {"0,X,32-bit float", "0 X f32", ""},
      {"0,X,无符号16位", "0 X u16", ""},
      {"0,X,有符号32位", "0 X s32", ""},
      {"0,X,16位无符号整数", "0 X u16", ""},
      {"0,X,32位浮点数", "0 X f32", ""},
  };
  expect_rows("address,name,type", kRows);
}

TEST(ListRow, MayContradictItsNumberOfWords) {
  constexpr Row kRows[] = {
      {"0,X,u32,1", "0 X u32", "'1' does not match the type 'u32'; the type is used"},
      {"0,X,u16,1", "0 X u16", ""},
      {"0,X,u32,2", "0 X u32", ""},
      {"0,X,u32,32 bit", "0 X u32", ""},
  };
  expect_rows("address,name,type,words", kRows);
}

TEST(ListRow, MayBeATitleBetweenOthers) {
  constexpr Row kRows[] = {
      {"0,A,R\nMotor parameters,,\n1,B,R", "0 A u16 r\n1 B u16 r",
       "'Motor parameters' is alone in its row; it is ignored as a title"},
  };
  expect_rows("address,name,access", kRows);
  EXPECT_EQ(lines_in("address,name,access\n0x,,\n"),
            "l.csv:2:1: address: '0x' is not an address; expected 0 to 65535, or 0x0000 to 0xFFFF\n"
            "l.csv:2:4: name: is missing; expected a name in every row");
}

}  // namespace list_rows_test
}  // namespace understudy::emulator::model_file
