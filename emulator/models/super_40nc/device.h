// SUPER-40NC: a four-axis controller on Modbus RTU by two ports. Its state is one value; what contacts and
// registers do is in effects.cpp, what a scan does with command contacts in commands.cpp, with the panel's
// keys in keys.cpp, and what axes do in axes.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/contacts.h"
#include "emulator/models/super_40nc/keys.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/terminals.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/surroundings.h"

namespace understudy::emulator::models::super_40nc {

using interpreter::super_40nc::Code;

/// D8094 to D8096.
struct ErrorReport {
  Code code = Code::none;
  std::int32_t step = 0;
  std::int32_t other_step = 0;
  Tick tick = -1;  // of the first of several in one tick, which stays

  bool operator==(const ErrorReport&) const = default;
};

/// Outputs that show for a time that something is finished (《X45.》, 《X46.》, 《C4.》, 《C5.》).
inline constexpr std::size_t kSignalCount = 10;

/// The panel's HOME or ZERO key at work: axes by their order.
struct OrderKey {
  bool runs = false;
  std::int8_t order = 0;  // of the axes under way
  bool has_failed = false;

  bool operator==(const OrderKey&) const = default;
};

struct State {
  bool touched = true;      // something was written since the last scan
  bool run_switch = false;  // PLC_RUN, as looked at in this tick
  bool emergency = false;   // CEMG
  bool emergency_obeyed = false;
  bool wheel_selected = false;  // D8020 or D8021 was written since the last scan
  std::array<std::int32_t, 3> analog{};
  std::int32_t wheel_edges = 0;  // MPG, as looked at
  std::array<motion::Axis, kAxisCount> chips{};
  std::array<motion::Surroundings, kAxisCount> here{};
  std::array<AxisState, kAxisCount> axes{};
  Contacts contacts;
  ErrorReport error;
  std::array<Tick, kSignalCount> signal_until{};
  std::array<std::uint32_t, 2> receive_errors{};  // by port
  OrderKey homing_by_key;
  OrderKey zeroing_by_key;
  Tick logo_at = kNever;  // when M8502 comes on
  bool logo_over = false;
  bool file_changed = false;  // M8023 is ON for the next scan
  bool shows_file_changed = false;
  std::int32_t file = 0;                                   // in memory, as D9001 has it
  std::int32_t recipe = 0;                                 // as D9002 has it
  std::array<std::int32_t, kAxisCount> rpm_at_power_up{};  // X14
  std::int32_t logo_ms = 0;                                // C0, as it was at power-up
  std::array<std::int64_t, kAxisCount> encoders_seen{};    // up to the last tick
  Eeprom eeprom;
  TextBlocks blocks;
  Image image{};

