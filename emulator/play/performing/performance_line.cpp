// Performs steps that use the line: write, expect, send.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/command_window.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

Value require_fitting(const Target& target, world::Number number) {
  if (const auto value = value_for(target, number)) return *value;
  const bool is_real = target.place && target.place->is_real();
  throw StepError(target.name + ": " + world::number_text(number) +
                  (is_real ? " is too large for a 32-bit real" : " is not a whole number; expected one"));
}

std::string bytes_text(std::span<const std::uint8_t> bytes) {
  return bytes.empty() ? "nothing" : world::hex_text(bytes);
}

std::string to_text(const HostReply& reply) {
  switch (reply.kind) {
    case HostReply::Kind::good: return "done";
    case HostReply::Kind::exception: return "exception " + world::exception_text(reply.exception);
    case HostReply::Kind::silence: return "no reply";
    case HostReply::Kind::garbled: return "an unexpected reply: " + bytes_text(reply.bytes);
  }
  return {};
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string names_of(const std::vector<Target>& targets, const Request& request) {
  std::vector<std::string> names;
  for (const std::size_t entry : request.entries) names.push_back(targets[entry].name);
  return joined(names);
}

}  // namespace

void Performance::require(const HostReply& reply, const Answer& answer, const std::string& what) {
  const auto& exception = answer.exception;
  const bool is_good = exception ? reply.kind == HostReply::Kind::exception && reply.exception == *exception
                       : answer.silence ? reply.kind == HostReply::Kind::silence
                                        : reply.kind == HostReply::Kind::good;
  if (is_good) return;
  const std::string expected = exception        ? "exception " + world::exception_text(*exception)
                               : answer.silence ? "no reply"
                                                : "success";
  throw StepError(what + ": " + to_text(reply) + "; expected " + expected, what + ": " + expected,
                  what + ": " + to_text(reply));
}

/// Requires silence. The host waits until `within` is over, whatever it receives.
void Performance::require_silence(const Place& place, const std::vector<std::uint8_t>& request,
                                  SimTime within, const std::string& what) {
  moment_in(within);  // throws if that is beyond the end of simulated time
  const auto reply = executor_->exchange(place.line, request, SIZE_MAX, within);
  require(judge_reply(request, reply), {.silence = within}, what);
}

Performance::Place Performance::spoken_to(std::size_t device, const Via& via) {
  Place place{.line = via.value_or(lines_[device].front())};
  if (lines_[device].size() > 1) place.on_line = " on line " + bench_.lines[place.line].name;
  executor_->with_world(
      [&](world::World& world) { place.station = world.device(device).station_number().value_or(0); });
  return place;
}

std::vector<Words> Performance::words_of_all(const std::vector<Target>& targets,
                                             std::vector<bool>& low_word_first) {
  std::vector<Words> words;
  executor_->with_world([&](world::World& world) {
    for (const Target& target : targets) {
      low_word_first.push_back(world.device(target.device).register_bank()->low_word_first());
      words.push_back(words_of(target, low_word_first.back()));
    }
  });
  return words;
}

std::vector<std::vector<std::uint16_t>> Performance::read_over_line(const std::vector<Target>& targets,
                                                                    const Answer& answer, const Via& via) {
  std::vector<bool> low_word_first;
  const std::vector<Words> words = words_of_all(targets, low_word_first);
  std::vector<std::vector<std::uint16_t>> read(targets.size());
  for (const Request& request : read_requests(words)) {
    const Place place = spoken_to(request.words.device, via);
    const std::string what = "read " + names_of(targets, request) + place.on_line;
    if (answer.silence) {
      require_silence(
          place, read_request(place.station, request.words.table, request.words.first, request.words.count),
          *answer.silence, what);
      continue;
    }
    const HostReply reply = executor_->read(place.line, place.station, request.words.table,
                                            request.words.first, request.words.count);
    require(reply, answer, what);
    if (answer.exception) continue;
    for (const std::size_t entry : request.entries) {
      const auto first = reply.words.begin() + (words[entry].first - request.words.first);
      read[entry].assign(first, first + words[entry].count);
    }
  }
  return read;
}

