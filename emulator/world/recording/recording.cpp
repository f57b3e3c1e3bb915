#include "emulator/world/recording/recording.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/names/names.h"
#include "emulator/world/strict_json.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

using Json = nlohmann::ordered_json;
using What = RecordedEvent::What;

constexpr const char* kRecordingKind = "recording";
constexpr int kRecordingFormat = 1;

constexpr std::array<std::pair<What, std::string_view>, 18> kEventWords{{
    {What::opened, "open"},
    {What::closed, "close"},
    {What::settings, "settings"},
    {What::bytes, "in"},
    {What::departed, "left"},
    {What::purged, "purge"},
    {What::nothing_more, "pause"},
    {What::sent, "out"},
    {What::input, "input"},
    {What::power, "power"},
    {What::inject, "inject"},
    {What::clear, "clear"},
    {What::write, "write"},
    {What::assign, "assign"},
    {What::program, "program"},
    {What::command, "command"},
    {What::wait, "wait"},
    {What::end, "end"},
}};

constexpr std::string_view word_of(What what) {
  for (const auto& [known, word] : kEventWords) {
    if (known == what) return word;
  }
  return {};
}

// In the order of pty::Parity.
constexpr std::array<std::string_view, 5> kParities{"none", "odd", "even", "mark", "space"};

bool is_of_a_line(What what) { return what <= What::sent; }
bool is_of_a_device(What what) {
  return what == What::input || what == What::power || what == What::write || what == What::assign ||
         what == What::program || what == What::command;
}

std::string hex_of(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

// --- reading -----------------------------------------------------------------------------------

Json parse_line(std::string_view line) {
  try {
    Json parsed = parse_strict_json<Json>(line, [](const std::string& key) {
      return RecordingError(understudy::quoted(key) + ": appears twice; expected it only once");
    });
    if (!parsed.is_object()) throw RecordingError("line: is not an object; expected an object");
    return parsed;
  } catch (const Json::exception&) {
    throw RecordingError("line: is damaged or not JSON; expected one object");
  }
}

const Json& require(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw RecordingError(std::string(key) + ": is missing; expected a value");
  return *found;
}

std::string text_at(const Json& object, const char* key) {
  const Json& value = require(object, key);
  if (!value.is_string()) throw RecordingError(std::string(key) + ": is not text; expected text");
  return value.get<std::string>();
}

std::int64_t number_at(const Json& object, const char* key, std::int64_t lowest, std::int64_t highest) {
  const Json& value = require(object, key);
  const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
  if (!value.is_number_integer() || huge || value.get<std::int64_t>() < lowest ||
      value.get<std::int64_t>() > highest) {
    throw RecordingError(std::string(key) + ": is not a valid number; expected " + std::to_string(lowest) +
                         " to " + std::to_string(highest));
  }
  return value.get<std::int64_t>();
}

bool truth_at(const Json& object, const char* key) {
  const Json& value = require(object, key);
  if (!value.is_boolean())
    throw RecordingError(std::string(key) + ": is neither true nor false; expected true or false");
  return value.get<bool>();
}

/// Parses the settings of a host's port. Parity and data bits may be unknown.
pty::HostSettings host_at(const Json& object) {
  pty::HostSettings host{.baud = static_cast<int>(number_at(object, "baud", 0, INT32_MAX)),
                         .stop_bits = static_cast<int>(number_at(object, "stop_bits", 1, 2))};
  if (object.contains("data_bits")) host.data_bits = static_cast<int>(number_at(object, "data_bits", 5, 8));
  if (object.contains("parity")) {
    const std::string written = text_at(object, "parity");
    const auto* const found = std::ranges::find(kParities, written);
    if (found == kParities.end())
      throw RecordingError("parity: " + understudy::quoted(written) +
                           " is not a parity; expected none, odd, even, mark or space");
    host.parity = static_cast<pty::Parity>(found - kParities.begin());
  }
  return host;
}

std::vector<std::uint8_t> bytes_at(const Json& object, const char* key) {
  const std::string text = text_at(object, key);
  const auto digit = [&](char c) -> std::uint8_t {
    if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
    throw RecordingError(std::string(key) + ": is not a sequence of bytes; expected two digits per byte");
  };
  if (text.size() % 2 != 0)
    throw RecordingError(std::string(key) + ": ends in half a byte; expected two digits");
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(digit(text[i]) << 4 | digit(text[i + 1])));
  }
  return bytes;
}

/// Parses a failure. Recordings from earlier versions contain only the text.
RecordedFailure failure_at(const Json& object, SimTime end) {
  const auto text = [&](const char* key) {
    return object.contains(key) ? text_at(object, key) : std::string();
  };
  RecordedFailure failed{.what = text_at(object, "failed"),
                         .at = end,
                         .scenario = text("scenario"),
                         .place = text("place"),
                         .step = text("step")};
  if (object.contains("failed_ns")) failed.at = SimTime{number_at(object, "failed_ns", 0, end.count())};
  return failed;
}

