// `understudy tap` on lines that the test speaks on, and `compare --follow` of what it writes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "pty/rtu_crc.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace tap_test {

using nlohmann::json;
using Frame = std::vector<std::uint8_t>;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Frame frame(Frame bytes) {
  pty::append_rtu_crc(bytes);
  return bytes;
}
const Frame kRequest = frame({1, 3, 0, 1, 0, 1});  // HW_Code
const Frame kReply = frame({1, 3, 2, 0xC0, 0x01});
const Frame kOtherReply = frame({1, 3, 2, 0x12, 0x34});

/// The end of a line at which the test speaks. An adapter is at the other end.
class Wire {
 public:
  Wire() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    ::grantpt(master_.get());
    ::unlockpt(master_.get());
    path_ = ::ptsname(master_.get());
  }
  const std::string& path() const { return path_; }
  void say(const Frame& bytes) const {
    ASSERT_EQ(::write(master_.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  bool has_heard_something() const {
    std::uint8_t byte = 0;
    return ::read(master_.get(), &byte, 1) > 0;
  }

 private:
  Descriptor master_;
  std::string path_;
};

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(30)); }

/// A host asks and a controller replies, on one wire or on two.
void converse(const Wire& host, const Wire& box, const Frame& reply = kReply) {
  host.say(kRequest);
  pause();
  box.say(reply);
  pause();
}

std::string bench_in(const PrivateFolder& folder) {
  return folder.write(
      "bench.yaml",
      "understudy: 1\nlines:\n  line:\n    stations:\n      - { name: box, model: simple2-r3 }\n");
}

class Tap {
 public:
  explicit Tap(const Words& arguments) : process_(words(arguments)) {
    EXPECT_TRUE(eventually([&] { return has(process_.output(), "listening: "); })) << process_.errors();
  }
  /// Returns true if no descriptor of a port can be written to.
  bool only_reads(const std::string& port) const {
    const std::string folder = "/proc/" + std::to_string(process_.pid());
    for (const auto& entry : std::filesystem::directory_iterator(folder + "/fd")) {
      std::error_code error;
      if (std::filesystem::read_symlink(entry.path(), error) != port) continue;
      std::ifstream info(folder + "/fdinfo/" + entry.path().filename().string());
      for (std::string word; info >> word;)
        if (word == "flags:" && info >> word) return (std::stoi(word, nullptr, 8) & O_ACCMODE) == O_RDONLY;
    }
    return false;
  }
  /// Ends it as Ctrl-C does. Returns what it has printed.
  std::string end() {
    process_.send(SIGINT);
    EXPECT_EQ(process_.wait(kPatience), 0) << process_.errors();
    return process_.output();
  }

 private:
  static Words words(const Words& arguments) {
    Words all{UNDERSTUDY_BINARY, "tap"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  Process process_;
};

json compared(const std::string& capture, const std::string& bench) {
  const Finished finished = understudy({"compare", capture, "--bench", bench, "--format", "json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  return json::parse(finished.output, nullptr, false)[0];
}

TEST(Tap, WritesWhatOneOrTwoAdaptersHear) {
  for (const std::string ending : {".txt", ".pcapng"}) {
    for (const bool is_alone : {true, false}) {
      const PrivateFolder folder;
      const Wire host;
      const Wire box;
      const Wire& second = is_alone ? host : box;
      const std::string capture = folder / ("heard" + ending);
      Words arguments{host.path(), "-o", capture};
      if (!is_alone) arguments.insert(arguments.begin(), box.path());  // which is which, the frames tell
      Tap tap(arguments);
      EXPECT_TRUE(tap.only_reads(host.path()));
      for (int i = 0; i < 9; ++i) converse(host, second);
      const std::string summary = tap.end();
      EXPECT_TRUE(has(summary, std::to_string(is_alone ? 18 : 9) + " Modbus frames")) << summary;
      EXPECT_FALSE(host.has_heard_something() || box.has_heard_something());
      const json report = compared(capture, bench_in(folder));
      EXPECT_EQ(report["exchanges"], 9) << report;
      EXPECT_EQ(report["different"], 0) << report;
      EXPECT_TRUE(has(report["notes"].dump(), "were distinguished by their frames")) << report;
    }
  }
}

TEST(Tap, IsFollowedByAComparison) {
  const PrivateFolder folder;
  const Wire wire;
  const std::string capture = folder / "heard.txt";
  Tap tap({wire.path(), "-o", capture});
  Process follower(
      {UNDERSTUDY_BINARY, "compare", capture, "--bench", bench_in(folder), "--power-up", "--follow"});
  for (int i = 0; i < 3; ++i) converse(wire, wire);
  converse(wire, wire, kOtherReply);
  // A reply is judged when the host has asked again.
  EXPECT_TRUE(eventually([&] {
    converse(wire, wire);
    return has(follower.output(), "controller: box.HW_Code = 4660; bench: box.HW_Code = 49153");
  })) << follower.output()
      << follower.errors();
  follower.send(SIGINT);
  EXPECT_EQ(follower.wait(kPatience), 1);
  EXPECT_TRUE(has(follower.output(), "1 different")) << follower.output();
  EXPECT_TRUE(has(follower.output(), "first difference: " + capture)) << follower.output();
  tap.end();
}

TEST(Tap, SaysWhenItHearsNoFrame) {
  const PrivateFolder folder;
  const Wire wire;
  Tap tap({wire.path() + ",9600,8N1", "-o", folder / "heard.txt"});
  wire.say({0x55, 0x00, 0x55});
  pause();
  const std::string summary = tap.end();
  EXPECT_TRUE(has(summary, ": 3 bytes, 0 Modbus frames")) << summary;
  EXPECT_TRUE(has(summary, "check the speed and framing (9600 8N1)")) << summary;
}

TEST(Tap, RefusesWhatItCannotDoInOneLine) {
  const PrivateFolder folder;
  const Wire wire;
  const std::string to = folder / "heard.txt";
  const struct {
    Words words;
    int exit_code;
    std::string what;
  } cases[] = {
      {{folder / "none", "-o", to}, 3, "No such file or directory; expected a serial port"},
      {{"modbus-tcp://127.0.0.1:502", "-o", to}, 2, "a gateway does not pass on other masters' requests"},
      {{wire.path() + ",fast", "-o", to}, 2, "'fast' is not a speed"},
      {{wire.path(), "-o", folder / "heard.pcap"}, 2, "expected .pcapng"},
      {{wire.path(), "-o", bench_in(folder)}, 3, "it is a bench; expected a capture to replace"},
      {{wire.path(), "-o", to, "--line", "a b"}, 2, "is not a name; expected one word"},
      {{wire.path()}, 2, "--output"},
      {{wire.path(), wire.path() + ",9600", "-o", to}, 2, "is the same port as the first"},
  };
  for (const auto& row : cases) {
    Words words{"tap"};
    words.insert(words.end(), row.words.begin(), row.words.end());
    const Finished refused = understudy(words);
    EXPECT_EQ(refused.exit_code, row.exit_code) << row.what << refused.errors;
    EXPECT_TRUE(has(refused.errors, row.what)) << refused.errors;
  }
}

}  // namespace tap_test
}  // namespace understudy::acceptance
