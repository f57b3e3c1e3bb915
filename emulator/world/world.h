// A world: a running bench. It advances only by advance_to(); everything in it is a function of its setup and
// of what was given to it, and at which simulated times.
//
// Each tick runs the same phases for all devices: inputs, interpreters, motion, plant, outputs. Between
// ticks lines do what is due on them; at the same instant a tick comes before the lines, and the lines
// follow each other in the bench's order.
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

/// How long to wait for the rest of an incomplete frame, by the host's clock.
inline constexpr std::chrono::nanoseconds kFramePatience = std::chrono::milliseconds(10);

struct WorldOptions {
  bool strict_framing = false;
  /// How long an incomplete frame waits where the framing is tolerant (simulated time).
  SimTime patience = kFramePatience;
  bool enforce_settings = true;  // devices are deaf to a host with another speed
};

class FaultWatch;

class World final : public WorldView {
 public:
  /// Throws SettingError if the models refuse something, NameError if a fault waits for something unknown.
  World(const Bench& bench, const WorldOptions& options, const std::function<void(const std::string&)>& log);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  SimTime now() const override { return now_; }
  /// Does everything that is due up to and including `time`. Times in the past are not an error and do
  /// nothing.
  void advance_to(SimTime time);
  /// When something will happen by itself next; nothing if only the outside can change anything.
  std::optional<SimTime> next_due() const;
  std::uint64_t ticks_run() const { return ticks_.run; }          // one by one
  std::uint64_t ticks_crossed() const { return ticks_.crossed; }  // in bulk

  /// Runs every tick, quiet or not; the results are the same (this exists to prove it).
  void set_bulk_ticks(bool on) { bulk_ticks_ = on; }

  /// Adds a watcher until it is removed; several see a tick in the order in which they were added.
  void add_watcher(TickWatcher& watcher) { watchers_.push_back(&watcher); }
  void remove_watcher(TickWatcher& watcher) { std::erase(watchers_, &watcher); }
  /// For a watcher, while it is shown a tick: advance_to() ends there, once all have seen it.
  void stop_here() { stops_here_ = true; }

  /// Until it is removed; several are told in the order in which they were added.
  void add_listener(OutsideListener& listener) { listeners_.push_back(&listener); }
  void remove_listener(OutsideListener& listener) { std::erase(listeners_, &listener); }

  // --- lines ---------------------------------------------------------------------------------
  std::size_t line_count() const override { return lines_.size(); }
  const WorldLine& line(std::size_t number) const override { return *lines_[number]; }

  // What hosts do there, as pty/line.h has it: all that reaches a line from outside comes in here.
  void host_opened(std::size_t line) { lines_[line]->line.host_opened(); }
  void host_closed(std::size_t line) { lines_[line]->line.host_closed(); }
  void host_settings(std::size_t line, const std::optional<pty::HostSettings>& settings) {
    lines_[line]->line.host_settings(settings);
  }
  /// Bytes of the host that is there now; `at` is this moment, or one to come. At most line().room() of them.
  void receive(std::size_t line, std::span<const std::uint8_t> bytes, SimTime at) {
    lines_[line]->line.receive(bytes, at);
  }
  void receive(std::size_t line, std::span<const std::uint8_t> bytes) { receive(line, bytes, now_); }
  /// At this moment, of a host that has closed since.
  void receive_departed(std::size_t line, std::span<const std::uint8_t> bytes) {
    lines_[line]->line.receive_departed(bytes, now_);
  }
  void host_purged(std::size_t line) { lines_[line]->line.host_purged(); }
  /// The clock stands, and nothing more has come for as long as a frame is waited for.
  void nothing_more(std::size_t line) { lines_[line]->line.nothing_more(now_); }
  /// The host has taken this many bytes of the line's output.
  void take_output(std::size_t line, std::size_t count) { lines_[line]->line.take_output(count); }

