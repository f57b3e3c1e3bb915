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

/// Writes results as JUnit XML: a test suite for each file, a test case for each scenario or branch. Times
/// are simulated seconds. The steps and the lint findings are in system-out. Cases from `vary` have no
/// system-out if they passed, or if they failed like an earlier case. In JUnit, counts precede the results,
/// so the results are kept in an unnamed file until the end.
class Junit {
 public:
  /// Throws std::system_error if there is no space for the results.
  Junit();
  void add(const ScenarioResult& result);
  /// Passes the whole text to `take` in pieces.
  void write(const std::function<void(std::string_view)>& take);

 private:
  struct Piece {
    long begin = 0;  // position in the file
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

/// Escapes a text for XML, including attributes. Characters that XML cannot contain (control characters,
/// invalid UTF-8) become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace understudy::emulator::play
