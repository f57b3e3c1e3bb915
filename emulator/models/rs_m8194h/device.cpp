#include "emulator/models/rs_m8194h/device.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "base/simulated_time.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device_bytes.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/state_fields.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

MapPolicy policy_by_choice(const Device& device) {
  MapPolicy policy = rs_m8194h::model().registers->policy();
  if (device.chose(option("half_items", "exception_3"))) policy.cut_pair = Refusal::bad_value;
  return policy;
}

}  // namespace

RsM8194h::RsM8194h(const DeviceSettings& given)
    : StatefulDevice(rs_m8194h::model(), given),
      RegisterBankOf(module_, *rs_m8194h::model().registers, given.firmware),
      PersistentMemory(rs_m8194h::model().name, given.firmware),
      policy_(policy_by_choice(*this)),
      ground_(*this),
      module_(ground_, state_),
      requests_(ground_, state_, module_),
      ports_(*this, module_) {}

/// A number that several faults share has no meaning of its own; the tables say more about those.
std::string_view RsM8194h::meaning_of_reason(int reason) const {
  std::string_view meaning;
  const bool is_other = chose(option("illegal_reason_numbers", "of_12_1_12"));
  for (const interpreter::rs_m8194h::FaultRow& row : interpreter::rs_m8194h::kFaults) {
    if ((is_other ? row.reason_12_1_12 : row.reason_4_16_2) != reason) continue;
    if (!meaning.empty()) return {};
    meaning = row.meaning;
  }
  return meaning;
}

Addressing RsM8194h::addressing(std::uint8_t address) const {
  if (module_.status.is_deaf()) return Addressing::ignore;
  if (address == 0) {
    return chose(option("broadcast", "ignored")) ? Addressing::ignore : Addressing::execute_silently;
  }
  return address == station_number() ? Addressing::execute_and_reply : Addressing::ignore;
}

pty::SimTime RsM8194h::end_silence(pty::SimTime usual) const {
  constexpr std::chrono::milliseconds kOfTheUser(10);
  return chose(option("silent_time", "10ms")) ? pty::SimTime(kOfTheUser) : usual;
}

pty::SimTime RsM8194h::reply_delay() const {
  constexpr std::chrono::milliseconds kLater(5);
  return chose(option("response_delay", "5ms_later")) ? pty::SimTime(kLater) : pty::SimTime{0};
}

pty::LineSettings RsM8194h::line_settings(std::size_t port) const {
  pty::LineSettings settings = Device::line_settings(port);
  if (keeps_its_speed()) settings.baud = model().line.ports[port].bauds.front();
  return settings;
}

bool RsM8194h::takes_parts() const { return chose(option("window_parts", "kept_for_the_command")); }

bool RsM8194h::keeps_its_speed() const { return chose(option("line_speeds", "115200_alone")); }

void RsM8194h::prefetch(Tick tick) const {
  Device::prefetch(tick);
  module_.prefetch();
}

// --- memory ----------------------------------------------------------------------------------------------

std::uint64_t RsM8194h::memory_revision() const {
  return state().eeprom.revision() + state().blocks.revision();
}

std::function<void(NvImage&)> RsM8194h::memory_writer() const {
  return registers_writer(*this, state().eeprom.content());
}

void RsM8194h::read_memory(const NvImage& image) {
  const auto values = read_registers(*this, image, Device::model().firmwares.back());
  for (std::size_t slot = 0; slot < values.size(); ++slot) state_.eeprom.put(slot, values[slot]);
}

void RsM8194h::check_restored(State& restored) const {
  restored.eeprom.check_restored(state_.eeprom);
  restored.blocks.check_restored(state_.blocks);
  check_restored_registers(*this, restored.image, restored.eeprom.content());
}

}  // namespace understudy::emulator::models::rs_m8194h

template class understudy::emulator::StatefulDevice<understudy::emulator::models::rs_m8194h::RsM8194h,
                                                    understudy::emulator::models::rs_m8194h::State>;