void Performance::perform(const WriteStep& step) {
  std::vector<Target> targets;
  std::vector<Value> values;
  for (const WriteStep::Entry& entry : step.entries) targets.push_back(entry.target);
  for (const WriteStep::Entry& entry : step.entries)
    values.push_back(require_fitting(entry.target, present_value(entry.value)));
  std::vector<bool> low_word_first;
  const std::vector<Words> words = words_of_all(targets, low_word_first);
  for (const Request& request : write_requests(words, [&](std::size_t i) { return is_bit(targets[i]); })) {
    const Place place = spoken_to(request.words.device, step.via);
    const std::string what = "write " + names_of(targets, request) + place.on_line;
    std::vector<std::uint16_t> brought;
    for (const std::size_t entry : request.entries) {
      std::vector<std::uint16_t> present;
      if (is_bit(targets[entry])) {
        const HostReply reply = executor_->read(place.line, place.station, request.words.table,
                                                request.words.first, request.words.count);
        require(reply, {}, "read " + targets[entry].name + place.on_line + " to write it");
        present = reply.words;
      }
      // An earlier request in this step may have changed the word order.
      bool is_low_first = low_word_first[entry];
      executor_->with_world([&](world::World& world) {
        is_low_first = world.device(targets[entry].device).register_bank()->low_word_first();
      });
      const auto part = words_with(targets[entry], values[entry], is_low_first, present);
      brought.insert(brought.end(), part.begin(), part.end());
    }
    if (step.answer.silence) {
      require_silence(place, write_request(place.station, request.words.table, request.words.first, brought),
                      *step.answer.silence, what);
    } else {
      require(executor_->write(place.line, place.station, request.words.table, request.words.first, brought),
              step.answer, what);
    }
  }
}

void Performance::perform(const CommandStep& step) {
  for (const CommandStep::Entry& entry : step.entries) {
    const Place place = spoken_to(entry.device, step.via);
    WindowMessage message;
    std::string what;
    executor_->with_world([&](world::World& world) {
      const Device& device = world.device(entry.device);
      message = window_message(device, entry.text);  // uses the present word order
      what = "command " + device.name() + ": " + entry.text + place.on_line;
    });
    if (step.answer.silence) {
      require_silence(place, message_request(place.station, message.first, message.words),
                      *step.answer.silence, what);
    } else {
      require(executor_->write_message(place.line, place.station, message.first, message.words), step.answer,
              what);
    }
  }
}

void Performance::perform(const ExpectStep& step) {
  std::vector<Target> targets;
  for (const ExpectStep::Entry& entry : step.entries) {
    if (!entry.target.is_value) targets.push_back(entry.target);
  }
  std::vector<bool> low_word_first;
  words_of_all(targets, low_word_first);
  const auto words = read_over_line(targets, step.answer, step.via);
  if (!step.answer.is_good()) return;
  std::vector<std::string> expected;
  std::vector<std::string> came;
  std::vector<std::string> details;
  std::size_t next = 0;  // index of the next value that was read
  for (const ExpectStep::Entry& entry : step.entries) {
    const Target& target = entry.target;
    std::string reported;
    bool holds = false;
    const auto look = [&](world::Number value) {
      reported = world::number_text(value);
      holds = entry.value.holds(value);
    };
    if (target.is_value) {
      look(present_value(target.name));
    } else {
      reported = "not a number";
      if (const auto number = number_of(target, value_in(target, words[next], low_word_first[next])))
        look(*number);
      ++next;
    }
    if (holds) continue;
    expected.push_back(target.name + " = " + entry.value.text);
    came.push_back(target.name + " = " + reported);
    details.push_back(target.name + " is " + reported + "; expected " + entry.value.text);
  }
  if (details.empty()) return;
  throw StepError(details.front(), joined(expected), joined(came), {details.begin() + 1, details.end()});
}

void Performance::perform(const SendStep& step) {
  const bool wants_bytes = step.reply && !step.reply->empty();
  moment_in(step.within);  // throws if that is beyond the end of simulated time
  const std::size_t wanted = wants_bytes ? step.reply->size() : SIZE_MAX;
  const std::vector<std::uint8_t> reply = executor_->exchange(step.line, step.bytes, wanted, step.within);
  if (!step.reply || reply == *step.reply) return;
  std::vector<std::string> details;
  executor_->with_world([&](world::World& world) {
    details.push_back("that is: " + world.line(step.line).reply_text(step.bytes, reply));
  });
  if (reply.empty()) details.clear();
  throw StepError("the reply is " + bytes_text(reply) + "; expected " + bytes_text(*step.reply),
                  bytes_text(*step.reply), bytes_text(reply), std::move(details));
}

}  // namespace understudy::emulator::play
