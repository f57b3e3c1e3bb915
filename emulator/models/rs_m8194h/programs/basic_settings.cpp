// The settings in section 3: which of them a command changes, and the Initial Table as the commands that
// create it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include "base/complete_table.h"
#include "base/state/shared_text.h"
#include "base/text/lines.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using lang::Command;
using lang::Verb;

void pulse_mode(BasicSettings& s, const Command& c) { s.pulse_mode = byte_at(c, 1); }
void max_v(BasicSettings& s, const Command& c) { s.max_v = c.values[1]; }
void limit_levels(BasicSettings& s, const Command& c) {
  s.forward_limit_level = byte_at(c, 1);
  s.reverse_limit_level = byte_at(c, 2);
}
void limit_stop(BasicSettings& s, const Command& c) { s.limit_stop_mode = byte_at(c, 1); }
void near_home_level(BasicSettings& s, const Command& c) { s.near_home_level = byte_at(c, 1); }
void home_level(BasicSettings& s, const Command& c) { s.home_level = byte_at(c, 1); }
/// Sets soft limits. Soft limits and a ring exclude each other: the later setting applies (3.15.1).
void soft_limits(BasicSettings& s, const Command& c) {
  s.soft_limits = true;
  s.forward_soft_limit = c.signed_value(1);
  s.reverse_soft_limit = c.signed_value(2);
  s.soft_limit_source = byte_at(c, 3);
  s.ring = false;
}
void no_soft_limits(BasicSettings& s, const Command&) { s.soft_limits = false; }
void encoder(BasicSettings& s, const Command& c) {
  s.encoder_mode = byte_at(c, 1);
  s.encoder_division = byte_at(c, 2);
  s.index_level = byte_at(c, 3);
}
void servo_on(BasicSettings& s, const Command&) { s.servo = true; }
void servo_off(BasicSettings& s, const Command&) { s.servo = false; }
void alarm(BasicSettings& s, const Command& c) {
  s.alarm = c.values[1] == 1;
  s.alarm_level = byte_at(c, 2);
}
void in_position(BasicSettings& s, const Command& c) {
  s.in_position = c.values[1] == 1;
  s.in_position_level = byte_at(c, 2);
}
void filter(BasicSettings& s, const Command& c) {
  s.filtered = byte_at(c, 1);
  s.filter_time = byte_at(c, 2);
}
void ring(BasicSettings& s, const Command& c) {
  s.ring = true;
  s.ring_top = c.values[1];
  s.soft_limits = false;
}
void no_ring(BasicSettings& s, const Command&) { s.ring = false; }
void avoid_triangles(BasicSettings& s, const Command&) { s.avoids_triangles = true; }
void allow_triangles(BasicSettings& s, const Command&) { s.avoids_triangles = false; }

using Change = void (*)(BasicSettings& settings, const Command& command);
// clang-format off
constexpr HandlerRow<Verb, Change> kChanges[] = {
    {Verb::set_pulse_mode, pulse_mode},   {Verb::set_max_v, max_v},
    {Verb::set_hlmt, limit_levels},       {Verb::limitstop_mode, limit_stop},
    {Verb::set_nhome, near_home_level},   {Verb::set_home_edge, home_level},
    {Verb::set_slmt, soft_limits},        {Verb::clear_slmt, no_soft_limits},
    {Verb::set_encoder, encoder},         {Verb::servo_on, servo_on},
    {Verb::servo_off, servo_off},         {Verb::set_alarm, alarm},
    {Verb::set_inpos, in_position},       {Verb::set_filter, filter},
    {Verb::vring_enable, ring},           {Verb::vring_disable, no_ring},
    {Verb::avtri_enable, avoid_triangles}, {Verb::avtri_disable, allow_triangles},
};
// clang-format on

