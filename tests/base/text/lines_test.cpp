#include "base/text/lines.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace understudy {
namespace lines_test {

struct Case {
  std::string_view text;
  std::vector<std::string> lines;
};

TEST(TextLines, OfAText) {
  const Case cases[] = {
      {"", {}},
      {"a", {"a"}},
      {"a\n", {"a"}},
      {"\n", {""}},
      {"\n\n", {"", ""}},
      {"a\nb", {"a", "b"}},
      {"a\n\nb\r\n", {"a", "", "b\r"}},
  };
  for (const Case& one : cases) {
    std::vector<std::string> lines;
    int number = 0;
    for (const TextLine line : TextLines(one.text)) {
      EXPECT_EQ(line.number, ++number) << one.text;
      lines.emplace_back(line.text);
    }
    EXPECT_EQ(lines, one.lines) << one.text;
  }
}

TEST(TextLines, BehindAByteOrderMark) {
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBFMP 1"), "MP 1");
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBF\xEF\xBB\xBFMP 1"), "\xEF\xBB\xBFMP 1");
  EXPECT_EQ(without_byte_order_mark("MP 1\xEF\xBB\xBF"), "MP 1\xEF\xBB\xBF");
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB"), "\xEF\xBB");
  EXPECT_EQ(without_byte_order_mark(""), "");
}

}  // namespace lines_test
}  // namespace understudy
