// Four tables over the eight functions that reach them: requests and replies written by hand from the MODBUS
// Application Protocol V1.1b3, 6.1 to 6.12, whose state diagrams give the order of exceptions.
#include <gtest/gtest.h>

#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {
namespace tables_test {

using world::Bytes;

struct Exchange {
  std::string_view request;
  std::string_view reply;  // empty: the first five bytes of the request
  const char* what = "";
};

std::unique_ptr<Device> make_workbench() {
  DeviceSettings settings;
  settings.name = "it";
  return make_device(model(), settings);
}

const WorkbenchState& state_of(const Device& device) { return static_cast<const Workbench&>(device).state; }

void expect_exchanges(Device& device, std::span<const Exchange> exchanges) {
  for (const Exchange& exchange : exchanges) {
    const WorkbenchState before = state_of(device);
    const std::string reply = world::answer(device, world::hex(exchange.request));
    EXPECT_EQ(reply, exchange.reply.empty() ? exchange.request.substr(0, 14) : exchange.reply)
        << exchange.request << ": " << exchange.what;
    if (reply.size() == 5) {
      EXPECT_EQ(state_of(device), before) << exchange.request << ": refused, but something has changed";
    }
  }
}

TEST(Tables, CoilsAreReadAndWritten) {
  const auto device = make_workbench();
  const Exchange exchanges[] = {
      {"01 00 00 00 50", "01 0A 00 00 00 00 00 00 00 00 00 00"},
      {"0F 00 03 00 0A 02 CD 01", "", "ten bits: CD is the first eight"},
      {"01 00 00 00 10", "01 02 68 0E"},
      {"05 00 00 FF 00", ""},
      {"01 00 00 00 08", "01 01 69"},
      {"05 00 00 00 00", ""},
      {"01 00 00 00 03", "01 01 00", "the rest of a byte is zero"},
      {"01 00 03 00 01", "01 01 01"},
      {"0F 00 40 00 01 01 FF", "", "what is beyond the count is not looked at"},
      {"01 00 40 00 10", "01 02 01 00"},
      {"01 00 4E 00 18", "01 03 00 00 00", "behind 79 there is a hole"},
      {"05 00 50 FF 00", "85 02", "a hole takes nothing"},
      {"0F 00 4E 00 04 01 0F", "8F 02", "two coils and a hole"},
      {"05 00 64 FF 00", "85 02", "can only be read"},
      {"0F 00 64 00 01 01 01", "8F 02"},
      {"05 00 00 00 01", "85 03", "neither FF00 nor 0000"},
      {"05 00 00 FF FF", "85 03"},
      {"05 FF FF 12 34", "85 03", "the value is judged before the address"},
      {"01 17 D0 00 01", "81 02", "beyond the table"},
      {"01 FF FF 00 02", "81 02"},
  };
  expect_exchanges(*device, exchanges);
}

TEST(Tables, DiscreteInputsAreViewsOfTerminalsAndAxes) {
  const auto device = make_workbench();
  for (const int terminal : {0, 3, 15}) device->set_input(terminal, 1);
  const Exchange exchanges[] = {
      {"02 00 00 00 10", "02 02 09 80"},
      {"02 00 03 00 01", "02 01 01"},
      {"02 00 10 00 22", "02 05 02 00 02 00 02", "one for each axis, and holes between"},
      {"02 00 10 00 23", "82 02"},
      {"05 00 6E FF 00", ""},
      {"10 1F 40 00 04 08 0A 01 00 01 00 00 07 D0", ""},
  };
  expect_exchanges(*device, exchanges);
  device->run_interpreters(1);
  const Exchange moving[] = {{"02 00 20 00 02", "02 01 03"}, {"01 00 64 00 03", "01 01 02"}};
  expect_exchanges(*device, moving);
}

TEST(Tables, HoldingRegistersHaveHolesPairsAndReals) {
  const auto device = make_workbench();
  const Exchange exchanges[] = {
      {"03 00 00 00 03", "03 06 00 64 00 64 00 64"},
      {"03 00 02 00 02", "03 04 00 64 00 00", "a hole reads zero"},
      {"06 00 03 00 01", "86 02", "and takes nothing"},
      {"06 00 01 0F A0", ""},
      {"06 00 01 0F A1", "86 03"},
      {"06 00 08 FE 0C", "", "-500"},
      {"06 00 08 FE 0B", "86 03"},
      {"10 00 10 00 06 0C 00 00 00 01 FF FF FF FE 7F FF FF FF", "", "a register for each axis"},
      {"03 00 10 00 06", "03 0C 00 00 00 01 FF FF FF FE 7F FF FF FF"},
      {"03 00 10 00 01", "83 02", "half a pair"},
      {"03 00 11 00 02", "83 02", "two halves"},
      {"03 00 0F 00 03", "03 06 00 00 00 00 00 01", "a hole and a whole"},
      {"06 00 10 00 05", "86 02"},
      {"10 00 11 00 02 04 00 05 00 06", "90 02"},
      {"10 00 10 00 03 06 00 05 00 06 00 07", "90 02", "a pair and a half"},
      {"03 00 20 00 02", "03 04 3F C0 00 00", "1.5"},
      {"10 00 22 00 02 04 40 49 0F DB", ""},
      {"10 00 22 00 02 04 43 A0 D3 33", "90 03", "321.65"},
      {"10 00 22 00 02 04 7F C0 00 00", "90 03", "not a number"},
      {"10 00 22 00 02 04 BF 80 00 00", "90 03", "-1"},
      {"03 00 20 00 04", "03 08 3F C0 00 00 40 49 0F DB"},
      {"06 00 40 00 01", "86 02", "can only be read"},
      {"06 00 32 00 01", ""},
      {"03 00 32 00 01", "83 02", "can only be written"},
      {"10 02 00 00 01 02 00 07", ""},
      {"03 02 20 00 01", "03 02 00 00"},
      {"06 02 21 00 01", "86 02", "beside the last one"},
      {"06 00 31 00 01", "", "the other order of words"},
      {"03 00 20 00 02", "03 04 00 00 3F C0"},
      {"03 1F 3F 00 01", "03 02 00 00"},
      {"03 1F 40 00 01", "83 02"},
      {"03 1F 54 00 01", "83 02", "beyond the table"},
  };
  expect_exchanges(*device, exchanges);
}

TEST(Tables, InputRegistersAreATableOfTheirOwn) {
  const auto device = make_workbench();
  const Exchange exchanges[] = {
      {"04 00 00 00 01", "04 02 00 00"},
      {"10 1F 40 00 01 02 0A 02", ""},
      {"10 1F 40 00 01 02 0A 02", ""},
      {"04 00 00 00 02", "04 04 00 20 00 00", "two commands wait: bits 4 and 5"},
      {"10 00 12 00 02 04 00 01 00 02", ""},
      {"04 00 02 00 06", "04 0C 00 00 00 00 00 01 00 02 00 00 00 00"},
      {"04 00 04 00 01", "84 02"},
      {"04 00 08 00 02", "04 04 41 AC 00 00", "21.5"},
      {"04 00 14 00 01", "04 02 00 44"},
      {"04 00 14 00 02", "84 02", "beyond the table, though holding registers go on"},
  };
  expect_exchanges(*device, exchanges);
}

std::string head(int code, std::size_t address, std::size_t count, std::string_view bytes = "") {
  Bytes pdu = world::read_pdu(static_cast<std::uint8_t>(code), address, count);
  return world::text(pdu) + (bytes.empty() ? "" : " ") + std::string(bytes);
}

/// A write of this many bytes of data, each 0x00.
std::string write_of(int code, std::size_t address, std::size_t count, std::size_t bytes, std::size_t sent) {
  Bytes data{static_cast<std::uint8_t>(bytes)};
  data.resize(1 + sent);
  return head(code, address, count, world::text(data));
}

TEST(Tables, CountsGoFromOneToTheLimitOfTheFunction) {
  const auto device = make_workbench();
  struct Limit {
    int code;
    std::size_t address;
    std::size_t max;
    std::size_t bytes;  // of this many
  };
  for (const Limit& limit : {Limit{0x01, 0x1000, 2000, 250}, Limit{0x03, 0x64, 125, 250}}) {
    const std::string name = head(limit.code, 0, 0).substr(0, 2);
    const std::string max = world::answer(*device, world::hex(head(limit.code, limit.address, limit.max)));
    EXPECT_EQ(max.size(), 3 * (2 + limit.bytes) - 1) << name;
    EXPECT_EQ(max.substr(0, 5), name + " FA");
  }
  for (const Limit& limit : {Limit{0x01, 0x1000, 2000, 0}, Limit{0x02, 0, 2000, 0}, Limit{0x03, 0, 125, 0},
                             Limit{0x04, 0, 125, 0}}) {
    const std::string refused = world::text(Bytes{static_cast<std::uint8_t>(limit.code | 0x80)});
    for (const std::size_t address : {limit.address, std::size_t{0xFFFF}}) {
      for (const std::size_t count : {std::size_t{0}, limit.max + 1, std::size_t{0xFFFF}}) {
        EXPECT_EQ(world::answer(*device, world::hex(head(limit.code, address, count))), refused + " 03");
      }
      EXPECT_EQ(world::answer(*device, world::hex(head(limit.code, 0xFFFF, limit.max))), refused + " 02");
    }
  }
  for (const Limit& limit : {Limit{0x0F, 0x1000, 1968, 246}, Limit{0x10, 0x64, 123, 246}}) {
    const std::string good = write_of(limit.code, limit.address, limit.max, limit.bytes, limit.bytes);
    EXPECT_EQ(world::answer(*device, world::hex(good)), good.substr(0, 14));
    const std::string refused = world::text(Bytes{static_cast<std::uint8_t>(limit.code | 0x80)});
    const std::size_t beyond = limit.code == 0x0F ? 247 : 248;
    for (const std::string& request :
         {write_of(limit.code, limit.address, 0, 0, 0), write_of(limit.code, 0xFFFF, 0, 0, 0),
          write_of(limit.code, limit.address, limit.max + 1, beyond, 246)}) {
      EXPECT_EQ(world::answer(*device, world::hex(request)), refused + " 03") << request;
    }
  }
}

TEST(Tables, ByteCountsThatLieAreRefusedBeforeAddresses) {
  const auto device = make_workbench();
  for (const std::size_t address : {std::size_t{0}, std::size_t{0xFFF0}}) {
    const std::string requests[] = {write_of(0x0F, address, 9, 1, 1),
                                    write_of(0x0F, address, 8, 2, 2),
                                    write_of(0x0F, address, 8, 1, 2),
                                    write_of(0x0F, address, 8, 1, 0),
                                    write_of(0x0F, address, 8, 0, 0),
                                    write_of(0x10, address, 1, 4, 4),
                                    write_of(0x10, address, 2, 2, 2),
                                    write_of(0x10, address, 1, 2, 1),
                                    write_of(0x10, address, 1, 2, 3),
                                    write_of(0x10, address, 2, 3, 3),
                                    head(0x10, address, 1),
                                    head(0x0F, address, 1),
                                    head(0x01, address, 1, "00"),
                                    head(0x02, address, 1, "00"),
                                    head(0x05, address, 0xFF00, "00"),
                                    head(0x06, address, 1, "00"),
                                    head(0x03, address, 1, "00"),
                                    "01 00 00 00",
                                    "05 00 00 FF",
                                    "0F 00",
                                    "02"};
    for (const std::string& request : requests) {
      const auto code = static_cast<std::uint8_t>(world::hex(request)[0] | 0x80);
      const std::string reply = world::text(Bytes{code, 3});
      const Exchange wanted[] = {{request, reply}};
      expect_exchanges(*device, wanted);
    }
  }
}

TEST(Tables, AModelMayAllowLessThanTheStandard) {
  static constexpr FunctionLimit kLimits[] = {{0x01, 16}, {0x03, 5}, {0x0F, 8}, {0x10, 2}};
  Model narrow = model();
  narrow.rtu->limits = kLimits;
  static const Model* made = nullptr;
  made = &narrow;
  narrow.make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
    return std::make_unique<Workbench>(*made, settings);
  };
  DeviceSettings settings;
  settings.name = "it";
  const auto device = make_device(narrow, settings);
  const Exchange exchanges[] = {
      {"01 00 00 00 10", "01 02 00 00"},
      {"01 00 00 00 11", "81 03"},
      {"02 00 00 00 12", "02 03 00 00 02"},
      {"03 00 03 00 05", "03 0A 00 00 00 00 00 00 00 00 00 00"},
      {"03 00 03 00 06", "83 03"},
      {"0F 00 00 00 08 01 00", ""},
      {"0F 00 00 00 09 02 00 00", "8F 03"},
      {"10 00 64 00 02 04 00 01 00 02", ""},
      {"10 00 64 00 03 06 00 01 00 02 00 03", "90 03"},
  };
  expect_exchanges(*device, exchanges);
}

}  // namespace tables_test
}  // namespace understudy::emulator::workbench
