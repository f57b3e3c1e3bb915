// A sheet in its four formats.
#include "emulator/device/describe/sheet.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/interpreter/facts.h"

namespace understudy::emulator {
namespace sheet_test {

const Sheet kSheet{.columns = {"name", "count", "remark"},
                   .rows = {{"plain", "12", "nothing special"},
                            {"a,b", "-3", "says \"no\""},
                            {"pipe|bar", "", "two\nlines"},
                            {"位址列表", "0x10", "007"}}};

TEST(SheetFormats, HaveFourNames) {
  EXPECT_EQ(parse_sheet_format("table"), SheetFormat::table);
  EXPECT_EQ(parse_sheet_format("csv"), SheetFormat::csv);
  EXPECT_EQ(parse_sheet_format("json"), SheetFormat::json);
  EXPECT_EQ(parse_sheet_format("markdown"), SheetFormat::markdown);
  for (const char* name : {"", "CSV", "csv ", "yaml", "md"}) EXPECT_FALSE(parse_sheet_format(name)) << name;
}

TEST(SheetFormats, CsvQuotesWhatNeedsIt) {
  EXPECT_EQ(format_sheet(kSheet, SheetFormat::csv),
            "name,count,remark\n"
            "plain,12,nothing special\n"
            "\"a,b\",-3,\"says \"\"no\"\"\"\n"
            "pipe|bar,,\"two\nlines\"\n"
            "位址列表,0x10,007\n");
}

TEST(SheetFormats, AReaderOfCsvGetsTheCellsBack) {
  const std::string csv =
      format_sheet({.columns = kSheet.columns, .rows = {kSheet.rows[1]}}, SheetFormat::csv);
  const std::string line = csv.substr(csv.find('\n') + 1);
  EXPECT_EQ(csv_cells(line.substr(0, line.size() - 1)), kSheet.rows[1]);
}

TEST(SheetFormats, AColumnOfNumbersIsOfNumbersInJsonWithNullForNone) {
  const Sheet sheet{.columns = {"address", "max"}, .rows = {{"0x10", "12"}, {"16", ""}, {"0x12", "-3"}}};
  const auto parsed = nlohmann::json::parse(format_sheet(sheet, SheetFormat::json));
  EXPECT_EQ(parsed[0]["max"], 12);
  EXPECT_TRUE(parsed[1]["max"].is_null());
  EXPECT_EQ(parsed[2]["max"], -3);
  EXPECT_EQ(parsed[1]["address"], "16") << "the others are none";
}

TEST(SheetFormats, JsonIsAnArrayOfObjects) {
  const std::string json = format_sheet(kSheet, SheetFormat::json);
  const auto parsed = nlohmann::json::parse(json);
  ASSERT_TRUE(parsed.is_array());
  ASSERT_EQ(parsed.size(), kSheet.rows.size());
  EXPECT_EQ(parsed[0]["count"], "12");
  EXPECT_EQ(parsed[1]["count"], "-3");
  EXPECT_EQ(parsed[1]["remark"], "says \"no\"");
  EXPECT_EQ(parsed[2]["count"], "");
  EXPECT_EQ(parsed[2]["remark"], "two\nlines");
  EXPECT_EQ(parsed[3]["name"], "位址列表");
  EXPECT_EQ(parsed[3]["count"], "0x10");
  EXPECT_EQ(json.back(), '\n');
  EXPECT_LT(json.find("\"name\""), json.find("\"count\"")) << "the columns keep their order";
}

TEST(SheetFormats, MarkdownIsATableInWhichABarIsNoBorder) {
  const Sheet sheet{.columns = {"name", "options"}, .rows = {{"stop", "at_once|softly"}, {"empty", ""}}};
  EXPECT_EQ(format_sheet(sheet, SheetFormat::markdown),
            "| name | options |\n"
            "|---|---|\n"
            "| stop | at_once\\|softly |\n"
            "| empty |  |\n");
}

TEST(SheetFormats, TheTableForPeopleIsAlignedAndHasNoTrailingSpaces) {
  const Sheet sheet{.columns = {"name", "n", "remark"},
                    .rows = {{"a", "1", "first"}, {"longest", "12345", ""}, {"位址", "", "wide letters"}}};
  EXPECT_EQ(format_sheet(sheet, SheetFormat::table),
            "name     n      remark\n"
            "a        1      first\n"
            "longest  12345\n"
            "位址            wide letters\n");
}

TEST(SheetFormats, ASheetWithoutRowsIsItsHeader) {
  const Sheet sheet{.columns = {"a", "b"}, .rows = {}};
  EXPECT_EQ(format_sheet(sheet, SheetFormat::csv), "a,b\n");
  EXPECT_EQ(format_sheet(sheet, SheetFormat::table), "a  b\n");
  EXPECT_EQ(format_sheet(sheet, SheetFormat::markdown), "| a | b |\n|---|---|\n");
  EXPECT_EQ(nlohmann::json::parse(format_sheet(sheet, SheetFormat::json)), nlohmann::json::array());
}

}  // namespace sheet_test
}  // namespace understudy::emulator
