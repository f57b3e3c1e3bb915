#include "emulator/box/stage/box_executor.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/stage/permission.h"
#include "emulator/box/stage/rig.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/world.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kFramesKept = 20;
constexpr WallTime kSleepSlice = std::chrono::milliseconds(50);
constexpr SimTime kShadowTime = std::chrono::milliseconds(500);
constexpr std::size_t kWriteReplySize = 8;
constexpr const char* kFollows = "  NOT SENT: follows what is not done";

std::string deed_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Returns true for what a rig counts from a beginning of its own, not from the scenario's.
bool counts_from_beginning(std::string_view name) {
  constexpr std::array<std::string_view, 12> kCounts{
      "pulses",   "target",  "position",   "lost",     "encoder",   "greatest_speed",
      "requests", "replies", "exceptions", "bytes_in", "bytes_out", "greatest_acceleration"};
  return std::ranges::find(kCounts, name.substr(name.rfind('.') + 1)) != kCounts.end();
}

bool is_write_frame(const Bytes& frame) { return frame.size() > 1 && world::is_write(frame); }

}  // namespace

BoxExecutor::BoxExecutor(const play::Scenario& scenario, BoxLines& lines, const StageSettings& settings)
    : scenario_(scenario),
      settings_(settings),
      shadow_(scenario.bench, {.gap = scenario.gap}),
      begin_(serve::wall_now()) {
  for (const world::LineSetup& line : scenario.bench.lines) {
    is_real_.push_back(lines.has(line.name) && !line.stations.empty());
    hosts_.push_back(nullptr);
    if (!is_real_.back() || is_rehearsal()) continue;
    const world::DeviceSetup& first = scenario.bench.devices[line.stations.front().device];
    int station = 1;
    shadow_.with_world([&](world::World& world) {
      station = world.device(line.stations.front().device).station_number().value_or(1);
    });
    hosts_.back() = &lines.host(line.name, *first.model, station);
    hosts_.back()->set_heartbeat([this] { throw_if_interrupted(); });
  }
  for (std::size_t device = 0; device < scenario.bench.devices.size(); ++device) ask_word_order(device);
  begin_ = serve::wall_now();
}

BoxExecutor::~BoxExecutor() {
  stop();
  put_back();
  for (LineHost* const host : hosts_)
    if (host != nullptr) host->set_heartbeat({});
}

void BoxExecutor::throw_if_interrupted() const {
  if (!is_stopping_ && settings_.is_interrupted && settings_.is_interrupted()) throw play::ExecutionAborted();
}

std::optional<std::size_t> BoxExecutor::line_of(std::size_t device) const {
  for (std::size_t i = 0; i < hosts_.size(); ++i) {
    const auto& stations = scenario_.bench.lines[i].stations;
    const bool is_on = std::ranges::any_of(stations, [&](const auto& one) { return one.device == device; });
    if (is_on && hosts_[i] != nullptr) return i;
  }
  return std::nullopt;
}

/// The order of words may be a setting of the controller. The shadow encodes and decodes, so it gets the
/// same.
void BoxExecutor::ask_word_order(std::size_t number) {
  const Model& model = *scenario_.bench.devices[number].model;
  const std::optional<std::size_t> line = line_of(number);
  if (!line || model.registers == nullptr || model.registers->policy().word_order_in.empty()) return;
  int station = 1;
  std::optional<NamedPlace> place;
  with_world([&](world::World& world) {
    const Device& device = world.device(number);
    station = device.station_number().value_or(1);
    place = find_register(model, model.registers->policy().word_order_in, device.firmware());
  });
  if (!place) return;
  const Table table = place->place.row->table;
  const std::uint16_t address = place->place.address();
  const Bytes request = play::read_request(station, table, address, 1);
  const play::HostReply reply = play::judge_reply(request, host(*line).ask(request, WallTime{0}).reply);
  if (reply.kind == play::HostReply::Kind::good) shadow_.write(*line, station, table, address, reply.words);
}

// --- time ----------------------------------------------------------------------------------------

SimTime BoxExecutor::now() {
  if (is_rehearsal()) {
    SimTime present{0};
    shadow_.with_world([&](world::World& world) { present = world.now(); });
    return present;
  }
  return SimTime{serve::wall_now() - begin_};
}

