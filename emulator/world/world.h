// A world is a running bench. Only advance_to() advances it. Everything in it depends only on its setup and
// on its inputs with their simulated times.
//
// Each tick runs the same phases for all devices: inputs, interpreters, motion, plant, outputs. Between
// ticks, lines process what is due on them. At the same instant, a tick precedes the lines, and the lines run
// in the bench's order.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/machine_edges.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/outside.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::world {

/// How long to wait for the rest of an incomplete frame, measured with the host's clock.
inline constexpr std::chrono::nanoseconds kFramePatience = std::chrono::milliseconds(10);

struct WorldOptions {
  bool strict_framing = false;
  /// With tolerant framing, how long to wait for the rest of an incomplete frame (simulated time).
  SimTime patience = kFramePatience;
  bool enforce_settings = true;  // devices ignore a host with a different speed
};

class FaultWatch;

class World final : public WorldView {
 public:
  /// Throws SettingError if a model refuses a setting, and NameError if one of the faults is impossible in
  /// this world.
  World(const Bench& bench, const WorldOptions& options, const std::function<void(const std::string&)>& log);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  SimTime now() const override { return now_; }
  /// Processes everything that is due up to and including `time`. If `time` is in the past, does nothing.
  void advance_to(SimTime time);
  /// Returns when something will happen without an outside event, or nothing if only outside events can
  /// change anything.
  std::optional<SimTime> next_due() const;
  std::uint64_t ticks_run() const { return ticks_.run; }          // ticks that were run separately
  std::uint64_t ticks_skipped() const { return ticks_.skipped; }  // ticks that were skipped in bulk

  /// If `on` is false, all ticks are run one by one. The results are the same, which tests check.
  void set_bulk_ticks(bool on) { bulk_ticks_ = on; }

  /// Adds a watcher, which stays until it is removed. Watchers are notified of each tick in the order in
  /// which they were added.
  void add_watcher(TickWatcher& watcher) { watchers_.push_back(&watcher); }
  void remove_watcher(TickWatcher& watcher) { std::erase(watchers_, &watcher); }
  /// A watcher can call this during on_tick(): advance_to() then ends at that tick, after all watchers have
  /// been notified.
  void stop_here() { stops_here_ = true; }

  /// Adds a listener, which stays until it is removed. Listeners are called in the order in which they were
  /// added.
  void add_listener(OutsideListener& listener) { listeners_.push_back(&listener); }
  void remove_listener(OutsideListener& listener) { std::erase(listeners_, &listener); }

  // --- lines ---------------------------------------------------------------------------------
  std::size_t line_count() const override { return lines_.size(); }
  const WorldLine& line(std::size_t number) const override { return *lines_[number]; }

  // The actions of hosts on a line (see pty/line.h). Everything that reaches a line from outside uses these
  // functions.
  void host_opened(std::size_t line) { lines_[line]->line.host_opened(); }
  void host_closed(std::size_t line) { lines_[line]->line.host_closed(); }
  void host_settings(std::size_t line, const std::optional<pty::HostSettings>& settings) {
    lines_[line]->line.host_settings(settings);
  }
  /// Receives at most line().room() bytes from the current host. `at` is the present moment or a later one.
  void receive(std::size_t line, std::span<const std::uint8_t> bytes, SimTime at) {
    lines_[line]->line.receive(bytes, at);
  }
  void receive(std::size_t line, std::span<const std::uint8_t> bytes) { receive(line, bytes, now_); }
  /// Receives bytes from a host that has already closed the line.
  void receive_departed(std::size_t line, std::span<const std::uint8_t> bytes) {
    lines_[line]->line.receive_departed(bytes, now_);
  }
  void host_purged(std::size_t line) { lines_[line]->line.host_purged(); }
  /// Called when the clock is stopped and the host has sent nothing for as long as the line waits for a
  /// frame.
  void nothing_more(std::size_t line) { lines_[line]->line.nothing_more(now_); }
  /// Called when the host has read this many bytes of the line's output.
  void take_output(std::size_t line, std::size_t count) { lines_[line]->line.take_output(count); }

