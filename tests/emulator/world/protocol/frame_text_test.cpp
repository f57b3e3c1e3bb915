// Frames in words.
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::world {
namespace frame_text_test {

class FrameText : public testing::Test {
 protected:
  using Bytes = std::vector<std::uint8_t>;
  static Bytes framed(Bytes bytes) {
    pty::append_rtu_crc(bytes);
    return bytes;
  }
  World world_{parse_bench(models::all_models(),
                           "understudy: 1\n"
                           "lines:\n"
                           "  rs485:\n"
                           "    stations:\n"
                           "      - { name: feeder, model: simple2-r3, address: 1 }\n"
                           "      - { name: turner, model: simple2-r3, address: 2 }\n"
                           "      - { name: old, model: simple2-r3, address: 3, firmware: \"1.40\" }\n",
                           "bench.yaml", "."),
               WorldOptions{},
               {}};
};

TEST_F(FrameText, RequestsNameTheirRegisters) {
  struct Case {
    Bytes request;
    std::string text;
  };
  const std::vector<Case> cases = {
      {framed({1, 6, 0x10, 0x05, 0, 1}), "write 0x1005 feeder.Aaxis_Move_INC = 1"},
      {framed({2, 6, 0x10, 0x05, 0, 1}), "write 0x1005 turner.Aaxis_Move_INC = 1"},
      {framed({1, 3, 0x0E, 0x04, 0, 2}), "read 0x0E04 feeder.Cord_A"},
      {framed({1, 3, 0x0E, 0x04, 0, 1}), "read 0x0E04 feeder.Cord_A_L"},
      {framed({1, 3, 0x0E, 0x05, 0, 2}), "read 0x0E05 feeder.Cord_A_H, Cord_B_L"},
      {framed({1, 3, 0x00, 0x02, 0, 3}), "read 0x0002 feeder.Version, 0x0003, Aaxis_Mode"},
      {framed({1, 16, 0x10, 0x00, 0, 3, 6, 0x86, 0xA0, 0, 1, 0, 200}),
       "write 0x1000 feeder.Aaxis_Pulse = 100000, Aaxis_Speed = 200"},
      {framed({1, 16, 0x10, 0x00, 0, 2, 4, 0xFF, 0xFF, 0xFF, 0xFF}), "write 0x1000 feeder.Aaxis_Pulse = -1"},
      {framed({1, 16, 0x40, 0x00, 0, 10, 20, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0}),
       "write 0x4000 feeder.MAIN_LINE0_CMD = 256, MAIN_LINE0_DATA1 = 256, MAIN_LINE0_DATA2 = 256, "
       "MAIN_LINE0_JMP = 256, MAIN_LINE1_CMD = 256, MAIN_LINE1_DATA1 = 256, MAIN_LINE1_DATA2 = 256, "
       "MAIN_LINE1_JMP = 256, and 2 more words"},
      {framed({9, 3, 0x00, 0x01, 0, 1}), "station 9: read 0x0001 0x0001"},
      {framed({0, 6, 0x10, 0x13, 0, 1}), "station 0: write 0x1013 feeder.ALL_SVON = 1"},
      {framed({1, 5, 0x00, 0x01, 0, 1}), "01 05 00 01 00 01 5D CA"},
      {{1, 3, 0, 1, 0, 1, 0xD5, 0xCB}, "01 03 00 01 00 01 D5 CB"},
      {{0xFF}, "FF"},
      {{}, ""},
  };
  for (const Case& c : cases) EXPECT_EQ(world_.line(0).request_text(c.request), c.text);
}

TEST_F(FrameText, RepliesSayWhatTheRequestAskedFor) {
  const Bytes read = framed({1, 3, 0x0E, 0x04, 0, 2});
  const Bytes write = framed({1, 6, 0x10, 0x05, 0, 1});
  struct Case {
    Bytes request;
    Bytes reply;
    std::string text;
  };
  const std::vector<Case> cases = {
      {read, framed({1, 3, 4, 0x7D, 0, 0, 0}), "feeder.Cord_A = 32000"},
      {read, framed({1, 0x83, 2}), "exception 2 (illegal data address)"},
      {read, framed({1, 0x83, 99}), "exception 99"},
      {read, framed({2, 3, 4, 0x7D, 0, 0, 0}), "02 03 04 7D 00 00 00 "},  // another station's
      {{}, framed({1, 3, 2, 0xC0, 1}), "01 03 02 C0 01 29 84"},
      {read, framed({1, 3, 2, 0xC0, 1}), "01 03 02 C0 01 29 84"},
      {write, write, "done"},
      {read, {1, 3, 4}, "01 03 04"},
  };
  for (const Case& c : cases)
    EXPECT_EQ(world_.line(0).reply_text(c.request, c.reply).substr(0, c.text.size()), c.text);
}

TEST_F(FrameText, RefusalsHaveTheReasonOfTheTables) {
  struct Case {
    Bytes request;
    Bytes reply;
    std::string text;
  };
  const std::vector<Case> cases = {
      {framed({1, 6, 0x10, 0x02, 0xFD, 0xE8}), framed({1, 0x86, 3}),
       "exception 3 (illegal data value): feeder.Aaxis_Speed accepts 0 to 32768, not 65000"},
      {framed({1, 6, 0, 1, 0, 1}), framed({1, 0x86, 2}),
       "exception 2 (illegal data address): feeder.HW_Code is read-only"},
      {framed({1, 3, 0x0F, 0xFF, 0, 1}), framed({1, 0x83, 2}),
       "exception 2 (illegal data address): there is no register at 0x0FFF; the nearest are 0x0E"},
      {framed({1, 3, 0xFF, 0xFF, 0, 1}), framed({1, 0x83, 2}),
       "exception 2 (illegal data address): there is no register at 0xFFFF; the last is "},
      {framed({3, 3, 0xFF, 0x08, 0, 1}), framed({3, 0x83, 2}),
       "exception 2 (illegal data address): 0xFF08 old.PROG_UNLOCK exists from firmware 1.51 on"},
      {framed({1, 0x2B, 14, 1, 0}), framed({1, 0xAB, 1}),
       "exception 1 (illegal function): function 43 is not supported; feeder has 3"},
      {framed({1, 16, 0x10, 0, 0, 2, 2, 0, 1}), framed({1, 0x90, 3}),
       "exception 3 (illegal data value): its byte count does not fit 2 values"},
      {framed({1, 3, 0, 0, 0, 0}), framed({1, 0x83, 3}),
       "exception 3 (illegal data value): it requests 0 registers"},
      // What the device was doing is not in its tables.
      {framed({1, 6, 0x10, 0x02, 0, 1}), framed({1, 0x86, 3}), "exception 3 (illegal data value)"},
      {framed({1, 6, 0x10, 0x02, 0, 1}), framed({1, 0x86, 6}), "exception 6 (device busy)"},
  };
  for (const Case& c : cases) {
    const std::string reported = world_.line(0).reply_text(c.request, c.reply);
    EXPECT_EQ(reported.substr(0, c.text.size()), c.text);
    if (c.text.ends_with(")")) {
      EXPECT_EQ(reported, c.text);
    }
  }
}

TEST_F(FrameText, LongNoiseIsCut) {
  EXPECT_EQ(hex_text(Bytes(300, 0x55)).substr(90), "55 55 ... (300 bytes)");
}

}  // namespace frame_text_test
}  // namespace understudy::emulator::world
