#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

/// Results as JUnit XML: a test suite for each file, a test case for each scenario or branch. Times are
/// simulated seconds; the steps and the lint's findings are in system-out. Of cases that `vary` made, it is
/// left out where they passed, or failed like one before.
/// The counts stand in front of what they count, so results wait in a file that has no name.
class Junit {
 public:
  /// Throws std::system_error if there is no room for them.
  Junit();
  void add(const ScenarioResult& result);
  /// Gives the whole text away, piece by piece.
  void write(const std::function<void(std::string_view)>& take);

 private:
  struct Piece {
    long begin = 0;  // in the file
    long end = 0;
  };
  struct Suite {
    std::string file;
    Tally tally{};
    std::vector<Piece> pieces{};
  };
  [[noreturn]] static void fail();

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> waiting_;
  long end_ = 0;
  std::vector<Suite> suites_;  // in the order of their first results
  std::map<std::string, std::size_t> numbers_;
  Tally all_;
};

std::string junit_text(std::span<const ScenarioResult> results);

/// For XML, in attributes as well: what XML cannot hold (control characters, broken UTF-8) becomes U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace understudy::emulator::play
