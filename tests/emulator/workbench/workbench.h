// A made-up controller, for tests of combinations that no real model has (registers.h).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "tests/emulator/workbench/language.h"
#include "tests/emulator/workbench/machine.h"
#include "tests/emulator/workbench/memory.h"
#include "tests/emulator/workbench/registers.h"
#include "tests/emulator/workbench/window.h"

namespace understudy::emulator::workbench {

struct WorkbenchState {
  std::vector<std::uint32_t> image{};
  std::array<std::int32_t, kAxisCount> positions{};
  std::array<std::int32_t, kAxisCount> targets{};
  std::vector<std::vector<std::uint16_t>> fifo{};
  std::uint32_t done = 0;
  std::uint8_t cause = 0;            // the cause of the last exception
  std::uint16_t reason = 0;          // the same as its own error number
  std::uint8_t program_refused = 0;  // the last loaded program was refused
  MotorsState motors{};
  std::array<std::uint32_t, 2> receive_errors{};
  std::array<std::uint8_t, 2> last_receive_error{};  // 1 + pty::ReceiveError
  Kept kept{};

  bool operator==(const WorkbenchState&) const = default;
};

}  // namespace understudy::emulator::workbench

namespace understudy {

template <>
struct StateOf<emulator::workbench::WorkbenchState> {
  using Value = emulator::workbench::WorkbenchState;
  static constexpr auto fields = FieldList{field<&Value::image>(),
                                           field<&Value::positions>(),
                                           field<&Value::targets>(),
                                           field<&Value::fifo>(),
                                           field<&Value::done>(),
                                           field<&Value::cause>(),
                                           field<&Value::reason>(),
                                           field<&Value::program_refused>(),
                                           field<&Value::motors>(),
                                           field<&Value::receive_errors>(),
                                           field<&Value::last_receive_error>(),
                                           field<&Value::kept>()};
};

}  // namespace understudy

