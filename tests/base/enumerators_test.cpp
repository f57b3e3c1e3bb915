// Which numbers of an enumeration have names.
#include "base/enumerators.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace understudy {
namespace enumerators_test {

enum class Colour : std::uint8_t { red, green };
enum class Sparse : std::uint8_t { one = 1, seven = 7, max = 255 };

namespace {
enum class Hidden : std::uint8_t { first, second };
}  // namespace

TEST(Enumerators, AreDistinguishedFromNumbersWithoutAName) {
  static_assert(has_name<Colour::red>() && has_name<Colour::green>());
  static_assert(has_name<static_cast<Colour>(1)>() && !has_name<static_cast<Colour>(2)>());
  static_assert(!is_last<Colour::red>() && is_last<Colour::green>());
  static_assert(!has_name<static_cast<Sparse>(0)>() && has_name<Sparse::seven>() && has_name<Sparse::max>());
  static_assert(has_name<Hidden::second>() && !is_last<Hidden::first>() && is_last<Hidden::second>());
}

}  // namespace enumerators_test
}  // namespace understudy
