// Lists the fields of the states of lines and their listeners (base/state/fields.h), in the order of the
// bytes.
#pragma once

#include "base/state/fields.h"
#include "base/state/queue_fields.h"
#include "base/state/state_bytes.h"
#include "pty/ascii_framer.h"
#include "pty/line.h"
#include "pty/rtu_framer.h"
#include "pty/text_lines.h"

namespace understudy {

template <>
struct StateOf<pty::Parity> {
  static constexpr auto last = pty::Parity::space;
};

template <>
struct StateOf<pty::ReceivedText::What> {
  static constexpr auto last = pty::ReceivedText::What::release;
};

template <>
struct StateOf<pty::LineSettings> {
  using Value = pty::LineSettings;
  static constexpr auto fields = FieldList{field<&Value::baud>(), field<&Value::data_bits>(),
                                           field<&Value::parity>(), field<&Value::stop_bits>()};
};

template <>
struct StateOf<pty::HostSettings> {
  using Value = pty::HostSettings;
  static constexpr auto fields = FieldList{field<&Value::baud>(), field<&Value::stop_bits>(),
                                           field<&Value::data_bits>(), field<&Value::parity>()};
};

template <>
struct StateOf<pty::TimedByte> {
  using Value = pty::TimedByte;
  static constexpr auto fields = FieldList{field<&Value::start>(), field<&Value::end>(),
                                           field<&Value::value>(), field<&Value::number>()};
};

template <>
struct StateOf<pty::Line::Burst> {
  using Value = pty::Line::Burst;
  static constexpr auto fields =
      FieldList{field<&Value::start>(), field<&Value::count>(), field<&Value::end>()};
};

template <>
struct StateOf<pty::Line::Member> {
  using Value = pty::Line::Member;
  static constexpr auto fields =
      FieldList{field<&Value::is_deaf>(), field<&Value::transmission>(), field<&Value::noticed_at>()};
};

template <>
struct StateOf<pty::Line::Warned> {
  using Value = pty::Line::Warned;
  static constexpr auto fields =
      FieldList{field<&Value::of_deafness>(), field<&Value::of_no_speed>(), field<&Value::of_collision>()};
};

template <>
struct StateOf<pty::Adapter> {
  using Value = pty::Adapter;
  static constexpr auto fields =
      FieldList{field<&Value::echoes>(), field<&Value::latency>(), field<&Value::is_unplugged>()};
};

template <>
struct StateOf<pty::Line::State> {
  using Value = pty::Line::State;
  static constexpr auto fields = FieldList{field<&Value::settings>(),
                                           field<&Value::members>(),
                                           field<&Value::is_host_open>(),
                                           field<&Value::host_settings>(),
                                           field<&Value::departed_settings>(),
                                           field<&Value::last_departed>(),
                                           field<&Value::last_received>(),
                                           field<&Value::warned>(),
                                           field<&Value::input>(),
                                           field<&Value::arriving>(),
                                           field<&Value::is_received>(),
                                           field<&Value::leaving>(),
                                           field<&Value::adapter>(),
                                           field<&Value::lump>(),
                                           field<&Value::lump_at>()};
  static constexpr std::size_t apart = 1;  // Line::Edge, which never affects the stations
};

template <>
struct StateOf<pty::LineCounters> {
  using Value = pty::LineCounters;
  static constexpr auto fields =
      FieldList{field<&Value::bytes_in>(), field<&Value::bytes_out>(), field<&Value::bytes_unheard>(),
                field<&Value::bytes_discarded>(), field<&Value::collisions>()};
};

template <>
struct StateOf<pty::Line::Edge> {
  using Value = pty::Line::Edge;
  static constexpr auto fields =
      FieldList{field<&Value::output>(), field<&Value::counters>(), field<&Value::clock>()};
};

template <>
struct StateOf<pty::RtuFramer::Character> {
  using Value = pty::RtuFramer::Character;
  static constexpr auto fields =
      FieldList{field<&Value::value>(), field<&Value::end>(), field<&Value::number>()};
};

/// Saves the characters one after another, each with all its fields.
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
  static constexpr auto fields = FieldList{field<&Value::first>(), field<&Value::size>()};
};

template <>
struct StateOf<pty::RtuFramer::State> {
  using Value = pty::RtuFramer::State;
  static constexpr auto fields =
      FieldList{field<&Value::characters>(),      field<&Value::ready>(),
                field<&Value::undecided>(),       field<&Value::candidate>(),
                field<&Value::search_again_at>(), field<&Value::is_paused>(),
                field<&Value::resumed>(),         field<&Value::oversize>(),
                field<&Value::last_end>(),        field<&Value::character_under_way>(),
                field<&Value::dropped>()};
};

template <>
struct StateOf<pty::RtuFramer> : StateHeldBy<pty::RtuFramer> {};

template <>
struct StateOf<pty::TextLines::State> {
  using Value = pty::TextLines::State;
  static constexpr auto fields = FieldList{field<&Value::text>(), field<&Value::is_overlong>(),
                                           field<&Value::was_return>(), field<&Value::dropped>()};
};

template <>
struct StateOf<pty::TextLines> : StateHeldBy<pty::TextLines> {};

template <>
struct StateOf<pty::AsciiFramer::State> {
  using Value = pty::AsciiFramer::State;
  static constexpr auto fields =
      FieldList{field<&Value::characters>(), field<&Value::last_end>(), field<&Value::dropped>()};
};

template <>
struct StateOf<pty::AsciiFramer> : StateHeldBy<pty::AsciiFramer> {};

template <>
struct StateOf<pty::AsciiFrame> {
  using Value = pty::AsciiFrame;
  static constexpr auto fields = FieldList{field<&Value::bytes>(), field<&Value::rtu>(), field<&Value::end>(),
                                           field<&Value::last_character>()};
};

template <>
struct StateOf<pty::ReceivedText> {
  using Value = pty::ReceivedText;
  static constexpr auto fields = FieldList{field<&Value::what>(), field<&Value::text>(), field<&Value::end>(),
                                           field<&Value::last_character>()};
};

}  // namespace understudy