void BoxExecutor::advance(SimTime by) {
  if (is_rehearsal()) return shadow_.advance(by);
  const WallTime end = serve::wall_now() + by;
  while (true) {
    throw_if_interrupted();
    const WallTime rest = end - serve::wall_now();
    if (rest <= WallTime{0}) return;
    std::this_thread::sleep_for(std::min(rest, kSleepSlice));
  }
}

bool BoxExecutor::run_until(const play::Awaited&, SimTime deadline) {
  if (deadline > now()) advance(deadline - now());
  return false;
}

// --- requests ------------------------------------------------------------------------------------

std::optional<std::string> BoxExecutor::why_unreachable(std::size_t line) const {
  if (is_real_[line]) return std::nullopt;
  return "line " + scenario_.bench.lines[line].name + " has no port; expected --on " +
         scenario_.bench.lines[line].name + "=PORT";
}

void BoxExecutor::note(std::size_t line, const char* arrow, const std::string& text) {
  frames_.push_back(format_duration(now()) + " " + scenario_.bench.lines[line].name + " " + arrow + " " +
                    text);
  if (frames_.size() > kFramesKept) frames_.pop_front();
}

void BoxExecutor::note_edit(std::size_t line, const std::string& text) {
  const Model& model = *scenario_.bench.devices[scenario_.bench.lines[line].stations.front().device].model;
  if (model.edit_mark_of_line == nullptr) return;
  const EditMark mark = model.edit_mark_of_line(text);
  const auto open = editing_.find(line);
  if (open == editing_.end()) {
    if (mark == EditMark::begins || mark == EditMark::begins_one_line) editing_.emplace(line, mark);
  } else if (mark == EditMark::ends || open->second == EditMark::begins_one_line) {
    editing_.erase(open);
  }
}

std::optional<std::string> BoxExecutor::why_no_query(std::size_t line) const {
  if (!editing_.contains(line)) return std::nullopt;
  return "a program is being entered on line " + scenario_.bench.lines[line].name +
         ", and a query would become a part of it";
}

void BoxExecutor::plan(const SentRequest& request, std::size_t line, const std::string& remark) {
  if (!settings_.only_plans || !settings_.say) return;
  const bool only_reads = request.hazards == Hazards::reads;
  if (!only_reads) planned_.clear();
  if (only_reads && !planned_.insert(request.what).second) return;
  settings_.say("  " + scenario_.bench.lines[line].name + ": " + request.what +
                (only_reads ? "" : "  [" + to_text(request.hazards) + "]") + remark);
}

/// Lists a request. A run ends its scenario at the first one that is not sent; a plan goes on.
void BoxExecutor::plan(const SentRequest& request, std::size_t line) {
  std::string remark;
  try {
    require_allowed(request, settings_.allowed, settings_.envelope);
  } catch (const play::NotAllowed&) {
    remark = "  NOT SENT: needs " + flag_for(beyond(request.hazards, settings_.allowed));
  } catch (const play::BeyondEnvelope&) {
    remark = "  NOT SENT: beyond the envelope";
  }
  const bool was_cut = std::exchange(is_plan_cut_, is_plan_cut_ || !remark.empty());
  if (was_cut && remark.empty()) remark = kFollows;
  plan(request, line, remark);
}

Hazards BoxExecutor::require(std::size_t line, const SentRequest& request) {
  throw_if_interrupted();
  if (settings_.only_plans) {
    plan(request, line);
    return request.hazards;
  }
  require_allowed(request, settings_.allowed, settings_.envelope);
  const bool may_move = has(request.hazards, Hazards::motion) || has(request.hazards, Hazards::output);
  if (may_move && request.device) may_move_.insert(*request.device);
  if (may_move && !request.device)
    for (const world::StationSetup& station : scenario_.bench.lines[line].stations)
      may_move_.insert(station.device);
  return request.hazards;
}

