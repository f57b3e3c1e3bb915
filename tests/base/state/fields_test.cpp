// Fields by name: an incomplete list does not compile, and a list shows where two values differ.
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

struct Shelf {
  std::string label{};
  std::map<std::int32_t, Lamp> lamps{};
  std::array<std::uint8_t, 3> drawers{};
};

/// A type that is saved in another form than in memory, and that cannot be copied.
class Ring {
 public:
  Ring() = default;
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;
  std::size_t size() const { return 2; }
  std::uint8_t operator[](std::size_t i) const { return items_[(first_ + i) % 2]; }
  void turn() { first_ = 1 - first_; }
  void set(std::size_t i, std::uint8_t value) { items_[i] = value; }

 private:
  friend struct StateOf<Ring>;
  std::array<std::uint8_t, 2> items_{1, 2};
  std::size_t first_ = 0;
};

/// A type of which only some members are state.
class Counter {
 public:
  Counter() = default;
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  std::int32_t count = 0;
  bool runs = false;

 private:
  friend struct StateOf<Counter>;
  [[maybe_unused]] int watchers_ = 0;
};

inline std::string drawer(std::size_t number) { return number == 2 ? "lowest" : std::to_string(number); }

}  // namespace fields_test

template <>
struct StateOf<fields_test::Colour> {
  static constexpr auto last = fields_test::Colour::green;
};
template <>
struct StateOf<fields_test::Lamp> {
  static constexpr auto fields =
      FieldList{field<&fields_test::Lamp::colour>(), field<&fields_test::Lamp::brightness>()};
  static void check(const fields_test::Lamp& lamp) {
    require_state(lamp.brightness >= 0, "a lamp must not be darker than dark");
  }
};
template <>
struct StateOf<fields_test::Panel> {
  using Panel = fields_test::Panel;
  static constexpr auto fields =
      FieldList{field<&Panel::is_on>(), field<&Panel::number>(), field<&Panel::spare>(),
                field<&Panel::lamps>(), field<&Panel::bytes>(),  field<&Panel::since>()};
};

template <>
struct StateOf<fields_test::Shelf> {
  using Shelf = fields_test::Shelf;
  static constexpr auto fields =
      FieldList{field<&Shelf::label>(), field<&Shelf::lamps>(), field<&Shelf::drawers>(fields_test::drawer)};
};
template <>
struct StateOf<fields_test::Ring> {
  static void write(const fields_test::Ring& ring, StateWriter& writer) {
    for (std::size_t i = 0; i < ring.size(); ++i) writer.write(ring[i]);
  }
  static void read(fields_test::Ring& ring, StateReader& reader) {
    reader.read(ring.items_);
    ring.first_ = 0;
  }
};
template <>
struct StateOf<fields_test::Counter> {
  using Counter = fields_test::Counter;
  static constexpr auto fields = FieldList{field<&Counter::runs>(), field<&Counter::count>()};
  static constexpr std::size_t members = 3;
  static constexpr std::size_t apart = 1;
};

namespace fields_test {

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
  writer.write(panel);
  return writer.take();
}

