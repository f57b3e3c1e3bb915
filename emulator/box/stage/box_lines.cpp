#include "emulator/box/stage/box_lines.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/box/asking/modbus_master.h"
#include "emulator/box/asking/text_asker.h"
#include "emulator/box/photograph/photo_parts.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/photograph/read_plan.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/model.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/protocol/received_lines.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace {

constexpr WallTime kReceiveSlice = std::chrono::milliseconds(50);
constexpr WallTime kAnswerPause = std::chrono::milliseconds(8);
constexpr int kLongestRtuFrame = 270;

}  // namespace

LineHost::LineHost(const PortName& port, const Model& model, int station, WallTime timeout)
    : port_(port), model_(model), station_(station), wire_(open_wire(port)), timeout_(timeout) {
  require_rtu(model, port);
  find_settings();
}

void LineHost::find_settings() {
  const std::vector<pty::LineSettings> tried = settings_to_try(model_, port_);
  bool is_noisy = false;
  int other_station = -1;
  for (const pty::LineSettings& line : tried) {
    wire_->set_line(line);
    settings_ = line;
    for (int i = 0; i < 2; ++i)
      if (answers(is_noisy, other_station)) return;
  }
  const std::string who = model_.rtu ? "station " + std::to_string(station_) : "the controller";
  if (other_station >= 0)
    throw BoxError(one_line(port_.place) + ": station " + std::to_string(other_station) +
                   " answered a request to " + who + "; expected a line with one controller of each number");
  throw BoxError(silence_text(port_, who, tried, is_noisy, false));
}

bool LineHost::is_answering() {
  bool is_noisy = false;
  int other_station = -1;
  settle();
  return answers(is_noisy, other_station) || answers(is_noisy, other_station);
}

bool LineHost::answers(bool& is_noisy, int& other_station) {
  if (!model_.rtu) {
    TextAsker asker(*wire_, timeout_ + settings_.duration_of(100));
    const TextReply reply = asker.ask("?VER", kAnswerPause);
    is_noisy = is_noisy || !reply.asked.reply.empty();
    return !reply.lines.empty() &&
           std::ranges::all_of(reply.lines.front(), [](char c) { return c >= ' ' && c <= '~'; });
  }
  const WallTime of_line = port_.has_settings() ? settings_.duration_of(kLongestRtuFrame) : WallTime{0};
  const ModbusExchange::Settings of_exchange{.station = station_,
                                             .timeout = timeout_ + of_line,
                                             .silence = play::silence_between_frames(settings_),
                                             .is_tcp = port_.is_modbus_tcp(),
                                             .heartbeat = [this] {
                                               if (heartbeat_) heartbeat_();
                                             }};
  exchange_.emplace(*wire_, of_exchange);
  const ReadBlock block = read_plan(model_).front();
  const ReadCell& first = block.cells.front();
  ModbusMaster master(*wire_, of_exchange);
  const ReadReply read = master.read(block.table, first.address, first.size);
  const auto kind = read.reply.kind;
  is_noisy = is_noisy || (kind == play::HostReply::Kind::garbled && read.other_station < 0);
  if (read.other_station >= 0) other_station = read.other_station;
  return kind == play::HostReply::Kind::good || kind == play::HostReply::Kind::exception;
}

void LineHost::wait(WallTime gap) {
  if (gap <= WallTime{0}) return;
  while (true) {
    const WallTime rest = quiet_since_ + gap - serve::wall_now();
    if (rest <= WallTime{0}) return;
    if (heartbeat_) heartbeat_();
    std::this_thread::sleep_for(std::min(rest, kReceiveSlice));
  }
}

Asked LineHost::ask(const Bytes& request, WallTime gap) {
  wait(gap);
  if (heartbeat_) heartbeat_();
  Asked asked = exchange_->ask(request);
  quiet_since_ = serve::wall_now();
  return asked;
}

void LineHost::receive_until(Bytes& bytes, WallTime until) {
  if (heartbeat_) heartbeat_();
  wire_->receive(bytes, std::min(until, serve::wall_now() + kReceiveSlice));
}

