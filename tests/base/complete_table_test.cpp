// A table with exactly one handler for each key, or none.
#include "base/complete_table.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace understudy {
namespace complete_table_test {

enum class Verb : unsigned char { go, stop, wait };
using Rows = std::vector<HandlerRow<Verb, int>>;

constexpr Verb kVerbs[] = {Verb::go, Verb::stop, Verb::go};
constexpr HandlerRow<Verb, int> kSome[] = {{Verb::stop, 2}};
constexpr HandlerRow<Verb, int> kOthers[] = {{Verb::go, 1}};
constexpr CompleteTable<Verb, int> kTable(kVerbs, kSome, kOthers);

/// The reason why the compiler would refuse a constexpr table of these rows.
std::string refusal(const Rows& rows, const Rows& more = {}) {
  try {
    const CompleteTable<Verb, int> table(kVerbs, rows, more);
    return "";
  } catch (const char* why) {
    return why;
  }
}

TEST(CompleteTable, EachKeyHasItsHandler) {
  static_assert(kTable[Verb::go] == 1 && kTable[Verb::stop] == 2);
  static_assert(kTable.has(Verb::go) && !kTable.has(Verb::wait) && kTable[Verb::wait] == 0);
  EXPECT_EQ(refusal({{Verb::go, 1}, {Verb::stop, 2}}), "");
}

TEST(CompleteTable, AForgottenKeyIsRefused) {
  EXPECT_EQ(refusal({{Verb::go, 1}}), "a key has no handler");
  EXPECT_EQ(refusal({}), "a key has no handler");
}

TEST(CompleteTable, ADoubledKeyIsRefused) {
  EXPECT_EQ(refusal({{Verb::go, 1}, {Verb::stop, 2}, {Verb::go, 1}}), "a key has two handlers");
  EXPECT_EQ(refusal({{Verb::go, 1}, {Verb::stop, 2}}, {{Verb::stop, 3}}), "a key has two handlers");
}

TEST(CompleteTable, AHandlerOfNoKeyIsRefused) {
  EXPECT_EQ(refusal({{Verb::go, 1}, {Verb::stop, 2}, {Verb::wait, 3}}), "a handler has an unknown key");
}

}  // namespace complete_table_test
}  // namespace understudy
