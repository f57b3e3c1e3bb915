// Requests without frames: exceptions and their order, limits, writes of several registers
// (specification 1.3, 1.4; MODBUS Application Protocol V1.1b3).
#include "emulator/world/stations/server.h"

#include <gtest/gtest.h>

#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::world {
namespace server_test {

constexpr std::uint16_t kStatus = 0x0000;
constexpr std::uint16_t kPulse = 0x1000;
constexpr std::uint16_t kMoveInc = 0x1005;
constexpr std::uint16_t kServo = 0x1014;
constexpr std::uint16_t kMovingA = 1U << 4;

std::string ask(Device& device, std::string_view pdu) { return answer(device, hex(pdu)); }

TEST(ModbusServer, EveryOtherFunctionIsUnknownWhateverFollowsIt) {
  const auto device = make_simple2();
  for (int function = 0; function <= 0xFF; ++function) {
    if (function == 0x03 || function == 0x04 || function == 0x06 || function == 0x10) continue;
    const auto code = static_cast<std::uint8_t>(function);
    const std::string wanted = text(Bytes{static_cast<std::uint8_t>(code | 0x80), 0x01});
    EXPECT_EQ(answer(*device, {code}), wanted);
    EXPECT_EQ(answer(*device, {code, 0x10, 0x02, 0x00, 0x01}), wanted);
    EXPECT_EQ(answer(*device, Bytes(253, code)), wanted);
  }
  EXPECT_TRUE(same_state(*device, *make_simple2()));
}

TEST(ModbusServer, TestsFunctionThenQuantityThenAddressesThenValues) {
  struct Case {
    std::string_view what;
    std::string_view request;
    std::string_view reply;
  };
  const std::vector<Case> cases = {
      {"nothing at all", "", "80 01"},
      {"an unknown function with a bad quantity at a hole", "01 00 03 00 00", "81 01"},
      {"a read of no register", "03 00 00 00 00", "83 03"},
      {"a read of no register at a hole", "03 00 03 00 00", "83 03"},
      {"a read of too many", "03 40 00 00 7E", "83 03"},
      {"a read of too many from a hole", "04 00 03 00 7E", "84 03"},
      {"a read of 65535 registers", "03 00 00 FF FF", "83 03"},
      {"a read of a hole", "03 00 03 00 01", "83 02"},
      {"a read across a hole", "04 00 02 00 03", "84 02"},
      {"a read that ends in a hole", "03 00 05 00 02", "83 02"},
      {"a read that begins in a hole", "03 00 03 00 02", "83 02"},
      {"a read past the last address", "03 FF FF 00 02", "83 02"},
      {"a write to a hole", "06 00 03 00 00", "86 02"},
      {"a write to a read-only register", "06 00 01 C0 01", "86 02"},
      {"a write of a value above the range", "06 10 03 0B B9", "86 03"},
      {"a write of a value below the range", "06 F0 1C 00 00", "86 03"},
      {"a write of several with quantity 0", "10 10 00 00 00 00", "90 03"},
      {"quantity 0 at a hole", "10 00 03 00 00 00", "90 03"},
      {"a byte count that is too small", "10 10 00 00 02 02 00 01", "90 03"},
      {"a byte count that is too big", "10 10 00 00 01 04 00 01 00 00", "90 03"},
      {"an odd byte count", "10 10 02 00 01 03 00 01 00", "90 03"},
      {"a wrong byte count at a hole", "10 00 03 00 01 04 00 01 00 00", "90 03"},
      {"a write of several across a hole", "10 10 1D 00 02 04 00 00 00 00", "90 02"},
      {"the same with a bad value before the hole", "10 10 1D 00 02 04 00 02 00 00", "90 02"},
      {"a bad value before a read-only register", "10 00 04 00 02 04 FF FF FF FF", "90 02"},
      {"a write of several past the last address", "10 FF FF 00 02 04 00 00 00 00", "90 02"},
      {"the last of several out of range", "10 10 02 00 03 06 00 C8 00 05 0B B9", "90 03"},
      {"a whole 32-bit value out of range", "10 F0 02 00 02 04 00 00 00 00", "90 03"},
      {"a 32-bit value just above the range", "10 F0 02 00 02 04 00 01 80 00", "90 03"},
  };
  const auto device = make_simple2();
  for (const Case& c : cases) EXPECT_EQ(ask(*device, c.request), c.reply) << c.what;
  EXPECT_TRUE(same_state(*device, *make_simple2())) << "a refused request has changed something";
}

TEST(ModbusServer, ARequestOfTheWrongLengthIsABadValue) {
  const std::vector<std::pair<std::string_view, std::string_view>> requests = {
      {"03 00 00 00 01", "83 03"},
      {"04 00 00 00 01", "84 03"},
      {"06 10 02 00 C8", "86 03"},
      {"10 10 02 00 01 02 00 C8", "90 03"},
      {"10 10 00 00 05 0A 7D 00 00 00 00 C8 00 05 00 05", "90 03"},
  };
  const auto device = make_simple2();
  for (const auto& [request, reply] : requests) {
    const Bytes whole = hex(request);
    for (std::size_t size = 1; size < whole.size(); ++size) {
      EXPECT_EQ(answer(*device, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
                reply)
          << request << " cut to " << size;
    }
    Bytes longer = whole;
    while (longer.size() < 253) {
      longer.push_back(0);
      EXPECT_EQ(answer(*device, longer), reply) << request << " as long as " << longer.size();
    }
  }
  EXPECT_TRUE(same_state(*device, *make_simple2()));
}

TEST(ModbusServer, ReadsUpTo125RegistersAndWritesUpTo123) {
  const auto device = make_simple2();
  EXPECT_EQ(read(*device, 0x4000, 125).size(), 125u);
  EXPECT_TRUE(read(*device, 0x4000, 126).empty());
  EXPECT_EQ(serve(*device, read_pdu(0x04, 0x4000, 125)).size, 252u);

  Words words(123);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint16_t>(i + 1);
  EXPECT_EQ(answer(*device, write_request(0x4000, words)), "10 40 00 00 7B");
  EXPECT_EQ(read(*device, 0x4000, 123), words);
  words.assign(124, 9);
  EXPECT_EQ(answer(*device, write_request(0x4000, words)), "90 03");
  EXPECT_EQ(read(*device, 0x4000, 2), (Words{1, 2}));
}

TEST(ModbusServer, TheLastAddressesMayBeReadToTheEnd) {
  const auto device = make_simple2();
  EXPECT_EQ(read(*device, 0xFF00, 10).size(), 10u);
  EXPECT_EQ(answer(*device, read_pdu(3, 0xFF00, 11)), "83 02");
}

TEST(ModbusServer, BothReadFunctionsReadTheSameRegisters) {
  const auto device = make_simple2();
  EXPECT_EQ(ask(*device, "03 F0 02 00 02"), "03 04 0C 80 00 00");
  EXPECT_EQ(ask(*device, "04 F0 02 00 02"), "04 04 0C 80 00 00");
}

TEST(ModbusServer, PanelsMayReadTheMotionBlocksSixWriteOnlyWords) {
  const auto device = make_simple2();
  answer(*device, write_request(kPulse, Words{0x7D00, 0, 200, 5, 6}));
  Words block(30, 0);
  block[0] = 0x7D00;
  block[2] = 200;
  block[3] = 5;
  block[4] = 6;
  EXPECT_EQ(read(*device, kPulse, 30), block);
}

TEST(ModbusServer, ProgramCellsKeepTheLowByteOfWhatIsWritten) {
  const auto device = make_simple2();
  EXPECT_EQ(ask(*device, "06 40 02 FF FB"), "06 40 02 FF FB");  // -5: the reply is the request
  EXPECT_EQ(ask(*device, "03 40 02 00 01"), "03 02 00 FB");
  EXPECT_EQ(ask(*device, "10 40 00 00 04 08 12 34 01 00 FF FF 00 7F"), "10 40 00 00 04");
  EXPECT_EQ(read(*device, 0x4000, 4), (Words{0x34, 0x00, 0xFF, 0x7F}));
}

// --- commands that start motion ---------------------------------------------------------------

TEST(ModbusServer, OneRequestSetsAMoveAndStartsItWithTheNewValues) {
  const auto device = make_simple2();
  answer(*device, write_request(kServo, 1));
  EXPECT_EQ(answer(*device, write_request(kPulse, Words{0x7D00, 0, 200, 5, 5, 1})), "10 10 00 00 06");
  EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, kMovingA);
  EXPECT_EQ(read(*device, kMoveInc, 1), Words{1});
}

TEST(ModbusServer, TheNextReadShowsWhatARequestHasStarted) {
  const auto device = make_simple2();
  answer(*device, write_request(kServo, 1));
  answer(*device, write_request(kPulse, Words{100, 0, 200, 5, 5}));
  EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, 0);
  answer(*device, write_request(kMoveInc, 1));
  EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, kMovingA);
}