Bytes LineHost::exchange(const Bytes& bytes, std::size_t wanted, WallTime within, WallTime gap) {
  if (port_.is_modbus_tcp()) return ask(bytes, gap).reply;
  wait(gap);
  exchange_ ? exchange_->keep_silence() : settle();
  wire_->discard();
  const WallTime begin = serve::wall_now();
  wire_->send(bytes);
  if (exchange_) exchange_->note_traffic(true);  // also if the wait is given up
  const WallTime sending = settings_.duration_of(static_cast<std::int64_t>(bytes.size()));
  // An adapter may hold bytes back: that is no fault of the controller.
  const bool is_silence_wanted = wanted == SIZE_MAX;
  const WallTime deadline = begin + sending + within + (is_silence_wanted ? WallTime{0} : timeout_);
  Bytes reply;
  while (reply.size() < wanted && serve::wall_now() < deadline) receive_until(reply, deadline);
  // Bytes that follow at once belong to the reply, expected or not.
  const bool is_cut = !is_silence_wanted && !reply.empty() && !receive_rest(reply);
  quiet_since_ = serve::wall_now();
  is_unsettled_ = is_cut || is_silence_wanted != reply.empty();
  if (exchange_) exchange_->note_traffic(is_unsettled_);
  return reply;
}

/// Receives until an adapter would have passed on everything. Returns false if the line does not fall silent.
bool LineHost::receive_rest(Bytes& bytes) {
  const WallTime end = serve::wall_now() + kLongestUnrest;
  while (wire_->receive(bytes, serve::wall_now() + kAdapterDelay)) {
    if (heartbeat_) heartbeat_();
    if (serve::wall_now() >= end) return false;
  }
  return true;
}

/// Drops the rest of what was not expected.
void LineHost::settle() {
  Bytes dropped;
  if (std::exchange(is_unsettled_, false)) receive_rest(dropped);
}

void LineHost::send_text(const std::string& text, WallTime gap) {
  wait(gap);
  wire_->discard();
  unread_.clear();
  Bytes line(text.begin(), text.end());
  line.push_back('\r');
  wire_->send(line);
  // Returns when the controller has the line.
  std::this_thread::sleep_for(settings_.duration_of(static_cast<std::int64_t>(line.size())));
  quiet_since_ = serve::wall_now();
  is_unsettled_ = true;  // nobody waits for its answer
}

std::vector<std::string> LineHost::exchange_text(const std::optional<std::string>& text,
                                                 const world::LinesWanted& wanted, WallTime within,
                                                 WallTime gap) {
  if (text) {
    wait(gap);
    settle();
    send_text(*text, {});
  }
  const auto heard_now = [this] {
    return world::lines_in({reinterpret_cast<const char*>(unread_.data()), unread_.size()});
  };
  const WallTime deadline = serve::wall_now() + within + (wanted.lines.empty() ? WallTime{0} : timeout_);
  world::ReceivedLines received = heard_now();
  while (!world::has_come(wanted, received) && serve::wall_now() < deadline) {
    receive_until(unread_, deadline);
    received = heard_now();
  }
  // Bytes that follow an answer at once belong to it, expected or not, up to one more line.
  bool is_silent = false;
  while (text && !is_silent && received.finished <= wanted.lines.size() && serve::wall_now() < deadline) {
    is_silent = !wire_->receive(unread_, std::min(deadline, serve::wall_now() + kAdapterDelay));
    received = heard_now();
  }
  is_unsettled_ = text ? !is_silent : received.lines != wanted.lines;
  const std::size_t wanted_lines = wanted.lines.size();
  if (!text && wanted_lines > 0 && received.finished >= wanted_lines) {
    unread_.erase(unread_.begin(),
                  unread_.begin() + static_cast<std::ptrdiff_t>(received.ends[wanted_lines - 1]));
    received.lines.resize(wanted_lines);
  } else {
    unread_.clear();
  }
  if (!received.lines.empty()) quiet_since_ = serve::wall_now();
  return received.lines;
}

bool BoxLines::are_answering() {
  return std::ranges::all_of(hosts_, [](const auto& host) { return host.second->is_answering(); });
}

LineHost& BoxLines::host(const std::string& line, const Model& model, int station) {
  const std::string name = ports_.contains(line) ? line : kAnyLine;
  std::unique_ptr<LineHost>& host = hosts_[name];
  if (!host) host = std::make_unique<LineHost>(ports_.at(name), model, station, timeout_);
  return *host;
}

}  // namespace understudy::emulator::box
