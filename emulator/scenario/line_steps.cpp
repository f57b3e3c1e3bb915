// Steps that use the line: write, expect, send.
#include <cctype>

#include "emulator/one_line.h"
#include "emulator/parse_integer.h"
#include "emulator/scenario/step_forms.h"
#include "emulator/scenario/step_readers.h"
#include "emulator/scenario/steps_reader.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator {

namespace {

std::optional<int> read_exception(const YamlFields& step) {
  if (!step.has("exception")) return std::nullopt;
  return static_cast<int>(step.at("exception").integer(kExceptionForm));
}

/// "write feeder.A=1, feeder.B=2", and "(exception 3)" behind it.
struct Sentence {
  std::string text;
  bool is_first = true;
  void add(const std::string& part) {
    text += (is_first ? " " : ", ") + part;
    is_first = false;
  }
  std::string finished(std::optional<int> exception) const {
    return exception ? text + " (exception " + std::to_string(*exception) + ")" : text;
  }
};

std::vector<std::pair<std::string, YamlFields>> demand_registers(const YamlFields& value) {
  value.demand_map();
  auto entries = value.entries();
  if (entries.empty()) value.fail("is empty; expected registers, as in `{ feeder.Aaxis_SVON: 1 }`");
  return entries;
}

constexpr std::size_t kMostBytes = 1024;  // of one step

std::vector<std::uint8_t> read_bytes(const YamlFields& field) {
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
                 " is no byte; expected bytes such as 01 03 00 01, with +crc at the end for the "
                 "checksum");
    }
    for (std::size_t i = 0; i < word.size(); i += 2) {
      bytes.push_back(static_cast<std::uint8_t>(*parse_integer("0x" + word.substr(i, 2))));
    }
  }
  if (bytes.empty() || bytes.size() > kMostBytes) {
    field.fail("has " + std::to_string(bytes.size()) + " bytes; expected 1 to " + std::to_string(kMostBytes));
  }
  return bytes;
}

}  // namespace

void read_write(StepsReader& reader, const YamlFields& step, const YamlFields& value) {
  WriteStep write;
  write.exception = read_exception(step);
  Sentence sentence{"write"};
  for (const auto& [name, field] : demand_registers(value)) {
    Target target = reader.trial().target(field, name);
    if (target.is_value) {
      field.fail(name +
                 " is no register, and is not written over the line so; expected `send: { text: ... }`");
    }
    std::string what = reader.trial().value_to_write(field, target, write.exception.has_value());
    sentence.add(name + "=" + on_one_line(what));
    write.entries.push_back({.target = std::move(target), .value = std::move(what)});
  }
  const std::string text = sentence.finished(write.exception);
  reader.add(step, text, std::move(write));
}

void read_expect(StepsReader& reader, const YamlFields& step, const YamlFields& value) {
  ExpectStep expect;
  expect.exception = read_exception(step);
  Sentence sentence{"expect"};
  for (const auto& [name, field] : demand_registers(value)) {
    Target target = reader.trial().target(field, name);
    if (target.is_value && expect.exception) field.fail(name + " is no register; expected no exception");
    Tolerance wanted = reader.trial().value_to_expect(field, target);
    sentence.add(name + ": " + wanted.text);
    expect.entries.push_back({.target = std::move(target), .value = std::move(wanted)});
  }
  const std::string text = sentence.finished(expect.exception);
  reader.add(step, text, std::move(expect));
}

void read_send(StepsReader& reader, const YamlFields& step, const YamlFields& value) {
  if (value.is_map() && value.has("text")) return read_send_text(reader, step, value);
  value.demand_keys(kSendKeys);
  SendStep send;
  send.line = read_line_of(reader, value, Protocol::modbus_rtu);
  send.bytes = read_bytes(value.at("bytes"));
  std::string text = "send " + on_one_line(value.at("bytes").text());
  if (value.has("reply")) {
    const YamlFields reply = value.at("reply");
    const bool is_nothing = reply.text() == "nothing";
    send.reply = is_nothing ? std::vector<std::uint8_t>() : read_bytes(reply);
    text += ", reply " + on_one_line(reply.text());
  }
  if (value.has("within")) send.within = value.at("within").duration();
  if (send.within <= SimTime{0}) value.at("within").fail("is no time at all; expected some");
  reader.add(step, text, std::move(send));
}

}  // namespace understudy::emulator
