// RS-M8194H: four axes on a motion chip, behind a window of registers. The RS-M8194H itself handles Modbus
// and checks requests; the i-8094H module (module.h) contains the FIFO, the chip and the macros.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/user_program.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/ports.h"
#include "emulator/models/rs_m8194h/requests.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/state.h"

namespace understudy::emulator::models::rs_m8194h {

class RsM8194h final : public StatefulDevice<RsM8194h, State>,
                       public RegisterBankOf<Module>,
                       public ModbusStation,
                       public PersistentMemory,
                       public UserProgram {
 public:
  explicit RsM8194h(const DeviceSettings& given);

  const Ports* terminals() const override { return &ports_; }
  Ports* axes() override { return &ports_; }
  const Ports* axes() const override { return &ports_; }

  // --- registers ---------------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  bool low_word_first() const override { return module_.memory.low_word_first(); }
  bool takes_parts() const override;
  const MapPolicy& map_policy() const override { return policy_; }
  DeviceAnswer admits(const RegisterRequest& request, Checked checked) const override {
    return requests_.admits(request, checked, *this);
  }
  bool takes_whole(const RegisterRequest& request) const override { return requests_.takes_whole(request); }
  DeviceAnswer take_whole(const RegisterRequest& request) override { return requests_.take_whole(request); }
  bool diverts(const Place& place, std::uint32_t bits) override { return requests_.diverts(place, bits); }
  void read_answered(const RegisterRequest& request) override { requests_.read_answered(request); }
  void exception_answered(const RefusedRequest& request) override { requests_.exception_answered(request); }
  bool keeps(const RegisterRow& row) const override { return module_.memory.keeps(row); }
  void register_written(const RegisterRow& row, std::size_t slot) override {
    module_.memory.register_written(row, slot);
  }
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }

  // --- its line ----------------------------------------------------------------------------------
  Addressing addressing(std::uint8_t address) const override;
  std::string_view meaning_of_reason(int reason) const override;
  pty::SimTime end_silence(pty::SimTime usual) const override;
  pty::SimTime reply_delay() const override;
  pty::LineSettings line_settings(std::size_t port) const override;
  bool keeps_its_speed() const override;

  // --- time --------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override { module_.sample_inputs(tick, take_inputs_changed()); }
  void step_motion(Tick tick) override { module_.step_motion(tick); }
  void update_outputs(Tick tick) override { module_.update_outputs(tick); }
  Tick next_active_tick(Tick done) const override {
    return inputs_changed() ? done + 1 : module_.next_active_tick(done);
  }
  Tick next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const override {
    return inputs_changed() ? done + 1 : module_.next_event_tick(done, max, ahead);
  }
  void fast_forward_to(Tick /*done*/, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override {
    module_.motion_step.fast_forward_to(tick, ahead, pulses);
  }
  void prefetch(Tick tick) const override;

  // --- memory ------------------------------------------------------------------------------------
  TextBlocks* text_blocks() override { return &state_.blocks; }
  const TextBlocks* text_blocks() const override { return &state_.blocks; }
  std::uint64_t memory_revision() const override;
  void settle_memory() override { state_.eeprom.settle(state_.image); }
  void load_program(std::string_view text) override { module_.load_program(text); }
  std::string program_text() const override { return module_.programs.text(); }
  std::vector<ProgramLocation> program_locations() const override { return module_.programs.locations(); }

 protected:
  void power_up() override { module_.power_up(); }
  void power_down() override { module_.power_down(); }
  void check_restored(State& restored) const override;
  void take_over(const State& restored) override { module_.take_over(restored); }
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  void watch_program(ProgramWatch* watch) override { module_.programs.set_watch(watch); }

  const MapPolicy policy_;
  const Ground ground_;
  Module module_;
  Requests requests_;
  Ports ports_;
};

}  // namespace understudy::emulator::models::rs_m8194h
