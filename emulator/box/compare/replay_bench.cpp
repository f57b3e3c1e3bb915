#include "emulator/box/compare/replay_bench.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/compare/input_log.h"
#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/play/performing/state_text.h"
#include "emulator/world/bench/bench.h"
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
  constexpr std::size_t kMost = 2000;  // in one request
  return Addressed{.table = span->table,
                   .first = span->first,
                   .count = static_cast<int>(std::min(span->count, kMost)),
                   .is_write = asked.writes.has_value()};
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

const RegisterBank* ReplayBench::bank_of(std::span<const std::uint8_t> request) const {
  for (const auto& station : line().stations) {
    const ModbusStation* const modbus = station->device().modbus();
    if (modbus != nullptr && modbus->addressing(request[0]) != Addressing::ignore)
      return station->device().register_bank();
  }
  return nullptr;
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
                            SimTime tolerance) {
  advance_to(std::max(world_.now(), at - tolerance));
  const std::vector<std::uint16_t> before = registers_now(request);
  const std::optional<double> number_before = number_now(request);
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
