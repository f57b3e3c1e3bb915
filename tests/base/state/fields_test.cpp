// Fields by name: a list is complete or does not compile, and tells where two values differ.
#include "base/state/fields.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"

namespace understudy {

namespace fields_test {

enum class Colour : std::uint8_t { red, green };

struct Lamp {
  Colour colour = Colour::red;
  double brightness = 0;
};

struct Panel {
  std::int32_t number = 0;
  std::optional<std::int32_t> spare{};
  std::array<Lamp, 2> lamps{};
  std::vector<std::uint8_t> bytes{};
  std::chrono::nanoseconds since{0};
  bool is_on = false;
};

}  // namespace fields_test

template <>
struct StateOf<fields_test::Colour> {
  static constexpr auto last = fields_test::Colour::green;
};
template <>
struct StateOf<fields_test::Lamp> {
  static constexpr auto fields = std::tuple{field("colour", &fields_test::Lamp::colour),
                                            field("brightness", &fields_test::Lamp::brightness)};
  static void check(const fields_test::Lamp& lamp) {
    demand_state(lamp.brightness >= 0, "a lamp must not be darker than dark");
  }
};
template <>
struct StateOf<fields_test::Panel> {
  using Panel = fields_test::Panel;
  static constexpr auto fields = std::tuple{field("is_on", &Panel::is_on), field("number", &Panel::number),
                                            field("spare", &Panel::spare), field("lamps", &Panel::lamps),
                                            field("bytes", &Panel::bytes), field("since", &Panel::since)};
};

namespace fields_test {

using fields_test::Colour;
using fields_test::Lamp;
using fields_test::Panel;

Panel a_panel() {
  return {.number = 7,
          .spare = -1,
          .lamps = {{{Colour::green, 0.5}, {Colour::red, 1.5}}},
          .bytes = {1, 2, 3},
          .since = std::chrono::nanoseconds(12),
          .is_on = true};
}

std::vector<std::byte> bytes_of(const Panel& panel) {
  StateWriter writer;
  writer.put_value(panel);
  return writer.take();
}

std::string refusal_of(const std::vector<std::byte>& bytes) {
  Panel panel;
  StateReader reader(bytes);
  try {
    reader.take_value(panel);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

TEST(Fields, MembersAreCountedWhateverTheyAre) {
  static_assert(state_fields::member_count<Lamp>() == 2);
  static_assert(state_fields::member_count<Panel>() == 6);
  static_assert(std::tuple_size_v<std::remove_cvref_t<decltype(fields_of<Panel>())>> == 6);
}

TEST(Fields, AreSavedInTheOrderOfTheirListAndComeBack) {
  const std::vector<std::byte> bytes = bytes_of(a_panel());
  EXPECT_EQ(bytes.front(), std::byte{1}) << "is_on is first in the list, not in memory";
  EXPECT_EQ(bytes[1], std::byte{7});
  Panel restored;
  StateReader reader(bytes);
  reader.take_value(restored);
  reader.demand_end();
  EXPECT_EQ(first_difference(restored, a_panel()), "");
  EXPECT_EQ(bytes_of(restored), bytes);
}

TEST(Fields, WhatNoValueCanBeIsRefused) {
  std::vector<std::byte> torn = bytes_of(a_panel());
  torn.pop_back();
  EXPECT_EQ(refusal_of(torn), "the bytes end too early");
  std::vector<std::byte> no_colour = bytes_of(a_panel());
  const std::size_t at_colour = 1 + 4 + 1 + 4;
  no_colour[at_colour] = std::byte{2};
  EXPECT_EQ(refusal_of(no_colour), "an enumeration has no such value");
  Panel dark = a_panel();
  dark.lamps[1].brightness = -1;
  EXPECT_EQ(refusal_of(bytes_of(dark)), "a lamp must not be darker than dark");
}

TEST(Difference, IsToldByTheNamesOfTheFields) {
  struct Case {
    void (*change)(Panel& panel);
    const char* told;
  };
  for (const auto& [change, told] : {
           Case{[](Panel&) {}, ""},
           Case{[](Panel& p) { p.number = 8; }, "number: 7 against 8"},
           Case{[](Panel& p) { p.spare.reset(); }, "spare: something against nothing"},
           Case{[](Panel& p) { p.spare = 3; }, "spare: -1 against 3"},
           Case{[](Panel& p) { p.lamps[1].brightness = 0.25; }, "lamps[1].brightness: 1.5 against 0.25"},
           Case{[](Panel& p) { p.lamps[0].colour = Colour::red; }, "lamps[0].colour: 1 against 0"},
           Case{[](Panel& p) { p.bytes.pop_back(); }, "bytes: 3 elements against 2 elements"},
           Case{[](Panel& p) { p.bytes[2] = 9; }, "bytes[2]: 3 against 9"},
           Case{[](Panel& p) { p.since += std::chrono::nanoseconds(1); }, "since: 12 against 13"},
           Case{[](Panel& p) {
                  p.is_on = false;
                  p.number = 1;
                },
                "is_on: true against false"},
       }) {
    Panel other = a_panel();
    change(other);
    EXPECT_EQ(first_difference(a_panel(), other), told);
  }
}

TEST(Difference, BeginsWithThePathThatIsAskedFor) {
  Panel other = a_panel();
  other.number = 0;
  EXPECT_EQ(first_difference(a_panel(), other, "door.panel"), "door.panel.number: 7 against 0");
}

}  // namespace fields_test
}  // namespace understudy
