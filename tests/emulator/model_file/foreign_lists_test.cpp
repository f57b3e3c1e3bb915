// Lists as manuals, home automation and data collectors have them. All of them are invented; their shapes are
// those of public lists.
#include <gtest/gtest.h>

#include <string>

#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/starter.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/model_file/listed_lines.h"

namespace understudy::emulator::model_file {
namespace foreign_lists_test {

TEST(ForeignList, MayHaveOtherColumns) {
  const Foreign kLists[] = {
      {"Modbus Address,Parameter,R/W,Data type,Units\n0,A,RO,UINT16,V\n1,B,R/W,INT32,A\n",
       "0 A u16 r V\n1 B s32 A\n"},
      {"Reg;Variable name;RW;Factor;Range\n7;A;rw;0,1;0-100\n", "7 A u16 0..100\n"},
      {"Registeradresse\tBezeichnung\tZugriff\tDatentyp\tEinheit\n3\tDrehzahl\tnur lesen\tWORD\trpm\n",
       "3 Drehzahl u16 r rpm\n"},
      {"地址,名称,读写,数据类型,单位\n16,速度,只读,uint16,rpm\n", "16 速度 u16 r rpm\n"},
      {"位址,名稱,讀寫,資料型態,單位,預設值\n16,速度,讀寫,int16,rpm,5\n", "16 速度 s16 =5 rpm\n"},
      {"A device of ours\n\nFunction code,Address,Description\n4,2,Power\n3,2,Limit\n1,0,Run\n",
       "input 2 Power u16 r\n2 Limit u16\ncoil 0 Run bit\n"},
      {"Register,Type,Name\n5,Input register,A\n5,Holding register,B\n", "input 5 A u16 r\n5 B u16\n"},
      {"address,type,name\n5,R,A\n6,RW,B\n", "5 A u16 r\n6 B u16\n"},
      {"variable name,documented name,data "
       "type,register,writable,values\n,Amps,USHORT,1,R,\nVolts,U,,2,W,0-9\n",
       "1 Amps u16 r\n2 Volts u16 0..9\n"},
      {"_address,name,unit,type,len,factor,offset,role\n,,,,,,,\n3,P,W,floatbe,2,1,0,level\n",
       "3 P f32hi W\n"},
  };
  for (const Foreign& one : kLists) EXPECT_EQ(lines_in(one.list), one.registers) << one.list;
}

TEST(ForeignList, HasColumnsByTheFlag) {
  const char* const list = "No,Where,What,How\n1,10,A,R\n2,11,B,RW\n";
  ListReading reading;
  parse_columns("address=Where,name=What,access=How", reading);
  EXPECT_EQ(lines_in(list, reading), "10 A u16 r\n11 B u16\n");
  ListReading letters;
  parse_columns("address=B,name=C", letters);
  EXPECT_EQ(lines_in(list, letters), "10 A u16\n11 B u16\n");
  EXPECT_EQ(remarks_on(list, letters),
            "l.csv:1:1: columns: ignored: No, How; --columns COLUMN=HEADING gives them a meaning\n");
  ListReading wrong;
  parse_columns("address=Were,name=What", wrong);
  EXPECT_EQ(lines_in(list, wrong),
            "l.csv:1:1: columns: there is no heading 'Were'; the nearest is 'Where'\n"
            "l.csv:1:1: columns: there is no column address; expected a first line such as "
            "address,name,access,width,unit,min,max,default, or --columns "
            "address=HEADING");
  for (const char* const flag : {"address", "=A", "address=", "adress=A", "name=A,name=B", ""})
    EXPECT_THROW(parse_columns(flag, wrong), std::invalid_argument) << flag;
}

TEST(ForeignList, HasTheTypesOfTheField) {
  const Foreign kTypes[] = {
      {"uint16be", "0 X u16hi\n"},
      {"uint16le", "0 X u16losb\n"},
      {"INT", "0 X s16\n"},
      {"DINT", "0 X s32\n"},
      {"DWORD", "0 X u32\n"},
      {"Unsigned Int16", "0 X u16\n"},
      {"float (32 bit)", "0 X f32\n"},
      {"floatsw", "0 X f32lo\n"},
      {"uint32_be", "0 X u32hi\n"},
      {"int32sb", "0 X s32hisb\n"},
      {"boolean", "0 X u16 0..1\n"},
      {"16BIT_FLAGS", "0 X u16\n"},
      {"uint64", "0 X_1 u16\n1 X_2 u16\n2 X_3 u16\n3 X_4 u16\n"},
      {"STRING(5)", "0 X_1 u16\n1 X_2 u16\n2 X_3 u16\n"},
      {"char[4]", "0 X_1 u16\n1 X_2 u16\n"},
      {"rawhex", "0 X u16\n"},
      {"BCD", "0 X bcd16\n"},
  };
  for (const Foreign& one : kTypes)
    EXPECT_EQ(lines_in(std::string("address,name,type\n0,X,") + one.list + "\n"), one.registers) << one.list;
  EXPECT_EQ(lines_in("address,name,type,order\n0,A,f32,cdab\n2,B,u32,Big Endian\n4,C,u32,dcba\n"),
            "0 A f32lo\n2 B u32hi\n4 C u32losb\n");
  EXPECT_EQ(
      lines_in("address,name,type,default\n0,A,uint64,0x0001000200030004\n4,B,string4,OK!\n6,C,bcd,1234\n"),
      "0 A_1 u16 =1\n1 A_2 u16 =2\n2 A_3 u16 =3\n3 A_4 u16 =4\n4 B_1 u16 =20299\n5 B_2 u16 =8448\n"
      "6 C bcd16 =4660\n");
  EXPECT_EQ(lines_in("address,name,type,len\n0,A,string,2\n2,B,string,4 bytes\n4,C,INT,2\n6,D,uint32,2\n"),
            "0 A_1 u16\n1 A_2 u16\n2 B_1 u16\n3 B_2 u16\n4 C s32\n6 D u32\n");
}

TEST(ForeignList, HasNamesAsManualsPrintThem) {
  const char* const list =
      "address,name\n0,P0.01\n1,01-00\n2,50Hz limit\n3,Reserved\n4,Reserved\n5,Speed\n6,Speed\n";
  EXPECT_EQ(lines_in(list),
            "0 P0_01 u16 (P0.01)\n1 _01_00 u16 (01-00)\n2 _50Hz_limit u16 (50Hz limit)\n3 Reserved u16\n"
            "4 Reserved_4 u16\n5 Speed u16\n6 Speed_6 u16\n");
  EXPECT_EQ(remarks_on(list),
            "l.csv:2:3: name: 'P0.01' is called 'P0_01' here (and 2 more)\n"
            "l.csv:8:3: name: 'Speed' is already a name in line 7; here it is called 'Speed_6'\n");
}

TEST(ForeignList, HasNamesThatMeanSomethingElseHere) {
  const char* const list =
      "address,name\n0,and\n1,=cmd\n2,#x\n3,-speed\n4,on\n5,coil\n6,Input\n7,a=b\n8,速度\n9,_x\n12,%\n10,* "
      "top "
      "*\n11,_on\n";
  EXPECT_EQ(
      lines_in(list),
      "0 _and u16 (and)\n1 _cmd u16 (=cmd)\n2 _x u16 (#x)\n3 _speed u16 (-speed)\n4 _on u16 (on)\n"
      "5 _coil u16 (coil)\n6 Input u16\n7 a_b u16 (a=b)\n8 速度 u16\n9 _x_9 u16\n12 Register_12 u16 (%)\n10 "
      "_top u16 (* top *)\n"
      "11 _on_11 u16\n");
  EXPECT_EQ(remarks_on("address,name\n0,and\n1,=cmd\n"),
            "l.csv:2:3: name: 'and' is called '_and' here (and 1 more)\n");
}

TEST(ForeignList, MayDescribeARegisterTwice) {
  const Foreign kLists[] = {
      {"address,name,access\n0,A,R\n0,A,W\n", "0 A u16\n"},
      {"address,name,access,unit\n0,A,R,\n0,B,W,V\n", "0 A u16 V or B\n"},
      {"address,name,function,min,max,default\n0,A,3,,,\n0,A set,6,1,9,\n", "0 A u16 1..9 =1 or A set\n"},
      {"address,name,function,min,max,default\n0,A,3,1,9,\n0,A set,6,,,4\n", "0 A u16 1..9 =4 or A set\n"},
      {"address,name,min,max\n0,A,1,9\n0,A,,\n", "0 A u16 1..9 =1\n"},
      {"address,name,bits\n0,A,0 X\n0,A,\"0 X, 1 Y\"\n", "0 A u16 X:0 Y:1\n"},
      {"address,name,type,access\n0,A,u32,R\n0,B,u32,R\n2,B_L,u16,R\n", "0 A u32 r or B\n2 B_L_2 u16 r\n"},
      {"address,name,type,default\n0,A high,uint8,1\n0,A low,uint8,2\n",
       "0 Register_0 u16 =258 A_high:8+8 A_low:0+8\n"},
      {"address,name,type\n0,Year (LSB),uint8\n0,Month,uint8\n", "0 Register_0 u16 Year_LSB:0+8 Month:8+8\n"},
      {"address,name,type,access\n0,A,uint8,R\n0,A set,uint8,W\n", "0 A u16 or A set\n"},
      {"address,name,type\n0,A,u32\n0,A high,u16\n1,A low,u16\n", "0 A u32\n"},
      {"address,name,type\n0,A,string4\n0,A,string4\n", "0 A_1 u16\n1 A_2 u16\n"},
      {"address,name\n0,A\n1,B\n0,B\n", "0 A u16 or B_0\n1 B u16\n"},
  };
  for (const Foreign& one : kLists) EXPECT_EQ(lines_in(one.list), one.registers) << one.list;
  EXPECT_EQ(remarks_on("address,name,access\n0,A,R\n0,A,W\n1,C,R\n1,D,W\n2,Reserved,R\n2,Reserved,R\n"),
            "l.csv:3:3: name: 'A' is also in line 2; the rows are one register (and 1 more)\n");
  EXPECT_EQ(remarks_on("address,name,access\n0,C,R\n0,D,W\n"),
            "l.csv:3:3: name: 'D' is another name of 'C' in line 2\n");
  EXPECT_EQ(remarks_on("address,name,type\n0,A high,uint8\n0,A low,uint8\n"),
            "l.csv:3:3: name: 'A low' is a byte of 'Register_0', as 'A high' in line 2\n");
  EXPECT_EQ(remarks_on("address,name,type\n0,A,u32\n1,A low,u16\n"),
            "l.csv:3:3: name: 'A low' is half of 'A' in line 2; it gets no separate name\n");
  const Model& model =
      described_models().parse(model_with("address,name,type\n4,A,u32\n4,B,u32\n", ""), "m.yaml");
  for (const char* const name : {"A", "B", "B_H"})
    EXPECT_EQ(model.registers->find(name, 100)->place.row->address, 4) << name;
}

TEST(ForeignList, NamesBothRowsThatContradict) {
  const Foreign kRows[] = {
      {"A,u32,,,,\n0,B,u16,,,,\n", "another type (u32, here u16)"},
      {"A,u16,V,,,\n0,B,u16,A,,,\n", "another unit (V, here A)"},
      {"A,u16,,0,5,\n0,B,u16,,0,6,\n", "another range (0..5, here 0..6)"},
      {"A,u16,,,,1\n0,B,u16,,,,2\n", "another default (1, here 2)"},
      {"A,f32,,,,\n0,B,floatsw,,,,\n", "a different order of words or bytes"},
      {"A,uint8,,,,\n0,B,uint8,,,,\n",
       "8 bits too, and the names do not show which byte is high (10.b8 and 10.b0 do)"},
      {"A low,uint8,,,,\n0,B low,uint8,,,,\n", "the same byte, according to the two names"},
  };
  for (const Foreign& one : kRows) {
    const std::string first(one.list, std::string(one.list).find(','));
    EXPECT_EQ(lines_in("address,name,type,unit,min,max,default\n0," + std::string(one.list)),
              "l.csv:3:1: address: '0' is taken by " + first + " in line 2, which has " + one.registers +
                  "; expected rows that agree, or a free address");
  }
  EXPECT_EQ(
      lines_in("address,name\n0,A\n0,B\n0,C\n"),
      "l.csv:4:1: address: '0' is taken by A in line 2, which has two other names (A and B); expected rows "
      "that agree, or a free address");
}

TEST(ForeignList, HasAddressesAsManualsPrintThem) {
  const Foreign kAddresses[] = {
      {"2000H\n2001h", "8192 A u16\n8193 B u16\n"},
      {"&H20\n$21", "32 A u16\n33 B u16\n"},
      {"10A0\n1000", "4256 A u16\n4096 B u16\n"},
      {"10-11\n12~13", "10 A u32\n12 B u32\n"},
      {"0x10 - 0x11\n0x12", "16 A u32\n18 B u16\n"},
      {"4x0001\n3x0002", "0 A u16\ninput 1 B u16 r\n"},
      {"400001\n300002", "0 A u16\ninput 1 B u16 r\n"},
      {"40001\n40003", "0 A u16\n2 B u16\n"},
      {"30001\n10001", "input 0 A u16 r\ndiscrete 0 B bit r\n"},
      {"40001\n40000", "40001 A u16\n40000 B u16\n"},
      {"D100\nHR101", "100 A u16\n101 B u16\n"},
      {"0008\n0100 (256)", "8 A u16\n100 B u16\n"},
      {"9.0\n9.b1", "9 Register_9 u16 A:0 B:1\n"},
      {"100~103\n104", "100 A_1 u16\n101 A_2 u16\n102 A_3 u16\n103 A_4 u16\n104 B u16\n"},
  };
  for (const Foreign& one : kAddresses) {
    const std::string two(one.list);
    const std::size_t end = two.find('\n');
    EXPECT_EQ(lines_in("address,name\n" + two.substr(0, end) + ",A\n" + two.substr(end + 1) + ",B\n"),
              one.registers)
        << one.list;
  }
}

TEST(ForeignList, SaysHowItsAddressesAreRead) {
  const auto remark = [](const std::string& address) {
    return remarks_on("address,name\n" + address + ",A\n");
  };
  EXPECT_EQ(remark("0"), "");
  EXPECT_EQ(remark("1"),
            "l.csv:2:1: address: read as addresses on the wire: 1 is the second register (with --addresses "
            "from_one, the first)\n");
  EXPECT_EQ(remark("40001"),
            "l.csv:2:1: address: read as Modicon numbers: '40001' is 0 on the wire (--addresses wire leaves "
            "the addresses unchanged)\n");
  EXPECT_EQ(
      remark("40001,B\n50001"),
      "l.csv:3:1: address: read as addresses on the wire, like all others of the list: '50001' is not a "
      "Modicon number, although others can be (--addresses modicon)\n");
  EXPECT_EQ(
      lines_in("address,name\n40069,A\n"),
      "l.csv:2:1: address: the addresses can be Modicon numbers or addresses on the wire: '40069' is holding "
      "register 68, or register 40069; expected --addresses modicon, or --addresses wire");
  EXPECT_EQ(lines_in("address,name\n40069,A\n", {.addresses = AddressReading::wire}), "40069 A u16\n");
  EXPECT_EQ(lines_in("address,name\n40069,A\n", {.addresses = AddressReading::modicon}), "68 A u16\n");
  EXPECT_EQ(lines_in("address,name\n1,A\n0x1,B\n", {.addresses = AddressReading::from_one}),
            "0 A u16\n1 B u16\n");
  EXPECT_EQ(lines_in("address,name\n7,A\n", {.addresses = AddressReading::modicon, .table = Table::coil}),
            "coil 6 A bit\n");
  EXPECT_EQ(
      lines_in("address,name,table\n40001,A,input\n", {.addresses = AddressReading::modicon}),
      "l.csv:2:1: address: '40001' is a number of the table holding; expected a number of the table input");
}

TEST(ForeignList, HasNumbersInTheUnit) {
  const Foreign kRows[] = {
      {"0.00,400.00,0.01Hz,,50.00", "0 X u16 0..40000 =5000 0.01Hz\n"},
      {"0,400,0.01Hz,,50", "0 X u16 0..400 =50 0.01Hz\n"},
      {"-1.5,1.5,V,0.1,0.5", "0 X u16 0..15 =5 0.1V\n"},
      {"\"0,0\",\"2,5\",kW,\"0,1\",", "0 X u16 0..25 0.1kW\n"},
      {"0.0,3.0,A,10,", "0 X u16 0..30 A\n"},
      {"0.005,1.00,0.01Hz,,", "l.csv:2:5: min: '0.005' is not a multiple of '0.01Hz'; expected a multiple"},
      {"0.5,1,Hz,,",
       "l.csv:2:5: min: '0.5' is in the unit, but the row has no step; expected counts, or a unit such as "
       "0.01Hz"},
      {"0,100 %,%,,", "0 X u16 0..100 %\n"},
  };
  for (const Foreign& one : kRows) {
    std::string row(one.list);
    if (row.starts_with("-1.5")) row.replace(0, 4, "0.0");
    EXPECT_EQ(lines_in("address,name,min,max,unit,scale,default\n0,X," + row + "\n").substr(0, 200),
              one.registers)
        << row;
  }
  EXPECT_EQ(lines_in("address,name,min,max,unit,scale,offset\n0,T,-40.0,60.0,C,0.1,-40\n"),
            "0 T s16 0..1000 0.1C\n");
}

TEST(ForeignList, SaysWhichNumbersAreCounts) {
  const auto remark = [](const std::string& row) {
    return remarks_on("address,name,min,max,unit,scale,decimals\n0,X," + row + "\n");
  };
  const std::string counts = " is read as counts of '0.1'; with a decimal point it would be in the unit\n";
  EXPECT_EQ(remark("0,400,Hz,0.1,"), "l.csv:2:7: max: '400'" + counts);
  EXPECT_EQ(remark("0,40.0,Hz,0.1,"), "");
  EXPECT_EQ(remark("0,400,Hz,1,"), "");
  EXPECT_EQ(remark("0,400,Hz,,"), "");
  EXPECT_EQ(remark("0,400,Hz,a tenth,"),
            "l.csv:2:14: scale: 'a tenth' is not a step; it is ignored. Expected 0.1, /10 or 10\n");
  EXPECT_EQ(remark("0,400,Hz,/3,"),
            "l.csv:2:14: scale: '/3' is not a step; it is ignored. Expected 0.1, /10 or 10\n");
  EXPECT_EQ(remark("0,400,Hz,,12"),
            "l.csv:2:15: decimals: '12' is not a number from 0 to 9; it is ignored\n");
}

TEST(ForeignList, HasValuesWithNames) {
  const auto of = [](const std::string& values) {
    return lines_in("address,name,values\n0,X,\"" + values + "\"\n");
  };
  EXPECT_EQ(of("0: off, 1: on, 5: test"), "0 X u16 0..5\n");
  EXPECT_EQ(of("0=off;1=on"), "0 X u16 0..1\n");
  EXPECT_EQ(of("{ \"\"1\"\": \"\"a\"\", \"\"2\"\": \"\"b\"\" }"), "0 X u16 1..2 =1\n");
  EXPECT_EQ(of("b0: too hot, b3: stopped"), "0 X u16 too_hot:0 stopped:3\n");
  EXPECT_EQ(of("0~100"), "0 X u16 0..100\n");
  EXPECT_EQ(of("see chapter 4"), "0 X u16\n");
  EXPECT_EQ(remarks_on("address,name,values\n0,X,as set\n"),
            "l.csv:2:5: values: 'as set' is neither a range nor an enumeration; it is ignored\n");
  EXPECT_EQ(lines_in("address,name,type\n10,A,8bit\n10.b8,B,4bit\n"), "10 A u16 B:8+4\n");
}

TEST(ForeignList, MayHaveOtherEncodings) {
  const char16_t* const list = u"\uFEFFaddress,name\n0,\u901F\u5EA6\n";
  std::string utf16;
  for (const char16_t* at = list; *at != 0; ++at) {
    utf16 += static_cast<char>(*at & 0xFF);
    utf16 += static_cast<char>(*at >> 8);
  }
  EXPECT_EQ(lines_in(utf16), "0 速度 u16\n");
  EXPECT_EQ(lines_in("address,name,unit\n0,T\xFCr,\xB0"
                     "C\n"),
            "0 Tür u16 °C\n");
  EXPECT_EQ(lines_in("address,name\n0,\xCB\xD9\xB6\xC8\n", {.encoding = "gbk"}), "0 速度 u16\n");
  EXPECT_EQ(lines_in("address,name\n0,\xB3\x74\xAB\xD7\n", {.encoding = "big5"}), "0 速度 u16\n");
  EXPECT_EQ(lines_in("address,name\n0,\xFF\xFF\n", {.encoding = "gbk"}),
            "l.csv:1:1: registers: the list cannot be read as 'gbk'; expected another encoding");
}

TEST(ForeignList, MayBelongToSeveralFirmwares) {
  const std::string list = "address,name,since\n0,A,\n1,B,1.52\n";
  const Model& model = described_models().parse(model_with(list, "firmware: [ '1.00', '1.52' ]\n"), "m.yaml");
  EXPECT_FALSE(model.registers->find("B", 100));
  EXPECT_TRUE(model.registers->find("B", 152));
  EXPECT_EQ(model.firmwares.back(), 152);
  EXPECT_EQ(diagnostic_about(model_with(list, "")),
            "m.yaml:6:5: since: '1.52' is not a firmware of the model; expected a version listed under "
            "`firmware`, such as 1.52");
  EXPECT_EQ(diagnostic_about(model_with("address,name\n0,A\n", "firmware: [ '1.52', '1.00' ]\n")),
            "m.yaml:6:21: firmware[1]: '1.00' is not above the previous version; expected the oldest version "
            "first");
  EXPECT_NE(starter_model(imported(list), {}, "one", "l.csv").find("firmware: [ '1.00', '1.52' ]"),
            std::string::npos);
}

TEST(ForeignList, IsReadAgainByItsModel) {
  const std::string list = "Reg,Tag\n40001,A\n";
  ListReading reading{.guesses_addresses = true};
  parse_columns("name=Tag", reading);
  const std::string text = starter_model(read_list_file(list, "l.csv", reading), reading, "one", "l.csv");
  EXPECT_NE(text.find("list:\n  columns: { name: Tag }\n  addresses: modicon"), std::string::npos) << text;
  EXPECT_EQ(diagnostic_about(model_with(list, "list: { addresses: modicon }\n")), "");
  EXPECT_EQ(diagnostic_about(model_with(list, "list: { addresses: modicn }\n")),
            "m.yaml:6:20: list.addresses: 'modicn' is not valid; the nearest is 'modicon'");
  EXPECT_EQ(diagnostic_about(model_with(list, "list: { columns: { nam: Tag } }\n")),
            "m.yaml:6:25: list.columns.nam: 'nam' is not a column; the nearest is 'name'");
}

}  // namespace foreign_lists_test
}  // namespace understudy::emulator::model_file