void BoxExecutor::note_written(std::size_t line, SimTime begin, std::size_t bytes, Hazards hazards) {
  if (hazards == Hazards::reads) return;
  const SimTime sending =
      hosts_[line] == nullptr
          ? SimTime{0}
          : SimTime{hosts_[line]->settings().duration_of(static_cast<std::int64_t>(bytes))};
  last_write_ = {.earliest = is_rehearsal() ? begin : std::min(begin + sending, now()), .latest = now()};
}

play::HostReply BoxExecutor::ask(std::size_t line, const Bytes& request) {
  SentRequest sent;
  with_world([&](world::World& world) { sent = judge_frame(world, line, request); });
  const Hazards hazards = require(line, sent);
  note(line, "->", sent.what);
  if (settings_.is_bare && !is_rehearsal() && hazards != Hazards::reads) keep_before(line, request);
  const SimTime begin = now();
  Bytes reply;
  if (is_rehearsal()) {
    reply = shadow_.exchange(line, request, play::wanted_size(request, {}), kShadowTime);
  } else {
    reply = host(line).ask(request, scenario_.gap).reply;
  }
  note_written(line, begin, request.size(), hazards);
  play::HostReply judged = play::judge_reply(request, reply);
  std::string printed = "nothing";
  with_world([&](world::World& world) {
    if (!reply.empty()) printed = world.line(line).reply_text(request, reply);
  });
  note(line, "<-", printed);
  // Station numbers and the order of words follow what was written.
  if (!is_rehearsal() && is_write_frame(request) && judged.kind == play::HostReply::Kind::good)
    shadow_.exchange(line, request, kWriteReplySize, kShadowTime);
  return judged;
}

play::HostReply BoxExecutor::read(std::size_t line, int station, Table table, std::uint16_t first,
                                  int count) {
  return ask(line, play::read_request(station, table, first, count));
}
play::HostReply BoxExecutor::write(std::size_t line, int station, Table table, std::uint16_t first,
                                   std::span<const std::uint16_t> words) {
  return ask(line, play::write_request(station, table, first, words));
}
play::HostReply BoxExecutor::write_message(std::size_t line, int station, std::uint16_t first,
                                           std::span<const std::uint16_t> words) {
  return ask(line, play::message_request(station, first, words));
}

std::vector<std::uint8_t> BoxExecutor::exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                                std::size_t wanted, SimTime within) {
  SentRequest sent;
  with_world([&](world::World& world) { sent = judge_frame(world, line, bytes); });
  const Hazards hazards = require(line, sent);
  note(line, "->", sent.what);
  const SimTime begin = now();
  const Bytes request(bytes.begin(), bytes.end());
  std::vector<std::uint8_t> reply;
  if (is_rehearsal()) {
    reply = shadow_.exchange(line, bytes, wanted, within);
  } else {
    reply = host(line).exchange(request, wanted, within, scenario_.gap);
  }
  note_written(line, begin, request.size(), hazards);
  note(line, "<-", reply.empty() ? "nothing" : world::hex_text(reply));
  return reply;
}

void BoxExecutor::send_text(std::size_t line, const std::string& text) {
  SentRequest sent;
  with_world([&](world::World& world) { sent = judge_text(world, line, text); });
  const Hazards hazards = require(line, sent);
  note(line, "->", "\"" + text + "\"");
  note_edit(line, text);
  const SimTime begin = now();
  is_rehearsal() ? shadow_.send_text(line, text) : host(line).send_text(text, scenario_.gap);
  note_written(line, begin, text.size() + 1, hazards);
}

std::vector<std::string> BoxExecutor::exchange_text(std::size_t line, const std::optional<std::string>& text,
                                                    const world::LinesWanted& wanted, SimTime within) {
  Hazards hazards = Hazards::reads;
  if (text) {
    SentRequest sent;
    with_world([&](world::World& world) { sent = judge_text(world, line, *text); });
    hazards = require(line, sent);
    note(line, "->", "\"" + *text + "\"");
    note_edit(line, *text);
  }
  const SimTime begin = now();
  std::vector<std::string> received = is_rehearsal()
                                          ? shadow_.exchange_text(line, text, wanted, within)
                                          : host(line).exchange_text(text, wanted, within, scenario_.gap);
  if (text) note_written(line, begin, text->size() + 1, hazards);
  note(line, "<-", world::lines_text(received));
  return received;
}

