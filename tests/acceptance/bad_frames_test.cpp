// Wrong frames on real ptys: how each controller with its own tables answers every function's wrong counts,
// lengths and byte counts, and a window that is written in part. After each, the next good frame is served
// and the contents are unchanged.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emulator/models/models.h"
#include "emulator/serve/daemon/daemon_thread.h"
#include "emulator/world/bench_file/bench_file.h"
#include "pty/rtu_crc.h"
#include "tests/acceptance/raw_host.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::acceptance {
namespace bad_frames_test {

constexpr int kSilence = 0;  // instead of an exception

struct Case {
  std::string what;
  std::string request;  // without station and checksum
  int exception = kSilence;
};

struct Subject {
  const char* name;
  const char* model;
  const char* first;  // an address of each of its tables, with plain values behind it
  bool has_input_registers;
  std::vector<Case> own{};
};

/// "03 00 64 00 00", of numbers in hex.
std::string joined(const std::string& function, const std::string& address, const std::string& rest) {
  return function + " " + address + (rest.empty() ? "" : " ") + rest;
}

std::string bytes_of(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " 01";
  return text;
}

/// The order of the MODBUS Application Protocol V1.1b3: counts and lengths are checked before addresses
/// (exception 3), addresses before values, and an unknown function before everything (exception 1).
std::vector<Case> cases_of(const Subject& subject) {
  std::vector<Case> cases;
  const std::string at = subject.first;
  const std::array<std::string, 4> beyond{"07 D1", "07 D1", "00 7E", "00 7E"};
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    const std::string function = "0" + std::to_string(i + 1);
    const bool is_present = function != "04" || subject.has_input_registers;
    const auto add = [&](const char* what, const std::string& address, const std::string& rest, int wanted) {
      cases.push_back({what, joined(function, address, rest), is_present ? wanted : 1});
    };
    add("no count", at, "00 00", 3);
    add("one more than a reply holds", at, beyond[i], 3);
    add("the most that can be said", at, "FF FF", 3);
    add("beyond all addresses", "FF FF", "00 02", 2);
    add("cut short", at, "", 3);
    add("too long", at, "00 01 00", 3);
  }
  const auto add = [&](const char* what, const std::string& function, const std::string& rest, int wanted) {
    cases.push_back({what, joined(function, at, rest), wanted});
  };
  add("neither on nor off", "05", "00 01", 3);
  add("nearly on", "05", "FF 01", 3);
  add("cut short", "05", "FF", 3);
  add("too long", "05", "FF 00 00", 3);
  add("cut short", "06", "", 3);
  add("too long", "06", "00 01 00", 3);
  add("no count", "0F", "00 00 00", 3);
  add("one more than a frame holds", "0F", "07 B1 F7" + bytes_of(247), 3);
  add("the byte count says one more", "0F", "00 02 02 01", 3);
  add("one more, which is there", "0F", "00 02 02 01 01", 3);
  add("the byte count says none", "0F", "00 02 00 01", 3);
  add("no byte count", "0F", "00 02", 3);
  add("no count", "10", "00 00 00", 3);
  add("one more than a frame holds", "10", "00 7C F8" + bytes_of(20), 3);
  add("with all its words, longer than any frame", "10", "00 7C F8" + bytes_of(248), kSilence);
  add("the byte count says one more", "10", "00 02 05 01 01 01 01", 3);
  add("one more, which is there", "10", "00 02 05 01 01 01 01 01", 3);
  add("the byte count says one word less", "10", "00 02 02 01 01 01 01", 3);
  add("no byte count", "10", "00 02", 3);
  for (const char* function : {"00", "07", "08", "11", "16", "17", "2B", "7F"}) {
    cases.push_back({"unknown function", joined(function, at, "00 01"), 1});
  }
  cases.insert(cases.end(), subject.own.begin(), subject.own.end());
  return cases;
}

