#include "emulator/model_file/line_fields.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/binder.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::model_file {

using models::imported::Description;
using models::imported::Line;
using world::Diagnostics;
using world::YamlFields;

namespace {

/// A function that the emulator supports, and the maximum number of registers or bits in a request.
struct Served {
  std::uint8_t code = 0;
  int max = 1;
};
std::vector<Served> all_served() {
  std::vector<Served> all;
  for (const world::FunctionRow& row : world::kModbusFunctions) all.push_back({row.code, row.max});
  for (const world::OtherFunctionRow& row : world::kOtherModbusFunctions)
    all.push_back({static_cast<std::uint8_t>(row.code), row.max});
  std::sort(all.begin(), all.end(), [](const Served& a, const Served& b) { return a.code < b.code; });
  return all;
}

std::uint8_t read_function(const YamlFields& field) {
  const auto code = field.integer(kFunctionSchema);
  std::string known;
  for (const Served& row : all_served()) {
    if (row.code == code) return row.code;
    known += (known.empty() ? "" : ", ") + std::to_string(row.code);
  }
  field.fail(std::to_string(code) + " is not a supported function; expected one of " + known);
}

/// Reads, by function, how many registers or bits a request may contain.
void read_limits(const YamlFields& field, Line& line) {
  field.require_map();
  const std::vector<Served> all = all_served();
  for (const auto& [code, max] : field.entries()) {
    const auto number = parse_integer(code);
    const bool is_known =
        number && std::find(line.functions.begin(), line.functions.end(), *number) != line.functions.end();
    if (!is_known) max.fail(understudy::quoted(code) + " is not in `functions`; expected one of these");
    const Served& row =
        *std::find_if(all.begin(), all.end(), [&](const Served& one) { return one.code == *number; });
    const auto count = max.integer(kMaxSchema);
    if (count > row.max) {
      max.fail(std::to_string(count) + " is more than function " + code + " allows; expected " +
               std::to_string(row.max) + " or fewer");
    }
    line.limits.push_back({.code = row.code, .max = static_cast<int>(count)});
  }
}

/// Reads the objects of the device identification. The mandatory objects are always present.
void read_identity(const YamlFields& field, Line& line) {
  field.require_keys(kIdentityKeys);
  line.identity.clear();
  constexpr std::size_t kBasic = 3;
  constexpr std::size_t kMaxLetters = 240;
  for (std::size_t id = 0; id < kIdentityKeys.size(); ++id) {
    const auto given = field.find(kIdentityKeys[id].key);
    if (!given && id >= kBasic) continue;
    std::string text = given ? given->text() : "";
    if (text.size() > kMaxLetters)
      given->fail("is too long; expected " + std::to_string(kMaxLetters) + " letters or fewer");
    line.identity.emplace_back(static_cast<std::uint8_t>(id), std::move(text));
  }
}

void read_framing(const YamlFields& field, Line& line) {
  line.is_ascii = read_word(field, kFramingSchema) == 1;
  if (!line.is_ascii) return;
  line.data_bits = 7;  // as in the standard: 7E1
  line.parity = pty::Parity::even;
}

void read_data_bits(const YamlFields& field, Line& line) {
  line.data_bits = static_cast<int>(field.integer(kDataBitsSchema));
  if (line.data_bits != 8 && !line.is_ascii)
    field.fail("Modbus RTU frames have bytes of 8 bits; expected 8, or `framing: ascii`");
}

}  // namespace

std::size_t read_word(const YamlFields& field, const Schema& schema) {
  const std::string written = field.text();
  for (std::size_t i = 0; i < schema.words.size(); ++i) {
    if (schema.words[i] == written) return i;
  }
  const std::vector<std::string> words(schema.words.begin(), schema.words.end());
  field.fail(understudy::quoted(written) + " is not valid" + suggestion(written, words));
}

