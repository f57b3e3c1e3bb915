// Lists the events of a bench for observers: writes to registers and their authors, inputs, power, programs,
// faults, refused requests, dropped frames. Events are numbered from 1, and only the most recent ones are
// kept.
//
// Outside events are noted when they happen, and so are requests of hosts that write, when a device executes
// them: only the device knows that it has, and which number it had then. Other events on the lines are made
// from the frame log on demand, so they cost nothing while nobody reads them.
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
  /// one of write, input, power, program, command, inject, clear, fault, exception, dropped, restored, speed,
  /// stop, logpoint
  std::string_view what;
  std::string by;      // host, control or page; empty if none of them caused it
  std::string line{};  // the line of the host that caused it
  std::string device{};
  std::string name{};   // the register or terminal, in the form that the control socket accepts
  std::string value{};  // a number as text
  std::string text{};   // further details, for people
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
  /// Like the above, with all its fields. The time is set to now.
  void note(Event event);
  /// Adds an event that records that the world has been put into another state.
  void restored();
  /// Restarts the log after the world has been put into another state: these events, the oldest first, get
  /// new numbers and replace all earlier ones, including those from frames.
  void restored_after(std::vector<Event> events);

  /// Makes events of the frames since the last call, at most `frames` of them. Returns true if some are
  /// left. The functions below process all of them.
  bool collect(std::size_t frames);
  /// Returns at most `max` of the kept events, from that number on.
  std::vector<Event> since(std::uint64_t number, std::size_t max);
  /// Returns the number of the next event.
  std::uint64_t next_number();

 private:
  /// An event, with the number that the next frame had when it was noted. Events and frames are listed in
  /// that order.
  struct Noted {
    std::uint64_t next_frame = 0;
    Event event{};
    std::vector<std::uint8_t> request{};  // the frame of a host that has written registers: further events
    std::size_t station = 0;              // the station on `line` that has executed it
    std::size_t line = 0;
    std::optional<std::uint16_t> masked{};  // the value that a mask has made
  };

  /// Notes the requests that the stations of a line execute.
  class Served;
  void note(Noted noted);

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
