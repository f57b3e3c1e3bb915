#include "emulator/box/compare/replay_bench.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/compare/input_log.h"
#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/performing/state_text.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

std::optional<Addressed> addressed_by(std::span<const std::uint8_t> request) {
  if (request.size() < 8 || !pty::rtu_crc_ok(request)) return {};
  const world::ModbusRequest asked = world::parse_request_frame(request);
  const auto& span = asked.writes ? asked.writes : asked.reads;
  if (!span) return {};
  constexpr std::size_t kMax = 2000;  // in one request
  return Addressed{.table = span->table,
                   .first = span->first,
                   .count = static_cast<int>(std::min(span->count, kMax)),
                   .is_write = asked.writes.has_value()};
}

std::vector<std::uint16_t> words_in(const Addressed& asked, std::span<const std::uint8_t> request,
                                    std::span<const std::uint8_t> reply) {
  const auto count = static_cast<std::size_t>(asked.count);
  const bool has_bits = is_table_of_bits(asked.table);
  const std::size_t size = has_bits ? (count + 7) / 8 : 2 * count;
  const bool is_good = reply.size() == size + 5 && reply[0] == request[0] && reply[1] == request[1] &&
                       reply[2] == size && pty::rtu_crc_ok(reply);
  std::vector<std::uint16_t> words;
  for (std::size_t i = 0; is_good && i < count; ++i) {
    words.push_back(static_cast<std::uint16_t>(has_bits ? reply[3 + i / 8] >> i % 8 & 1
                                                        : reply[3 + 2 * i] << 8 | reply[4 + 2 * i]));
  }
  return words;
}

/// Collects what stations send.
class ReplayBench::ReplyRecorder final : public pty::LineObserver {
 public:
  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& transmission) override {
    if (!reply.at) reply.at = transmission.start;
    reply.bytes.insert(reply.bytes.end(), transmission.bytes.begin(), transmission.bytes.end());
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

  BenchReply reply;
};

namespace {

/// Replies are judged by their bytes and times, so the host's settings do not matter.
constexpr world::WorldOptions kOptions{.strict_framing = false, .enforce_settings = false};

}  // namespace

ReplayBench::ReplayBench(const world::Bench& bench, std::size_t line)
    : world_(bench, kOptions, {}), line_(line), recorder_(std::make_unique<ReplyRecorder>()) {
  world_.add_observer(line_, *recorder_);
}

ReplayBench::~ReplayBench() { world_.remove_observer(line_, *recorder_); }

std::optional<std::size_t> ReplayBench::device_of(std::span<const std::uint8_t> request) const {
  for (const auto& station : line().stations) {
    const ModbusStation* const modbus = station->device().modbus();
    if (modbus == nullptr || modbus->addressing(request[0]) == Addressing::ignore) continue;
    for (std::size_t number = 0; number < world_.device_count(); ++number)
      if (&world_.device(number) == &station->device()) return number;
  }
  return std::nullopt;
}

const RegisterBank* ReplayBench::bank_of(std::span<const std::uint8_t> request) const {
  const auto device = device_of(request);
  return device ? world_.device(*device).register_bank() : nullptr;
}

/// A capture does not show the inputs, but registers do that are called like them. What the controller shows
/// is set on the bench, unless a machine or a wire decides it there.
std::vector<std::size_t> ReplayBench::take_inputs(std::span<const std::uint8_t> request,
                                                  std::span<const std::uint16_t> shown,
                                                  std::span<const std::uint16_t> bench) {
  std::vector<std::size_t> taken;
  const auto asked = addressed_by(request);
  const auto number = device_of(request);
  if (!asked || !number || shown.size() != bench.size()) return taken;
  const Device& device = world_.device(*number);
  const auto terminals = device.model().terminals;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] == bench[i]) continue;
    const RegisterBank& bank = *device.register_bank();
    const Place place = bank.at(asked->table, static_cast<std::uint16_t>(asked->first + i));
    if (!place || place.row->access != Access::read || is_32_bit(place.row->type)) continue;
    const auto terminal =
        std::ranges::find(terminals, bank.map().unique_name(*place.row, place.index), &TerminalRow::name);
    if (terminal == terminals.end() || terminal->kind != TerminalRow::Kind::digital_in) continue;
    if (!takes_input(*number, static_cast<int>(terminal - terminals.begin()), shown[i], bench[i])) continue;
    taken.push_back(i);
    taken_inputs_.insert(device.name() + "." + std::string(terminal->name));
  }
  return taken;
}