void read_line(const YamlFields& fields, Line& line, Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_keys(kLineKeys); });
  const auto read = [&](std::string_view key, const auto& how) {
    diagnostics.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  read("framing", [&](const YamlFields& field) { read_framing(field, line); });
  read("data_bits", [&](const YamlFields& field) { read_data_bits(field, line); });
  read("baud", [&](const YamlFields& field) {
    std::vector<int> bauds;
    const auto add = [&](const YamlFields& one) {
      bauds.push_back(static_cast<int>(one.integer(kBaudSchema)));
    };
    if (field.is_list()) {
      for (const YamlFields& one : field.elements()) add(one);
    } else {
      add(field);
    }
    if (bauds.empty()) field.fail("is empty; expected at least one speed");
    line.bauds = bauds;
  });
  read("parity", [&](const YamlFields& field) {
    constexpr std::array<pty::Parity, 3> kOrder{pty::Parity::none, pty::Parity::even, pty::Parity::odd};
    line.parity = kOrder.at(read_word(field, kParitySchema));
  });
  read("stop_bits",
       [&](const YamlFields& field) { line.stop_bits = static_cast<int>(field.integer(kStopBitsSchema)); });
  read("silence", [&](const YamlFields& field) {
    if (line.is_ascii) field.fail("ends Modbus RTU frames; expected no `silence` with `framing: ascii`");
    line.silence = field.duration();
    constexpr pty::SimTime kLongest = std::chrono::seconds(1);
    if (*line.silence <= pty::SimTime{0} || *line.silence > kLongest)
      field.fail(understudy::quoted(field.text()) +
                 " is not valid; expected a duration above 0 and up to 1s");
  });
  read("stations", [&](const YamlFields& field) {
    const auto ends = field.elements();
    if (ends.size() != 2) field.fail("expected the lowest and the highest number, as in [1, 247]");
    line.lowest_station = static_cast<int>(ends[0].integer(kStationSchema));
    line.highest_station = static_cast<int>(ends[1].integer(kStationSchema));
    if (line.lowest_station > line.highest_station)
      field.fail("ends before it begins; expected a range such as [1, 247]");
  });
  read("functions", [&](const YamlFields& field) {
    std::vector<std::uint8_t> functions;
    for (const YamlFields& one : field.elements()) functions.push_back(read_function(one));
    if (functions.empty()) field.fail("is empty; expected at least one function");
    line.functions = functions;
  });
  read("most", [&](const YamlFields& field) { read_limits(field, line); });
  read("identity", [&](const YamlFields& field) { read_identity(field, line); });
  read("server_id", [&](const YamlFields& field) {
    line.server_id = field.text();
    constexpr std::size_t kMaxLetters = 200;
    if (line.server_id.size() > kMaxLetters) field.fail("is too long; expected 200 letters or fewer");
  });
  read("broadcast",
       [&](const YamlFields& field) { line.obeys_broadcasts = read_word(field, kBroadcastSchema) == 0; });
}

void read_policy(const YamlFields& fields, MapPolicy& policy, Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_keys(kMapKeys); });
  const auto read = [&](std::string_view key, const Schema& schema, const auto& take) {
    diagnostics.attempt([&] {
      if (const auto field = fields.find(key)) take(read_word(*field, schema));
    });
  };
  read("holes", kRefusedOrZeroSchema, [&](std::size_t word) {
    policy.unmapped = word == 0 ? MapPolicy::Unmapped::refused : MapPolicy::Unmapped::reads_zero;
  });
  read("out_of_range", kOutOfRangeSchema, [&](std::size_t word) {
    constexpr std::array<MapPolicy::OutOfRange, 3> kOrder{
        MapPolicy::OutOfRange::refused, MapPolicy::OutOfRange::clamped, MapPolicy::OutOfRange::stored};
    policy.out_of_range = kOrder.at(word);
  });
  read("read_only", kRefusedOrIgnoredSchema, [&](std::size_t word) {
    policy.read_only = word == 0 ? MapPolicy::ReadOnly::refused : MapPolicy::ReadOnly::ignores_writes;
  });
  read("write_only", kZeroOrRefusedSchema, [&](std::size_t word) {
    policy.write_only = word == 0 ? MapPolicy::WriteOnly::reads_zero : MapPolicy::WriteOnly::refused;
  });
  read("halves", kHalvesSchema, [&](std::size_t word) {
    constexpr std::array<MapPolicy::Halves, 3> kOrder{MapPolicy::Halves::may_be_written_alone,
                                                      MapPolicy::Halves::judged_with_the_other,
                                                      MapPolicy::Halves::come_whole};
    policy.halves = kOrder.at(word);
    policy.read_halves = policy.halves == MapPolicy::Halves::come_whole
                             ? MapPolicy::ReadHalves::come_whole
                             : MapPolicy::ReadHalves::may_be_read_alone;
  });
  read("first_word", kHighOrLowSchema, [&](std::size_t word) { policy.low_word_first = word == 1; });
}

std::string read_station_register(const YamlFields& field, const Binder& binder,
                                  const Description& description) {
  const models::imported::Spot spot = binder.spot(field);
  const auto& listed = description.registers[spot.number];
  const bool suits = spot.is_whole() && listed.access != Access::write && listed.table == Table::holding &&
                     !is_32_bit(listed.type) && !listed.is_bcd;
  if (!suits)
    field.fail(understudy::quoted(field.text()) +
               " cannot hold the station number; expected a 16-bit holding register");
  const Line& line = description.line;
  if (listed.factory < line.lowest_station || listed.factory > line.highest_station) {
    field.fail(understudy::quoted(listed.name) + " has the default " + std::to_string(listed.factory) +
               "; expected a default from " + std::to_string(line.lowest_station) + " to " +
               std::to_string(line.highest_station) + " (`stations`)");
  }
  return field.text();
}

}  // namespace understudy::emulator::model_file