Fault fault_at(const Json& object, const KnownDevices& devices) {
  const Json& fault = require(object, "fault");
  if (!fault.is_object() || fault.empty())
    throw RecordingError("fault: is not an object; expected an object");
  FaultText text{};
  for (const auto& [name, value] : fault.items()) {
    if (!value.is_string()) throw RecordingError("fault: has a value that is not text; expected text");
    if (&value != &fault.front()) {
      text.fields.emplace_back(name, value.get<std::string>());
      continue;
    }
    text.kind = name;
    text.place = value.get<std::string>();
  }
  try {
    return find_fault(devices, text);
  } catch (const NameError& error) {
    throw RecordingError(std::string("fault: ") + error.what());
  }
}

PreparedWrite write_at(const Json& object) {
  PreparedWrite write;
  write.table = static_cast<Table>(number_at(object, "table", 0, 3));
  write.first = static_cast<std::uint16_t>(number_at(object, "first", 0, 65535));
  const std::vector<std::uint8_t> bytes = bytes_at(object, "words");
  if (bytes.size() != 2 && bytes.size() != 4) throw RecordingError("words: expected one or two words");
  write.count = bytes.size() / 2;
  for (std::size_t i = 0; i < write.count; ++i) {
    write.words[i] = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  }
  return write;
}

}  // namespace

std::string to_line(const RecordingHeader& header) {
  Json line{{"understudy", kRecordingFormat},
            {"kind", kRecordingKind},
            {"version", header.version},
            {"strict_framing", header.options.strict_framing},
            {"enforce_settings", header.options.enforce_settings},
            {"patience_ns", header.options.patience.count()},
            {"seed", header.seed},
            {"bench", header.bench}};
  if (!header.snapshot.empty()) line["snapshot"] = header.snapshot;
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

RecordingHeader parse_header(std::string_view text) {
  const Json line = parse_line(text);
  if (!line.contains("understudy") || !line.contains("kind") || line["kind"] != kRecordingKind) {
    throw RecordingError("kind: is missing or different; expected a recording");
  }
  number_at(line, "understudy", kRecordingFormat, kRecordingFormat);
  RecordingHeader header;
  header.version = text_at(line, "version");
  header.options.strict_framing = truth_at(line, "strict_framing");
  header.options.enforce_settings = truth_at(line, "enforce_settings");
  header.options.patience = SimTime{number_at(line, "patience_ns", 0, kHorizon.count())};
  header.seed = static_cast<std::uint64_t>(number_at(line, "seed", 0, INT64_MAX));
  header.bench = text_at(line, "bench");
  if (line.contains("snapshot")) header.snapshot = text_at(line, "snapshot");
  return header;
}

namespace {

/// Builds the line for an event by hand, because the objects of a JSON library would take most of the
/// recording time. The library is still used to escape texts.
class EventLine {
 public:
  EventLine(SimTime at, What what) {
    text_.reserve(128);
    text_ += R"({"t":)" + std::to_string(at.count()) + R"(,"do":")";
    text_ += word_of(what);
    text_ += '"';
  }
  void number(std::string_view key, std::int64_t value) { raw(key, std::to_string(value)); }
  void truth(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }
  void word(std::string_view key, std::string_view value) { raw(key, '"' + std::string(value) + '"'); }
  void hexadecimal(std::string_view key, const std::vector<std::uint8_t>& bytes) {
    raw(key, '"' + hex_of(bytes) + '"');
  }
  void json(std::string_view key, const Json& value) {
    raw(key, value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  std::string finished() && { return std::move(text_) + '}'; }

 private:
  void raw(std::string_view key, std::string_view value) {
    text_ += ",\"";
    text_ += key;
    text_ += "\":";
    text_ += value;
  }
  std::string text_;
};

std::vector<std::uint8_t> bytes_of_words(const PreparedWrite& write) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < write.count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(write.words[i] >> 8));
    bytes.push_back(static_cast<std::uint8_t>(write.words[i]));
  }
  return bytes;
}

void add_failure(EventLine& line, const RecordedFailure& failed) {
  line.json("failed", Json(failed.what));
  line.number("failed_ns", failed.at.count());
  line.json("scenario", Json(failed.scenario));
  line.json("place", Json(failed.place));
  line.json("step", Json(failed.step));
}

}  // namespace

