// Tables of what was touched, their sums and their gaps.
#include "emulator/world/coverage/touched.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace understudy::emulator::world {
namespace touched_test {

TouchedReport report_of(std::int64_t read, std::int64_t written, std::int64_t refused) {
  TouchedReport report;
  report.models["m"] = {
      {.name = "bits", .columns = {"read as 1"}, .rows = {{"STATUS.alarm", {read}}}},
      {.name = "registers",
       .columns = {"read", "written", "refused"},
       .rows = {{"SPEED", {read, written, refused}}, {"STATUS", {read, kCannotBe, kCannotBe}, true}}}};
  return report;
}

TEST(Touched, AddsUp) {
  TouchedReport sum = report_of(1, 0, kCannotBe);
  sum.add(report_of(2, 0, 4));
  sum.add(report_of(0, 0, kCannotBe));
  EXPECT_EQ(sum, report_of(3, 0, 4));
  TouchedReport nothing;
  nothing.add(sum);
  EXPECT_EQ(nothing, sum);
  const TouchedTable::Share share = sum.models["m"][1].share();
  EXPECT_EQ(share.touched, 3);
  EXPECT_EQ(share.all, 4);
}

TEST(Touched, ListsTheWorstGapsFirst) {
  const auto cells = report_of(0, 0, kCannotBe).untouched();
  std::string text;
  for (const Untouched& cell : cells) text += text_of(cell) + "\n";
  EXPECT_EQ(text,
            "m: registers: STATUS: never read\n"
            "m: bits: STATUS.alarm: never read as 1\n"
            "m: registers: SPEED: never read\n"
            "m: registers: SPEED: never written\n");
}

TEST(Touched, IsJson) {
  const auto json = nlohmann::json::parse(json_text(report_of(2, 0, kCannotBe)));
  EXPECT_EQ(json["kind"], "device-coverage");
  const auto& registers = json["models"]["m"]["registers"];
  EXPECT_EQ(registers["touched"], 2);
  EXPECT_EQ(registers["of"], 3);
  EXPECT_EQ(registers["rows"]["SPEED"], nlohmann::json::parse("[2,0,null]"));
  ASSERT_EQ(json["untouched"].size(), 1U);
  EXPECT_EQ(json["untouched"][0]["row"], "SPEED");
  EXPECT_EQ(json["untouched"][0]["never"], "written");
}

}  // namespace touched_test
}  // namespace understudy::emulator::world
