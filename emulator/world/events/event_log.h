// What happens on a bench, for onlookers: writes to registers and who made them, inputs, power, programs,
// faults, refused requests, dropped frames. Numbered from 1 on; the last ones are kept.
//
// What comes from outside is noted as it comes. What goes over the lines is remembered by the frame log
// anyway: it is made into events when somebody asks, so that nothing is paid for them while nobody does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
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
  /// write, input, power, program, inject, clear, fault, exception, dropped, restored, paused, resumed, speed
  std::string_view what;
  std::string by;      // host, control, page; empty where nobody did it
  std::string line{};  // on which a host did it
  std::string device{};
  std::string name{};   // of the register or terminal, as the control socket takes it
  std::string value{};  // as a number
  std::string text{};   // more, for people
};

class EventLog final : private OutsideListener {
 public:
  static constexpr std::size_t kKept = 4'096;

  /// Both must outlive it.
  EventLog(World& world, const FrameLog& frames);
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Whoever acts from outside from now on: "control", "page".
  void set_author(std::string_view author) { author_ = author; }
  const std::string& author() const { return author_; }
  /// Something that the world does not know about.
  void note(std::string_view what, std::string text);
  /// The world has another state.
  void restored();
  /// The same, and these happened before, the oldest first: they get new numbers, and are all that is told of
  /// what was until now, frames included.
  void restored_after(std::vector<Event> events);

  /// Makes events of what has come since, of so many frames at most; whether some are left. The others below
  /// do so with all.
  bool collect(std::size_t frames);
  /// At most `most` of those kept, from that number on.
  std::vector<Event> since(std::uint64_t number, std::size_t most);
  /// Of the event that comes next.
  std::uint64_t next_number();

 private:
  /// Noted, with the number that the next frame had then: they are told in that order.
  struct Noted {
    std::uint64_t next_frame = 0;
    Event event;
  };

  void on_input(std::size_t device, int terminal, std::int32_t level) override;
  void on_power(std::size_t device, bool on) override;
  void on_inject(const Fault& fault) override;
  void on_clear_fault(std::size_t number) override;
  void on_write(std::size_t device, const PreparedWrite& write) override;
  void on_assign(std::size_t device, std::string_view name, double value) override;
  void on_program(std::size_t device, std::string_view text, bool is_refused) override;
  void on_command(std::size_t device, std::string_view text) override;
  void on_fault(std::size_t number, bool in_force) override;

  void note(Event event);
  void add(Event event);
  void take_frame(const FrameLog::Told& frame);
  void add_writes(const FrameLog::Told& request, SimTime at);
  std::string fault_text_of(std::size_t number) const;

  World& world_;
  const FrameLog& frames_;
  std::string author_ = "control";
  std::deque<Noted> noted_;
  std::deque<Event> events_;
  std::uint64_t next_number_ = 1;
  std::uint64_t next_frame_ = 1;
};

/// The registers that words bring, with what they make of them: "feeder.Cord_A" and "3200".
struct WrittenRegister {
  std::string name;
  std::string value;
};
std::vector<WrittenRegister> written_registers(const Device& device, Table table, std::uint16_t first,
                                               std::span<const std::uint16_t> words);

}  // namespace understudy::emulator::world
