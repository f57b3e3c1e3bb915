#include "base/files/background_writer.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <future>

namespace understudy {
namespace background_writer_test {

using Outcome = BackgroundWriter::Outcome;

TEST(BackgroundWriter, WritesEveryPieceInOrderAndWhole) {
  std::vector<std::string> written;
  BackgroundWriter writer(1 << 20, [&](std::string_view piece) {
    written.emplace_back(piece);
    return 0;
  });
  std::vector<std::string> given;
  for (int i = 0; i < 10'000; ++i) {
    given.push_back("piece " + std::to_string(i));
    ASSERT_EQ(writer.append(given.back()), Outcome::taken);
  }
  writer.finish();
  EXPECT_EQ(written, given);
  EXPECT_EQ(writer.failure().error, 0);
}

TEST(BackgroundWriter, NeverWaitsForASlowDiskAndBoundsWhatWaits) {
  std::promise<void> go_on;
  std::shared_future<void> may_go_on = go_on.get_future().share();
  std::promise<void> writing;
  std::string written;
  BackgroundWriter writer(10, [&](std::string_view piece) {
    if (written.empty()) writing.set_value();
    may_go_on.wait();
    written += piece;
    return 0;
  });
  EXPECT_EQ(writer.append("aaaa"), Outcome::taken);
  writing.get_future().wait();
  EXPECT_EQ(writer.append("bbbb"), Outcome::taken);
  EXPECT_EQ(writer.append("cccc"), Outcome::taken);
  EXPECT_EQ(writer.append("dddd"), Outcome::full) << "8 of 10 bytes are taken already";
  EXPECT_EQ(writer.append("ee"), Outcome::taken) << "a piece that fits is accepted all the same";
  go_on.set_value();
  writer.finish();
  EXPECT_EQ(written, "aaaabbbbccccee");
}

TEST(BackgroundWriter, EndsAtTheFirstErrorAndCountsWhatIsLost) {
  std::promise<void> go_on;
  std::shared_future<void> may_go_on = go_on.get_future().share();
  std::string written;
  BackgroundWriter writer(100, [&](std::string_view piece) {
    may_go_on.wait();
    if (piece == "c") return ENOSPC;
    written += piece;
    return 0;
  });
  for (const char* piece : {"a", "b", "c", "d", "e"}) EXPECT_EQ(writer.append(piece), Outcome::taken);
  go_on.set_value();
  while (writer.failure().error == 0) std::this_thread::yield();
  EXPECT_EQ(writer.append("f"), Outcome::failed);
  writer.finish();
  EXPECT_EQ(written, "ab");
  EXPECT_EQ(writer.failure().error, ENOSPC);
  EXPECT_EQ(writer.failure().lost, 3U);
}

TEST(BackgroundWriter, FinishesAtOnceWhenThereIsNothing) {
  BackgroundWriter writer(100, [](std::string_view) { return 0; });
  writer.finish();
  writer.finish();
}

}  // namespace background_writer_test
}  // namespace understudy