  // The observers of a line. They change nothing.
  void add_observer(std::size_t line, pty::LineObserver& observer) {
    lines_[line]->line.add_observer(observer);
  }
  void remove_observer(std::size_t line, pty::LineObserver& observer) {
    lines_[line]->line.remove_observer(observer);
  }
  /// Reports to the observers how a fault has affected a message. It has no other effect.
  void report_strike(std::size_t line, const pty::StruckMessage& message) {
    lines_[line]->line.report_strike(message);
  }

  // --- devices and the plant ---------------------------------------------------------------------
  std::size_t device_count() const override { return devices_.size(); }
  Device& device(std::size_t number) { return *devices_[number]; }
  const Device& device(std::size_t number) const override { return *devices_[number]; }
  const KnownDevices& known() const override { return known_; }
  const PlantAxis& plant(std::size_t device, int axis) const override;
  std::int64_t sent_pulses(std::size_t device, int axis) const override {
    return sent_pulses_[device][static_cast<std::size_t>(axis)];
  }
  /// Holds a digital input on, or releases it. Switches and wires at the same input still affect it. This
  /// also sets analog inputs (in millivolts) and switches on the housing.
  void set_external_input(std::size_t device, int terminal, std::int32_t level);
  /// Returns the level that set_external_input() last set.
  std::int32_t external_input(std::size_t device, int terminal) const;
  /// The sources that drive an input. `stuck` overrides all others.
  struct Input {
    std::int32_t external = 0;
    bool wired = false;
    bool plant = false;
    std::optional<bool> stuck{};
  };
  const Input& input(std::size_t device, int terminal) const {
    return inputs_[device][static_cast<std::size_t>(terminal)];
  }
  /// Writes a register without using the line.
  Refusal write(std::size_t device, const PreparedWrite& write);
  /// Sets a value by its name, for a device without registers. Returns nothing, or the reason for a refusal.
  /// A refused call changes nothing.
  std::optional<std::string> assign(std::size_t device, const std::string& name, double value);
  /// Throws ProgramError.
  void load_program(std::size_t device, std::string_view text);
  /// Executes a command by its name without using the line: as one message to the device's window
  /// (emulator/device/command_window.h), or as a line of text whose answer is not sent. Throws ProgramError
  /// for a text that is not a command. Returns why the device refused the command.
  Objection command(std::size_t device, std::string_view text);
  /// Switches power between two ticks. A device without power stops sending immediately. During a power-cut
  /// fault, the device stays off; afterwards, it is on only if it is switched on.
  void switch_power(std::size_t device, bool on);

  const std::vector<WireSetup>& wires() const { return wires_; }

  // --- faults --------------------------------------------------------------------------------
  /// Adds a fault, which takes effect from the next tick on, or when its trigger fires. Returns its number
  /// for clear_fault(). If the fault is impossible in this world, throws NameError and changes nothing.
  std::size_t inject(const Fault& fault);
  /// Returns false if there is no fault with that number.
  bool clear_fault(std::size_t number);
  /// Clears all faults, whether active or waiting, in the order of their numbers.
  void clear_faults();
  const std::map<std::size_t, ArmedFault>& faults() const { return faults_; }

 private:
  template <class T>
  friend struct understudy::StateOf;  // state_fields.h lists the members that are state

  /// A contact of an axis's machine, and the device input to which it is connected.
  struct ContactWire {
    std::size_t axis = 0;
    Contact contact = Contact::home;
    int input = 0;
  };

  /// The edges last sent to a device for an axis, and the position of the machine when the device's count was
  /// 0.
  struct SentEdges {
    bool is_sent = false;
    std::int64_t origin = 0;
    MachineEdges edges{};
  };

  /// A counted input that is being turned evenly.
  struct InputTurn {
    std::size_t device = 0;
    int terminal = 0;
    std::int64_t counts = 0;
    Tick ticks = 1;
    Tick ticks_left = 0;
  };

  /// Limits how often skipping is tried again after a failed attempt. This affects only speed.
  struct SkipTries {
    static constexpr Tick kMaxApart = 64;
    Tick next = 0;
    Tick apart = 1;
  };

  struct TickCounts {
    std::uint64_t run = 0;
    std::uint64_t skipped = 0;
  };

  struct Supply {
    bool is_switched_on = true;
  };

