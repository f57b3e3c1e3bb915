// What the end of a scenario sends to a real controller: the model's own stop, and what registers held
// before.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/box/stage/box_executor.h"
#include "emulator/box/stage/permission.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/command_window.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/names/level.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::box {

// --- what it was before --------------------------------------------------------------------------

/// Reads the registers that a request is about to write. Triggers and views hold nothing of their own.
void BoxExecutor::keep_before(std::size_t line, const Bytes& request) {
  struct Whole {
    std::uint16_t first;
    int count;
    bool operator==(const Whole&) const = default;
  };
  const std::optional<Written> written = written_by(request);
  if (!written) return;
  std::vector<Whole> registers;
  with_world([&](world::World& world) {
    for (const world::StationSetup& station : scenario_.bench.lines[line].stations) {
      const Device& device = world.device(station.device);
      if (device.station_number() != request[0] || device.register_bank() == nullptr) continue;
      const RegisterMap& map = *device.model().registers;
      for (std::size_t i = 0; i < written->words.size(); ++i) {
        const Place place = map.at(written->table, static_cast<std::uint16_t>(written->first + i),
                                   device.firmware(), device.register_bank()->low_word_first());
        if (!place || place.row->access != Access::read_write || place.row->is_view) continue;
        if (!place.row->acts_on_zero || place.row->message != nullptr) continue;
        const Whole whole{.first = place.address(), .count = is_32_bit(place.row->type) ? 2 : 1};
        if (registers.empty() || registers.back() != whole) registers.push_back(whole);
      }
    }
  });
  for (const Whole& whole : registers) {
    const bool is_known = std::ranges::any_of(before_, [&](const Before& known) {
      return known.line == line && known.station == request[0] && known.table == written->table &&
             known.first == whole.first;
    });
    if (is_known) continue;
    const play::HostReply reply = play::judge_reply(
        play::read_request(request[0], written->table, whole.first, whole.count),
        host(line).ask(play::read_request(request[0], written->table, whole.first, whole.count), {}).reply);
    if (reply.kind != play::HostReply::Kind::good) continue;
    before_.push_back({.line = line,
                       .station = request[0],
                       .table = written->table,
                       .first = whole.first,
                       .words = reply.words});
  }
}

/// Notes how to undo what a rig is about to do. Hand wheels and programs stay as they are.
void BoxExecutor::keep_before(const std::vector<std::string>& words) {
  const auto note = [&](const std::vector<std::string>& undo) {
    if (std::ranges::find(undoing_, undo) == undoing_.end()) undoing_.push_back(undo);
  };
  if (words[0] == "power" && words[2] == "off") note({"power", words[1], "on"});
  if (words[0] == "inject") note({"clear", words.back().substr(words.back().find('=') + 1)});
  if (words[0] != "input") return;
  with_world([&](world::World& world) {
    const world::InputName input = world::find_input(world.known(), words[1]);
    const TerminalRow& row = input.row(world.known());
    // Nothing is connected to the inputs of a bare controller, and its switches are off.
    note({"input", words[1], world::level_text(row, 0)});
    // Switches are often read at power-up alone.
    if (row.kind == TerminalRow::Kind::dip_switch)
      note({"power", scenario_.bench.devices[input.device].settings.name, "cycle"});
  });
}

void BoxExecutor::put_back() {
  is_stopping_ = true;
  put_back_surroundings();
  put_back_registers();
  is_stopping_ = false;
}

void BoxExecutor::put_back_surroundings() {
  // Switches come before the power, so the last word is that of a power cycle.
  std::stable_partition(undoing_.begin(), undoing_.end(),
                        [](const auto& words) { return words[0] != "power"; });
  for (const std::vector<std::string>& words : std::exchange(undoing_, {})) {
    std::string why;
    try {
      why = act(words).value_or("");
    } catch (const std::exception& error) {
      why = error.what();
    }
    if (!why.empty() && settings_.say) settings_.say("not put back: " + one_line(why));
  }
  undoing_.clear();
}

