// Listings: those that the manual prints, with all their step numbers; refused ones, with places and codes.
#include "interpreter/super_40nc/listing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace understudy::interpreter::super_40nc {
namespace listing_test {

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> samples() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(TEST_FACTS "/super_40nc/samples")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(Super40ncListing, TakesTheManualsWithTheirSteps) {
  ASSERT_EQ(samples().size(), 69u);
  int steps = 0;
  for (const auto& path : samples()) {
    const std::string text = text_of_file(path);
    const Checked checked = check(text);
    ASSERT_TRUE(checked.program) << path << ": "
                                 << (checked.errors.empty() ? "" : to_string(checked.errors[0]));
    EXPECT_TRUE(checked.warnings.empty()) << path;
    for (const char letter : text) steps += letter == '\n' ? 1 : 0;
  }
  EXPECT_GT(steps, 426);  // printed transitions
}

TEST(Super40ncListing, IsGivenBackAsTheManualPrintsIt) {
  for (const auto& path : samples()) {
    const std::string text = text_of_file(path);
    const std::string body = text.substr(text.find('\n') + 1);  // without the remark
    EXPECT_EQ(list(*check(text).program), body) << path;
  }
}

TEST(Super40ncListing, SurvivesCheckAndListWithoutLoss) {
  const std::string text =
      "AREA C\n0 NOP\n1 STP * * * *\n5 STR * K1 * D5\n9 CAL K7 D3\n12 RET\n13 LAB K7\n14 LIN * * K-5\n18 RST "
      "T3\n19 END\n"
      "AREA X BASE 500\n500 END\n"
      "AREA PLC\n3500 LDI M8699\n3501 OUT C31 D9\n3503 ZRST T0 T63\n3505 FMV D9499 D8000 C1\n3508 END\n"
      "FILE 0\n0 END\n"
      "FILE 17\n0 F D8006\n1 END\n";
  const Checked checked = check(text);
  ASSERT_TRUE(checked.program) << to_string(checked.errors.at(0));
  EXPECT_EQ(list(*checked.program), text);
  EXPECT_EQ(checked.program->files.size(), 2u);
  EXPECT_FALSE(checked.program->area(Area::y));
}

TEST(Super40ncListing, IsReadInAnyCaseWithCommasAndRemarks) {
  const Checked checked = check("\xEF\xBB\xBF; a remark\r\n area x ; X\r\n\tlin0\r\n");
  EXPECT_FALSE(checked.program);
  const Checked right = check("area c base 10\r\n drv k1,*,K-3;rest\n 14 outTC T0 K1\nEND\n");
  EXPECT_FALSE(right.program);  // OUT cannot be there
  const Checked plain = check("area c base 10\r\n drv k1,*****,K-3;rest\n\n 14 end");
  ASSERT_TRUE(plain.program) << to_string(plain.errors.at(0));
  EXPECT_EQ(list(*plain.program), "AREA C BASE 10\n10 DRV K1 * K-3\n14 END\n");
}

TEST(Super40ncListing, MayBeOfNothing) {
  EXPECT_EQ(check("").program, Program{});
  const Checked empty = check("AREA PLC\nAREA X\n");
  ASSERT_TRUE(empty.program);
  EXPECT_TRUE(empty.program->area(Area::plc)->lines.empty());
  EXPECT_EQ(list(*empty.program), "AREA X\nAREA PLC\n");
}

struct Refusal {
  const char* text;
  int line;
  int column;
  Code code;
  int step;
};

std::string many(int count, const std::string& line) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line + "\n";
  return text;
}