// --- the surroundings ----------------------------------------------------------------------------

/// A last word "optional" marks what need not be done: only a rig is asked for it.
std::optional<std::string> BoxExecutor::act(const std::vector<std::string>& all) {
  std::vector<std::string> words = all;
  for (std::string& word : words) word = named_for_rig(word);
  const bool is_optional = words.back() == "optional";
  if (is_optional) words.pop_back();
  throw_if_interrupted();
  if (is_rehearsal()) {
    if (settings_.only_plans) {
      plan_deed(words, is_optional);
      return std::nullopt;
    }
    if (!settings_.rig.empty() || settings_.asks) return std::nullopt;
  }
  if (settings_.is_bare && !settings_.rig.empty()) keep_before(all);
  if (!settings_.rig.empty()) {
    const CommandAnswer answer = run_command(settings_.rig, words, [this] { throw_if_interrupted(); });
    if (answer.exit_code == 0) return done(words);
    if (answer.exit_code != kRigCannot && settings_.on_rig_failure) settings_.on_rig_failure();
    if (answer.exit_code != kRigCannot)
      throw play::RigFailed("the rig failed at `" + deed_text(words) + "` with exit code " +
                            std::to_string(answer.exit_code) + "; expected 0, or 3 for what it cannot do");
    if (is_optional || !settings_.asks) return "the rig cannot do it: " + deed_text(words);
  }
  if (is_optional) return "it is optional";
  if (settings_.asks) {
    if (ask_person(words, [this] { throw_if_interrupted(); })) {
      if (settings_.is_bare) keep_before(all);
      return done(words);
    }
    return "nobody did it: " + deed_text(words);
  }
  return "`" + deed_text(words) + "` needs a rig or a person; expected --rig COMMAND or --ask";
}

void BoxExecutor::plan_deed(const std::vector<std::string>& words, bool is_optional) {
  const bool has_rig = !settings_.rig.empty();
  const bool has_anyone = has_rig || settings_.asks;
  if (is_optional && !has_rig) return;
  const std::string remark = !has_anyone    ? "  NOT DONE: needs --rig COMMAND or --ask"
                             : is_plan_cut_ ? "  NOT DONE: follows what is not done"
                                            : "";
  if (!has_anyone) is_plan_cut_ = true;
  planned_.clear();
  if (settings_.say) settings_.say(std::string(has_rig ? "  rig: " : "  you: ") + deed_text(words) + remark);
}

/// A controller that was off may have another order of words.
std::optional<std::string> BoxExecutor::done(const std::vector<std::string>& words) {
  const bool was_switched = words.size() > 2 && words[0] == "power" && words[2] != "off";
  for (std::size_t i = 0; was_switched && i < scenario_.bench.devices.size(); ++i)
    if (named_for_rig(scenario_.bench.devices[i].settings.name) == words[1]) ask_word_order(i);
  return std::nullopt;
}

std::optional<std::string> BoxExecutor::tell(const std::string& name) {
  if (settings_.rig.empty() || settings_.only_plans) return std::nullopt;
  if (settings_.is_bare && counts_from_beginning(name)) return std::nullopt;
  if (is_rehearsal()) return value_in_rehearsal(name);
  const CommandAnswer answer =
      run_command(settings_.rig, {"value", named_for_rig(name)}, [this] { throw_if_interrupted(); });
  if (answer.exit_code != 0) return std::nullopt;
  return answer.output;
}

std::string BoxExecutor::value_in_rehearsal(const std::string& name) {
  std::string text;
  with_world([&](world::World& world) {
    const world::Probes probes(world);
    text = world::number_text(probes.value(probes.resolve(name).handle));
  });
  return text;
}

/// A rig knows the one controller by one name, whatever the proofs call it.
std::string BoxExecutor::named_for_rig(const std::string& word) const {
  const std::string& name = scenario_.bench.devices.front().settings.name;
  if (settings_.rig_name.empty()) return word;
  if (word == name) return settings_.rig_name;
  return word.starts_with(name + ".") ? settings_.rig_name + word.substr(name.size()) : word;
}

}  // namespace understudy::emulator::box
