// Lists the fields of the states of lines and their listeners (base/state/fields.h), in the order of the
// bytes.
#pragma once

#include "base/state/fields.h"
#include "base/state/queue_fields.h"
#include "base/state/state_bytes.h"
#include "pty/line.h"
#include "pty/rtu_framer.h"
#include "pty/text_lines.h"

namespace understudy {

template <>
struct StateOf<pty::Parity> {
  static constexpr auto last = pty::Parity::space;
};

template <>
struct StateOf<pty::HeardText::What> {
  static constexpr auto last = pty::HeardText::What::go_on;
};

template <>
struct StateOf<pty::LineSettings> {
  using Value = pty::LineSettings;
  static constexpr auto fields =
      FieldList{field("baud", &Value::baud), field("data_bits", &Value::data_bits),
                field("parity", &Value::parity), field("stop_bits", &Value::stop_bits)};
};

template <>
struct StateOf<pty::HostSettings> {
  using Value = pty::HostSettings;
  static constexpr auto fields =
      FieldList{field("baud", &Value::baud), field("stop_bits", &Value::stop_bits),
                field("data_bits", &Value::data_bits), field("parity", &Value::parity)};
};

template <>
struct StateOf<pty::TimedByte> {
  using Value = pty::TimedByte;
  static constexpr auto fields = FieldList{field("start", &Value::start), field("end", &Value::end),
                                           field("value", &Value::value), field("number", &Value::number)};
};

template <>
struct StateOf<pty::Line::Burst> {
  using Value = pty::Line::Burst;
  static constexpr auto fields =
      FieldList{field("start", &Value::start), field("count", &Value::count), field("end", &Value::end)};
};

template <>
struct StateOf<pty::Line::Member> {
  using Value = pty::Line::Member;
  static constexpr auto fields = FieldList{field("is_deaf", &Value::is_deaf), field("speech", &Value::speech),
                                           field("noticed_at", &Value::noticed_at)};
};

template <>
struct StateOf<pty::Line::Warned> {
  using Value = pty::Line::Warned;
  static constexpr auto fields =
      FieldList{field("of_deafness", &Value::of_deafness), field("of_no_speed", &Value::of_no_speed),
                field("of_collision", &Value::of_collision)};
};

template <>
struct StateOf<pty::Adapter> {
  using Value = pty::Adapter;
  static constexpr auto fields = FieldList{field("echoes", &Value::echoes), field("latency", &Value::latency),
                                           field("is_unplugged", &Value::is_unplugged)};
};

template <>
struct StateOf<pty::Line::State> {
  using Value = pty::Line::State;
  static constexpr auto fields = FieldList{field("settings", &Value::settings),
                                           field("members", &Value::members),
                                           field("is_host_open", &Value::is_host_open),
                                           field("host_settings", &Value::host_settings),
                                           field("departed_settings", &Value::departed_settings),
                                           field("last_departed", &Value::last_departed),
                                           field("last_received", &Value::last_received),
                                           field("warned", &Value::warned),
                                           field("input", &Value::input),
                                           field("arriving", &Value::arriving),
                                           field("is_heard", &Value::is_heard),
                                           field("leaving", &Value::leaving),
                                           field("adapter", &Value::adapter),
                                           field("lump", &Value::lump),
                                           field("lump_at", &Value::lump_at)};
  static constexpr std::size_t apart = 1;  // Line::Edge, which never affects the stations
};

template <>
struct StateOf<pty::LineCounters> {
  using Value = pty::LineCounters;
  static constexpr auto fields =
      FieldList{field("bytes_in", &Value::bytes_in), field("bytes_out", &Value::bytes_out),
                field("bytes_unheard", &Value::bytes_unheard),
                field("bytes_discarded", &Value::bytes_discarded), field("collisions", &Value::collisions)};
};

template <>
struct StateOf<pty::Line::Edge> {
  using Value = pty::Line::Edge;
  static constexpr auto fields = FieldList{
      field("output", &Value::output), field("counters", &Value::counters), field("clock", &Value::clock)};
};

template <>
struct StateOf<pty::RtuFramer::Character> {
  using Value = pty::RtuFramer::Character;
  static constexpr auto fields =
      FieldList{field("value", &Value::value), field("end", &Value::end), field("number", &Value::number)};
};

/// Saves the characters one after another, each as a whole.
template <>
struct StateOf<pty::RtuFramer::Characters> {
  using Value = pty::RtuFramer::Characters;
  static void write(const Value& characters, StateWriter& writer) {
    writer.write(static_cast<std::uint32_t>(characters.size()));
    for (std::size_t i = 0; i < characters.size(); ++i) writer.write(characters[i]);
  }
  static void read(Value& characters, StateReader& reader) {
    characters.clear();
    std::uint32_t count = 0;
    for (reader.read(count); count > 0; --count) {
      pty::RtuFramer::Character character;
      reader.read(character);
      characters.push_back(character);
    }
  }
};

template <>
struct StateOf<pty::RtuFramer::Frame> {
  using Value = pty::RtuFramer::Frame;
  static constexpr auto fields = FieldList{field("first", &Value::first), field("size", &Value::size)};
};

template <>
struct StateOf<pty::RtuFramer::State> {
  using Value = pty::RtuFramer::State;
  static constexpr auto fields = FieldList{field("characters", &Value::characters),
                                           field("ready", &Value::ready),
                                           field("undecided", &Value::undecided),
                                           field("candidate", &Value::candidate),
                                           field("look_again_at", &Value::search_again_at),
                                           field("is_paused", &Value::is_paused),
                                           field("resumed", &Value::resumed),
                                           field("oversize", &Value::oversize),
                                           field("last_end", &Value::last_end),
                                           field("character_under_way", &Value::character_under_way),
                                           field("dropped", &Value::dropped)};
};

template <>
struct StateOf<pty::RtuFramer> : StateHeldBy<pty::RtuFramer> {};

template <>
struct StateOf<pty::TextLines::State> {
  using Value = pty::TextLines::State;
  static constexpr auto fields =
      FieldList{field("text", &Value::text), field("is_overlong", &Value::is_overlong),
                field("was_return", &Value::was_return), field("dropped", &Value::dropped)};
};

template <>
struct StateOf<pty::TextLines> : StateHeldBy<pty::TextLines> {};

template <>
struct StateOf<pty::HeardText> {
  using Value = pty::HeardText;
  static constexpr auto fields =
      FieldList{field("what", &Value::what), field("text", &Value::text), field("end", &Value::end),
                field("last_character", &Value::last_character)};
};

}  // namespace understudy
