#include "emulator/box/stage/permission.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "emulator/device/command_window.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/view/world_view.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kFrameChecksum = 2;

std::uint16_t frame_word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

constexpr std::size_t kLongestRead = 8;  // with its checksum; a longer frame may contain another one

bool only_reads(std::span<const std::uint8_t> frame) {
  const std::uint8_t code = frame[1];
  const bool is_identification = code == 0x2B && frame[2] == 0x0E;
  const bool is_read = (code >= 0x01 && code <= 0x04) || code == 0x07 || code == 0x0B || code == 0x0C ||
                       code == 0x11 || is_identification;
  return is_read && frame.size() <= kLongestRead;
}

/// Adds each number of a command: of "RSM_SET_V XY 1000" it is 1000.
void add_numbers(const Model& model, const std::string& text, SentRequest& request) {
  const auto command = model.numbers_of_command == nullptr ? std::nullopt : model.numbers_of_command(text);
  if (!command) {
    request.unjudged = "it is not a command";
    return;
  }
  for (const std::optional<double>& number : command->numbers) {
    if (number) {
      request.numbers.push_back({.names = command->names, .value = world::finite_number(*number)});
    } else {
      request.numbers.push_back(
          {.names = command->names, .why_not = "takes a number that only the controller knows"});
    }
  }
}

class WriteJudge {
 public:
  WriteJudge(const Device& device, const Written& written, SentRequest& request)
      : device_(device), map_(*device.model().registers), written_(written), request_(request) {}

  Hazards hazards() {
    Hazards all = Hazards::settings;
    for (std::size_t i = 0; i < written_.words.size(); ++i) {
      const Place place = at(i);
      if (!place) return unknown("it writes to an address that no table names");
      if (place.row->message != nullptr) return all | of_message(i);
      all = all | hazards_of(*place.row);
      const bool is_told = i > 0 && is_32_bit(place.row->type) && is_second_word(place, low_word_first());
      if (!is_told) note_value(place, i);  // the first word has told the second
    }
    return all;
  }

 private:
  Place at(std::size_t i) const {
    return map_.at(written_.table, static_cast<std::uint16_t>(written_.first + i), device_.firmware(),
                   low_word_first());
  }
  bool low_word_first() const { return device_.register_bank()->low_word_first(); }

  Hazards of_message(std::size_t i) {
    const Model& model = device_.model();
    const Place place = at(i);
    const char* const no_command = "what it writes to the window is not a command";
    if (i != 0 || place.index != 0 || model.hazards_of_command == nullptr) return unknown(no_command);
    if (const auto text = window_text(device_, written_.table, written_.first, written_.words)) {
      add_numbers(model, *text, request_);
    } else {
      unknown(no_command);
    }
    return model.hazards_of_command(written_.words);
  }

  Hazards unknown(const char* why) {
    request_.unjudged = why;
    return Hazards::all;
  }

  void note_value(const Place& place, std::size_t i) {
    const RegisterRow& row = *place.row;
    SentNumber& sent = request_.numbers.emplace_back();
    sent.names = {map_.unique_name(row, place.index)};
    const auto take = [&](Value value) {
      sent.value = row.type == Type::f32 ? world::finite_number(real_of(value)) : world::Number(value);
    };
    if (!is_32_bit(row.type)) return take(value_of(wire_word(row, written_.words[i]), row.type));
    if (i + 1 < written_.words.size() && !is_second_word(place, low_word_first())) {
      const std::uint32_t bits =
          bits_of_wire(row, written_.words[i], written_.words[i + 1], low_word_first());
      return take(value_of(bits, row.type));
    }
    sent.why_not = "is written by half";
  }

  const Device& device_;
  const RegisterMap& map_;
  const Written& written_;
  SentRequest& request_;
};

}  // namespace

std::optional<Written> written_by(std::span<const std::uint8_t> frame) {
  if (frame.size() < 6 + kFrameChecksum) return std::nullopt;
  const std::size_t size = frame.size() - kFrameChecksum;
  Written written{.table = frame[1] == 0x05 || frame[1] == 0x0F ? Table::coil : Table::holding,
                  .first = frame_word(frame, 2)};
  if (frame[1] == 0x05 || frame[1] == 0x06) {
    const std::uint16_t word = frame_word(frame, 4);
    written.words.push_back(written.table == Table::coil ? static_cast<std::uint16_t>(word != 0 ? 1 : 0)
                                                         : word);
    return size == 6 ? std::optional(written) : std::nullopt;
  }
  if (frame[1] != 0x0F && frame[1] != 0x10) return std::nullopt;
  const std::size_t count = frame_word(frame, 4);
  const std::size_t bytes = written.table == Table::coil ? (count + 7) / 8 : 2 * count;
  if (size != 7 + bytes || frame[6] != bytes) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    written.words.push_back(written.table == Table::coil
                                ? static_cast<std::uint16_t>(frame[7 + i / 8] >> i % 8 & 1)
                                : frame_word(frame, 7 + 2 * i));
  }
  return written;
}

