// A window takes the words of one request as one message; what the device itself refuses, and what it learns
// of refusals.
#include <gtest/gtest.h>

#include "emulator/device/register_map/access.h"
#include "tests/emulator/workbench/one_station.h"

namespace understudy::emulator::workbench {
namespace window_test {

using Rig = OneStation;

constexpr const char* kMoveY = "10 1F 40 00 04 08 0A 01 00 01 00 00 03 E8";
constexpr const char* kStopAll = "10 1F 40 00 01 02 0A 02";

TEST(Window, TakesARequestAsOneMessage) {
  Rig rig;
  EXPECT_EQ(rig.ask(kMoveY), "10 1F 40 00 04");
  EXPECT_EQ(rig.ask("06 1F 40 0A 02"), "06 1F 40 0A 02");
  const std::vector<std::vector<std::uint16_t>> wanted = {{kMove, 1, 0, 1000}, {kStop}};
  EXPECT_EQ(rig.state().fifo, wanted);
}

TEST(Window, IsRefusedInPartFromTheMiddleOrTooLong) {
  struct Case {
    const char* request;
    const char* reply;
    const char* what;
  };
  const Case cases[] = {
      {"10 1F 40 00 03 06 0A 01 00 01 00 00", "90 03", "a part of its command"},
      {"10 1F 40 00 05 0A 0A 01 00 01 00 00 03 E8 00 00", "90 03", "more than its command"},
      {"10 1F 41 00 03 06 00 01 00 00 03 E8", "90 02", "from the middle"},
      {"06 1F 41 0A 02", "86 02", "from the middle, one word"},
      {"10 1F 3F 00 02 04 00 00 0A 02", "90 02", "together with what is before it"},
      {"10 1F 53 00 02 04 0A 02 00 00", "90 02", "over its end"},
      {"10 1F 40 00 01 02 0B 02", "90 03", "no such command"},
      {"10 1F 40 00 04 08 0A 01 00 03 00 00 03 E8", "90 03", "no such axis"},
      {"03 1F 40 00 01", "83 02", "read"},
  };
  for (const Case& c : cases) {
    Rig rig;
    const WorkbenchState before = rig.state();
    EXPECT_EQ(rig.ask(c.request), c.reply) << c.what;
    EXPECT_TRUE(rig.state().fifo.empty() && rig.state().image == before.image) << c.what;
  }
  Rig rig;
  std::string longer = "10 1F 40 00 15 2A 0A 02";
  for (int i = 0; i < 20; ++i) longer += " 00 00";
  EXPECT_EQ(rig.ask(longer), "90 02") << "21 words for a window of 20";
}

TEST(Refusals, AFullFifoIsBusyAndAnAbsentModuleFails) {
  Rig rig;
  for (std::size_t i = 0; i < kFifo; ++i) EXPECT_EQ(rig.ask(kMoveY), "10 1F 40 00 04");
  const WorkbenchState full = rig.state();
  EXPECT_EQ(rig.ask(kMoveY), "90 06");
  EXPECT_EQ(rig.ask("10 1F 40 00 01 02 0B 02"), "90 03")
      << "a command is checked before there is room for it";
  EXPECT_EQ(rig.ask("10 00 10 00 04 08 00 00 00 01 00 00 00 02"), "90 06") << "no part of it is stored";
  EXPECT_EQ(rig.ask("10 00 10 00 03 06 00 00 00 01 00 00"), "90 02") << "the check of a cut pair comes first";
  EXPECT_EQ(rig.ask("03 00 10 00 02"), "03 04 00 00 00 00") << "a read does not wait";
  EXPECT_EQ(rig.state().positions, full.positions);
  EXPECT_EQ(rig.state().fifo, full.fifo);
  EXPECT_EQ(rig.ask("05 00 6F FF 00"), "05 00 6F FF 00");
  EXPECT_EQ(rig.ask(kStopAll), "90 04");
  EXPECT_EQ(rig.ask("10 1F 40 00 01 02 0B 02"), "90 04") << "there is nothing to check it";
  EXPECT_EQ(rig.ask("03 00 10 00 02"), "83 04");
  EXPECT_EQ(rig.ask("03 00 10 00 01"), "83 02") << "the address comes first";
  EXPECT_EQ(rig.ask("03 00 00 00 01"), "03 02 00 64") << "the module's own checks follow";
}

TEST(Refusals, TheDeviceLearnsOfEachThatIsAnswered) {
  struct Case {
    const char* request;
    Cause cause;
  };
  const Case cases[] = {
      {"08 00 00 12 34", Cause::unknown_function}, {"03 00 00 00 00", Cause::bad_count},
      {"01 00 00 07 D1", Cause::bad_count},        {"0F 00 00 00 08 02 00 00", Cause::bad_length},
      {"05 00 00 12 34", Cause::bad_bit},          {"03 FF FF 00 01", Cause::no_register},
      {"06 00 40 00 01", Cause::read_only},        {"03 00 32 00 01", Cause::write_only},
      {"03 00 10 00 01", Cause::cut_pair},         {"06 00 10 00 01", Cause::cut_pair},
      {"06 1F 41 00 01", Cause::cut_message},      {"06 00 00 00 00", Cause::out_of_range},
      {"06 1F 40 00 01", Cause::bad_message},
  };
  Rig rig;
  for (const Case& c : cases) {
    EXPECT_NE(rig.ask(c.request), "") << c.request;
    EXPECT_EQ(rig.state().cause, static_cast<int>(c.cause)) << c.request;
    EXPECT_EQ(rig.ask("04 00 10 00 01"), "04 02 00 " + world::text(world::Bytes{rig.state().cause}));
  }
  EXPECT_EQ(rig.ask("06 00 00 00 00", 0), "") << "broadcast";
  EXPECT_EQ(rig.state().cause, static_cast<int>(Cause::bad_message)) << "which is not reported";
}

TEST(Window, CannotBeWrittenByItsNames) {
  Rig rig;
  RegisterBank& bank = *rig.device->register_bank();
  const auto place = bank.find("Command0");
  ASSERT_TRUE(place);
  PreparedWrite write;
  EXPECT_EQ(prepare_value(bank, *place, kStop, write), Refusal::no_register);
  EXPECT_EQ(write_value(bank, *place, kStop), Refusal::no_register);
  EXPECT_TRUE(rig.state().fifo.empty());
}

}  // namespace window_test
}  // namespace understudy::emulator::workbench
