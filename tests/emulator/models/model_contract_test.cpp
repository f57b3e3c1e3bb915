// The promises of every model, checked for every listed model: a new one needs no entry here. See also
// restored_states_test.cpp (flipped bytes, changed images) and world/sleepers/ (single ticks compared with
// long advances).
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/models.h"

namespace understudy::emulator::models {
namespace model_contract_test {

class ModelContract : public testing::TestWithParam<const Model*> {
 protected:
  static const Model& model() { return *GetParam(); }
  static std::unique_ptr<Device> make(Firmware firmware) {
    DeviceSettings settings;
    settings.name = "d";
    settings.firmware = firmware;
    return make_device(model(), settings);
  }
};

/// Returns a value that the register does not hold and its row allows, or the same one if there is no other.
Value another_value(const RegisterRow& row, Value present) {
  const TypeLimits limits = row.ranged ? TypeLimits{row.min, row.max} : limits_of(row.type);
  for (const Value value : {present + 1, present - 1, limits.lowest, limits.highest}) {
    const bool is_allowed = value >= limits.lowest && value <= limits.highest;
    const bool is_stored = (static_cast<std::uint32_t>(value) & ~row.stored_bits) == 0;
    if (value != present && is_allowed && is_stored) return value;
  }
  return present;
}

TEST_P(ModelContract, KeepsEachPersistentRegisterOverAPowerCut) {
  if (model().registers == nullptr) return;  // it has no registers
  int kept = 0;
  for (const Firmware firmware : model().firmwares) {
    const std::unique_ptr<Device> fresh = make(firmware);
    const std::vector<std::byte> at_first = fresh->save_state();
    for (const RegisterRow& row : model().registers->rows()) {
      RegisterBank& bank = *fresh->register_bank();
      const bool is_plain = row.access != Access::read && row.message == nullptr && !row.is_view;
      if (!is_plain || !bank.has_row(row) || !bank.keeps(row)) continue;
      for (const int index : std::set<int>{0, row.count - 1}) {
        const std::string name = bank.map().unique_name(row, index);
        const auto place = bank.find(name);
        ASSERT_TRUE(place) << name;
        if (write_value(bank, *place, another_value(row, read_value(bank, *place))) != Refusal::none)
          continue;
        const Value written = read_value(bank, *place);
        PersistentMemory& memory = *fresh->memory();
        const NvImage before = memory.nv_image();
        memory.settle_memory();
        const NvImage stored = memory.nv_image();
        if (!row.needs_no_time) {
          EXPECT_FALSE(holds_the_same(before, stored)) << name << " is not stored";
        }
        fresh->switch_power(false);
        EXPECT_TRUE(holds_the_same(memory.nv_image(), stored)) << name;
        fresh->switch_power(true);
        // A row with a reader may show something else after the power cut: a password is locked again.
        if (row.reader == nullptr) {
          EXPECT_EQ(read_value(bank, *place), written) << name << " of firmware " << firmware;
        }
        ++kept;
        // Its memory is unchanged: effects of one register on another are not tested here.
        const std::unique_ptr<Device> other = make(firmware);
        fresh->restore_state(other->save_state());
      }
    }
    EXPECT_EQ(fresh->save_state(), at_first);
  }
  EXPECT_GT(kept, 0);
}

/// As station 5: for some models 0 is an ordinary address, and the factory setting.
TEST_P(ModelContract, NeverAnswersABroadcast) {
  if (!model().rtu) return;  // it does not speak Modbus
  for (const Firmware firmware : model().firmwares) {
    DeviceSettings settings;
    settings.name = "d";
    settings.firmware = firmware;
    const auto kept_in = model().line.station_numbers->kept_in;
    if (kept_in.empty()) settings.address = 5;
    if (!kept_in.empty()) settings.set = {{std::string(kept_in), 5}};
    const std::unique_ptr<Device> device = make_device(model(), settings);
    ASSERT_EQ(device->station_number(), 5) << firmware;
    EXPECT_EQ(device->modbus()->addressing(5), Addressing::execute_and_reply) << firmware;
    EXPECT_NE(device->modbus()->addressing(0), Addressing::execute_and_reply) << firmware;
  }
}

TEST_P(ModelContract, HasASectionForEachRegister) {
  if (model().registers == nullptr) return;  // it has no registers
  for (const RegisterRow& row : model().registers->rows()) EXPECT_FALSE(row.section.empty()) << row.name;
}

TEST_P(ModelContract, CallsTerminalsByNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const TerminalRow& row : model().terminals) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " is used twice";
    // Conditions name them without brackets.
    EXPECT_FALSE(row.name.empty() || std::isdigit(static_cast<unsigned char>(row.name.front())) != 0)
        << row.name;
    for (const char c : row.name)
      EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') << row.name;
    EXPECT_LE(row.lowest, row.highest) << row.name;
  }
}