TEST(Super40ncListing, IsRefusedWithPlaceCodeAndStep) {
  const Refusal kRefusals[] = {
      // unknown words and operands
      {"LD X0\n", 1, 1, Code::unknown, 0},
      {"AREA W\nLD X0\n", 1, 6, Code::unknown, 0},
      {"AREA\n", 1, 1, Code::unknown, 0},
      {"AREA X\nEND\nAREA X\nEND\n", 3, 6, Code::unknown, 0},
      {"AREA X BASE\nEND\n", 1, 8, Code::unknown, 1500},
      {"AREA X BASE -1\nEND\n", 1, 8, Code::unknown, 1500},
      {"FILE\n", 1, 1, Code::no_such_file, 0},
      {"FILE 30000\n", 1, 6, Code::no_such_file, 0},
      {"FILE 1\nEND\nFILE 1\nEND\n", 3, 6, Code::unknown, 0},
      {"AREA X\n  LDX X0\nEND\n", 2, 3, Code::unknown, 1500},
      {"AREA X\nSET Y0\nSET Q1\nEND\n", 3, 5, Code::unknown, 1501},
      {"AREA X\nSET Y\nEND\n", 2, 5, Code::unknown, 1500},
      {"AREA X\nSET X1\nEND\n", 2, 5, Code::unknown, 1500},
      {"AREA X\nSET\nEND\n", 2, 1, Code::unknown, 1500},
      {"AREA X\nSET Y1 Y2\nEND\n", 2, 8, Code::unknown, 1500},
      {"AREA C\nLIN K1 K2 K3 K4 K5\nEND\n", 2, 17, Code::unknown, 0},
      {"AREA C\nF *\nEND\n", 2, 3, Code::unknown, 0},
      {"AREA C\nCWR K1 K2\nEND\n", 2, 1, Code::unknown, 0},
      {"AREA C\nTMR\nEND\n", 2, 1, Code::unknown, 0},
      {"AREA C\nLAB K10000000\nEND\n", 2, 5, Code::unknown, 0},
      {"AREA C\nLAB K-1\nEND\n", 2, 5, Code::unknown, 0},
      {"AREA PLC\nLD X0\nOUT T0\nEND\n", 3, 1, Code::unknown, 3501},
      {"AREA PLC\nLD X0\nOUT X1\nEND\n", 3, 5, Code::unknown, 3501},
      {"AREA X\nAOST\nEND\n", 2, 1, Code::unknown, 1500},
      // step numbers
      {"AREA X\n1500 SET Y0\n1502 END\n", 3, 1, Code::unknown, 1501},
      {"AREA X\n1500\n", 2, 1, Code::unknown, 1500},
      {"AREA X\n99999999999999999999 END\n", 2, 1, Code::unknown, 1500},
      // numbers
      {"AREA X\nSET Y32\nEND\n", 2, 5, Code::out_of_range, 1500},
      {"AREA X\nSET M512\nEND\n", 2, 5, Code::out_of_range, 1500},
      {"AREA X\nSET M8700\nEND\n", 2, 5, Code::out_of_range, 1500},
      {"AREA X\nMOV K2147483648 D0\nEND\n", 2, 5, Code::out_of_range, 1500},
      {"AREA X\nMOV K0 D1000\nEND\n", 2, 8, Code::out_of_range, 1500},
      {"AREA X\nMOV K0 D9500\nEND\n", 2, 8, Code::out_of_range, 1500},
      {"AREA X\nMOV T64 D0\nEND\n", 2, 5, Code::out_of_range, 1500},
      {"AREA X\nZRST M10 M0\nEND\n", 2, 1, Code::out_of_range, 1500},
      {"AREA X\nZRST M0 Y5\nEND\n", 2, 1, Code::out_of_range, 1500},
      {"AREA X\nZRST M500 M8001\nEND\n", 2, 1, Code::out_of_range, 1500},
      {"AREA X\nZRST D999 D8000\nEND\n", 2, 1, Code::out_of_range, 1500},
      {"AREA X\nZRST D8599 D9000\nEND\n", 2, 1, Code::out_of_range, 1500},
      // areas
      {"AREA X\nLIN K1\nEND\n", 2, 1, Code::wrong_area, 1500},
      {"AREA PLC\nLAB K1\nEND\n", 2, 1, Code::wrong_area, 3500},
      {"AREA C\nOUT Y1\nEND\n", 2, 1, Code::wrong_area, 0},
      // structure
      {"AREA X\nSET Y0\n", 2, 1, Code::no_end, 1500},
      {"AREA X\nIF\nENDI\nEND\n", 2, 1, Code::logic, 1500},
      {"AREA X\nCJ K1\nEND\n", 2, 1, Code::logic, 1500},
      {"AREA X\nLD X0\nSET Y0\nEND\n", 3, 1, Code::logic, 1501},
      {"AREA X\nLD X0\nEND\n", 3, 1, Code::logic, 1501},
      {"AREA X\nAND X0\nCJ K0\nEND\n", 2, 1, Code::logic, 1500},
      {"AREA X\nLD X0\nANB\nCJ K0\nEND\n", 3, 1, Code::logic, 1501},
      {"AREA X\nLD X0\nIF\nEND\n", 3, 1, Code::pairing, 1501},
      {"AREA X\nENDI\nEND\n", 2, 1, Code::pairing, 1500},
      {"AREA X\nELSE\nEND\n", 2, 1, Code::pairing, 1500},
      {"AREA X\nLD X0\nIF\nELSE\nELSE\nENDI\nEND\n", 5, 1, Code::pairing, 1503},
      {"AREA PLC\nOUT Y0\nEND\n", 2, 1, Code::logic, 3500},
      {"AREA PLC\nAND X0\nOUT Y0\nEND\n", 2, 1, Code::logic, 3500},
      {"AREA PLC\nLD X0\nORB\nEND\n", 3, 1, Code::logic, 3501},
      {"AREA PLC\nLD X0\nMRD\nEND\n", 3, 1, Code::logic, 3501},
      {"AREA PLC\nLD X0\nMPS\nMPP\nMPP\nEND\n", 5, 1, Code::logic, 3503},
  };
  for (const Refusal& refusal : kRefusals) {
    const Checked checked = check(refusal.text);
    EXPECT_FALSE(checked.program) << refusal.text;
    ASSERT_FALSE(checked.errors.empty()) << refusal.text;
    const Diagnostic& error = checked.errors[0];
    EXPECT_EQ(std::tuple(error.line, error.column, error.code, error.step),
              std::tuple(refusal.line, refusal.column, refusal.code, refusal.step))
        << refusal.text << to_string(error);
    EXPECT_FALSE(error.what.empty());
  }
}

