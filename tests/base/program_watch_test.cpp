// Observers of a program.
#include "base/program_watch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace understudy {
namespace program_watch_test {

class Notes final : public ProgramWatch {
 public:
  Notes(std::string& text, char name) : text_(text), name_(name) {}
  void program_loaded(std::uint64_t mark) override { note("look " + std::to_string(mark)); }
  void runs(int part, int line, std::int64_t times) override {
    note("runs " + std::to_string(part) + " " + std::to_string(line) + " " + std::to_string(times));
  }
  void decides(int part, int line, bool outcome, std::int64_t times) override {
    note("decides " + std::to_string(part) + " " + std::to_string(line) + (outcome ? " yes " : " no ") +
         std::to_string(times));
  }

 private:
  void note(const std::string& what) { text_ += std::string(1, name_) + ": " + what + "\n"; }

  std::string& text_;
  char name_;
};

TEST(ProgramWatches, NotifyEachOfThemOfEverythingInOrder) {
  std::string text;
  Notes first(text, 'a');
  Notes second(text, 'b');
  ProgramWatches watches;
  watches.add(first);
  watches.add(second);
  ProgramWatch* const reported = watches.watch();
  reported->program_loaded(7);
  reported->runs(1, 2, 3);
  reported->decides(4, 5, true, 6);
  EXPECT_EQ(
      text,
      "a: look 7\nb: look 7\na: runs 1 2 3\nb: runs 1 2 3\na: decides 4 5 yes 6\nb: decides 4 5 yes 6\n");
}

TEST(ProgramWatches, AreNobodyOrTheOnlyOne) {
  std::string text;
  Notes first(text, 'a');
  Notes second(text, 'b');
  ProgramWatches watches;
  EXPECT_EQ(watches.watch(), nullptr);
  watches.add(first);
  EXPECT_EQ(watches.watch(), &first);
  watches.add(second);
  EXPECT_EQ(watches.watch(), &watches);
  watches.remove(first);
  EXPECT_EQ(watches.watch(), &second);
  watches.remove(second);
  EXPECT_EQ(watches.watch(), nullptr);
}

}  // namespace program_watch_test
}  // namespace understudy
