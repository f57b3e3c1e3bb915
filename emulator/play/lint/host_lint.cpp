#include "emulator/play/lint/host_lint.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/lint/finding.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::emulator::play {

namespace {

constexpr std::size_t kMaxWaiting = 4 * pty::kRtuMaxFrame;
constexpr int kFastestByCharacters = 19200;

/// Returns t1.5, the maximum silence within a frame (MODBUS over Serial Line V1.02, 2.5.1.1).
SimTime one_and_a_half_characters(const pty::LineSettings& settings) {
  if (settings.baud > kFastestByCharacters) return std::chrono::microseconds(750);
  return settings.duration_of(3) / 2;
}

}  // namespace

HostLint::HostLint(world::World& world, std::size_t line)
    : world_(world),
      number_(line),
      options_(world.line(line).line.options()),
      // The framer is never strict, even if the devices are: it must receive frames that a strict framer
      // would drop, in order to explain why.
      framer_({.strict = false,
               .silence = SimTime{0},
               .patience = world.line(line).framing.patience,
               .rest_patience = world.line(line).framing.rest_patience}) {
  const world::WorldLine& watched = world_.line(line);
  if (!watched.protocol.is_framed_by_silence()) return;
  const auto is_modbus = [](const auto& station) { return station->device().modbus() != nullptr; };
  if (std::none_of(watched.stations.begin(), watched.stations.end(), is_modbus)) return;
  if (has_time()) {
    longest_gap_ = one_and_a_half_characters(options_.settings);
    for (const auto& station : watched.stations) {
      const Device& device = station->device();
      if (device.modbus() == nullptr) continue;
      const SimTime end_silence = device.modbus()->end_silence(device.model().rtu->end_silence);
      silence_ = std::max(silence_, end_silence);
      longest_gap_ = std::min(longest_gap_, end_silence);
    }
  }
  world_.add_observer(number_, *this);
}

HostLint::~HostLint() { world_.remove_observer(number_, *this); }

void HostLint::restart() {
  framer_.reset();
  waiting_.clear();
  under_way_.reset();
  busy_until_.reset();
  asked_.reset();
  last_number_ = 0;
}

void HostLint::on_character(const pty::TimedByte& character, bool is_received) {
  const bool follows = last_number_ == 0 || character.number == last_number_ + 1;
  if (!follows || !is_received) restart();  // bytes that no device receives are a different problem
  last_number_ = character.number;
  under_way_.reset();
  if (!is_received) return;
  const SimTime idle = busy_until_ ? character.start - *busy_until_ : kForever;
  waiting_.push_back({character.number, character.start, idle});
  if (waiting_.size() > kMaxWaiting) waiting_.erase(waiting_.begin(), waiting_.end() - pty::kRtuMaxFrame);
  busy_until_ = std::max(character.end, busy_until_.value_or(character.end));
  framer_.push(character);
}

void HostLint::on_transmission(const pty::Transmission& transmission) {
  const auto next = waiting_.empty() ? under_way_ : std::optional(waiting_.front().start);
  if (asked_ && next && *next < transmission.start) find(LintRule::not_waited).add(*next, asked_->command);
  const bool is_answer = asked_ && transmission.bytes.size() > 1 &&
                         transmission.bytes[0] == asked_->station &&
                         transmission.last_character == asked_->last_character;
  if (is_answer && transmission.bytes[1] == asked_->function) carried_out(*asked_);
  asked_.reset();
  SimTime end = transmission.start;
  if (has_time()) end += options_.settings.duration_of(static_cast<std::int64_t>(transmission.bytes.size()));
  busy_until_ = std::max(end, busy_until_.value_or(end));
}

void HostLint::run(SimTime now) {
  while (const auto frame = framer_.take_due(now)) {
    const auto last = std::find_if(waiting_.begin(), waiting_.end(), [&](const Character& character) {
      return character.number == frame->last_character;
    });
    if (last == waiting_.end()) continue;
    const auto end = static_cast<std::size_t>(last - waiting_.begin()) + 1;
    if (end < frame->size) continue;
    const auto characters = std::span(waiting_).subspan(end - frame->size, frame->size);
    const SimTime begin = characters.front().start;
    const Character last_character = characters.back();
    const auto bytes = std::span(frame->bytes).first(frame->size);
    const std::string command = world_.line(number_).command_text(bytes);
    judge_times(characters, command);
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(end));
    judge_request(bytes, last_character, begin, command);
  }
}

void HostLint::judge_times(std::span<const Character> frame, const std::string& command) {
  if (!has_time()) return;
  const Character& first = frame.front();
  if (first.idle < silence_) {
    Finding& finding = find(LintRule::too_soon);
    finding.extreme = finding.count == 0 ? first.idle : std::min(finding.extreme, first.idle);
    finding.add(first.start, command);
  }
  SimTime longest{0};
  for (const Character& character : frame.subspan(1)) longest = std::max(longest, character.idle);
  if (longest <= longest_gap_) return;
  Finding& finding = find(LintRule::gap);
  finding.extreme = std::max(finding.extreme, longest);
  finding.add(first.start, command);
}

void HostLint::judge_request(std::span<const std::uint8_t> frame, const Character& last, SimTime at,
                             const std::string& command) {
  const std::uint8_t station = frame[0];
  asked_ = Asked{.station = station,
                 .function = frame[1],
                 .at = at,
                 .last_character = last.number,
                 .command = command,
                 .worn = {}};
  const world::ModbusRequest request = world::parse_request_frame(frame);
  bool is_present = false;
  bool will_be_answered = false;
  for (const auto& present : world_.line(number_).stations) {
    const Device& device = present->device();
    const Addressing addressing =
        device.modbus() == nullptr ? Addressing::ignore : device.modbus()->addressing(station);
    if (addressing == Addressing::ignore) continue;
    is_present = true;
    will_be_answered = will_be_answered || addressing == Addressing::execute_and_reply;
    if (request.writes && device.powered()) judge_write(device, request, at);
  }
  if (!is_present) find(LintRule::absent, std::to_string(station)).add(at);
  if (will_be_answered) return;
  if (is_present) carried_out(*asked_);
  asked_.reset();
}

void HostLint::judge_write(const Device& device, const world::ModbusRequest& request, SimTime at) {
  const RegisterBank& bank = *device.register_bank();
  const std::vector<std::uint16_t> values = written_words(bank, request);
  const RegisterRow* last_row = nullptr;
  int last_index = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto address = static_cast<std::uint16_t>(request.writes->first + i);
    const Place place = bank.at(request.writes->table, address);
    if (!place) continue;
    const std::string name = device.name() + "." + bank.map().unique_name(*place.row, place.index);
    // A register with two words counts once.
    const bool is_second_word = place.row == last_row && place.index == last_index;
    last_row = place.row;
    last_index = place.index;
    if (place.row->access == Access::read) {
      if (!is_second_word) find(LintRule::read_only, name).add(at);
      continue;
    }
    if (!bank.keeps(*place.row) || place.slot == Place::kNoSlot) continue;
    const std::uint32_t bits = bank.image()[static_cast<std::size_t>(place.slot)];
    const auto present = static_cast<std::uint16_t>(place.part == Place::Part::high ? bits >> 16 : bits);
    const bool is_listed = !asked_->worn.empty() && asked_->worn.back() == name;
    if (present != values[i] && !is_listed) asked_->worn.push_back(name);
  }
}

void HostLint::carried_out(const Asked& asked) {
  for (const std::string& name : asked.worn) find(LintRule::eeprom_wear, name).add(asked.at);
}

}  // namespace understudy::emulator::play