std::string to_line(const RecordedEvent& event, const KnownDevices& devices) {
  EventLine line(event.at, event.what);
  const auto where = static_cast<std::int64_t>(event.where);
  if (is_of_a_line(event.what)) line.number("line", where);
  if (is_of_a_device(event.what)) line.number("device", where);
  switch (event.what) {
    case What::bytes:
    case What::departed:
    case What::sent: line.hexadecimal("bytes", event.bytes); break;
    case What::settings:
      if (event.host) {
        line.number("baud", event.host->baud);
        line.number("stop_bits", event.host->stop_bits);
        if (event.host->data_bits) line.number("data_bits", *event.host->data_bits);
        if (event.host->parity) line.word("parity", kParities[static_cast<std::size_t>(*event.host->parity)]);
      }
      break;
    case What::input:
      line.number("terminal", event.place);
      line.number("level", event.value);
      break;
    case What::power: line.truth("on", event.value != 0); break;
    case What::inject: {
      const FaultText text = fault_text(devices, event.fault);
      Json fault{{text.kind, text.place}};
      for (const auto& [name, value] : text.fields) fault[name] = value;
      line.json("fault", fault);
      break;
    }
    case What::clear: line.number("number", event.value); break;
    case What::write:
      line.number("table", static_cast<int>(event.write.table));
      line.number("first", event.write.first);
      line.hexadecimal("words", bytes_of_words(event.write));
      break;
    case What::assign:
      line.json("name", Json(event.text));
      line.json("value", Json(event.real));
      break;
    case What::program:
      line.json("text", Json(event.text));
      if (event.value != 0) line.json("refused", Json(true));
      break;
    case What::command: line.json("text", Json(event.text)); break;
    case What::wait:
      line.number("since", event.since.count());
      line.number("thread", where);
      line.json("text", Json(event.text));
      break;
    case What::end:
      if (!event.failed.what.empty()) add_failure(line, event.failed);
      if (!event.text.empty()) line.json("state", Json(event.text));
      break;
    case What::opened:
    case What::closed:
    case What::purged:
    case What::nothing_more: break;
  }
  return std::move(line).finished();
}

namespace {

void take_wait(const Json& line, RecordedEvent& event) {
  event.since = SimTime{number_at(line, "since", 0, event.at.count())};
  event.where = static_cast<std::size_t>(number_at(line, "thread", 1, INT32_MAX));
  event.text = text_at(line, "text");
}

}  // namespace

RecordedEvent parse_event(std::string_view text, const KnownDevices& devices, std::size_t line_count) {
  const Json line = parse_line(text);
  RecordedEvent event;
  const std::string word = text_at(line, "do");
  bool is_known = false;
  for (const auto& [what, known] : kEventWords) {
    if (known != word) continue;
    event.what = what;
    is_known = true;
  }
  if (!is_known)
    throw RecordingError("do: " + understudy::quoted(word) + " is not an event; expected a recorded event");
  event.at = SimTime{number_at(line, "t", 0, kHorizon.count())};
  const auto last = [](std::size_t count) { return static_cast<std::int64_t>(count) - 1; };
  if (is_of_a_line(event.what)) {
    event.where = static_cast<std::size_t>(number_at(line, "line", 0, last(line_count)));
  }
  if (is_of_a_device(event.what)) {
    event.where = static_cast<std::size_t>(number_at(line, "device", 0, last(devices.size())));
  }
  switch (event.what) {
    case What::bytes:
    case What::departed:
    case What::sent: event.bytes = bytes_at(line, "bytes"); break;
    case What::settings:
      if (line.contains("baud")) event.host = host_at(line);
      break;
    case What::input: {
      const auto& terminals = devices[event.where].model->terminals;
      event.place = static_cast<int>(number_at(line, "terminal", 0, last(terminals.size())));
      const TerminalRow& row = terminals[static_cast<std::size_t>(event.place)];
      event.value = number_at(line, "level", row.lowest, row.highest);
      break;
    }
    case What::power: event.value = truth_at(line, "on") ? 1 : 0; break;
    case What::inject: event.fault = fault_at(line, devices); break;
    case What::clear: event.value = number_at(line, "number", 0, INT64_MAX); break;
    case What::write: event.write = write_at(line); break;
    case What::assign:
      event.text = text_at(line, "name");
      if (!require(line, "value").is_number()) throw RecordingError("value: is not a number; expected one");
      event.real = line["value"].get<double>();
      break;
    case What::program:
      event.text = text_at(line, "text");
      event.value = line.contains("refused") && truth_at(line, "refused") ? 1 : 0;
      break;
    case What::command: event.text = text_at(line, "text"); break;
    case What::wait: take_wait(line, event); break;
    case What::end:
      if (line.contains("state")) event.text = text_at(line, "state");
      if (line.contains("failed")) event.failed = failure_at(line, event.at);
      break;
    case What::opened:
    case What::closed:
    case What::purged:
    case What::nothing_more: break;
  }
  return event;
}

}  // namespace understudy::emulator::world
