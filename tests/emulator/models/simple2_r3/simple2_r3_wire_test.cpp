// Every register of the Simple2-R3 as a host sees it (specification 1.4 and 2).
#include <gtest/gtest.h>

#include <map>

#include "tests/emulator/device/register_map/register_facts.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::simple2_r3 {
namespace simple2_r3_wire_test {

constexpr const char* kReadNoAddress = "83 02";
constexpr const char* kWriteNoAddress = "86 02";
constexpr const char* kWriteBadValue = "86 03";
constexpr const char* kWriteManyNoAddress = "90 02";
constexpr const char* kWriteManyBadValue = "90 03";

std::map<std::uint16_t, RegisterFact> facts_by_address() {
  std::map<std::uint16_t, RegisterFact> facts;
  for (const RegisterFact& fact : simple2_r3_registers()) facts[fact.address] = fact;
  return facts;
}

/// What a 32-bit value needs in one request, low word first.
world::Bytes write_whole(std::uint16_t address, Value value) {
  return world::write_request(
      address, world::Words{static_cast<std::uint16_t>(value),
                            static_cast<std::uint16_t>(static_cast<std::uint32_t>(value) >> 16)});
}

std::string accepted(const world::Bytes& request) {
  return world::text(world::Bytes(request.begin(), request.begin() + 5));
}

/// Registers whose word is not simply what was written: commands, and the state they command.
bool is_command(const std::string& name) {
  for (const char* part : {"Move_INC", "Move_ABS", "_STOP", "_GoHome", "_ACLR"}) {
    if (name.ends_with(part)) return true;
  }
  return name == "Factory_Reset";
}

TEST(Simple2Wire, EveryAddressReadsItsFactoryWordOrIsRefused) {
  const auto facts = facts_by_address();
  const auto device = world::make_simple2();
  for (unsigned address = 0; address <= 0xFFFF; ++address) {
    const auto fact = facts.find(static_cast<std::uint16_t>(address));
    for (const std::uint8_t function : {0x03, 0x04}) {
      std::string wanted = function == 0x03 ? kReadNoAddress : "84 02";
      if (fact != facts.end()) {
        world::Bytes reply{function, 2};
        world::put(reply, fact->second.readable ? fact->second.factory_word : 0);
        wanted = world::text(reply);
      }
      ASSERT_EQ(world::answer(*device, world::read_pdu(function, address, 1)), wanted) << std::hex << address;
    }
  }
}

TEST(Simple2Wire, HolesAndReadOnlyRegistersRefuseWrites) {
  const auto facts = facts_by_address();
  const auto device = world::make_simple2();
  for (unsigned address = 0; address <= 0xFFFF; ++address) {
    const auto fact = facts.find(static_cast<std::uint16_t>(address));
    if (fact != facts.end() && fact->second.writable) continue;
    for (const std::uint16_t word : {0, 1, 0xFFFF}) {
      ASSERT_EQ(world::answer(*device, world::write_request(address, word)), kWriteNoAddress)
          << std::hex << address;
      ASSERT_EQ(world::answer(*device, world::write_request(address, world::Words{word})),
                kWriteManyNoAddress)
          << std::hex << address;
    }
  }
  EXPECT_TRUE(same_state(*device, *world::make_simple2()));
}

TEST(Simple2Wire, A16BitRangeIsAcceptedToBothEndsAndNotBeyond) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    if (!fact.writable || fact.is_32_bit) continue;
    SCOPED_TRACE(fact.name);
    const auto device = world::make_simple2();
    const Value min = fact.min.value_or(0);
    const Value max = fact.max.value_or(UINT16_MAX);
    if (min > 0) {
      const auto word = static_cast<std::uint16_t>(min - 1);
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, word)), kWriteBadValue);
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, world::Words{word})),
                kWriteManyBadValue);
    }
    if (max < UINT16_MAX) {
      const auto word = static_cast<std::uint16_t>(max + 1);
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, word)), kWriteBadValue);
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, UINT16_MAX)), kWriteBadValue);
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, world::Words{word})),
                kWriteManyBadValue);
    }
    EXPECT_TRUE(same_state(*device, *world::make_simple2())) << "a refused write has changed something";
    for (const Value value : {min, max}) {
      const world::Bytes request = world::write_request(fact.address, static_cast<std::uint16_t>(value));
      EXPECT_EQ(world::answer(*device, request), world::text(request)) << value;
      if (!fact.readable || is_command(fact.name)) continue;
      const bool is_program_cell = fact.name.starts_with("MAIN_LINE");  // 8 bits inside
      EXPECT_EQ(world::read(*device, fact.address, 1),
                world::Words{static_cast<std::uint16_t>(is_program_cell ? value & 0xFF : value)});
    }
  }
}