/// In the opposite order. What was allowed to be written is allowed to be put back.
void BoxExecutor::put_back_registers() {
  for (auto one = before_.rbegin(); one != before_.rend(); ++one) {
    try {
      host(one->line).ask(play::write_request(one->station, one->table, one->first, one->words), WallTime{0});
    } catch (const std::exception& error) {
      if (settings_.say) settings_.say("not put back: " + one_line(error.what()));
      break;
    }
  }
  before_.clear();
}

// --- the stop ------------------------------------------------------------------------------------

void BoxExecutor::stop() {
  if (may_move_.empty()) return;
  const std::set<std::size_t> devices = std::exchange(may_move_, {});
  if (is_rehearsal()) return;
  is_stopping_ = true;
  for (const std::size_t device : devices) {
    try {
      stop_device(device);
    } catch (const std::exception& error) {
      if (settings_.say)
        settings_.say("stop: " + scenario_.bench.devices[device].settings.name +
                      ": COULD NOT BE SENT: " + one_line(error.what()));
    }
  }
  is_stopping_ = false;
}

void BoxExecutor::stop_device(std::size_t number) {
  const world::Bench& bench = scenario_.bench;
  const Model& model = *bench.devices[number].model;
  const std::optional<std::size_t> line = line_of(number);
  if (!line) return;
  const auto say = [&](const std::string& what) {
    if (settings_.say) settings_.say("stop: " + bench.devices[number].settings.name + ": " + what);
  };
  if (model.stop.empty())
    say("NOT SENT: " + std::string(model.name) + " has no stop over the line; stop the machine by hand");
  for (const StopStep& step : model.stop) {
    if (model.rtu) {
      const std::string what = send_stop(number, *line, step);
      say(what);
      // The steps between a command and its repetition are only for a controller that refuses it at first.
      if (what == std::string(model.stop.back().text) + ": done") break;
      continue;
    }
    const std::string text(step.text);
    // While a program is being entered, the stop would become a line of it.
    if (editing_.erase(*line) != 0) host(*line).send_text("EXIT", WallTime{0});
    host(*line).send_text(text, WallTime{0});
    say(text + ": sent");
  }
}

/// Returns "ALL_STOP = 1: done". Of a register with other bits, only the bits of the stop change: a bit that
/// is on already is switched off first, because a controller may see no more than its change.
std::string BoxExecutor::send_stop(std::size_t number, std::size_t line, const StopStep& step) {
  std::string what(step.text);
  int station = 1;
  bool is_low_first = false;
  std::optional<play::Target> target;
  Bytes request;
  with_world([&](world::World& world) {
    const Device& device = world.device(number);
    station = device.station_number().value_or(1);
    is_low_first = device.register_bank()->low_word_first();
    if (auto place = find_register(device.model(), step.text, device.firmware())) {
      target = play::Target{.device = number, .name = what, .place = std::move(place)};
    } else {
      const WindowMessage message = window_message(device, step.text);
      request = play::message_request(station, message.first, message.words);
    }
  });
  const auto ask = [&](const Bytes& asked) {
    return play::judge_reply(asked, host(line).ask(asked, WallTime{0}).reply);
  };
  std::vector<Bytes> requests{request};
  if (target) {
    what += " = " + std::to_string(step.value);
    const play::Words words = play::words_of(*target, is_low_first);
    const auto write = [&](Value value, const std::vector<std::uint16_t>& present) {
      return play::write_request(station, words.table, words.first,
                                 play::words_with(*target, value, is_low_first, present));
    };
    std::vector<std::uint16_t> present(static_cast<std::size_t>(words.count));
    requests.clear();
    if (play::is_bit(*target)) {
      const play::HostReply reply = ask(play::read_request(station, words.table, words.first, words.count));
      if (reply.kind == play::HostReply::Kind::good) present = reply.words;
      const bool is_on = play::value_in(*target, present, is_low_first) == step.value;
      if (is_on && step.value != 0) requests.push_back(write(0, present));
    }
    requests.push_back(write(step.value, present));
  }
  play::HostReply reply;
  for (const Bytes& one : requests) reply = ask(one);
  using play::HostReply;
  return what + (reply.kind == HostReply::Kind::good        ? ": done"
                 : reply.kind == HostReply::Kind::exception ? ": REFUSED"
                                                            : ": NOT ANSWERED");
}

}  // namespace understudy::emulator::box
