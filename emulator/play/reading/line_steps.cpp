// Reads steps that use the line: write, expect, send.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/expression/tolerance.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::play {

namespace {

Answer read_answer(StepsReader& reader, const world::YamlFields& step) {
  Answer answer;
  reader.attempt([&] {
    if (const auto exception = step.find("exception"))
      answer.exception = static_cast<int>(exception->integer(kExceptionSchema));
  });
  reader.attempt([&] {
    const auto reply = step.find("reply");
    if (!reply) return;
    if (reply->text() != kNothing.front()) {
      reply->fail(quoted(reply->text()) +
                  " is unknown; expected nothing (values that are read are compared without `reply`)");
    }
    if (step.has("exception")) reply->fail("an exception is a reply; expected one of the two");
    answer.silence = SendStep{}.within;
  });
  reader.attempt([&] {
    const auto within = step.find("within");
    if (!within) return;
    if (!step.has("reply")) within->fail("has no effect without `reply: nothing`; expected both");
    answer.silence = read_within(*within);
  });
  return answer;
}

/// Reads `via` in a step that uses these devices.
Via read_via_of(const StepsReader& reader, const world::YamlFields& step,
                const std::vector<std::size_t>& devices) {
  const auto field = step.find(kViaKey.key);
  if (!field) return std::nullopt;
  return reader.trial().line_of_all(*field, devices);
}

/// Reads `via` of a step with these entries.
template <typename Entries>
Via read_via(const StepsReader& reader, const world::YamlFields& step, const Entries& entries) {
  const auto field = step.find(kViaKey.key);
  if (!field) return std::nullopt;
  std::vector<std::size_t> devices;
  for (const auto& entry : entries) {
    if (entry.target.is_value)
      field->fail(entry.target.name + " is not a register and is read without a line; expected no `via`");
    devices.push_back(entry.target.device);
  }
  return read_via_of(reader, step, devices);
}

/// Builds the text of a step: "write feeder.A=1, feeder.B=2", followed by "via rs485", "(exception 3)" or
/// "(no reply)".
struct Sentence {
  std::string text;
  bool is_first = true;
  void add_via(const world::YamlFields& step) {
    if (const auto via = step.find(kViaKey.key)) text += " via " + via->text();
  }
  void add(const std::string& part) {
    text += (is_first ? " " : ", ") + part;
    is_first = false;
  }
  std::string finished(const Answer& answer) const {
    if (answer.silence) return text + " (no reply)";
    return answer.exception ? text + " (exception " + std::to_string(*answer.exception) + ")" : text;
  }
};

std::vector<std::pair<std::string, world::YamlFields>> require_registers(const world::YamlFields& value) {
  value.require_map();
  auto entries = value.entries();
  if (entries.empty()) value.fail("is empty; expected registers, as in `{ feeder.Aaxis_SVON: 1 }`");
  return entries;
}

constexpr std::size_t kMaxBytes = 1024;  // per step

std::vector<std::uint8_t> read_bytes(const world::YamlFields& field) {
  const std::string text = field.text();
  std::vector<std::uint8_t> bytes;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t\n", at)) != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(" \t\n", at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end;
    if (word == "+crc" && !bytes.empty() && text.find_first_not_of(" \t\n", at) == std::string::npos) {
      pty::append_rtu_crc(bytes);
      break;
    }
    const bool is_hexadecimal =
        word.size() % 2 == 0 && word.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    if (!is_hexadecimal) {
      field.fail(quoted(word) +
                 " is not a byte; expected bytes such as 01 03 00 01, with +crc at the end for the "
                 "checksum");
    }
    for (std::size_t i = 0; i < word.size(); i += 2) {
      bytes.push_back(static_cast<std::uint8_t>(*parse_integer("0x" + word.substr(i, 2))));
    }
  }
  if (bytes.empty() || bytes.size() > kMaxBytes) {
    field.fail("has " + std::to_string(bytes.size()) + " bytes; expected 1 to " + std::to_string(kMaxBytes));
  }
  return bytes;
}

}  // namespace

