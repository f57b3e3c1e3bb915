#include "base/text/parse_integer.h"

#include <gtest/gtest.h>

namespace understudy {
namespace parse_integer_test {

TEST(ParseInteger, TakesWhatPeopleWrite) {
  struct {
    const char* text;
    std::int64_t value;
  } const cases[] = {{"0", 0},
                     {"12", 12},
                     {"-12", -12},
                     {"0x0C", 12},
                     {"-0x0c", -12},
                     {"007", 7},
                     {"9223372036854775807", INT64_MAX},
                     {"-9223372036854775807", -INT64_MAX},
                     {"0x7FFFFFFFFFFFFFFF", INT64_MAX}};
  for (const auto& c : cases) EXPECT_EQ(parse_integer(c.text), c.value) << c.text;
}

TEST(ParseInteger, RefusesWhatIsNoWholeNumber) {
  for (const char* text : {"", "-", "0x", "-0x", "--1", "0x-1", "+1", " 1", "1 ", "1.0", "1e3", "x", "12a",
                           "0xG", "9223372036854775808", "0x10000000000000000"}) {
    EXPECT_FALSE(parse_integer(text)) << text;
  }
}

}  // namespace parse_integer_test
}  // namespace understudy
