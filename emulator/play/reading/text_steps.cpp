// Reads steps that use text lines: send (with `text`), hear.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/protocol/received_lines.h"

namespace understudy::emulator::play {

namespace {

constexpr std::size_t kLongestText = 1023;  // 1024 bytes with the line ending

/// Reads a line of text.
std::string read_text(const world::YamlFields& field) {
  std::string text = field.text();
  if (text.find_first_of("\r\n") != std::string::npos) {
    field.fail("has several lines; expected one line, without its end");
  }
  if (text.size() > kLongestText) {
    field.fail("has " + std::to_string(text.size()) + " characters; expected at most " +
               std::to_string(kLongestText));
  }
  return text;
}

/// Reads one or several lines. Returns an empty list for `nothing`.
std::vector<std::string> read_texts(const world::YamlFields& field) {
  std::vector<std::string> lines;
  if (field.is_list()) {
    for (const world::YamlFields& line : field.elements()) lines.push_back(read_text(line));
    if (lines.empty()) field.fail("is empty; expected lines, or `nothing`");
  } else if (field.text() != "nothing") {
    lines.push_back(read_text(field));
  }
  return lines;
}

/// Returns the number of a line whose protocol is text.
std::size_t read_line_of_text(const StepsReader& reader, const world::YamlFields& value) {
  const std::size_t number = read_line_of(reader, value);
  const world::Bench& bench = reader.trial().bench();
  const world::LineSetup& line = bench.lines[number];
  const world::LineProtocol& protocol =
      world::protocol_of(*bench.devices[line.stations.front().device].model);
  if (!protocol.carries_text()) {
    value.fail("line '" + line.name + "' carries " + std::string(protocol.messages()) +
               "; expected a line that carries text, or `bytes`");
  }
  return number;
}

}  // namespace

std::size_t read_line_of(const StepsReader& reader, const world::YamlFields& value) {
  if (value.has("line")) return reader.trial().line(value.at("line"), value.at("line").text());
  if (reader.trial().bench().lines.size() > 1) {
    value.fail("'line' is missing, but the bench has several lines; expected it here");
  }
  return 0;
}

void read_send_text(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  reader.attempt([&] { value.require_keys(kSendTextKeys); });
  TextStep say;
  std::string text;
  reader.attempt([&] { say.line = read_line_of_text(reader, value); });
  reader.attempt([&] {
    say.text = read_text(value.at("text"));
    text = "send \"" + *say.text + "\"";
  });
  reader.attempt([&] {
    const auto reply = value.find("reply");
    if (!reply) return;
    say.lines = read_texts(*reply);
    text += ", reply " + world::lines_text(*say.lines);
  });
  reader.attempt([&] {
    if (const auto within = value.find("within")) say.within = read_within(*within);
  });
  reader.add(step, text, std::move(say));
}

void read_hear(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  reader.attempt([&] { value.require_keys(kHearKeys); });
  TextStep hear;
  std::string text;
  reader.attempt([&] { hear.line = read_line_of_text(reader, value); });
  reader.attempt([&] {
    hear.lines = read_texts(value.at("text"));
    text = "hear " + world::lines_text(*hear.lines);
  });
  reader.attempt([&] {
    if (const auto within = value.find("within")) hear.within = read_within(*within);
  });
  reader.add(step, text, std::move(hear));
}

}  // namespace understudy::emulator::play
