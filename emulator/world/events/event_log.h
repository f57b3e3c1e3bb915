// Lists the events of a bench for observers: writes to registers and their authors, inputs, power, programs,
// faults, refused requests, commands without effect, dropped frames. Events are numbered from 1, and only the
// most recent ones are kept.
//
// Outside events are recorded when they happen. Write requests from hosts are recorded when a device executes
// them, because only then can it be determined that it did, and which station number it had. All other events
// on the lines are created from the frame log on demand, so they cost nothing while nobody reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/frames/frame_log.h"
#include "emulator/world/outside.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct Event {
  std::uint64_t number = 0;
  SimTime time{0};
  /// one of write, input, power, program, command, inject, clear, fault, exception, ignored, dropped,
  /// restored, speed, stop, logpoint
  std::string_view what;
  std::string by;      // host, control or page; empty if the event has none of these causes
  std::string line{};  // the line of the host that caused the event
  std::string device{};
  std::string name{};   // the register or terminal, in the form that the control socket accepts
  std::string value{};  // a number as text
  std::string text{};   // more details, for people
};

class EventLog final : private OutsideListener {
 public:
  static constexpr std::size_t kKept = 4'096;

  /// `world` and `frames` must outlive the log.
  EventLog(World& world, const FrameLog& frames);
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Sets the author of outside events from now on: "control", "page".
  void set_author(std::string_view author) { author_ = author; }
  const std::string& author() const { return author_; }
  /// Adds an event that the world does not report.
  void note(std::string_view what, std::string text);
  /// The same for a whole event. The time is set to the present time.
  void note(Event event);
  /// Adds an event which records that the world was put into another state.
  void restored();
  /// Restarts the log after the world was put into another state. These events (the oldest first) get new
  /// numbers and replace all earlier events, including those from frames.
  void restored_after(std::vector<Event> events);

  /// Creates events from at most `frames` frames that have arrived since the last call. Returns true if some
  /// frames remain. The functions below process all frames.
  bool collect(std::size_t frames);
  /// Returns at most `max` of the kept events, beginning with number `number`.
  std::vector<Event> since(std::uint64_t number, std::size_t max);
  /// Returns the number of the next event.
  std::uint64_t next_number();

 private:
  /// An event, with the number of the next frame at the time when it was recorded. Events and frames are
  /// listed in this order.
  struct Noted {
    std::uint64_t next_frame = 0;
    Event event{};
    std::vector<std::uint8_t> request{};  // a host's frame that wrote registers, which are further events
    std::size_t station = 0;              // the station on `line` that has executed the frame
    std::size_t line = 0;
    std::optional<std::uint16_t> masked{};  // the value that results from a mask
  };

  /// Records the requests that the stations of a line execute.
  class Served;
  void note(Noted noted);
  /// Notes the commands that a device has ignored since the last call.
  /// Those that `why` names are of the host on `line`, whose request was served last.
  void note_ignored(std::size_t device, std::string_view why, const std::string& line);
  void note_all_ignored();

  void on_input(std::size_t device, int terminal, std::int32_t level) override;
  void on_power(std::size_t device, bool on) override;
  void on_inject(const Fault& fault) override;
  void on_clear_fault(std::size_t number) override;
  void on_write(std::size_t device, const PreparedWrite& write) override;
  void on_assign(std::size_t device, std::string_view name, double value) override;
  void on_program(std::size_t device, std::string_view text, bool is_refused) override;
  void on_command(std::size_t device, std::string_view text) override;
  void on_fault(std::size_t number, bool in_force) override;

  void add(Event event);
  void take_frame(const FrameLog::Decoded& frame);
  void take_noted(Noted& noted);
  std::string fault_text_of(std::size_t number) const;

  World& world_;
  const FrameLog& frames_;
  std::vector<std::unique_ptr<Served>> served_;  // one per line
  std::vector<std::uint64_t> next_reasons_;      // by device: the next of its reasons to note
  std::string author_ = "control";
  std::deque<Noted> noted_;
  std::deque<Event> events_;
  std::uint64_t next_number_ = 1;
  std::uint64_t next_frame_ = 1;
};

/// The registers that a write changes, with their new values: "feeder.Cord_A" and "3200".
struct WrittenRegister {
  std::string name;
  std::string value;
};
std::vector<WrittenRegister> written_registers(const Device& device, Table table, std::uint16_t first,
                                               std::span<const std::uint16_t> words);

}  // namespace understudy::emulator::world