TEST(Super40ncListing, SaysWhatItsErrorsAre) {
  EXPECT_EQ(to_string(check("AREA X\nSET Y99\nEND\n").errors.at(0)),
            "2:5: Y99 does not exist; expected Y0 to Y31");
  EXPECT_EQ(to_string(check("AREA X\nSTE Y9\nEND\n").errors.at(0)).substr(0, 31),
            "2:1: 'STE' is not an instructio");
  EXPECT_EQ(check("AREA X\nFOO\nBAR\nSET Y99\n").errors.size(), 4u);  // all of them, and no END
}

TEST(Super40ncListing, FindsStacksAndMemoryFull) {
  const auto first_code = [](const std::string& text) {
    const Checked checked = check(text);
    return checked.errors.empty() ? Code::none : checked.errors[0].code;
  };
  EXPECT_EQ(first_code("AREA PLC\n" + many(16, "LD X0") + "OUT Y0\nEND\n"), Code::none);
  EXPECT_EQ(first_code("AREA PLC\n" + many(17, "LD X0") + "OUT Y0\nEND\n"), Code::logic);
  EXPECT_EQ(first_code("AREA PLC\n" + many(30, "LD X0\nOUT Y0") + "END\n"), Code::none);
  EXPECT_EQ(first_code("AREA PLC\nLD X0\n" + many(16, "MPS") + "OUT Y0\nEND\n"), Code::none);
  EXPECT_EQ(first_code("AREA PLC\nLD X0\n" + many(17, "MPS") + "OUT Y0\nEND\n"), Code::logic);
  EXPECT_EQ(first_code("AREA X\n" + many(8, "LD X0\nIF") + many(8, "ENDI") + "END\n"), Code::none);
  EXPECT_EQ(first_code("AREA X\n" + many(9, "LD X0\nIF") + many(9, "ENDI") + "END\n"), Code::pairing);
  EXPECT_EQ(first_code("AREA X\n" + many(499, "SET Y0") + "END\n"), Code::none);
  const Checked full = check("AREA X\n" + many(500, "SET Y0") + "END\n");
  EXPECT_EQ(full.errors.at(0).code, Code::memory_full);
  EXPECT_EQ(full.errors.at(0).step, 2000);
  EXPECT_EQ(first_code("AREA C\n" + many(375, "LIN K1") + "END\n"), Code::memory_full);
  EXPECT_EQ(first_code("AREA C\n" + many(374, "LIN K1") + "END\n"), Code::none);
  Options lines;
  lines.choose(option("capacity_unit", "lines"));
  EXPECT_TRUE(check("AREA C\n" + many(1499, "LIN K1") + "END\n", lines).program);
}

TEST(Super40ncListing, LoadsADoubledLabelAndReportsIt) {
  const Checked checked = check("AREA Y\nLAB K5\nSET Y0\nLAB K5\nEND\n");
  ASSERT_TRUE(checked.program);
  ASSERT_EQ(checked.warnings.size(), 1u);
  EXPECT_EQ(checked.warnings[0].code, Code::label_twice);
  EXPECT_EQ(checked.warnings[0].step, 2002);
  EXPECT_EQ(checked.warnings[0].other_step, 2000);
  EXPECT_TRUE(check("AREA X\nLAB K5\nEND\nAREA Y\nLAB K5\nEND\n").warnings.empty());  // a separate area
  Options strict;
  strict.choose(option("duplicate_label", "refused_at_load"));
  EXPECT_FALSE(check("AREA Y\nLAB K5\nLAB K5\nEND\n", strict).program);
}