/// A window that accepts at least 16 words; a move of four words, and its first word alone.
std::vector<Case> cases_of_window(const std::string& move, int beyond_it) {
  const std::string more = " 00 00";
  return {{"a window in part", "10 1F 40 00 03 06 " + move.substr(0, 17), 3},
          {"a window in part, one word", "06 1F 40 " + move.substr(0, 5), 3},
          {"a window from its middle", "10 1F 41 00 03 06 " + move.substr(6), 2},
          {"a window from its middle, one word", "06 1F 41 00 01", 2},
          {"a command with a word too many", "10 1F 40 00 05 0A " + move + more, 3},
          {"more than the window",
           "10 1F 40 00 " + std::string(beyond_it == 21 ? "15 2A" : "66 CC") + bytes_of(2 * beyond_it), 2},
          {"a window and what is before it", "10 1F 3F 00 02 04 00 00 0A 02", 2}};
}

const Subject kSubjects[] = {
    {"Workbench", "workbench", "00 64", true, cases_of_window("0A 01 00 01 00 00 03 E8", 21)},
    {"RsM8194h", "rs-m8194h", "01 2C", true, cases_of_window("0A 4E 00 01 00 00 27 10", 102)},
    {"Super40nc", "super-40nc", "00 00", false},
};

class BadFrames : public testing::TestWithParam<Subject> {
 protected:
  BadFrames() : models_(emulator::models::all_models().begin(), emulator::models::all_models().end()) {
    models_.push_back(&emulator::workbench::model());
    folder_ = "/tmp/understudy-test-XXXXXX";
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
    const emulator::world::Bench bench = emulator::world::parse_bench(
        models_,
        "understudy: 1\nlines:\n  line:\n    link: ./port\n    timing: instant\n    stations:\n"
        "      - { name: it, address: 1, model: " +
            std::string(GetParam().model) + " }\n",
        "bench.yaml", folder_);
    emulator::serve::DaemonOptions options;
    options.watch_signals = false;
    daemon_ = std::make_unique<emulator::serve::DaemonThread>(bench, options, [](const std::string&) {});
    daemon_->start();
    host_ = std::make_unique<Host>(folder_ + "/port");
  }
  ~BadFrames() override {
    daemon_.reset();
    std::filesystem::remove_all(folder_);
  }

  void send(const std::string& request) {
    Bytes frame = hex("01 " + request);
    pty::append_rtu_crc(frame);
    host_->write(frame);
  }
  Bytes receive(std::size_t size) { return host_->read(size); }
  /// Checks the contents of its words and coils, and that the line works as before.
  Bytes asked() {
    send(joined("03", GetParam().first, "00 0A"));
    Bytes all = receive(5 + 20);
    send("01 00 00 00 10");
    const Bytes coils = receive(5 + 2);
    all.insert(all.end(), coils.begin(), coils.end());
    return all;
  }
  bool is_silent_now() { return is_silent(*host_); }

 private:
  std::vector<emulator::ListedModel> models_;
  std::string folder_;
  std::unique_ptr<emulator::serve::DaemonThread> daemon_;
  std::unique_ptr<Host> host_;
};

TEST_P(BadFrames, GetTheirExceptionAndTheNextIsServed) {
  const Bytes before = asked();
  ASSERT_EQ(before.size(), 32U);
  ASSERT_EQ(before[1], 0x03) << "valid frames are served";
  for (const Case& c : cases_of(GetParam())) {
    const std::string reported = c.what + ": " + c.request.substr(0, 40);
    send(c.request);
    if (c.exception == kSilence) {
      EXPECT_TRUE(is_silent_now()) << reported;
    } else {
      const auto function = static_cast<std::uint8_t>(hex(c.request)[0] | 0x80);
      Bytes wanted{0x01, function, static_cast<std::uint8_t>(c.exception)};
      pty::append_rtu_crc(wanted);
      EXPECT_EQ(receive(5), wanted) << reported;
    }
    EXPECT_EQ(asked(), before) << "after " << reported;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, BadFrames, testing::ValuesIn(kSubjects),
                         [](const auto& subject) { return std::string(subject.param.name); });

}  // namespace bad_frames_test
}  // namespace understudy::acceptance