bool ReplayBench::is_driven(std::size_t device, int terminal) const {
  const auto leads_here = [&](const world::WireSetup& wire) {
    return wire.to_axis < 0 && wire.to_device == device && wire.to_terminal == terminal;
  };
  if (std::ranges::any_of(world_.wires(), leads_here)) return true;
  const auto axes = world_.device(device).model().axes;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const world::PlantAxis& machine = world_.plant(device, static_cast<int>(axis));
    for (std::size_t contact = 0; contact < world::kContactNames.size(); ++contact)
      if (world::input_of(axes[axis], machine, static_cast<world::Contact>(contact)) == terminal) return true;
  }
  return false;
}

/// The bench may show a level later than it has it, because of a filter. If it has it, all is well.
bool ReplayBench::takes_input(std::size_t device, int terminal, std::int32_t shown, std::int32_t bench) {
  const auto level = [&] { return world_.device(device).input(terminal); };
  if ((shown != 0 && shown != 1) || is_driven(device, terminal)) return false;
  if (level() == shown) return true;
  if (level() != bench) return false;  // the register shows something else
  const std::int32_t before = world_.external_input(device, terminal);
  world_.set_external_input(device, terminal, shown);
  if (level() == shown) return true;
  world_.set_external_input(device, terminal, before);  // a fault holds it
  return false;
}

std::vector<std::string> ReplayBench::state_text(std::span<const std::uint8_t> request) const {
  std::vector<std::string> texts;
  for (std::size_t number = 0; number < world_.device_count(); ++number) {
    const Device& device = world_.device(number);
    const bool is_asked = std::ranges::any_of(line().stations, [&](const auto& station) {
      const ModbusStation* const modbus = station->device().modbus();
      return &station->device() == &device &&
             (modbus == nullptr || modbus->addressing(request[0]) != Addressing::ignore);
    });
    if (!is_asked) continue;
    for (std::string& text : play::device_state_text(world_, number)) texts.push_back(std::move(text));
  }
  return texts;
}

std::vector<std::uint16_t> ReplayBench::registers_now(std::span<const std::uint8_t> request) const {
  const auto addressed = addressed_by(request);
  const RegisterBank* const bank = addressed && !addressed->is_write ? bank_of(request) : nullptr;
  if (bank == nullptr) return {};
  std::vector<std::uint16_t> words(static_cast<std::size_t>(addressed->count));
  if (read_request(*bank, addressed->table, addressed->first, words)) return {};
  return words;
}

std::optional<double> ReplayBench::number_now(std::span<const std::uint8_t> request) const {
  std::string query(request.begin(), request.end());
  if (!query.starts_with('?') || line().stations.empty()) return {};
  query.erase(query.find_last_not_of("\r\n ") + 1);
  const NamedValues* const values = line().stations.front()->device().named_values();
  return values != nullptr ? values->value_named(query.substr(1)) : std::nullopt;
}

void ReplayBench::advance_to(SimTime time) {
  for (; next_input_ < inputs_.size() && inputs_[next_input_].at <= time; ++next_input_) {
    const InputChange& change = inputs_[next_input_];
    world_.advance_to(std::max(world_.now(), change.at));
    world_.set_external_input(change.device, change.terminal, change.level);
  }
  world_.advance_to(time);
}

BenchReply ReplayBench::ask(std::span<const std::uint8_t> request, SimTime at, SimTime until,
                            SimTime tolerance, std::span<const std::uint16_t> shown) {
  advance_to(std::max(world_.now(), at - tolerance));
  const std::vector<std::uint16_t> before = registers_now(request);
  const std::optional<double> number_before = number_now(request);
  std::vector<std::size_t> taken;
  if (!std::ranges::equal(shown, before)) taken = take_inputs(request, shown, before);
  advance_to(at);
  world_.take_output(line_, line().line.output().size());
  recorder_->reply = {};
  std::span<const std::uint8_t> rest = request;
  while (!rest.empty()) {
    const std::size_t part = std::min(rest.size(), line().line.room());
    world_.receive(line_, rest.first(part));
    rest = rest.subspan(part);
    if (!rest.empty()) advance_to(world_.next_due().value_or(until));
  }
  while (!recorder_->reply.at && world_.now() < until)
    advance_to(std::min(world_.next_due().value_or(until), until));
  if (recorder_->reply.at) advance_to(std::min(*recorder_->reply.at + tolerance, until));
  BenchReply reply = std::exchange(recorder_->reply, {});
  reply.taken = std::move(taken);
  reply.before = before;
  reply.after = registers_now(request);
  reply.number_before = number_before;
  reply.number_after = number_now(request);
  // Text may come in several pieces.
  if (!addressed_by(request) && reply.at) {
    recorder_->reply = std::move(reply);
    advance_to(until);
    reply = std::exchange(recorder_->reply, {});
  }
  return reply;
}

}  // namespace understudy::emulator::box
