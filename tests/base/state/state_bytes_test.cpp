// Bytes written by hand: how a value of each kind is written, what is refused, and the published examples of
// the codes.
#include "base/state/state_bytes.h"

#include <gtest/gtest.h>

#include <string_view>

#include "base/state/base64.h"

namespace understudy {

namespace state_bytes_test {

enum class Colour : std::uint8_t { red, green, blue };

struct Point {
  std::int16_t x = 0;
  std::int16_t y = 0;
  bool operator==(const Point&) const = default;
};

/// One member of every kind.
struct Sample {
  std::uint8_t byte = 0;
  std::int32_t number = 0;
  bool yes = false;
  Colour colour = Colour::red;
  double real = 0;
  std::chrono::nanoseconds time{0};
  std::optional<std::uint16_t> maybe;
  std::array<std::uint16_t, 2> pair{};
  std::vector<Point> points;
  std::map<std::uint8_t, std::uint8_t> entries;
  bool operator==(const Sample&) const = default;
};

class Secret {
 public:
  Secret() = default;
  explicit Secret(std::uint8_t value) : value_(value) {}
  std::uint8_t value() const { return value_; }

 private:
  friend struct understudy::StateOf<Secret>;
  std::uint8_t value_ = 0;
};

}  // namespace state_bytes_test

template <>
struct StateOf<state_bytes_test::Colour> {
  static constexpr auto last = state_bytes_test::Colour::blue;
};
template <>
struct StateOf<state_bytes_test::Point> {
  using Value = state_bytes_test::Point;
  static constexpr auto fields = FieldList{field<&Value::x>(), field<&Value::y>()};
  static void check(const Value& point) { require_within(point.x, -100, 100); }
};
template <>
struct StateOf<state_bytes_test::Sample> {
  using Value = state_bytes_test::Sample;
  static constexpr auto fields = FieldList{
      field<&Value::byte>(),   field<&Value::number>(), field<&Value::yes>(),   field<&Value::colour>(),
      field<&Value::real>(),   field<&Value::time>(),   field<&Value::maybe>(), field<&Value::pair>(),
      field<&Value::points>(), field<&Value::entries>()};
};
template <>
struct StateOf<state_bytes_test::Secret> {
  using Value = state_bytes_test::Secret;
  static constexpr auto fields = FieldList{field<&Value::value_>()};
  static constexpr std::size_t members = 1;
};

namespace state_bytes_test {

using namespace std::chrono_literals;

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> made;
  for (const int value : values) made.push_back(static_cast<std::byte>(value));
  return made;
}

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

template <class T>
std::vector<std::byte> saved(const T& value) {
  StateWriter writer;
  writer.write(value);
  return writer.take();
}

template <class T>
T restored(const std::vector<std::byte>& from) {
  StateReader reader(from);
  T value;
  reader.read(value);
  reader.require_end();
  return value;
}

template <class T>
std::string refusal(const std::vector<std::byte>& from) {
  try {
    restored<T>(from);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

// 1.5 is 0x3FF8 and twelve zeros. A vector, a map and an optional begin with their count, in 32 bits, or with
// a flag.
const Sample kSample{.byte = 0xAB,
                     .number = -2,
                     .yes = true,
                     .colour = Colour::blue,
                     .real = 1.5,
                     .time = 0x0102ns,
                     .maybe = 0x1234,
                     .pair = {1, 0x8000},
                     .points = {{.x = 3, .y = -1}},
                     .entries = {{7, 8}, {9, 10}}};

std::vector<std::byte> sample_bytes() {
  return bytes({0xAB,                                      // byte
                0xFE, 0xFF, 0xFF, 0xFF,                    // number
                1,    2,                                   // yes, blue
                0,    0,    0,    0,    0, 0, 0xF8, 0x3F,  // real
                2,    1,    0,    0,    0, 0, 0,    0,     // time
                1,    0x34, 0x12,                          // maybe
                1,    0,    0,    0x80,                    // pair
                1,    0,    0,    0,    3, 0, 0xFF, 0xFF,  // points
                2,    0,    0,    0,    7, 8, 9,    10});  // entries
}

TEST(StateBytes, AreLittleEndianAndWithoutPadding) {
  EXPECT_EQ(saved(kSample), sample_bytes());
  EXPECT_EQ(restored<Sample>(sample_bytes()), kSample);
  EXPECT_EQ(saved(Sample{}).size(), 1u + 4 + 1 + 1 + 8 + 8 + 1 + 4 + 4 + 4);
  EXPECT_EQ(restored<Sample>(saved(Sample{})), Sample{});
  EXPECT_EQ(saved(Secret(5)), bytes({5}));
  EXPECT_EQ(restored<Secret>(bytes({5})).value(), 5);
}

TEST(StateBytes, WhatATypeCannotBeIsRefused) {
  EXPECT_EQ(refusal<bool>(bytes({2})), "a boolean must be 0 or 1");
  EXPECT_EQ(refusal<Colour>(bytes({3})), "an enumeration has a value that does not exist");
  EXPECT_EQ(refusal<Colour>(bytes({2})), "");
  EXPECT_EQ(refusal<Point>(bytes({100, 0, 0, 0})), "");
  EXPECT_EQ(refusal<Point>(bytes({101, 0, 0, 0})), "a number is out of range");
  EXPECT_EQ(refusal<Point>(bytes({0x9C, 0xFF, 0, 0})), "");  // -100
  EXPECT_EQ(refusal<Point>(bytes({0x9B, 0xFF, 0, 0})), "a number is out of range");
  EXPECT_EQ(refusal<std::uint32_t>(bytes({1, 2, 3, 4, 5})), "bytes are left over");
  // Four thousand million elements: refused before memory is allocated for them.
  EXPECT_EQ(refusal<std::vector<Point>>(bytes({0xFF, 0xFF, 0xFF, 0xFF, 0})), "the bytes end too early");
  using Map = std::map<std::uint8_t, std::uint8_t>;
  EXPECT_EQ(refusal<Map>(bytes({2, 0, 0, 0, 7, 8, 7, 8})), "its entries are out of order");
  EXPECT_EQ(refusal<Map>(bytes({2, 0, 0, 0, 9, 8, 7, 8})), "its entries are out of order");
  const std::vector<std::byte> whole = sample_bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(refusal<Sample>({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}),
              "the bytes end too early")
        << size;
  }
}

// http://www.isthe.com/chongo/tech/comp/fnv/: test vectors of FNV-1a, 64 bits.
TEST(StateBytes, TheHashIsFnv1a) {
  EXPECT_EQ(hash_of({}), 0xcbf29ce484222325u);
  EXPECT_EQ(hash_of(bytes_of("a")), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hash_of(bytes_of("foobar")), 0x85944171f73967e8u);
  EXPECT_EQ(hash_of(bytes_of("bar"), hash_of(bytes_of("foo"))), 0x85944171f73967e8u);
}

// RFC 4648, section 10.
TEST(Base64, IsThatOfItsStandard) {
  const std::pair<std::string_view, std::string_view> cases[] = {{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, text] : cases) {
    EXPECT_EQ(to_base64(bytes_of(plain)), text);
    const auto back = from_base64(text);
    ASSERT_TRUE(back) << text;
    EXPECT_TRUE(std::equal(back->begin(), back->end(), bytes_of(plain).begin(), bytes_of(plain).end()));
  }
  // The last two digits of the alphabet: 111110 111111 ... is 0xFB 0xFF.
  EXPECT_EQ(to_base64(bytes({0xFB, 0xFF, 0xFF})), "+///");
  EXPECT_EQ(from_base64("+///"), bytes({0xFB, 0xFF, 0xFF}));
}

TEST(Base64, OtherTextIsRefused) {
  for (const std::string_view text : {"Z", "Zg", "Zg=", "Zg==Zg==", "Z===", "====", "Zm9v\n", "Zm 9", "Zm9_",
                                      "=m9v", "Zm=v", "Zh==", "Zm9="}) {
    EXPECT_EQ(from_base64(text), std::nullopt) << text;
  }
}

}  // namespace state_bytes_test
}  // namespace understudy
