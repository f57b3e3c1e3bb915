// The replies of each of the eight functions to wrong requests, and what the device learns of them: each kind
// of fault with each function. No part of such a request is executed.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <set>

#include "tests/emulator/workbench/one_station.h"

namespace understudy::emulator::workbench {
namespace bad_requests_test {

enum class Fault : std::uint8_t {
  no_count,
  beyond_the_limit,
  most_that_can_be_said,
  cut_short,
  too_long,
  byte_count_too_small,
  byte_count_too_large,
  bytes_missing,
  neither_on_nor_off,
  a_hole,
  beyond_the_table,
  beyond_all_addresses,
  read_only,
  write_only,
  half_a_pair,
  a_pair_and_a_half,
  out_of_range,
  window_in_part,
  window_from_the_middle,
  window_too_long,
  window_and_before_it,
  last,
};

struct Heard {
  std::uint16_t first = 0;
  std::size_t count = 0;
};

struct Case {
  Fault fault;
  const char* request;
  int exception;  // 0: valid; the table has valid requests too
  Cause cause = Cause::none;
  Heard received{};
  int reason = 0;
};

/// Repeated writes of one value: the request's head, followed by this many bytes 0x01.
std::string with_bytes(const std::string& head, int bytes) {
  std::string text = head;
  for (int i = 0; i < bytes; ++i) text += " 01";
  return text;
}

const std::string kCoilsBeyond = with_bytes("0F 10 00 07 B1 F7", 247);
// With all its words it would be longer than any frame (docs/wire.md).
const std::string kWordsBeyond = with_bytes("10 00 64 00 7C F6", 246);
const std::string kWindowBeyond = with_bytes("10 1F 40 00 15 2A", 42);

// By the state diagrams of the MODBUS Application Protocol V1.1b3, 6.1 to 6.12: count and byte count before
// the address, the address before the value; a value of function 05 that is neither before its address.
const Case kCases[] = {
    {Fault::no_count, "01 00 00 00 00", 3, Cause::bad_count, {0, 0}},
    {Fault::no_count, "02 00 00 00 00", 3, Cause::bad_count, {0, 0}},
    {Fault::no_count, "03 00 10 00 00", 3, Cause::bad_count, {0x10, 0}},
    {Fault::no_count, "04 FF FF 00 00", 3, Cause::bad_count, {0xFFFF, 0}},
    {Fault::no_count, "0F 00 00 00 00 00", 3, Cause::bad_count, {0, 0}},
    {Fault::no_count, "10 00 00 00 00 00", 3, Cause::bad_count, {0, 0}},

    {Fault::beyond_the_limit, "01 10 00 07 D1", 3, Cause::bad_count, {0x1000, 2001}},
    {Fault::beyond_the_limit, "02 00 00 07 D1", 3, Cause::bad_count, {0, 2001}},
    {Fault::beyond_the_limit, "03 00 64 00 7E", 3, Cause::bad_count, {0x64, 126}},
    {Fault::beyond_the_limit, "04 00 00 00 7E", 3, Cause::bad_count, {0, 126}},
    {Fault::beyond_the_limit, kCoilsBeyond.c_str(), 3, Cause::bad_count, {0x1000, 1969}},
    {Fault::beyond_the_limit, kWordsBeyond.c_str(), 3, Cause::bad_count, {0x64, 124}},

    {Fault::most_that_can_be_said, "01 10 00 FF FF", 3, Cause::bad_count, {0x1000, 0xFFFF}},
    {Fault::most_that_can_be_said, "02 00 00 FF FF", 3, Cause::bad_count, {0, 0xFFFF}},
    {Fault::most_that_can_be_said, "03 00 00 FF FF", 3, Cause::bad_count, {0, 0xFFFF}},
    {Fault::most_that_can_be_said, "04 00 00 FF FF", 3, Cause::bad_count, {0, 0xFFFF}},
    {Fault::most_that_can_be_said, "0F 00 00 FF FF FF 01", 3, Cause::bad_count, {0, 0xFFFF}},
    {Fault::most_that_can_be_said, "10 00 00 FF FF FE 01", 3, Cause::bad_count, {0, 0xFFFF}},

    {Fault::cut_short, "01 00 00 00", 3, Cause::bad_length, {0, 0}},
    {Fault::cut_short, "02 00 07", 3, Cause::bad_length, {7, 0}},
    {Fault::cut_short, "03 00 10 00", 3, Cause::bad_length, {0x10, 0}},
    {Fault::cut_short, "04 00", 3, Cause::bad_length, {0, 0}},
    {Fault::cut_short, "05 00 06 FF", 3, Cause::bad_length, {6, 1}},
    {Fault::cut_short, "06 00 01 00", 3, Cause::bad_length, {1, 1}},
    {Fault::cut_short, "0F 00 03 00 08", 3, Cause::bad_length, {3, 8}},
    {Fault::cut_short, "10 00 01", 3, Cause::bad_length, {1, 0}},

    {Fault::too_long, "01 00 00 00 01 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "02 00 00 00 01 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "03 00 00 00 01 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "04 00 00 00 01 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "05 00 00 FF 00 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "06 00 00 00 01 00", 3, Cause::bad_length, {0, 1}},
    {Fault::too_long, "0F 00 00 00 08 01 FF FF", 3, Cause::bad_length, {0, 8}},
    {Fault::too_long, "10 00 00 00 01 02 00 07 00", 3, Cause::bad_length, {0, 1}},

    {Fault::byte_count_too_small, "0F 00 00 00 09 01 FF", 3, Cause::bad_length, {0, 9}},
    {Fault::byte_count_too_small, "10 00 00 00 02 02 00 07", 3, Cause::bad_length, {0, 2}},
    {Fault::byte_count_too_large, "0F 00 00 00 08 02 FF FF", 3, Cause::bad_length, {0, 8}},
    {Fault::byte_count_too_large, "10 00 00 00 01 04 00 07 00 07", 3, Cause::bad_length, {0, 1}},
    {Fault::bytes_missing, "0F 00 00 00 09 02 FF", 3, Cause::bad_length, {0, 9}},
    {Fault::bytes_missing, "10 00 00 00 02 04 00 07 00", 3, Cause::bad_length, {0, 2}},

    {Fault::neither_on_nor_off, "05 00 00 00 01", 3, Cause::bad_bit, {0, 1}},
    {Fault::neither_on_nor_off, "05 00 00 FF 01", 3, Cause::bad_bit, {0, 1}},
    {Fault::neither_on_nor_off, "05 FF FF 01 00", 3, Cause::bad_bit, {0xFFFF, 1}},

    // Holes before the end of a table read zero, and ignore writes.
    {Fault::a_hole, "01 00 50 00 01", 0},
    {Fault::a_hole, "02 00 12 00 01", 0},
    {Fault::a_hole, "03 00 03 00 01", 0},
    {Fault::a_hole, "04 00 01 00 01", 0},
    {Fault::a_hole, "05 00 50 FF 00", 2, Cause::no_register, {0x50, 1}},
    {Fault::a_hole, "06 00 03 00 01", 2, Cause::no_register, {3, 1}},
    {Fault::a_hole, "0F 00 4E 00 04 01 0F", 2, Cause::no_register, {0x4E, 4}},
    {Fault::a_hole, "10 00 02 00 02 04 00 07 00 07", 2, Cause::no_register, {2, 2}},

    {Fault::beyond_the_table, "01 17 CF 00 02", 2, Cause::no_register, {0x17CF, 2}},
    {Fault::beyond_the_table, "02 00 31 00 02", 2, Cause::no_register, {0x31, 2}},
    {Fault::beyond_the_table, "03 1F 54 00 01", 2, Cause::no_register, {0x1F54, 1}},
    {Fault::beyond_the_table, "04 00 14 00 02", 2, Cause::no_register, {0x14, 2}},
    {Fault::beyond_the_table, "05 17 D0 FF 00", 2, Cause::no_register, {0x17D0, 1}},
    {Fault::beyond_the_table, "06 1F 54 00 01", 2, Cause::no_register, {0x1F54, 1}},
    {Fault::beyond_the_table, "0F 17 CF 00 02 01 03", 2, Cause::no_register, {0x17CF, 2}},
    {Fault::beyond_the_table, "10 1F 54 00 01 02 00 01", 2, Cause::no_register, {0x1F54, 1}},

    {Fault::beyond_all_addresses, "01 FF FF 07 D0", 2, Cause::no_register, {0xFFFF, 2000}},
    {Fault::beyond_all_addresses, "02 FF FF 00 02", 2, Cause::no_register, {0xFFFF, 2}},
    {Fault::beyond_all_addresses, "03 FF FF 00 7D", 2, Cause::no_register, {0xFFFF, 125}},
    {Fault::beyond_all_addresses, "04 FF FF 00 02", 2, Cause::no_register, {0xFFFF, 2}},
    {Fault::beyond_all_addresses, "0F FF FF 00 02 01 03", 2, Cause::no_register, {0xFFFF, 2}},
    {Fault::beyond_all_addresses, "10 FF FF 00 02 04 00 01 00 02", 2, Cause::no_register, {0xFFFF, 2}},

    {Fault::read_only, "05 00 64 FF 00", 2, Cause::read_only, {0x64, 1}},
    {Fault::read_only, "06 00 40 00 01", 2, Cause::read_only, {0x40, 1}},
    {Fault::read_only, "0F 00 64 00 03 01 07", 2, Cause::read_only, {0x64, 3}},
    {Fault::read_only, "10 00 40 00 02 04 00 00 00 01", 2, Cause::read_only, {0x40, 2}},
    {Fault::write_only, "03 00 31 00 02", 2, Cause::write_only, {0x31, 2}},

    {Fault::half_a_pair, "03 00 10 00 01", 2, Cause::cut_pair, {0x10, 1}},
    {Fault::half_a_pair, "04 00 03 00 01", 2, Cause::cut_pair, {3, 1}},
    {Fault::half_a_pair, "06 00 11 00 01", 2, Cause::cut_pair, {0x11, 1}},
    {Fault::half_a_pair, "10 00 11 00 02 04 00 05 00 06", 2, Cause::cut_pair, {0x11, 2}},
    {Fault::a_pair_and_a_half, "03 00 10 00 03", 2, Cause::cut_pair, {0x10, 3}},
    {Fault::a_pair_and_a_half, "04 00 02 00 03", 2, Cause::cut_pair, {2, 3}},
    {Fault::a_pair_and_a_half, "10 00 10 00 03 06 00 05 00 06 00 07", 2, Cause::cut_pair, {0x10, 3}},

    {Fault::out_of_range, "06 00 00 00 00", 3, Cause::out_of_range, {0, 1}},
    {Fault::out_of_range, "10 00 00 00 03 06 00 07 00 07 0F A1", 3, Cause::out_of_range, {0, 3}},
    {Fault::out_of_range, "10 00 20 00 04 08 3F C0 00 00 BF 80 00 00", 3, Cause::out_of_range, {0x20, 4}},

    {Fault::window_in_part,
     "10 1F 40 00 03 06 0A 01 00 01 00 00",
     3,
     Cause::bad_message,
     {0x1F40, 3},
     kWrongWords},
    {Fault::window_in_part, "06 1F 40 0A 01", 3, Cause::bad_message, {0x1F40, 1}, kWrongWords},
    {Fault::window_from_the_middle,
     "10 1F 41 00 03 06 00 01 00 00 03 E8",
     2,
     Cause::cut_message,
     {0x1F41, 3}},
    {Fault::window_from_the_middle, "06 1F 41 0A 02", 2, Cause::cut_message, {0x1F41, 1}},
    {Fault::window_too_long,
     "10 1F 40 00 05 0A 0A 01 00 01 00 00 03 E8 00 00",
     3,
     Cause::bad_message,
     {0x1F40, 5},
     kWrongWords},
    {Fault::window_too_long, kWindowBeyond.c_str(), 2, Cause::cut_message, {0x1F40, 21}},
    {Fault::window_and_before_it, "10 1F 3F 00 02 04 00 00 0A 02", 2, Cause::no_register, {0x1F3F, 2}},
};

std::uint8_t function_of(const Case& c) { return world::hex(c.request)[0]; }

TEST(BadRequests, GetTheRightExceptionAndChangeNothing) {
  for (const Case& c : kCases) {
    OneStation rig(true);  // only silence ends a frame: data that contradicts its length is received as well
    const WorkbenchState before = rig.state();
    const std::string reply = rig.ask(c.request);
    const std::uint8_t function = function_of(c);
    if (c.exception == 0) {
      EXPECT_EQ(reply.substr(0, 2), std::string(c.request).substr(0, 2)) << c.request;
      EXPECT_EQ(rig.state(), before) << c.request;
      continue;
    }
    EXPECT_EQ(reply, world::text(world::Bytes{static_cast<std::uint8_t>(function | 0x80),
                                              static_cast<std::uint8_t>(c.exception)}))
        << c.request;
    WorkbenchState after = rig.state();
    EXPECT_EQ(static_cast<int>(after.cause), static_cast<int>(c.cause)) << c.request;
    EXPECT_EQ(after.reason, c.reason) << c.request;
    after.cause = before.cause;
    after.reason = before.reason;
    EXPECT_EQ(after, before) << c.request << ": part of it was executed";
    const RefusedRequest& received = rig.bench().last_refused;
    EXPECT_EQ(received.function, function) << c.request;
    EXPECT_EQ(received.exception, c.exception) << c.request;
    EXPECT_EQ(received.first, c.received.first) << c.request;
    EXPECT_EQ(received.count, c.received.count) << c.request;
  }
}

TEST(BadRequests, EveryFunctionHasEveryFaultThatItCanHave) {
  constexpr std::uint8_t kReads[] = {0x01, 0x02, 0x03, 0x04};
  constexpr std::uint8_t kSeveral[] = {0x0F, 0x10};
  using Functions = std::set<std::uint8_t>;
  const Functions all(std::begin(kFunctions), std::end(kFunctions));
  Functions counted(std::begin(kReads), std::end(kReads));
  counted.insert(std::begin(kSeveral), std::end(kSeveral));
  const Functions several(std::begin(kSeveral), std::end(kSeveral));
  const Functions writes{0x05, 0x06, 0x0F, 0x10};
  const std::array<Functions, static_cast<std::size_t>(Fault::last)> possible{
      counted,                   // no_count
      counted,                   // beyond_the_limit
      counted,                   // most_that_can_be_said
      all,                       // cut_short
      all,                       // too_long
      several,                   // byte_count_too_small
      several,                   // byte_count_too_large
      several,                   // bytes_missing
      {0x05},                    // neither_on_nor_off
      all,                       // a_hole
      all,                       // beyond_the_table
      counted,                   // beyond_all_addresses
      writes,                    // read_only
      {0x03},                    // write_only: there are no coils or input registers of that kind
      {0x03, 0x04, 0x06, 0x10},  // half_a_pair
      {0x03, 0x04, 0x10},        // a_pair_and_a_half
      {0x06, 0x10},              // out_of_range
      {0x06, 0x10},              // window_in_part
      {0x06, 0x10},              // window_from_the_middle
      {0x10},                    // window_too_long
      {0x10},                    // window_and_before_it
  };
  std::array<Functions, static_cast<std::size_t>(Fault::last)> had;
  for (const Case& c : kCases) had[static_cast<std::size_t>(c.fault)].insert(function_of(c));
  for (std::size_t i = 0; i < had.size(); ++i) EXPECT_EQ(had[i], possible[i]) << "fault " << i;
}

TEST(BadRequests, AFunctionThatIsNotServedIsReportedToo) {
  for (const char* request : {"08 00 00 12 34", "17 00 00 00 01 00 00 00 01 02 00 00", "7F", "2B 0E 01 00"}) {
    OneStation rig(true);
    const auto function = static_cast<std::uint8_t>(world::hex(request)[0]);
    EXPECT_EQ(rig.ask(request), world::text(world::Bytes{static_cast<std::uint8_t>(function | 0x80), 1}));
    const RefusedRequest& received = rig.bench().last_refused;
    EXPECT_EQ(received.function, function);
    EXPECT_EQ(received.exception, 1);
    EXPECT_EQ(received.objection.cause, Cause::unknown_function);
    EXPECT_EQ(received.count, 0U) << "the meaning of its bytes is unknown";
  }
}

TEST(BadRequests, NothingAtAllIsNoFunction) {
  OneStation rig;
  const world::ModbusReply reply = world::serve(*rig.device, {});
  EXPECT_EQ(reply.size, 2U);
  EXPECT_EQ(reply.pdu[0], 0x80);
  EXPECT_EQ(reply.pdu[1], 1);
  EXPECT_EQ(reply.refused.objection.cause, Cause::unknown_function);
}

TEST(BadRequests, TheDeviceHasReasonsOfItsOwn) {
  OneStation rig;
  for (std::size_t i = 0; i < kFifo; ++i) ASSERT_EQ(rig.ask("06 1F 40 0A 02"), "06 1F 40 0A 02");
  struct Own {
    const char* request;
    int exception;
    int reason;
    std::size_t count;
  };
  const Own full[] = {{"06 1F 40 0A 02", 6, kFifoFull, 1},
                      {"10 00 10 00 04 08 00 00 00 01 00 00 00 02", 6, kFifoFull, 4},
                      {"06 1F 40 0B 02", 3, kUnknownCommand, 1},
                      {"06 00 00 00 00", 3, 0, 1}};
  const Own absent[] = {{"06 1F 40 0A 02", 4, kModuleAbsent, 1}, {"03 00 10 00 06", 4, kModuleAbsent, 6}};
  const auto expect_all = [&](std::span<const Own> cases) {
    for (const Own& c : cases) {
      EXPECT_EQ(rig.ask(c.request).substr(3), "0" + std::to_string(c.exception)) << c.request;
      EXPECT_EQ(rig.bench().last_refused.objection.reason, c.reason) << c.request;
      EXPECT_EQ(rig.bench().last_refused.exception, c.exception) << c.request;
      EXPECT_EQ(rig.bench().last_refused.count, c.count) << c.request;
      EXPECT_EQ(rig.ask("04 00 11 00 01"),
                "04 02 00 " + world::text(world::Bytes{static_cast<std::uint8_t>(c.reason)}));
    }
  };
  expect_all(full);
  ASSERT_EQ(rig.ask("05 00 6F FF 00"), "05 00 6F FF 00");
  expect_all(absent);
}

}  // namespace bad_requests_test
}  // namespace understudy::emulator::workbench