  template <class Notify>
  void notify(Notify what) const {
    for (OutsideListener* listener : listeners_) what(*listener);
  }
  void run_due_lines();
  void run_tick();
  Tick last_alike() const;
  void show_tick(bool is_rest);
  void run_lines(SimTime time);
  Tick next_active_tick() const;
  Tick next_event_tick(Tick limit) const;
  bool has_moving_wires() const;
  /// Running fewer ticks than this one by one is faster than skipping them.
  static constexpr Tick kMinSkip = 4;
  bool may_fast_forward(Tick limit) const {
    // A restore may have set time back very far.
    const bool is_too_soon = done_ < skip_tries_.next && skip_tries_.next - done_ <= SkipTries::kMaxApart;
    return !is_too_soon && limit - done_ >= kMinSkip && bulk_ticks_ && !disturbed_ && watchers_.empty();
  }
  Tick last_tick_to_skip(Tick limit);
  void fast_forward_to(Tick tick);
  SimTime next_line_time() const;
  void run_device(std::size_t number);
  void prefetch_device(std::size_t number) const;
  void step_plant(std::size_t number);
  /// The count wraps, because a forged snapshot may contain any value.
  static void count_sent(std::int64_t& sent, std::int64_t pulses) {
    sent = static_cast<std::int64_t>(static_cast<std::uint64_t>(sent) + static_cast<std::uint64_t>(pulses));
  }
  void latch_wires();
  void latch_drive(const WireSetup& wire);
  void connect_drive(const MachineSetup& machine);
  DriveInputs drive_inputs(std::size_t number, std::size_t axis) const;
  // Edges between ticks are in world_edges.cpp.
  MachineEdges edges_of(std::size_t device, std::size_t axis) const;
  void begin_edges();
  bool meets_edges(std::size_t device) const {
    return device < sent_edges_.size() && !sent_edges_[device].empty() && devices_[device]->powered();
  }
  void send_edges(std::size_t device);
  void resend_edges(std::size_t device);
  void check_positions(std::size_t device);
  void turn_inputs();
  void wire_contacts(std::size_t number);
  bool level_of(const WireSetup& wire) const;
  void move_by_hand(const Fault& fault);
  void apply_input(std::size_t device, int terminal);
  void apply_faults(std::size_t device);
  void apply_adapters();
  void remove_fault(std::map<std::size_t, ArmedFault>::iterator fault);
  void settle_power(std::size_t device);
  void poll_text(SimTime now);
  void arm_faults();
  void check_faults();
  void settle_faults();
  Tick next_fault_tick() const;

  KnownDevices known_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::vector<Axes*> axes_;  // by device
  std::vector<std::unique_ptr<WorldLine>> lines_;
  std::vector<WorldLine*> unasked_lines_;              // lines with devices that may send without a request
  std::vector<std::vector<PlantAxis>> plants_;         // [device][axis]
  std::vector<std::vector<std::size_t>> driven_axes_;  // by device: the axes that have a drive
  std::vector<std::vector<ContactWire>> contacts_;     // by device, as in the bench
  std::vector<std::vector<SentEdges>> sent_edges_;     // by device; empty if the device does not use edges
  std::vector<InputTurn> input_turns_;
  std::vector<std::vector<std::int64_t>> sent_pulses_;
  std::vector<std::vector<Input>> inputs_;  // [device][terminal]
  std::vector<Supply> supplies_;            // by device
  std::vector<WireSetup> wires_;
  std::vector<TickWatcher*> watchers_;
  bool stops_here_ = false;
  std::vector<OutsideListener*> listeners_;
  std::map<std::size_t, ArmedFault> faults_;  // by number
  std::size_t next_fault_ = 1;
  std::unique_ptr<FaultWatch> fault_watch_;  // null if no fault is waiting or changes with time
  std::uint64_t seed_ = 0;
  /// True if something changed that devices do not notice, so that the next tick must be run.
  bool disturbed_ = false;
  SimTime now_{0};
  Tick done_ = 0;  // the last tick that was run or skipped
  TickCounts ticks_;
  bool bulk_ticks_ = true;
  SkipTries skip_tries_;
};

}  // namespace understudy::emulator::world
