// Choices about what a request may do, and about its reply.
#include "emulator/device/axes.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_requests_test {

Refusal try_write(OneSimple2& feeder, std::uint16_t first, const std::vector<std::uint16_t>& words) {
  return write_words(*feeder.device().register_bank(), Table::holding, first, words);
}

/// The words from `first` on; none if the request is refused.
std::vector<std::uint16_t> read(OneSimple2& feeder, std::uint16_t first, std::size_t count) {
  std::vector<std::uint16_t> words(count, 0xEEEE);
  const Refusal refusal = read_words(*feeder.device().register_bank(), Table::holding, first, words);
  return refusal == Refusal::none ? words : std::vector<std::uint16_t>{};
}

using Words = std::vector<std::uint16_t>;

TEST(ChoicesRequests, ARefusedOneGetsAnExceptionOrNoAnswer) {
  const std::vector<std::vector<std::uint8_t>> refused = {
      {0x01, 0x05, 0x00, 0x00, 0xFF, 0x00, 0x8C, 0x3A},  // function 05
      {0x01, 0x03, 0x00, 0x03, 0x00, 0x01, 0x74, 0x0A},  // 0x0003 is a hole
      {0x01, 0x06, 0x10, 0x03, 0x0B, 0xB9, 0xBB, 0x88},  // AccTime 3001
  };
  const std::vector<std::vector<std::uint8_t>> exceptions = {
      {0x01, 0x85, 0x01, 0x83, 0x50}, {0x01, 0x83, 0x02, 0xC0, 0xF1}, {0x01, 0x86, 0x03, 0x02, 0x61}};
  const std::vector<std::uint8_t> hardware_code{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
  const std::vector<std::uint8_t> its_answer{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84};
  for (const auto& [option, answered] :
       each_option<bool>("exceptions", {{"modbus_v1_1b3", true}, {"no_answer", false}})) {
    OneSimple2 feeder(with("exceptions", option));
    for (std::size_t i = 0; i < refused.size(); ++i) {
      EXPECT_EQ(ask(feeder, refused[i]), answered ? exceptions[i] : std::vector<std::uint8_t>{})
          << option << ", " << i;
    }
    EXPECT_EQ(ask(feeder, hardware_code), its_answer) << option;
    const world::StationCounters& counters = feeder.world().line(0).stations.front()->counters();
    EXPECT_EQ(counters.requests, 4u) << option;
    EXPECT_EQ(counters.replies, answered ? 4u : 1u) << option;
    EXPECT_EQ(counters.exceptions, answered ? 3u : 0u) << option;
  }
}

TEST(ChoicesRequests, RegistersTakeEffectOnceAllAreStoredOrEachInItsTurn) {
  // SyncMode of A, and behind it SyncRPM: 1 RPM of 60000 pulses lets 5 through in 5 ms, the 3000 RPM that
  // were there before let all 20 through.
  for (const auto& [option, pulses] :
       each_option("request_effects", {{"once_all_are_stored", 5}, {"each_in_its_turn", 20}})) {
    ReadySimple2 feeder(with("request_effects", option));
    feeder.set("Aaxis_Resoultion", 60'000);
    feeder.write(0xF025, {1, 0, 0, 0, 1});  // Aaxis_SyncMode, Baxis_SyncMode, both slopes, SyncRPM of A
    feeder.device().axes()->set_encoder(0, 20);
    feeder.run(50);
    EXPECT_EQ(feeder.coordinate('A'), pulses) << option;
    // A whole move works either way: the trigger comes last.
    feeder.set("ALL_STOP", 1);
    feeder.write(0x1000, {1000, 0, 20, 1, 1, 1});
    feeder.run_while_moving('A');
    EXPECT_EQ(feeder.coordinate('A'), pulses + 1000) << option;
  }
}

TEST(ChoicesRequests, UnmappedAddressesAreRefusedOrZeroThatTakesNothing) {
  for (const auto& [option, refused] :
       each_option<bool>("unmapped_addresses", {{"exception_02", true}, {"zero_and_ignored", false}})) {
    OneSimple2 feeder(with("unmapped_addresses", option));
    // HW_Code, Version, a hole, Aaxis_Mode; 0x1FFF is a hole, 0x2000 Parms_Pulse1.
    EXPECT_EQ(read(feeder, 0x0001, 4), refused ? Words{} : (Words{0xC001, 152, 0, 0})) << option;
    EXPECT_EQ(try_write(feeder, 0x1FFF, {7, 9}), refused ? Refusal::no_register : Refusal::none) << option;
    EXPECT_EQ(feeder.get("Parms_Pulse1"), refused ? 0 : 9) << option;
    EXPECT_EQ(read(feeder, 0xFFFF, 2), Words{}) << option << ": there is nothing beyond 0xFFFF";
    Given older = with("unmapped_addresses", option);
    older.firmware = 150;
    OneSimple2 without_password(older);
    EXPECT_EQ(read(without_password, 0xFF07, 3), refused ? Words{} : (Words{0, 0, 0})) << option;
  }
}

TEST(ChoicesRequests, AWriteToAReadOnlyRegisterIsRefusedOrIgnored) {
  for (const auto& [option, refused] :
       each_option<bool>("write_to_read_only", {{"exception_02", true}, {"ignored", false}})) {
    OneSimple2 feeder(with("write_to_read_only", option));
    const Refusal expected = refused ? Refusal::no_register : Refusal::none;
    EXPECT_EQ(try_write(feeder, 0x0001, {7}), expected) << option;
    EXPECT_EQ(feeder.get("HW_Code"), 0xC001) << option;
    // Analog_B, then ENCA_Resoultion.
    EXPECT_EQ(try_write(feeder, 0x0E09, {7, 500, 0}), expected) << option;
    EXPECT_EQ(feeder.get("ENCA_Resoultion"), refused ? 3200 : 500) << option;
  }
}

TEST(ChoicesRequests, AValueOutOfRangeIsRefusedOrClamped) {
  struct Row {
    std::uint16_t address;
    Words words;
    const char* name;
    Value clamped, before;
  };
  const Row rows[] = {{0x1003, {3001}, "Aaxis_AccTime", 3000, 0},
                      {0xF01C, {0}, "Axis_VelMode_ACC", 1, 1000},
                      {0xF002, {0, 0}, "Aaxis_Resoultion", 1, 3200},
                      {0x0DF0, {0xFFFF}, "DOUT_ALL", 0x7F, 0},
                      {0xF002, {1, 0x8000}, "Aaxis_Resoultion", 0x8000'0000, 3200}};
  for (const auto& [option, refused] :
       each_option<bool>("write_out_of_range", {{"exception_03", true}, {"clamped", false}})) {
    for (const Row& row : rows) {
      OneSimple2 feeder(with("write_out_of_range", option));
      EXPECT_EQ(try_write(feeder, row.address, row.words), refused ? Refusal::bad_value : Refusal::none);
      EXPECT_EQ(feeder.get(row.name), refused ? row.before : row.clamped) << option << ", " << row.name;
    }
    OneSimple2 pwm(with("write_out_of_range", option));
    pwm.set("ALL_SVON", 1);
    EXPECT_EQ(try_write(pwm, 0x1019, {200}), refused ? Refusal::bad_value : Refusal::none);
    EXPECT_EQ(pwm.get("Aaxis_DirectPWM"), refused ? 0 : 100) << option;
    EXPECT_EQ(pwm.get("Aaxis_Mode"), refused ? 0 : 2) << option;
  }
}

TEST(ChoicesRequests, AWriteOnlyRegisterReadsAsZeroOrIsRefused) {
  for (const auto& [option, zero] :
       each_option<bool>("read_of_write_only", {{"zero", true}, {"exception_02", false}})) {
    OneSimple2 feeder(with("read_of_write_only", option));
    feeder.set("Baxis_Move_INC", 0);
    // Baxis_Move_INC, ALL_Move_INC, which can only be written, and ALL_STOP.
    EXPECT_EQ(read(feeder, 0x100B, 3), zero ? (Words{0, 0, 0}) : Words{}) << option;
    EXPECT_EQ(read(feeder, 0x100B, 1), Words{0}) << option;
    EXPECT_EQ(try_write(feeder, 0x100C, {1}), Refusal::none) << option;
  }
}

TEST(ChoicesRequests, HalfAValueIsStoredOrJudgedWithTheOtherHalf) {
  for (const auto& [option, judged] :
       each_option<bool>("half_writes", {{"stored_unjudged", false}, {"judged_with_other_half", true}})) {
    OneSimple2 feeder(with("half_writes", option));
    // Resoultion is 1 to 2^31; its halves are 3200 and 0.
    EXPECT_EQ(try_write(feeder, 0xF002, {0}), judged ? Refusal::bad_value : Refusal::none) << option;
    EXPECT_EQ(feeder.get("Aaxis_Resoultion"), judged ? 3200 : 0) << option;
    EXPECT_EQ(try_write(feeder, 0xF005, {0x8000}), judged ? Refusal::bad_value : Refusal::none) << option;
    EXPECT_EQ(feeder.get("Baxis_Resoultion"), judged ? 3200 : 0x8000'0C80) << option;
    EXPECT_EQ(try_write(feeder, 0x0E0B, {1}), Refusal::none) << option;
    EXPECT_EQ(feeder.get("ENCA_Resoultion"), 65536 + 3200) << option;
  }
}

}  // namespace choices_requests_test
}  // namespace understudy::emulator::models::simple2_r3