namespace understudy::emulator::workbench {

class Workbench final : public DeviceOf<Workbench>,
                        public RegisterBankOf<Workbench>,
                        public ModbusStation,
                        public UserProgram,
                        public Terminals,
                        public Axes {
 public:
  Workbench(const Model& model, const DeviceSettings& settings)
      : DeviceOf(model, settings), RegisterBankOf(*this, *model.registers, settings.firmware) {
    for (const RegisterRow& row : model.registers->rows()) {
      const auto slots = static_cast<std::size_t>(row.is_view ? 0 : row.count);
      state.image.insert(state.image.end(), slots, static_cast<std::uint32_t>(row.factory));
    }
    state.kept = factory_persistent(*model.registers);
  }

  /// A program's areas and files are persistent blocks; its settings take effect immediately.
  void load_program(std::string_view text) override {
    if (stored(absent_) != 0) {
      state.program_refused = 1;
      throw ProgramError(0, 0, "the module is absent; expected it there");
    }
    ProgramReader read = WorkbenchLanguage::read(text, settings());
    state.program_refused = read.mistakes.empty() ? 0 : 1;
    if (!read.mistakes.empty()) throw ProgramError(std::move(read.mistakes));
    TextBlocks& blocks = state.kept.blocks;
    for (const std::string_view area : kAreas) {
      const auto found = read.program.areas.find(std::string(area));
      blocks.erase("areas", std::string(area));
      if (found == read.program.areas.end()) continue;
      std::string lines;
      for (const ProgramStep& step : found->second) {
        lines += (step.label.empty() ? "" : step.label + ":") + "\t" + to_text(step, found->second) + "\n";
        if (step.row->opcode == 3)
          state.image[first_d_ + static_cast<std::size_t>(step.operands[0])] =
              static_cast<std::uint32_t>(step.operands[1]);
      }
      keep("areas", std::string(area), std::move(lines));
    }
    for (auto& [name, lines] : read.program.files) keep("files", name, std::move(lines));
  }
  /// Stores a block. A program that the language has accepted always fits.
  void keep(std::string_view kind, const std::string& name, std::string text) {
    const std::string why = state.kept.blocks.put(kind, name, SharedText(std::move(text)));
    if (!why.empty()) throw std::logic_error(name + ": " + why);
  }
  std::string program_text() const override {
    std::string text;
    for (const std::string_view area : kAreas) {
      const SharedText* const lines = state.kept.blocks.find("areas", std::string(area));
      if (lines != nullptr) text += "AREA " + std::string(area) + "\n" + lines->text();
    }
    const auto files = state.kept.blocks.all().find("files");
    if (files == state.kept.blocks.all().end()) return text;
    for (const auto& [name, lines] : files->second) {
      const bool is_ended = lines.text().empty() || lines.text().back() == '\n';
      text += "FILE " + name + "\n" + lines.text() + (is_ended ? "END\n" : "\nEND\n");
    }
    return text;
  }

  PersistentMemory* memory() override { return &memory_; }
  const PersistentMemory* memory() const override { return &memory_; }

  std::span<std::uint32_t> image() override { return state.image; }
  std::span<const std::uint32_t> image() const override { return state.image; }
  bool low_word_first() const override { return stored(word_order_) == 1; }
  void register_written(const RegisterRow& row, std::size_t slot) override {
    if (keeps(row)) state.kept.eeprom.write(slot, stored(slot), kWriteTime, now());
  }
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }
  Addressing addressing(std::uint8_t address) const override {
    if (address == stored(station_)) return Addressing::execute_and_reply;
    return address == 0 ? Addressing::execute_silently : Addressing::ignore;
  }
  void receive_failed(std::size_t port, pty::ReceiveError error) override {
    ++state.receive_errors[port];
    state.last_receive_error[port] = static_cast<std::uint8_t>(1 + static_cast<int>(error));
  }
  bool output(int number) const override {
    if (number >= kFirstGroupedOutput) return output_word(number, 1) != 0;
    if (number < kFirstOutput || number >= kVolts) return false;
    return powered() && state.image[first_output_ + static_cast<std::size_t>(number - kFirstOutput)] != 0;
  }
  bool output_moves(int) const override { return false; }
  std::uint32_t output_word(int first, int count) const override {
    if (first < kFirstGroupedOutput) return Terminals::output_word(first, count);
    // The grouped outputs of one request occupy at most three words.
    const int at = first - kFirstGroupedOutput;
    std::uint64_t words = 0;
    for (int i = 0; i < 3 && powered(); ++i) {
      const int word = at / kBitsOfGroup + i;
      if (word < kOutputWords) {
        const std::size_t slot = first_word_ + static_cast<std::size_t>(word);
        words |= std::uint64_t{state.image[slot]} << (i * kBitsOfGroup);
      }
    }
    return static_cast<std::uint32_t>(words >> (at % kBitsOfGroup) & ((std::uint64_t{1} << count) - 1));
  }
  std::int32_t analog_level(int) const override {
    return powered() ? static_cast<std::int32_t>(stored(volts_)) : 0;
  }
  std::int64_t output_pulses(int) const override { return state.motors.compared; }

  // --- its motors (machine.h), whose state is kept with the rest ---------------------------------------
  Motors& motors() { return motors_; }
  const Motors& motors() const { return motors_; }
  std::int64_t pulses_this_tick(int axis) const override {
    return powered() ? state.motors.motors[static_cast<std::size_t>(axis)].sent_pulses : 0;
  }
  double speed_pps(int) const override { return 0; }
  void set_encoder(int, std::int64_t) override {}
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override {
    return motors_.place_pulses(static_cast<std::size_t>(axis));
  }
  void set_edges(int axis, const MachineEdges& edges) override {
    motors_.set_edges(*this, static_cast<std::size_t>(axis), edges);
  }
  void sample_inputs(Tick) override {
    if (take_inputs_changed()) motors_.check_inputs(*this);
  }
  void step_motion(Tick tick) override { motors_.step(tick); }
  Tick next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const override {
    if (module_moves() || inputs_changed()) return done + 1;
    return std::min(motors_.next_event_tick(done, max, ahead), next_persistent_tick(done));
  }
  void fast_forward_to(Tick, Tick tick, const ClearTravel&, std::span<std::int64_t> pulses) override {
    motors_.fast_forward_to(tick, pulses);
  }

