// The common base of all parts of a SUPER-40NC: the register image, the special contacts as a scan sees them,
// the persistent memory, the error in D8094 to D8096, and the signals Y0 to Y9.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/choices.h"
#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/ground/contacts.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

using interpreter::super_40nc::Area;
using interpreter::super_40nc::Code;

/// What moves an axis: a step program or the PLC, in the order of their areas, or an operator by hand.
enum class Mover : std::uint8_t { c, x, y, z, u, plc, hand };

/// The number of the transition table that counts the errors.
inline constexpr std::size_t kErrorTable = 1;

/// The error that D8094 to D8096 show.
struct ErrorReport {
  Code code = Code::none;
  std::int32_t step = 0;
  Area area = Area::plc;  // area of the step program's line; plc: a line of the PLC, or no line
  std::int32_t other_step = 0;
  Tick tick = -1;  // if a tick has several errors, the first one stays

  bool operator==(const ErrorReport&) const = default;
};

/// Outputs that indicate for some time that something has finished (《X45.》, 《X46.》, 《C4.》, 《C5.》).
inline constexpr std::size_t kSignalCount = 10;
inline constexpr std::size_t kFirstEndSignal = 4;
inline constexpr std::size_t kPathSignal = 8;
inline constexpr std::size_t kEndOfCSignal = 9;

struct GroundState {
  bool touched = true;      // something was written since the last scan
  bool emergency = false;   // CEMG
  bool has_ticked = false;  // at least one tick has run since power-up
  std::array<std::int32_t, 3> analog{};
  Contacts contacts;
  ErrorReport error;
  std::array<Tick, kSignalCount> signal_until{};
  std::array<std::uint32_t, 2> receive_errors{};           // receive errors, by port
  std::array<std::int32_t, kAxisCount> rpm_at_power_up{};  // X14
  std::int32_t logo_ms = 0;                                // C0, as it was at power-up
  std::int32_t station = 0;                                // D9000, as it was at power-up
  std::vector<std::uint32_t> parameters_in_force;  // if written parameters take effect later; otherwise empty
  Eeprom eeprom;
  Image image{};

  bool operator==(const GroundState&) const = default;
};

/// Returns the code that D8094 shows for `why`.
Code code_of(motion::Cause why);

class Ground {
 public:
  using StepStates = interpreter::super_40nc::StepStates;

  /// `steps` is only read, because D8095 shows the line of a program.
  Ground(const Device& device, GroundState& state, const StepStates& steps);

  GroundState& state() { return state_; }
  const GroundState& state() const { return state_; }
  bool chose(const Option& option) const { return device_.chose(option); }
  Decisions& decisions() const { return device_.decisions(); }
  Tick now() const { return device_.now(); }
  std::int32_t input(int terminal) const { return device_.input(terminal); }
  bool powered() const { return device_.powered(); }
  const interpreter::super_40nc::Options& language_options() const { return options_; }

  // --- registers and contacts
  Settings registers() const { return Settings(state_.image, readings_, state_.parameters_in_force); }
  /// Writes a register without its effect, as the device itself does.
  void put(StoredRegister kept, std::int32_t value, int axis = 0);
  /// If the register is persistent, stores the image's value in the memory.
  void keep_slot(std::size_t slot) { state_.eeprom.write(slot, state_.image[slot], 0, now()); }
  bool contact(int number) const { return state_.image[relay_slot(number)] != 0; }
  void set_contact(int number, bool on) { state_.image[relay_slot(number)] = on ? 1 : 0; }
  /// Returns true if the contact is ON for this scan.
  bool is_on(int number) const { return state_.contacts.on(number, contact(number)); }
  bool rises(int number) const { return state_.contacts.rose(number, contact(number)); }
  void touch() { state_.touched = true; }
  bool keeps_unlisted() const { return !chose(option("unlisted_contacts", "read_0")); }

  // --- memory.cpp
  bool keeps(const RegisterRow& row) const;
  std::uint32_t factory_bits(const RegisterRow& row) const;
  Eeprom factory_memory() const;
  /// Loads the image from the memory, as at power-up.
  void load_image();
  void take_parameters();
  void take_power_up_parameters();

  // --- errors.cpp
  void report(const ErrorReport& error);
  void report(Code code) { report(ErrorReport{.code = code}); }
  /// Reports an error at the current line of the mover's program, if any.
  void report(Code code, Mover of_its_line);
  void clear_error() { state_.error = {}; }
  void error_is_over();
  /// Sets the PLC line that starts a motion, counted as in D8095; 0 outside such lines.
  void set_plc_step(int step) { plc_step_ = step; }

  // --- finish_signals.cpp
  /// Begins the signal Y0 + `signal`, or restarts it.
  void show_finished(std::size_t signal);
  /// Returns true if a line outputs the signal even if its axes are already at their targets.
  bool finishes_without_motion() const { return !chose(option("fsh_without_motion", "do_not_come")); }
  void update_signals(Tick tick);
  /// Returns the first tick after `done` in which a signal changes.
  Tick next_signal_tick(Tick done) const;

 private:
  int line_step(Mover mover) const;
  /// Returns true if the PLC may switch FSH and END outputs between their signals.
  bool shares_signals() const { return shares_signals_; }

  const Device& device_;
  GroundState& state_;
  const StepStates& steps_;
  interpreter::super_40nc::Options options_;
  Readings readings_;             // cached choices
  bool parameters_wait_ = false;  // cached: written parameters take effect later, all at once
  bool shares_signals_ = false;   // cached
  int plc_step_ = 0;              // not part of the state: 0 outside a line
};

/// The base class of all parts that use the ground.
class OnGround {
 protected:
  explicit OnGround(Ground& ground) : ground_(ground) {}

  bool chose(const Option& option) const { return ground_.chose(option); }
  Tick now() const { return ground_.now(); }
  /// Returns the previous tick, because moves of a scan start in the tick of the scan.
  Tick before_motion() const { return now() - 1; }
  std::int32_t input(int terminal) const { return ground_.input(terminal); }
  Settings registers() const { return ground_.registers(); }
  bool is_on(int contact_number) const { return ground_.is_on(contact_number); }
  bool rises(int contact_number) const { return ground_.rises(contact_number); }
  void report(Code code) { ground_.report(code); }

  Ground& ground_;
};

}  // namespace understudy::emulator::models::super_40nc
