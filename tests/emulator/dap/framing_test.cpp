// Bytes become messages however they arrive; what is not a frame is refused in the same way.
#include "emulator/dap/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::dap {
namespace framing_test {

struct Unframed {
  std::vector<std::string> messages;
  std::string error;
  bool is_empty = true;
  bool operator==(const Unframed&) const = default;
};

Unframed unframed(std::string_view bytes, std::size_t piece) {
  Unframed seen;
  Unframer unframer;
  try {
    while (!bytes.empty()) {
      unframer.push(bytes.substr(0, piece));
      bytes.remove_prefix(std::min(piece, bytes.size()));
      while (const auto message = unframer.take()) seen.messages.push_back(*message);
    }
  } catch (const FramingError& error) {
    seen.error = error.what();
  }
  seen.is_empty = unframer.is_empty();
  return seen;
}

/// Returns what comes out, which must not depend on how the bytes are cut.
Unframed unframed(const std::string& bytes) {
  const Unframed whole = unframed(bytes, bytes.size());
  for (const std::size_t piece : {1U, 2U, 7U, 1000U}) {
    const Unframed cut = unframed(bytes, piece);
    EXPECT_EQ(cut.messages, whole.messages) << piece;
    EXPECT_EQ(cut.error, whole.error) << piece;
  }
  return whole;
}

TEST(Unframer, TakesMessagesHoweverBytesAreCut) {
  const std::vector<std::string> messages{"{}", "", std::string("with\0zero\r\n\r\nand an end", 24), "last"};
  std::string bytes;
  for (const std::string& message : messages) bytes += framed(message);
  const Unframed seen = unframed(bytes);
  EXPECT_EQ(seen.messages, messages);
  EXPECT_TRUE(seen.is_empty);
  EXPECT_EQ(seen.error, "");
}

TEST(Unframer, ReadsOtherHeadersToo) {
  const Unframed seen = unframed("Content-Type: x\r\nContent-Length:   2\r\nMore: y\r\n\r\n{}");
  EXPECT_EQ(seen.messages, std::vector<std::string>{"{}"});
}

TEST(Unframer, WaitsForTheRestOfAMessage) {
  for (const std::string bytes : {"Content-Le", "Content-Length: 5\r\n", "Content-Length: 5\r\n\r\n1234"}) {
    const Unframed seen = unframed(bytes);
    EXPECT_TRUE(seen.messages.empty() && seen.error.empty() && !seen.is_empty) << bytes;
  }
}

TEST(Unframer, RefusesWrongLengths) {
  for (const std::string length : {"-1", "five", "", "5 bytes", "4194305", "99999999999999999999999"}) {
    EXPECT_EQ(unframed("Content-Length: " + length + "\r\n\r\n12345").error,
              "Content-Length: '" + length + "' is not a length; expected 0 to 4194304");
  }
  EXPECT_EQ(unframed("Content-Type: 5\r\n\r\n12345").error,
            "the header of a message has no Content-Length; expected \"Content-Length: N\"");
  EXPECT_EQ(unframed("\r\n\r\n").error,
            "the header of a message has no Content-Length; expected \"Content-Length: N\"");
}

TEST(Unframer, RefusesAHeadThatIsTooLong) {
  const std::string head = "Content-Length: 2\r\nMore: ";
  for (const bool ends : {false, true}) {
    const std::string bytes = head + std::string(2000, 'x') + (ends ? "\r\n\r\n{}" : "");
    EXPECT_EQ(unframed(bytes).error,
              "the header of a message has no end; expected at most 1024 bytes and an empty line");
  }
  const std::string longest = head + std::string(kLongestHead - head.size(), 'x');
  EXPECT_EQ(unframed(longest + "\r\n\r\n{}").messages, std::vector<std::string>{"{}"});
}

TEST(Unframer, TakesTheLongestMessage) {
  const std::string longest(kLongestMessage, 'x');
  const Unframed seen = unframed(framed(longest) + framed("{}"), 65536);
  EXPECT_EQ(seen.messages, (std::vector<std::string>{longest, "{}"}));
}

TEST(Unframer, TakesAFloodInOrder) {
  std::string bytes;
  for (int i = 0; i < 20'000; ++i) bytes += framed(std::to_string(i));
  const Unframed seen = unframed(bytes, 65536);
  ASSERT_EQ(seen.messages.size(), 20'000U);
  for (int i = 0; i < 20'000; ++i) ASSERT_EQ(seen.messages[static_cast<std::size_t>(i)], std::to_string(i));
}

}  // namespace framing_test
}  // namespace understudy::emulator::dap