TEST(ModbusServer, ABadValueKeepsTheWholeRequestFromStarting) {
  const auto device = make_simple2();
  answer(*device, write_request(kServo, 1));
  answer(*device, write_request(kPulse, Words{7, 0, 70, 7, 7}));
  EXPECT_EQ(answer(*device, write_request(kPulse, Words{9, 0, 90, 9, 3001, 1})), "90 03");
  EXPECT_EQ(answer(*device, write_request(kPulse, Words{9, 0, 90, 9, 9, 2})), "90 03");
  EXPECT_EQ(read(*device, kPulse, 6), (Words{7, 0, 70, 7, 7, 0}));
  EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, 0);
}

TEST(ModbusServer, TriggersOfOneRequestFireInTheOrderOfTheirAddresses) {
  // Move_INC comes before STOP, and before SVON.
  const auto device = make_simple2();
  answer(*device, write_request(kServo, 1));
  Words block(15, 0);
  block[0] = 1000;
  block[2] = 60;
  block[5] = 1;   // Aaxis_Move_INC
  block[14] = 1;  // Aaxis_STOP
  EXPECT_EQ(answer(*device, write_request(kPulse, block)), "10 10 00 00 0F");
  EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, 0) << "started, then stopped";

  const auto other = make_simple2();
  block.assign(21, 0);
  block[0] = 1000;
  block[2] = 60;
  block[5] = 1;
  block[20] = 1;  // Aaxis_SVON
  answer(*other, write_request(kPulse, block));
  EXPECT_EQ(read(*other, kServo, 1), Words{1});
  EXPECT_EQ(read(*other, kStatus, 1).at(0) & kMovingA, 0) << "the servo was off when the move came";
}

TEST(ModbusServer, AZeroToATriggerIsAcceptedAndDoesNothing) {
  const auto device = make_simple2();
  answer(*device, write_request(kServo, 1));
  answer(*device, write_request(kPulse, Words{1000, 0, 60, 5, 5, 1}));
  for (const std::uint16_t trigger : {0x1005, 0x100C, 0x100D, 0x100E, 0x1010, 0x1016, 0x101B, 0x101C, 0x2100,
                                      0x2106, 0x3001, 0x3004, 0xF024, 0xFF06}) {
    const Bytes request = write_request(trigger, 0);
    EXPECT_EQ(answer(*device, request), text(request)) << std::hex << trigger;
    EXPECT_EQ(read(*device, kStatus, 1).at(0) & kMovingA, kMovingA) << std::hex << trigger;
    EXPECT_EQ(read(*device, kMoveInc, 1), Words{1}) << std::hex << trigger;
  }
  EXPECT_EQ(answer(*device, write_request(0x1013, 0)), "06 10 13 00 00");  // ALL_SVON: here 0 acts
  EXPECT_EQ(read(*device, kStatus, 1), Words{0});
}

}  // namespace server_test
}  // namespace understudy::emulator::world