  // Those who look at a line; they change nothing.
  void add_observer(std::size_t line, pty::LineObserver& observer) {
    lines_[line]->line.add_observer(observer);
  }
  void remove_observer(std::size_t line, pty::LineObserver& observer) {
    lines_[line]->line.remove_observer(observer);
  }
  /// Lets them know of it; it has no other effect.
  void tell_strike(std::size_t line, const pty::StruckMessage& message) {
    lines_[line]->line.tell_strike(message);
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
  /// Holds a digital input on, or lets it go; switches and wires on the same input act as well. Or sets an
  /// analog input (millivolts) or a switch on the housing.
  void set_external_input(std::size_t device, int terminal, std::int32_t level);
  /// What set_external_input() gave it.
  std::int32_t external_input(std::size_t device, int terminal) const;
  /// Who drives an input. What is stuck hides the rest.
  struct Input {
    std::int32_t external = 0;
    bool wired = false;
    bool plant = false;
    std::optional<bool> stuck{};
  };
  const Input& input(std::size_t device, int terminal) const {
    return inputs_[device][static_cast<std::size_t>(terminal)];
  }
  /// Writes a register without the line.
  Refusal write(std::size_t device, const PreparedWrite& write);
  /// Sets a value by its name, for a device without registers. Returns nothing, or why not, and then nothing
  /// has changed.
  std::optional<std::string> assign(std::size_t device, const std::string& name, double value);
  /// Throws ProgramError.
  void load_program(std::size_t device, std::string_view text);
  /// Gives a device a command by its name, past the line, as one message to its window
  /// (emulator/device/command_window.h), or a line of text, whose answer is kept from the line. Throws
  /// ProgramError for what is not one; says why it was refused.
  Objection command(std::size_t device, std::string_view text);
  /// Between two ticks. What a device without power was saying ends at once. One whose power is cut has none
  /// until that is over, and then only if it is switched on.
  void switch_power(std::size_t device, bool on);

  const std::vector<WireSetup>& wires() const { return wires_; }

  // --- faults --------------------------------------------------------------------------------
  /// In force from the next tick on, or when its trigger says so; the number is for clear_fault(). Throws
  /// NameError if this world cannot have it; then nothing has changed.
  std::size_t inject(const Fault& fault);
  /// False if there is no fault of that number.
  bool clear_fault(std::size_t number);
  /// All faults, whether they have struck or wait, in the order of their numbers.
  void clear_faults();
  const std::map<std::size_t, ArmedFault>& faults() const { return faults_; }

 private:
  template <class T>
  friend struct understudy::StateOf;  // state_fields.h: which of these are state

  /// A contact of the machine on an axis, and its device's input to which it is wired.
  struct ContactWire {
    std::size_t axis = 0;
    Contact contact = Contact::home;
    int input = 0;
  };

  /// What a device that meets edges has been told of an axis, and where the machine was then when the device
  /// had counted to 0.
  struct ToldEdges {
    bool is_told = false;
    std::int64_t origin = 0;
    MachineEdges edges{};
  };

  /// A counted input that is being turned, evenly.
  struct InputTurn {
    std::size_t device = 0;
    int terminal = 0;
    std::int64_t counts = 0;
    Tick ticks = 1;
    Tick ticks_left = 0;
  };

  /// Where nothing could be crossed it is not tried again in each tick. Only what that costs depends on
  /// these.
  struct CrossingTries {
    static constexpr Tick kMostApart = 64;
    Tick next = 0;
    Tick apart = 1;
  };

  struct TickCounts {
    std::uint64_t run = 0;
    std::uint64_t crossed = 0;
  };

  /// Of a device's power.
  struct Supply {
    bool is_switched_on = true;
  };

  template <class Tell>
  void tell(Tell what) const {
    for (OutsideListener* listener : listeners_) what(*listener);
  }
  void begin_act();
  void run_tick();
  Tick last_alike() const;
  void show_tick(bool is_rest);
  void run_lines(SimTime time);
  Tick next_active_tick() const;
  Tick next_event_tick(Tick most) const;
  bool has_moving_wires() const;
  /// Fewer ticks are run one by one sooner than crossed.
  static constexpr Tick kWorthCrossing = 4;
  bool may_cross(Tick most) const {
    // A world may have been taken back to a time long before.
    const bool is_too_soon =
        done_ < crossing_tries_.next && crossing_tries_.next - done_ <= CrossingTries::kMostApart;
    return !is_too_soon && most - done_ >= kWorthCrossing && bulk_ticks_ && !disturbed_ && watchers_.empty();
  }
  Tick last_tick_to_cross(Tick most);
  void cross_to(Tick tick);
  SimTime next_line_time() const;
  void run_device(std::size_t number);
  void prefetch_device(std::size_t number) const;
  void step_plant(std::size_t number);
  /// It wraps: a forged snapshot may hold any count.
  static void count_sent(std::int64_t& sent, std::int64_t pulses) {
    sent = static_cast<std::int64_t>(static_cast<std::uint64_t>(sent) + static_cast<std::uint64_t>(pulses));
  }
  void latch_wires();
  void latch_drive(const WireSetup& wire);
  void connect_drive(const MachineSetup& machine);
  DriveInputs drive_inputs(std::size_t number, std::size_t axis) const;
  // Edges between ticks: world_edges.cpp.
  MachineEdges edges_of(std::size_t device, std::size_t axis) const;
  void begin_edges();
  bool meets_edges(std::size_t device) const {
    return device < told_edges_.size() && !told_edges_[device].empty() && devices_[device]->powered();
  }
  void tell_edges(std::size_t device);
  void tell_edges_anew(std::size_t device);
  void look_at_places(std::size_t device);
  void turn_inputs();
  void wire_contacts(std::size_t number);
  bool level_of(const WireSetup& wire) const;
  void move_by_hand(const Fault& fault);
  void apply_input(std::size_t device, int terminal);
  void apply_faults(std::size_t device);
  void apply_adapters();
  void remove_fault(std::map<std::size_t, ArmedFault>::iterator fault);
  void settle_power(std::size_t device);
  void look_for_speech(SimTime now);
  void arm_faults();
  void look_at_faults();
  void settle_faults();
  Tick next_fault_tick() const;

  KnownDevices known_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::vector<Axes*> axes_;  // of each device
  std::vector<std::unique_ptr<WorldLine>> lines_;
  std::vector<WorldLine*> unasked_lines_;              // those of them whose devices may speak unasked
  std::vector<std::vector<PlantAxis>> plants_;         // [device][axis]
  std::vector<std::vector<std::size_t>> driven_axes_;  // by device: those with a drive
  std::vector<std::vector<ContactWire>> contacts_;     // by device; as the bench has them
  std::vector<std::vector<ToldEdges>> told_edges_;     // by device; none where nobody asks
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
  std::unique_ptr<FaultWatch> fault_watch_;  // null: no fault waits for anything
  std::uint64_t seed_ = 0;
  bool disturbed_ = false;  // from outside, in a way that devices do not see: the next tick is run
  SimTime now_{0};
  Tick done_ = 0;  // the last tick that is over
  TickCounts ticks_;
  bool bulk_ticks_ = true;
  CrossingTries crossing_tries_;
};

}  // namespace understudy::emulator::world