SentRequest judge_frame(const world::WorldView& view, std::size_t line, std::span<const std::uint8_t> frame) {
  SentRequest request{.what = view.line(line).request_text(frame)};
  const bool is_frame =
      !view.line(line).protocol.carries_text() && frame.size() >= 4 && pty::rtu_crc_ok(frame);
  if (!is_frame) {
    request.unjudged = "it is not a frame with a right checksum";
    return request;
  }
  if (only_reads(frame)) {
    request.hazards = Hazards::reads;
    return request;
  }
  for (std::size_t i = 0; i < view.device_count(); ++i) {
    const auto& lines = view.known()[i].lines;
    if (std::ranges::find(lines, view.line_name(line)) == lines.end()) continue;
    if (view.device(i).station_number() == frame[0]) request.device = i;
  }
  const std::optional<Written> written = written_by(frame);
  if (frame[0] == 0) {
    request.unjudged = "it is a broadcast";
  } else if (!request.device || view.device(*request.device).register_bank() == nullptr) {
    request.unjudged = "the bench has no station " + std::to_string(frame[0]) + " on this line";
  } else if (!written) {
    request.unjudged = "it is not a write of a known form";
  } else {
    request.hazards = WriteJudge(view.device(*request.device), *written, request).hazards();
  }
  return request;
}

SentRequest judge_text(const world::WorldView& view, std::size_t line, const std::string& text) {
  SentRequest request{.what = "send \"" + text + "\""};
  for (std::size_t i = 0; i < view.device_count(); ++i) {
    const auto& lines = view.known()[i].lines;
    if (std::ranges::find(lines, view.line_name(line)) != lines.end()) request.device = i;
  }
  const bool has_controls =
      std::ranges::any_of(text, [](char c) { return (c >= '\0' && c < ' ' && c != '\t') || c == '\x7F'; });
  if (has_controls) request.unjudged = "it has control characters";
  if (!request.device || has_controls) return request;
  const Model& model = view.device(*request.device).model();
  if (model.hazards_of_line != nullptr) request.hazards = model.hazards_of_line(text);
  add_numbers(model, text, request);
  return request;
}

// --- the user's limits ---------------------------------------------------------------------------

Envelope read_envelope(const std::string& path) {
  const FileText text = read_text_file(path);
  if (!text) throw FileError(path + ": envelope: " + text.why + "; expected a file of limits");
  const auto file =
      world::YamlFields::parse(*text, path, "envelope", "expected `understudy: 1` and `limits`");
  file.require_map();
  Envelope envelope;
  bool has_limits = false;
  for (const auto& [key, value] : file.entries()) {
    if (key == "understudy") {
      value.integer(1, 1);
    } else if (key == "limits") {
      has_limits = true;
      for (const auto& [name, range] : value.entries()) {
        try {
          envelope.limits.push_back({.pattern = name,
                                     .range = world::parse_tolerance(range.text()),
                                     .place = path + ":" + std::to_string(range.line())});
        } catch (const world::ExpressionError& error) {
          range.fail(std::string(error.what()) + "; expected a range such as -3200..3200");
        }
      }
    } else {
      value.fail("is not a field of an envelope; expected understudy or limits");
    }
  }
  if (!has_limits) file.fail("limits is missing; expected names and ranges, such as `Aaxis_Speed: 0..60`");
  return envelope;
}

namespace {

/// Upper and lower case are the same, as they are to controllers that take text.
bool limits(const Envelope::Limit& limit, const SentNumber& number) {
  return std::ranges::any_of(number.names, [&](const std::string& name) {
    return fnmatch(limit.pattern.c_str(), name.c_str(), FNM_CASEFOLD) == 0;
  });
}

}  // namespace

std::string flag_for(Hazards hazards) {
  if (has(hazards, Hazards::motion) || has(hazards, Hazards::stops_answering)) return "--allow-motion";
  if (has(hazards, Hazards::output) && has(hazards, Hazards::memory)) return "--allow-outputs --allow-memory";
  if (has(hazards, Hazards::output)) return "--allow-outputs";
  return has(hazards, Hazards::memory) ? "--allow-memory" : "--allow-writes";
}

void require_allowed(const SentRequest& request, Hazards allowed, const Envelope& envelope) {
  const Hazards too_much = beyond(request.hazards, allowed);
  if (too_much != Hazards::reads) {
    std::string can;
    for (const HazardName& one : kHazardNames)
      if (has(too_much, one.hazard)) can = one.can;  // the last is the worst
    throw play::NotAllowed(request.what + " can " + can + "; it is sent only with " + flag_for(too_much));
  }
  const auto refuse = [&](const std::string& why) {
    return play::BeyondEnvelope(request.what + ": not sent, because " + why);
  };
  const bool is_limited = request.hazards != Hazards::reads && !envelope.limits.empty();
  if (is_limited && !request.unjudged.empty())
    throw refuse(request.unjudged + "; expected a request whose numbers can be compared with the envelope");
  for (const SentNumber& number : request.numbers) {
    for (const Envelope::Limit& limit : envelope.limits) {
      if (!limits(limit, number)) continue;
      if (!number.value)
        throw refuse(number.names.front() + " " + number.why_not + ", and " + limit.place +
                     " limits it; expected " + limit.range.text);
      if (!limit.range.holds(*number.value))
        throw refuse(number.names.front() + " = " + world::number_text(*number.value) + " is beyond " +
                     limit.place + "; expected " + limit.range.text);
    }
  }
}

}  // namespace understudy::emulator::box