std::string refusal_of(const std::vector<std::byte>& bytes) {
  Panel panel;
  StateReader reader(bytes);
  try {
    reader.read(panel);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

TEST(Fields, MembersAreCountedWhateverTheyAre) {
  static_assert(state_fields::has_members<Lamp, 2>());
  static_assert(!state_fields::has_members<Lamp, 1>() && !state_fields::has_members<Lamp, 3>());
  static_assert(state_fields::has_members<Panel, 6>());
  static_assert(!state_fields::has_members<Panel, 5>() && !state_fields::has_members<Panel, 7>());
  static_assert(std::remove_cvref_t<decltype(fields_of<Panel>())>::count == 6);
}

TEST(Fields, AreSavedInTheOrderOfTheirListAndComeBack) {
  const std::vector<std::byte> bytes = bytes_of(a_panel());
  EXPECT_EQ(bytes.front(), std::byte{1}) << "is_on is first in the list, not in memory";
  EXPECT_EQ(bytes[1], std::byte{7});
  Panel restored;
  StateReader reader(bytes);
  reader.read(restored);
  reader.require_end();
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
  EXPECT_EQ(refusal_of(no_colour), "an enumeration has a value that does not exist");
  Panel dark = a_panel();
  dark.lamps[1].brightness = -1;
  EXPECT_EQ(refusal_of(bytes_of(dark)), "a lamp must not be darker than dark");
}

TEST(Difference, IsReportedByTheNamesOfTheFields) {
  struct Case {
    void (*change)(Panel& panel);
    const char* reported;
  };
  for (const auto& [change, reported] : {
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
    EXPECT_EQ(first_difference(a_panel(), other), reported);
  }
}

TEST(Difference, OfTextMapsAndNamedElements) {
  using fields_test::Shelf;
  const Shelf shelf{.label = "left", .lamps = {{3, {Colour::green, 1}}, {5, {}}}, .drawers = {0, 1, 2}};
  struct Case {
    void (*change)(Shelf& shelf);
    const char* reported;
  };
  for (const auto& [change, reported] : {
           Case{[](Shelf&) {}, ""},
           Case{[](Shelf& s) { s.label = "l\"\r"; }, R"(label: "left" against "l\x22\x0d")"},
           Case{[](Shelf& s) { s.lamps.erase(5); }, "lamps[5]: something against nothing"},
           Case{[](Shelf& s) { s.lamps.erase(3); }, "lamps[3]: something against nothing"},
           Case{[](Shelf& s) { s.lamps[4]; }, "lamps[4]: nothing against something"},
           Case{[](Shelf& s) { s.lamps[9]; }, "lamps[9]: nothing against something"},
           Case{[](Shelf& s) { s.lamps[5].brightness = 2; }, "lamps[5].brightness: 0 against 2"},
           Case{[](Shelf& s) { s.drawers[1] = 8; }, "drawers[1]: 1 against 8"},
           Case{[](Shelf& s) { s.drawers[2] = 8; }, "drawers[lowest]: 2 against 8"},
       }) {
    Shelf other = shelf;
    change(other);
    EXPECT_EQ(first_difference(shelf, other), reported);
  }
}

TEST(Difference, OfWhatSavesItselfIsOfWhatIsInIt) {
  using fields_test::Ring;
  Ring one;
  Ring other;
  one.turn();
  one.set(1, 1);
  one.set(0, 2);
  EXPECT_EQ(first_difference(one, other), "") << "its position does not matter";
  other.set(1, 9);
  EXPECT_EQ(first_difference(one, other, "ring"), "ring[1]: 2 against 9");
  StateWriter writer;
  writer.write(other);
  const std::vector<std::byte> bytes = writer.take();
  EXPECT_EQ(bytes, (std::vector<std::byte>{std::byte{1}, std::byte{9}}));
  StateReader reader(bytes);
  reader.read(one);
  EXPECT_EQ(first_difference(one, other), "");
}

TEST(Fields, OfAClassThatCannotBeCopiedAreReadAndThenPutInForce) {
  using fields_test::Counter;
  Counter counter;
  const CopiedFields<Counter> before = copy_fields(counter);
  counter.count = 5;
  EXPECT_EQ(difference_of_copies<Counter>(before, copy_fields(counter), "a"), "a.count: 0 against 5");
  assign_fields(counter, CopiedFields<Counter>{true, 8});
  EXPECT_TRUE(counter.runs);
  EXPECT_EQ(counter.count, 8);
}

TEST(Difference, BeginsWithThePathThatIsAskedFor) {
  Panel other = a_panel();
  other.number = 0;
  EXPECT_EQ(first_difference(a_panel(), other, "door.panel"), "door.panel.number: 7 against 0");
}

}  // namespace fields_test
}  // namespace understudy