/// The settings that the Initial Table can contain, from the rows of the language.
constexpr auto kSettingVerbs = [] {
  std::array<Verb, 18> verbs{};
  std::size_t count = 0;
  for (const lang::CommandRow& row : lang::kCommands) {
    if (row.use.initial) verbs[count++] = row.verb;
  }
  return verbs;
}();
constexpr CompleteTable<Verb, Change> kTable(kSettingVerbs, kChanges);

std::string lines_of(const BasicSettings& settings, const BasicSettings& factory, std::uint32_t axis) {
  std::string text;
  const auto line = [&](Verb verb, std::initializer_list<std::uint32_t> values) {
    Command command{.code = lang::real_time_code(verb)};
    command.values[0] = axis | static_cast<std::uint32_t>(lang::kInitial);
    std::size_t next = 1;
    for (const std::uint32_t value : values) command.values[next++] = value;
    text += lang::text_of(command) + "\n";
  };
  const auto differs = [&](auto member) { return settings.*member != factory.*member; };
  const BasicSettings& s = settings;
  using S = BasicSettings;
  if (differs(&S::pulse_mode)) line(Verb::set_pulse_mode, {s.pulse_mode});
  if (differs(&S::max_v)) line(Verb::set_max_v, {s.max_v});
  if (differs(&S::forward_limit_level) || differs(&S::reverse_limit_level)) {
    line(Verb::set_hlmt, {s.forward_limit_level, s.reverse_limit_level});
  }
  if (differs(&S::limit_stop_mode)) line(Verb::limitstop_mode, {s.limit_stop_mode});
  if (differs(&S::near_home_level)) line(Verb::set_nhome, {s.near_home_level});
  if (differs(&S::home_level)) line(Verb::set_home_edge, {s.home_level});
  if (s.soft_limits) {
    line(Verb::set_slmt, {static_cast<std::uint32_t>(s.forward_soft_limit),
                          static_cast<std::uint32_t>(s.reverse_soft_limit), s.soft_limit_source});
  }
  if (differs(&S::encoder_mode) || differs(&S::encoder_division) || differs(&S::index_level)) {
    line(Verb::set_encoder, {s.encoder_mode, s.encoder_division, s.index_level});
  }
  if (s.servo) line(Verb::servo_on, {});
  if (s.alarm || differs(&S::alarm_level)) line(Verb::set_alarm, {s.alarm ? 1U : 0U, s.alarm_level});
  if (s.in_position || differs(&S::in_position_level)) {
    line(Verb::set_inpos, {s.in_position ? 1U : 0U, s.in_position_level});
  }
  if (differs(&S::filtered) || differs(&S::filter_time)) line(Verb::set_filter, {s.filtered, s.filter_time});
  if (s.ring) line(Verb::vring_enable, {s.ring_top});
  if (s.avoids_triangles) line(Verb::avtri_enable, {});
  return text;
}

}  // namespace

void apply_setting(BasicSettings& settings, const Command& command) {
  if (kTable.has(command.verb())) kTable[command.verb()](settings, command);
}

void keep_initial_table(TextBlocks& blocks, const InitialTable& table, const BasicSettings& factory) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    const std::string name(kAxisNames[a]);
    std::string text = lines_of(table[a], factory, mask_of(a));
    if (text.empty()) {
      blocks.erase(kInitialBlocks, name);
    } else {
      blocks.put(kInitialBlocks, name, SharedText(std::move(text)));
    }
  }
}

InitialTable initial_table_of(const TextBlocks& blocks, const BasicSettings& factory) {
  InitialTable table;
  table.fill(factory);
  for (std::size_t a = 0; a < kAxes; ++a) {
    const SharedText* const text = blocks.find(kInitialBlocks, std::string(kAxisNames[a]));
    if (text == nullptr) continue;
    for (const TextLine line : TextLines(text->text())) {
      const lang::ParsedCommand parsed = lang::parse_command(line.text);
      if (parsed.command) apply_setting(table[a], *parsed.command);
    }
  }
  return table;
}

}  // namespace understudy::emulator::models::rs_m8194h