/// It stops there with D8094 = 3 when it reaches the line, not before.
TEST(Super40ncListing, LoadsAJumpWithoutItsLabelAndNotesIt) {
  for (const char* jump : {"JMP K9", "CAL K9", "LD M0\nCJ K9"}) {
    const std::string text = "AREA X\nLAB K1\n" + std::string(jump) + "\nEND\nAREA Y\nLAB K9\nEND\n";
    const Checked checked = check(text);
    ASSERT_TRUE(checked.program) << jump;
    EXPECT_TRUE(checked.warnings.empty()) << jump;
    ASSERT_EQ(checked.notes.size(), 1u) << jump;
    EXPECT_EQ(checked.notes[0].code, Code::label_missing);
    Options common;
    common.choose(option("label_scope", "the_first_area_has_it"));
    EXPECT_TRUE(check(text, common).notes.empty()) << jump;
  }
  EXPECT_TRUE(check("AREA X\nLAB K1\nJMP K1\nEND\n").notes.empty());
}

TEST(Super40ncListing, OtherReadingsRefuseOtherThings) {
  Options options;
  options.choose(option("reset_timers_counters", "refused_at_load"));
  EXPECT_FALSE(check("AREA X\nRST T0\nEND\n", options).program);
  EXPECT_FALSE(check("AREA X\nZRST C0 C5\nEND\n", options).program);
  options = {};
  options.choose(option("mset", "refused_at_load"));
  EXPECT_FALSE(check("AREA X\nMSET K0\nEND\n", options).program);
  options = {};
  options.choose(option("void_lines", "refused_at_load"));
  EXPECT_EQ(check("AREA C\nCHK K0\nEND\n", options).errors.at(0).code, Code::wrong_area);
  options = {};
  options.choose(option("cj_without_group", "takes_the_last_result"));
  EXPECT_TRUE(check("AREA X\nCJ K0\nLD X0\nSET Y0\nLAB K0\nEND\n", options).program);
  options = {};
  options.choose(option("double_coils", "refused_at_load"));
  EXPECT_FALSE(check("AREA PLC\nLD X0\nOUT Y0\nOUT Y0\nEND\n", options).program);
  options = {};
  options.choose(option("area_bases", "older"));
  EXPECT_EQ(check("AREA X\nFOO\n", options).errors.at(0).step, 500);
}

/// Users come from an FX: their instructions are answered with this controller's equivalent, not with the
/// nearest spelling.
TEST(Super40ncListing, AnswersWordsOfOtherPlcsWithItsOwn) {
  struct Case {
    std::string line;
    std::string says;
  };
  const std::string any = "; expected X, Y, M, T, C, D or K and a number, or *";
  for (const Case& each : std::vector<Case>{
           {"AND= D0 K5", "'AND=' is not an instruction; expected AD="},
           {"and>= D0 K5", "'and>=' is not an instruction; expected AD>="},
           {"LDD= D0 K5", "'LDD=' is not an instruction; expected LD=, as every register has 32 bits"},
           {"ANDD<> D0 K5", "'ANDD<>' is not an instruction; expected AD<>, as every register has 32 bits"},
           {"ORD> D0 K5", "'ORD>' is not an instruction; expected OR>, as every register has 32 bits"},
           {"DMOV K1 D0", "'DMOV' is not an instruction; expected MOV, as every register has 32 bits"},
           {"MOVP K1 D0",
            "'MOVP' is not an instruction; expected MOV, after an LDP if it must act only once"},
           {"ANDI X0", "'ANDI' is not an instruction; expected ANI"},
           {"CALL K1", "'CALL' is not an instruction; expected CAL"},
           {"NOT", "'NOT' is not an instruction; expected INV"},
           {"MVO K1 D0", "'MVO' is not an instruction; the nearest is 'MOV'"},
           {"MOV H10 D0", "'H10' is not an operand: constants are decimal; expected K16"},
           {"MOV hff D0", "'hff' is not an operand: constants are decimal; expected K255"},
           {"MOV 10 D0", "'10' is not an operand; expected K10 for a constant"},
           {"MOV K1.5 D0", "'K1.5' is not an operand; expected K and a whole decimal number"},
           {"MOV E1.5 D0",
            "'E1.5' is not an operand: constants are whole numbers; expected K and a decimal number"},
           {"MOV K4M0 D0", "'K4M0' is not an operand: contacts cannot form a number" + any},
           {"MOV D0Z1 D1", "'D0Z1' is not an operand: there are no index registers" + any},
           {"MOV Z1 D1", "'Z1' is not an operand: there are no index registers" + any},
           {"MOV R0 D0", "'R0' is not an operand" + any},
           {"LD S0", "step relay S0 is not allowed in a program" + any},
           {"CAL P1", "'P1' is not an operand: a label is a constant; expected K and its number"},
           {"LD SM400", "'SM400' is not an operand" + any}}) {
    const Checked checked = check("AREA C\n" + each.line + "\nEND\n");
    ASSERT_FALSE(checked.errors.empty()) << each.line;
    EXPECT_EQ(checked.errors[0].message(), each.says);
    EXPECT_EQ(checked.errors[0].line, 2);
  }
}

}  // namespace listing_test
}  // namespace understudy::interpreter::super_40nc
