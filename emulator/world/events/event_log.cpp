#include "emulator/world/events/event_log.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/reasons.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/capture.h"
#include "pty/line_observer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kFramesAtOnce = 256;

std::string real_text(double value) { return number_text(finite_number(value)); }

}  // namespace

std::vector<WrittenRegister> written_registers(const Device& device, Table table, std::uint16_t first,
                                               std::span<const std::uint16_t> words) {
  std::vector<WrittenRegister> written;
  const RegisterBank* const bank = device.register_bank();
  if (bank == nullptr) return written;
  std::optional<Place> before;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Place place = bank->at(table, static_cast<std::uint16_t>(first + i));
    if (!place) continue;
    const std::string name = device.name() + "." + bank->map().unique_name(*place.row, place.index);
    const bool completes = before && before->is_same_register(place);
    before = place;
    if (completes) {
      const std::uint32_t bits = bits_of_wire(*place.row, words[i - 1], words[i], bank->low_word_first());
      written.back() = {name, value_text(value_of(bits, place.row->type), place.row->type)};
      continue;
    }
    const bool is_half = place.part != Place::Part::whole;
    const std::uint16_t word = wire_word(*place.row, words[i]);
    written.push_back({name, is_half ? std::to_string(word)
                                     : value_text(value_of(word, place.row->type), place.row->type)});
  }
  return written;
}

class EventLog::Served final : public pty::LineObserver {
 public:
  Served(EventLog& log, std::size_t line) : log_(log), line_(line) {}
  void on_start_bit(SimTime /*at*/) override {}
  void on_character(const pty::TimedByte& /*character*/, bool /*is_received*/) override {}
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& /*transmission*/) override {}
  void on_served(const pty::ServedRequest& served) override {
    note_write(served);
    if (served.why.empty()) return;
    const WorldLine& line = log_.world_.line(line_);
    const Device* const device = &line.stations[served.station]->device();
    for (std::size_t i = 0; i < log_.next_reasons_.size(); ++i)
      if (&log_.world_.device(i) == device) log_.note_ignored(i, served.why, line.line.name());
  }
  void note_write(const pty::ServedRequest& served) {
    constexpr std::uint8_t kRefused = 0x80;
    if (!is_write(served.request) || served.answer.empty() || (served.answer[0] & kRefused) != 0) return;
    Noted noted{
        .request = {served.request.begin(), served.request.end()}, .station = served.station, .line = line_};
    noted.event.time = served.time;
    const ModbusRequest request = parse_request_frame(served.request);
    const Device& device = log_.world_.line(line_).stations[served.station]->device();
    if (request.mask && device.register_bank() != nullptr) {
      const auto words = written_words(*device.register_bank(), request);
      if (!words.empty()) noted.masked = words.front();
    }
    log_.note(std::move(noted));
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime /*now*/) override {}
  std::size_t quiet_characters() const override { return SIZE_MAX; }

 private:
  EventLog& log_;
  std::size_t line_;
};

EventLog::EventLog(World& world, const FrameLog& frames) : world_(world), frames_(frames) {
  world_.add_listener(*this);
  for (std::size_t i = 0; i < world_.device_count(); ++i) {
    ModbusStation* const modbus = world_.device(i).modbus();
    next_reasons_.push_back(
        modbus == nullptr || modbus->reasons() == nullptr ? 0 : modbus->reasons()->next_number());
  }
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    served_.push_back(std::make_unique<Served>(*this, i));
    world_.add_observer(i, *served_.back());
  }
}

EventLog::~EventLog() {
  for (std::size_t i = 0; i < served_.size(); ++i) world_.remove_observer(i, *served_[i]);
  world_.remove_listener(*this);
}

void EventLog::note_ignored(std::size_t number, std::string_view why, const std::string& line) {
  Device& device = world_.device(number);
  const Reasons* const reasons = device.modbus() == nullptr ? nullptr : device.modbus()->reasons();
  if (reasons == nullptr || reasons->next_number() == next_reasons_[number]) return;
  for (Reasons::Said& said : reasons->since(std::exchange(next_reasons_[number], reasons->next_number()))) {
    const bool is_of_host = why.find(said.text) != std::string_view::npos;
    Noted noted{.event = {.what = "ignored",
                          .by = is_of_host ? "host" : "",
                          .line = is_of_host ? line : std::string(),
                          .device = device.name(),
                          .text = std::move(said.text)}};
    noted.event.time = time_of(said.tick);
    note(std::move(noted));
  }
}

/// Those of programs are noted late: when somebody reads the events.
void EventLog::note_all_ignored() {
  for (std::size_t i = 0; i < next_reasons_.size(); ++i) note_ignored(i, {}, {});
}

void EventLog::note(Noted noted) {
  noted.next_frame = frames_.next_number();
  if (noted_.size() == kKept) noted_.pop_front();
  noted_.push_back(std::move(noted));
}

void EventLog::note(Event event) {
  event.time = world_.now();
  note(Noted{.event = std::move(event)});
}

void EventLog::note(std::string_view what, std::string text) {
  note({.what = what, .by = author_, .text = std::move(text)});
}

void EventLog::restored() { note("restored", {}); }

void EventLog::restored_after(std::vector<Event> events) {
  noted_.clear();
  events_.clear();
  next_frame_ = frames_.next_number();
  for (Event& event : events) add(std::move(event));
}

