// Runs hosts in simulated time on a separate bench.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kBench =
    "understudy: 1\nlines:\n  rs485: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] }\n";

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class HostTime : public testing::Test {
 protected:
  Finished exec(const Words& command, const Words& flags = {}) const {
    Words words{"exec", bench_, "--host-time"};
    words.insert(words.end(), flags.begin(), flags.end());
    words.emplace_back("--");
    words.insert(words.end(), command.begin(), command.end());
    return understudy(words);
  }
  Finished python(const std::string& script, const Words& flags = {}) const {
    return exec({kPython, "-c", script}, flags);
  }
  /// Runs the script twice while the machine is loaded. Its output and the recording must be the same.
  Finished python_twice(const std::string& script, Words flags = {}) const {
    flags.emplace_back("--record");
    const auto run = [&](const char* recording) {
      Words all = flags;
      all.push_back(folder_ / recording);
      return python(script, all);
    };
    const std::string spin = "while :; do :; done";
    const Process first_load({"sh", "-c", spin});
    const Process second_load({"sh", "-c", spin});
    const Finished first = run("first");
    const Finished second = run("second");
    EXPECT_EQ(first.exit_code, 0) << first.errors;
    EXPECT_EQ(second.output, first.output);
    EXPECT_FALSE(text_of(folder_ / "first").empty());
    EXPECT_EQ(text_of(folder_ / "second"), text_of(folder_ / "first"));
    return first;
  }
  const PrivateFolder& folder() const { return folder_; }
  const std::string& bench() const { return bench_; }

 private:
  PrivateFolder folder_;
  std::string bench_ = folder_.write("bench.yaml", kBench);
};

}  // namespace host_time_test
}  // namespace understudy::acceptance