TEST(Simple2Wire, A32BitRangeIsAcceptedToBothEndsAndNotBeyond) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    if (!fact.writable || fact.half != 'L') continue;
    SCOPED_TRACE(fact.name);
    const auto device = world::make_simple2();
    const Value min = fact.min.value_or(fact.lowest());
    const Value max = fact.max.value_or(fact.highest());
    if (min > fact.lowest()) {
      EXPECT_EQ(world::answer(*device, write_whole(fact.address, min - 1)), kWriteManyBadValue);
    }
    if (max < fact.highest()) {
      EXPECT_EQ(world::answer(*device, write_whole(fact.address, max + 1)), kWriteManyBadValue);
      EXPECT_EQ(world::answer(*device, write_whole(fact.address, fact.highest())), kWriteManyBadValue);
    }
    EXPECT_TRUE(same_state(*device, *world::make_simple2())) << "a refused write has changed something";
    for (const Value value : {min, max}) {
      const world::Bytes request = write_whole(fact.address, value);
      EXPECT_EQ(world::answer(*device, request), accepted(request)) << value;
      const auto bits = static_cast<std::uint32_t>(value);
      EXPECT_EQ(world::read(*device, fact.address, 2),
                (world::Words{static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16)}));
    }
  }
}

TEST(Simple2Wire, HalfA32BitRegisterIsNeverJudged) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    if (!fact.writable || !fact.is_32_bit) continue;
    SCOPED_TRACE(fact.name);
    const auto device = world::make_simple2();
    for (const std::uint16_t word : {0x0000, 0x8000, 0xFFFF}) {
      const world::Bytes request = world::write_request(fact.address, word);
      EXPECT_EQ(world::answer(*device, request), world::text(request));
      EXPECT_EQ(world::read(*device, fact.address, 1), world::Words{word});
      const world::Bytes many = world::write_request(fact.address, world::Words{word});
      EXPECT_EQ(world::answer(*device, many), accepted(many));
    }
  }
}

TEST(Simple2Wire, WritingHalfLeavesTheOtherHalfAlone) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    if (!fact.writable || fact.half != 'L') continue;
    SCOPED_TRACE(fact.name);
    const auto device = world::make_simple2();
    world::answer(*device, write_whole(fact.address, 0x12345678));
    world::answer(*device, world::write_request(fact.address, 0xABCD));
    EXPECT_EQ(world::read(*device, fact.address, 2), (world::Words{0xABCD, 0x1234}));
    world::answer(*device, world::write_request(fact.address + 1u, 0x7FED));
    EXPECT_EQ(world::read(*device, fact.address, 2), (world::Words{0xABCD, 0x7FED}));
  }
}

TEST(Simple2Wire, RegistersOfNewerFirmwareAreHolesInOlderOnes) {
  for (const Firmware firmware : {139, 140, 141, 142, 150, 151, 152}) {
    DeviceSettings settings;
    settings.firmware = firmware;
    const auto device = world::make_simple2(settings);
    for (const RegisterFact& fact : simple2_r3_registers()) {
      const bool there = firmware >= fact.since;
      EXPECT_EQ(world::read(*device, fact.address, 1).size(), there ? 1u : 0u)
          << fact.name << " in " << firmware;
      if (there || !fact.writable) continue;
      EXPECT_EQ(world::answer(*device, world::write_request(fact.address, 0)), kWriteNoAddress) << fact.name;
    }
    EXPECT_EQ(world::read(*device, 0x0002, 1), world::Words{firmware}) << "Version in hundredths";
  }
}

TEST(Simple2Wire, AWriteTouchesNoOtherRegister) {
  const auto facts = simple2_r3_registers();
  const auto all_words = [&](Device& device) {
    world::Words words;
    for (const RegisterFact& fact : facts) words.push_back(world::read(device, fact.address, 1).at(0));
    return words;
  };
  const world::Words before = all_words(*world::make_simple2());
  const auto busy = static_cast<std::size_t>(
      std::find_if(facts.begin(), facts.end(),
                   [](const RegisterFact& f) { return f.name == "EEPROM_Writing"; }) -
      facts.begin());
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const RegisterFact& fact = facts[i];
    // Outputs, states, the password and the calibration show in more than one register; program cells are too
    // many to do all.
    const bool shared = fact.name.starts_with("DOUT") || fact.name.find("SVON") != std::string::npos ||
                        fact.name.find("ACLR") != std::string::npos ||
                        fact.name == "PROG_MAIN_RunTime_START" ||
                        fact.name.find("PWD") != std::string::npos || fact.name.starts_with("ADC_");
    if (!fact.writable || shared || (fact.name.starts_with("MAIN_LINE") && i % 37 != 0)) continue;
    const auto device = world::make_simple2();
    world::answer(*device, world::write_request(fact.address, fact.factory_word == 1 ? 0 : 1));
    world::Words after = all_words(*device);
    after[i] = before[i];
    after[busy] = before[busy];  // the EEPROM is, where the register is persistent
    EXPECT_EQ(after, before) << fact.name;
  }
}

}  // namespace simple2_r3_wire_test
}  // namespace understudy::emulator::models::simple2_r3