  /// Positions and commands belong to a module that may be absent; writes of positions are refused while its
  /// FIFO is full.
  DeviceAnswer admits(const RegisterRequest& request, Checked checked) const override {
    const bool is_of_module =
        request.table == Table::holding && (request.first == kWindow || (request.first & 0xFFF0) == 0x0010);
    if (!is_of_module) return Refusal::none;
    if (stored(absent_) != 0) return {Refusal::failure, kModuleAbsent};
    // A command is checked first (take_command()).
    const bool is_full = request.is_write() && request.first != kWindow && state.fifo.size() >= kFifo;
    if (checked == Checked::everything && is_full) return {Refusal::busy, kFifoFull};
    return Refusal::none;
  }
  void exception_answered(const RefusedRequest& request) override {
    state.cause = static_cast<std::uint8_t>(request.objection.cause);
    state.reason = request.objection.reason;
    last_refused = request;
  }

  void run_interpreters(Tick) override {
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      std::int32_t& position = state.positions[axis];
      const std::int64_t direction = std::int64_t{state.targets[axis]} - position;
      position += static_cast<std::int32_t>(std::clamp<std::int64_t>(direction, -100, 100));
    }
    if (stored(run_) == 0 || state.fifo.empty() || is_moving()) return;
    const std::vector<std::uint16_t> command = state.fifo.front();
    state.fifo.erase(state.fifo.begin());
    ++state.done;
    if (command[0] != kMove) return;
    state.targets[command[1]] = static_cast<std::int32_t>(std::uint32_t{command[2]} << 16 | command[3]);
  }
  void update_outputs(Tick tick) override { state.kept.eeprom.step(tick, state.image); }
  Tick next_persistent_tick(Tick done) const {
    return std::max(done + 1, state.kept.eeprom.next_active_tick());
  }
  bool module_moves() const { return is_moving() || (stored(run_) != 0 && !state.fifo.empty()); }
  Tick next_active_tick(Tick done) const override {
    return module_moves() || inputs_changed() || !motors_.is_quiet() ? done + 1 : next_persistent_tick(done);
  }
  bool is_moving() const { return state.positions != state.targets; }

  WorkbenchState state;
  RefusedRequest last_refused;  // for tests; not part of the state

 protected:
  void power_up() override { recall(state.kept.eeprom, map(), state.image); }
  void power_down() override { state.kept.eeprom.lose_power(); }
  void write_own_state(StateWriter& writer) const override { writer.write(state); }
  std::function<void()> read_own_state(StateReader& reader) override {
    const auto restored = std::make_shared<WorkbenchState>();
    reader.read(*restored);
    require_state(restored->image.size() == state.image.size(), "the image has a different size");
    restored->kept.eeprom.check_restored(state.kept.eeprom);
    restored->kept.blocks.check_restored(state.kept.blocks);
    require_state(restored->fifo.size() <= kFifo, "the FIFO exceeds its capacity");
    return [this, restored] { state = *restored; };
  }
  std::string own_difference(StateReader& a, StateReader& b) const override {
    return difference_of_saved<WorkbenchState>(a, b);
  }

 private:
  std::size_t slot_of(std::string_view name) const {
    return static_cast<std::size_t>(map().find(name, firmware())->place.slot);
  }
  std::uint32_t stored(std::size_t slot) const { return state.image[slot]; }

  WorkbenchMemory memory_{"workbench", firmware(), *this, state.kept};
  const std::size_t word_order_ = slot_of("Word_Order");
  const std::size_t first_output_ = slot_of("Output_0");
  const std::size_t run_ = slot_of("Run");
  const std::size_t absent_ = slot_of("Absent");
  const std::size_t station_ = slot_of("Station");
  const std::size_t volts_ = slot_of("Volts");
  const std::size_t first_word_ = slot_of("DO_Word_0");
  const std::size_t first_d_ = slot_of("D0");
  Motors motors_{state.motors};
};

inline std::size_t axis_of(Cell cell) { return static_cast<std::size_t>(cell.index); }