  bool operator==(const State&) const = default;
};

class Super40nc final : public Device,
                        public RegisterBankOf<Super40nc>,
                        public ModbusStation,
                        public KeptMemory,
                        public Terminals,
                        public Axes {
 public:
  explicit Super40nc(const DeviceSettings& given);

  RegisterBank* register_bank() override { return this; }
  const RegisterBank* register_bank() const override { return this; }
  ModbusStation* modbus() override { return this; }
  const ModbusStation* modbus() const override { return this; }
  KeptMemory* memory() override { return this; }
  const KeptMemory* memory() const override { return this; }
  const Terminals* terminals() const override { return this; }
  Axes* axes() override { return this; }
  const Axes* axes() const override { return this; }

  // --- registers -----------------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  void register_written(const RegisterRow& row, std::size_t slot) override;
  void registers_written() override { state_.touched = true; }
  void mention_unmodelled(const RegisterRow& row) const override;
  Addressing addressing(std::uint8_t address) const override;
  void receive_failed(std::size_t port, pty::ReceiveError error) override;

  // --- memory --------------------------------------------------------------------------------------
  TextBlocks* text_blocks() override { return &state_.blocks; }
  const TextBlocks* text_blocks() const override { return &state_.blocks; }
  std::uint64_t kept_revision() const override { return state_.eeprom.revision() + state_.blocks.revision(); }
  void settle_memory() override { state_.eeprom.settle(state_.image); }

  // --- time ----------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  bool same_state(const Device& other) const override;

  // --- terminals and axes --------------------------------------------------------------------------
  bool output(int terminal) const override;
  std::int32_t analog_level(int terminal) const override;
  std::int64_t pulses_this_tick(int axis) const override;
  double speed_pps(int axis) const override;
  void set_encoder(int axis, std::int64_t counts) override;
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override;
  void set_edges(int axis, const MachineEdges& edges) override;

  // --- for effects.cpp -----------------------------------------------------------------------------
  State& state() { return state_; }
  const State& state() const { return state_; }
  AxisState& axis(int number) { return state_.axes[static_cast<std::size_t>(number)]; }
  const AxisState& axis(int number) const { return state_.axes[static_cast<std::size_t>(number)]; }
  motion::Axis& chip(int number) { return state_.chips[static_cast<std::size_t>(number)]; }
  const motion::Axis& chip(int number) const { return state_.chips[static_cast<std::size_t>(number)]; }
  const motion::Surroundings& here(int number) const { return state_.here[static_cast<std::size_t>(number)]; }
  motion::Surroundings& here(int number) { return state_.here[static_cast<std::size_t>(number)]; }
  /// COUNTER1.
  std::int64_t machine_pulses(int number) const {
    return axis(number).command.at(chip(number).travel_pulses);
  }
  bool has_signal(int number, motion::Signal signal) const {
    return (chip(number).signals & motion::bit(signal)) != 0;
  }
  Settings registers() const { return Settings(state_.image); }
  /// As the device writes it: without its effect.
  void put(Kept kept, std::int32_t value, int of_axis = 0);

  /// In the work coordinate, as D8x17 shows it.
  std::int64_t work_lu(int axis) const;
  void set_work_lu(int axis, std::int64_t position);
  std::int32_t counter(int axis, int number) const;
  void set_counter(int axis, int number, std::int32_t pulses);
  bool comparator_holds(int axis, int number) const;
  bool status(int axis, AxisStatus what) const;
  /// D8x64.
  std::int32_t operation_of(int axis) const;
  /// In its own sense.
  double commanded_pps(int axis) const;
  /// D8x70, in steps of the chip.
  std::int32_t chip_speed(int axis) const;
  std::int64_t braking_pulses(int axis) const;
  /// A parameter of an axis was written: D9x00 + `number`, or a D8x, 0.
  void heed_axis(int axis, int number);
  /// The parameters of all axes may have changed.
  void heed_all();
  /// D9001, D9002: another path file or recipe.
  void change_file(std::int32_t number);
  void change_recipe(std::int32_t number);
  /// D9042, D9043, by D9045.
  void show_capacities();

  /// As it is stored: of contacts that are not views.
  bool contact(int number) const { return state_.image[relay_slot(number)] != 0; }
  void set_contact(int number, bool on);

 protected:
  void power_up() override;
  void power_down() override;
  void write_own_state(StateWriter& writer) const override;
  std::function<void()> read_own_state(StateReader& reader) override;
  std::string own_difference(StateReader& a, StateReader& b) const override;
  void write_memory(NvImage& image) const override;
  void read_memory(const NvImage& image) override;

 private:
  // --- memory.cpp
  void blank_state();
  Eeprom factory_memory() const;
  void reset_parameters();

  // --- commands.cpp, keys.cpp: the scan's step of contacts
  bool is_on(int contact) const;
  bool rises(int contact) const;
  void read_keys();
  void read_jog_keys();
  bool is_locked(const Key& key) const;
  /// In this scan; axis -1: on the main page.
  bool is_pressed(KeyDoes what, int axis) const;
  void obey_order_keys();
  void follow_order(OrderKey& key, Holder holder, Kept order_of_axis, void (Super40nc::*start)(int, int));
  void obey_contacts();
  void obey_stops();
  void obey_jogs(int axis);
  void obey_wheel();
  void see_contacts();
  /// M8002 or CEMG: nothing may start.
  bool is_stopped_by_emergency() const;
  bool is_held_in_reset(int axis) const;
  /// M8004, or one of those above: starts by hand are lost without a code.
  bool is_inhibited(int axis) const;

  // --- axes.cpp: what moves them
  void report(Code code, int step = 0, int other_step = 0);
  void clear_error() { state_.error = {}; }
  /// What a request gets; refusals are reported.
  Grant ask(int axis, Request request);
  void prepare(int axis);
  /// What a scan starts moves in its own tick.
  Tick before_motion() const { return now() - 1; }
  void begun(int axis, motion::Cause why_not, Holder holder);
  void start_jog(int axis, int way);
  void start_home(int axis, int order = 0);
  void start_zero(int axis, int order = 0);
  void start_wheel(int axis, WheelSource source);
  void set_zero(int axis);
  /// At once; of a home or zero return that is given up nothing is done.
  void stop_axis(int axis, Code code = Code::none);
  void ended(int axis);
  void home_ended(int axis, bool found, Code code);
  void fail(int axis, Code code);
  void let_go(int axis);
  void mirror_start(int axis, int mode, std::int64_t distance_pulses, const motion::SpeedLaw& law);
  void feed_wheel(std::int32_t edges);
  std::int64_t wheel_lu_per_count(int axis) const;
  void follow_ratio(int axis);
  /// Begins the signal Y0 + `signal`, or begins it anew.
  void show_finished(std::size_t signal);
  void count(int axis, std::int64_t travel_before, std::int64_t encoder_before, std::int64_t wheel_counts);
  void count_index(int axis, std::int8_t phase_before);
  void latch(int axis);
  motion::AxisSettings motor_settings(int axis) const;

  // --- signals.cpp: what they meet
  void look_at_inputs();
  void look_round(int axis);

  State state_;
  std::array<MachineEdges, kAxisCount> edges_{};  // not state: they are told again
};

}  // namespace understudy::emulator::models::super_40nc