TEST_P(ModelContract, WiresItsAxesToTerminalsOfTheRightKind) {
  ASSERT_FALSE(model().axes.empty());
  const auto is_that = [](int terminal, bool input) {
    return terminal < 0 || (static_cast<std::size_t>(terminal) < model().terminals.size() &&
                            is_input(model().terminals[static_cast<std::size_t>(terminal)].kind) == input);
  };
  for (const AxisRow& axis : model().axes) {
    for (const int input : {axis.upper_limit_input, axis.lower_limit_input, axis.home_input, axis.alarm_input,
                            axis.ready_input, axis.near_home_input, axis.mark_input, axis.index_input}) {
      EXPECT_TRUE(is_that(input, true)) << axis.name << ": " << input;
    }
    for (const int output : {axis.servo_output, axis.alarm_clear_output})
      EXPECT_TRUE(is_that(output, false)) << axis.name << ": " << output;
    EXPECT_GE(axis.home_input, 0) << axis.name << ": nothing would see a machine's home switch";
  }
}

TEST_P(ModelContract, StartsTheSameWheneverItIsMade) {
  for (const Firmware firmware : model().firmwares) {
    const std::unique_ptr<Device> one = make(firmware);
    const std::unique_ptr<Device> other = make(firmware);
    EXPECT_TRUE(one->powered());
    EXPECT_TRUE(one->same_state(*other)) << firmware;
    EXPECT_EQ(one->state_hash(), other->state_hash()) << firmware;
    other->switch_power(false);
    EXPECT_NE(one->state_hash(), other->state_hash()) << firmware;
    other->restore_state(one->save_state());
    EXPECT_TRUE(other->powered()) << firmware;
    EXPECT_EQ(one->state_hash(), other->state_hash()) << firmware;
    EXPECT_TRUE(one->same_state(*other)) << firmware;
    EXPECT_EQ(one->state_difference(one->save_state(), other->save_state()), "") << firmware;
  }
}

/// Each of these is reported first, because the state of all devices comes before a model's own.
TEST_P(ModelContract, DiffersByPowerByAnInputOrByTimeAlone) {
  const std::unique_ptr<Device> one = make(model().firmwares.front());
  const std::unique_ptr<Device> other = make(model().firmwares.front());
  const std::vector<std::byte> saved = one->save_state();
  const auto expect_told = [&](const std::string& begin) {
    EXPECT_FALSE(one->same_state(*other)) << begin;
    const std::string reported = one->state_difference(saved, other->save_state());
    EXPECT_EQ(reported.substr(0, begin.size()), begin);
    other->restore_state(saved);
    EXPECT_TRUE(one->same_state(*other)) << begin;
  };
  for (std::size_t i = 0; i < model().terminals.size(); ++i) {
    const TerminalRow& row = model().terminals[i];
    if (!is_input(row.kind)) continue;
    const int terminal = static_cast<int>(i);
    other->set_input(terminal, other->input(terminal) == row.lowest ? row.highest : row.lowest);
    expect_told("inputs[" + std::to_string(i) + "]: ");
  }
  other->set_now(5);
  expect_told("now: 0 against 5");
  // A power loss changes more than the power state. The first byte that differs is the power's alone.
  other->switch_power(false);
  const std::vector<std::byte> off = other->save_state();
  std::vector<std::byte> without_power = saved;
  const auto [of_saved, of_off] = std::mismatch(without_power.begin(), without_power.end(), off.begin());
  ASSERT_NE(of_saved, without_power.end());
  *of_saved = *of_off;
  other->restore_state(without_power);
  EXPECT_FALSE(other->powered());
  expect_told("powered: ");
}

TEST_P(ModelContract, HasWhatBeginnersNeed) {
  ASSERT_NE(model().first_files, nullptr) << "`understudy init` has nothing to write";
  EXPECT_NE(model().first_files->bench.find(model().name), std::string_view::npos);
  EXPECT_FALSE(model().first_files->steps.empty());
  EXPECT_FALSE(model().title.empty());
  EXPECT_TRUE(model().registers == nullptr || !model().sections.empty());
}

std::vector<const Model*> listed() {
  std::vector<const Model*> models;
  for (const Model* const model : all_models()) models.push_back(model);
  return models;
}

INSTANTIATE_TEST_SUITE_P(Of, ModelContract, testing::ValuesIn(listed()), [](const auto& instance) {
  std::string name;
  for (const char c : instance.param->name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
});

}  // namespace model_contract_test
}  // namespace understudy::emulator::models