inline Value position_of(const Workbench& bench, Cell cell) { return bench.state.positions[axis_of(cell)]; }
inline void set_position(Workbench& bench, Cell cell, Value value) {
  bench.state.positions[axis_of(cell)] = static_cast<std::int32_t>(value);
  bench.state.targets[axis_of(cell)] = static_cast<std::int32_t>(value);
}
inline Value is_driving(const Workbench& bench, Cell cell) {
  return bench.state.positions[axis_of(cell)] != bench.state.targets[axis_of(cell)] ? 1 : 0;
}
inline Value is_any_driving(const Workbench& bench, Cell) { return bench.is_moving() ? 1 : 0; }
inline Value fifo_length(const Workbench& bench, Cell) { return static_cast<Value>(bench.state.fifo.size()); }
inline Value last_cause(const Workbench& bench, Cell) { return bench.state.cause; }
inline Value program_refused(const Workbench& bench, Cell) { return bench.state.program_refused; }
inline Value last_reason(const Workbench& bench, Cell) { return bench.state.reason; }
inline Value commands_done(const Workbench& bench, Cell) { return bench.state.done; }
inline Value temperature(const Workbench&, Cell) { return value_of_real(21.5F); }
inline Value receive_errors(const Workbench& bench, Cell cell) {
  return bench.state.receive_errors[static_cast<std::size_t>(cell.index)];
}
inline Value input_level(const Workbench& bench, Cell cell) { return bench.input(cell.index); }

inline DeviceAnswer take_block(Workbench& bench, Cell, std::span<const std::uint16_t> words) {
  return change_block(bench.state.kept.blocks, words);
}

/// A command is checked by its code, its words and its axis; then it waits in the FIFO.
inline DeviceAnswer take_command(Workbench& bench, Cell, std::span<const std::uint16_t> words) {
  if (words[0] != kMove && words[0] != kStop) return {Refusal::bad_value, kUnknownCommand};
  const bool is_good = words[0] == kMove ? words.size() == 4 && words[1] < kAxisCount : words.size() == 1;
  if (!is_good) return {Refusal::bad_value, kWrongWords};
  if (bench.state.fifo.size() >= kFifo) return {Refusal::busy, kFifoFull};
  auto& command = bench.state.fifo.emplace_back(words.begin(), words.end());
  if (words[0] == kMove && bench.low_word_first()) std::swap(command[2], command[3]);
  return Refusal::none;
}

inline constexpr std::uint8_t kFunctions[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x0F, 0x10};
inline constexpr int kBauds[] = {115200, 9600};
inline constexpr int kSlowBauds[] = {19200, 38400};
inline constexpr PortRow kPorts[] = {
    {.name = kPortNames[0], .bauds = kBauds, .settings = {}},
    {.kind = PortRow::Kind::rs232,
     .name = kPortNames[1],
     .bauds = kSlowBauds,
     .settings = {.data_bits = 8, .parity = pty::Parity::none, .stop_bits = 1}}};
inline constexpr Firmware kFirmwares[] = {100};
inline constexpr std::string_view kStateRegisters[] = {"STATE", "holding.Position_X", "Temperature",
                                                       "Mode.PROGRAM"};

/// A parameter with one number for every axis, parameters that are counters, and one without a letter.
inline constexpr ParameterRow kParameters[] = {
    {.first = 20, .register_name = "Speed_{}", .letter = "P", .of_each_axis = true},
    {.first = 100, .count = 125, .register_name = "D{}", .letter = "D"},
    {.first = 7, .register_name = "Offset"}};

inline const Model& model() {
  static const RegisterMap map(kRows, kPolicy);
  static const Model made{
      .name = "workbench",
      .title = "a controller for tests",
      .firmwares = kFirmwares,
      .registers = &map,
      .parameters = kParameters,
      .window = &window(),
      .language = &language(),
      .choices = kChoices,
      .terminals = terminal_tables().rows,
      .terminal_groups = terminal_tables().groups,
      .axes = motor_rows(),
      .state_registers = kStateRegisters,
      .known_limitations = {},
      .line = {.protocol = kModbusRtu, .ports = kPorts, .station_numbers = StationNumbers{0, 247, "Station"}},
      .rtu = RtuRules{.end_silence = std::chrono::microseconds(500), .functions = kFunctions},
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<Workbench>(workbench::model(), settings);
      }};
  return made;
}

}  // namespace understudy::emulator::workbench