void EventLog::on_input(std::size_t device, int terminal, std::int32_t level) {
  const Device& of = world_.device(device);
  const TerminalRow& row = of.model().terminals[static_cast<std::size_t>(terminal)];
  note({.what = "input",
        .by = author_,
        .device = of.name(),
        .name = of.name() + "." + std::string(row.name),
        .value = std::to_string(level)});
}

void EventLog::on_power(std::size_t device, bool on) {
  note({.what = "power", .by = author_, .device = world_.device(device).name(), .value = on ? "1" : "0"});
}

void EventLog::on_inject(const Fault& fault) {
  note({.what = "inject",
        .by = author_,
        .device = world_.device(fault.device).name(),
        .text = to_text(world_.known(), fault)});
}

void EventLog::on_clear_fault(std::size_t number) {
  note({.what = "clear", .by = author_, .value = std::to_string(number), .text = fault_text_of(number)});
}

void EventLog::on_fault(std::size_t number, bool in_force) {
  const auto found = world_.faults().find(number);
  const std::string device =
      found == world_.faults().end() ? std::string() : world_.device(found->second.fault.device).name();
  note({.what = "fault",
        .by = {},
        .device = device,
        .value = std::to_string(number),
        .text = fault_text_of(number) + (in_force ? ": begins" : ": ends")});
}

void EventLog::on_write(std::size_t device, const PreparedWrite& write) {
  const Device& of = world_.device(device);
  const auto words = std::span(write.words).first(write.count);
  for (WrittenRegister& one : written_registers(of, write.table, write.first, words)) {
    note({.what = "write",
          .by = author_,
          .device = of.name(),
          .name = std::move(one.name),
          .value = std::move(one.value)});
  }
}

void EventLog::on_assign(std::size_t device, std::string_view name, double value) {
  const std::string& of = world_.device(device).name();
  note({.what = "write",
        .by = author_,
        .device = of,
        .name = of + "." + std::string(name),
        .value = real_text(value)});
}

void EventLog::on_program(std::size_t device, std::string_view text, bool is_refused) {
  note({.what = "program",
        .by = author_,
        .device = world_.device(device).name(),
        .text = std::to_string(std::count(text.begin(), text.end(), '\n')) + " lines" +
                (is_refused ? ", refused" : "")});
}

void EventLog::on_command(std::size_t device, std::string_view text) {
  note({.what = "command", .by = author_, .device = world_.device(device).name(), .text = std::string(text)});
}

std::string EventLog::fault_text_of(std::size_t number) const {
  const auto found = world_.faults().find(number);
  return "fault " + std::to_string(number) +
         (found == world_.faults().end() ? "" : " " + to_text(world_.known(), found->second.fault));
}

void EventLog::add(Event event) {
  event.number = next_number_++;
  if (events_.size() == kKept) events_.pop_front();
  events_.push_back(std::move(event));
}

/// Adds a recorded event, or the writes in a host's request.
void EventLog::take_noted(Noted& noted) {
  if (noted.request.empty()) return add(std::move(noted.event));
  const WorldLine& line = world_.line(noted.line);
  const Device& device = line.stations[noted.station]->device();
  ModbusRequest request = parse_request_frame(noted.request);
  if (noted.masked) request.words = {*noted.masked};
  if (!request.writes) return;
  for (WrittenRegister& one :
       written_registers(device, request.writes->table, request.writes->first, request.words)) {
    add({.time = noted.event.time,
         .what = "write",
         .by = "host",
         .line = line.line.name(),
         .device = device.name(),
         .name = std::move(one.name),
         .value = std::move(one.value)});
  }
}

void EventLog::take_frame(const FrameLog::Decoded& frame) {
  const bool is_request = frame.direction == pty::Direction::from_host;
  if (!frame.remark.empty()) {
    add({.time = frame.time, .what = "dropped", .by = {}, .line = frame.line, .text = frame.remark});
    if (is_request) return;
  }
  if (is_request || !frame.is_refusal) return;
  const auto request = frames_.request_of(frame.number);
  add({.time = frame.time,
       .what = "exception",
       .by = "host",
       .line = frame.line,
       .text = (request ? request->text + ": " : "") + frame.text});
}

/// Adds the events from frames and the other events in the order in which they happened.
bool EventLog::collect(std::size_t frames) {
  note_all_ignored();
  const std::uint64_t end = frames_.next_number();
  const auto add_noted_before = [&](std::uint64_t frame) {
    for (; !noted_.empty() && noted_.front().next_frame <= frame; noted_.pop_front())
      take_noted(noted_.front());
  };
  std::size_t taken = 0;
  while (next_frame_ < end && taken < frames) {
    const auto some = frames_.since(next_frame_, std::min(frames - taken, kFramesAtOnce));
    if (some.empty()) {
      next_frame_ = end;
      break;
    }
    for (const FrameLog::Decoded& frame : some) {
      add_noted_before(frame.number);
      take_frame(frame);
      next_frame_ = frame.number + 1;
    }
    taken += some.size();
  }
  add_noted_before(next_frame_);
  return next_frame_ < end;
}

std::vector<Event> EventLog::since(std::uint64_t number, std::size_t max) {
  collect(SIZE_MAX);
  std::vector<Event> some;
  const std::uint64_t first = next_number_ - events_.size();
  for (std::uint64_t next = std::max(number, first); next < next_number_ && some.size() < max; ++next) {
    some.push_back(events_[next - first]);
  }
  return some;
}

std::uint64_t EventLog::next_number() {
  collect(SIZE_MAX);
  return next_number_;
}

}  // namespace understudy::emulator::world