void read_write(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  WriteStep write;
  write.answer = read_answer(reader, step);
  Sentence sentence{"write"};
  const auto read = [&](const std::string& name, const world::YamlFields& field) {
    Target target = reader.trial().target(field, name);
    if (target.is_value) {
      field.fail(name +
                 " is not a register and cannot be written over the line; expected `send: { text: "
                 "... }`");
    }
    if (write.answer.silence && is_bit(target)) {
      field.fail(
          "the register of a bit is read before the write; expected whole registers with `reply: nothing`");
    }
    std::string what = reader.trial().value_to_write(field, target, write.answer.exception.has_value());
    sentence.add(name + "=" + world::on_one_line(what));
    write.entries.push_back({.target = std::move(target), .value = std::move(what)});
  };
  for (const auto& [name, field] : require_registers(value))
    reader.attempt([&, &its_name = name, &its_field = field] { read(its_name, its_field); });
  reader.attempt([&] { write.via = read_via(reader, step, write.entries); });
  if (reader.has_failed()) return;
  sentence.add_via(step);
  const std::string text = sentence.finished(write.answer);
  reader.add(step, text, std::move(write));
}

void read_command(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  value.require_map();
  CommandStep command;
  command.answer = read_answer(reader, step);
  Sentence sentence{"command"};
  std::vector<std::size_t> devices;
  const auto entries = value.entries();
  if (entries.empty()) value.fail("is empty; expected commands, as in `{ cell: MOVE X 1000 }`");
  const auto read = [&](const std::string& name, const world::YamlFields& field) {
    devices.push_back(reader.trial().device(field, name));
    reader.trial().require_command(field, devices.back());
    sentence.add(name + ": " + field.text());
    command.entries.push_back({.device = devices.back(), .text = field.text()});
  };
  for (const auto& [name, field] : entries)
    reader.attempt([&, &its_name = name, &its_field = field] { read(its_name, its_field); });
  reader.attempt([&] { command.via = read_via_of(reader, step, devices); });
  if (reader.has_failed()) return;
  sentence.add_via(step);
  const std::string text = sentence.finished(command.answer);
  reader.add(step, text, std::move(command));
}

void read_expect(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  ExpectStep expect;
  expect.answer = read_answer(reader, step);
  Sentence sentence{"expect"};
  const auto read = [&](const std::string& name, const world::YamlFields& field) {
    Target target = reader.trial().target(field, name);
    if (target.is_value && expect.answer.exception)
      field.fail(name + " is not a register; expected no exception");
    if (target.is_value && expect.answer.silence)
      field.fail(name + " is not a register and is read without a line; expected no `reply`");
    world::Tolerance wanted = reader.trial().value_to_expect(field, target);
    sentence.add(name + ": " + wanted.text);
    expect.entries.push_back({.target = std::move(target), .value = std::move(wanted)});
  };
  for (const auto& [name, field] : require_registers(value))
    reader.attempt([&, &its_name = name, &its_field = field] { read(its_name, its_field); });
  reader.attempt([&] { expect.via = read_via(reader, step, expect.entries); });
  if (reader.has_failed()) return;
  sentence.add_via(step);
  const std::string text = sentence.finished(expect.answer);
  reader.add(step, text, std::move(expect));
}

void read_send(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  if (value.is_map() && value.has("text")) return read_send_text(reader, step, value);
  reader.attempt([&] { value.require_keys(kSendKeys); });
  SendStep send;
  std::string text;
  reader.attempt([&] { send.line = read_line_of(reader, value); });
  reader.attempt([&] {
    send.bytes = read_bytes(value.at("bytes"));
    text = "send " + world::on_one_line(value.at("bytes").text());
  });
  reader.attempt([&] {
    const auto reply = value.find("reply");
    if (!reply) return;
    const bool is_nothing = reply->text() == "nothing";
    send.reply = is_nothing ? std::vector<std::uint8_t>() : read_bytes(*reply);
    text += ", reply " + world::on_one_line(reply->text());
  });
  reader.attempt([&] {
    if (const auto within = value.find("within")) send.within = read_within(*within);
  });
  reader.add(step, text, std::move(send));
}

}  // namespace understudy::emulator::play
