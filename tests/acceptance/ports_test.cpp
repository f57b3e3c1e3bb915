// A device with two ports on two ptys: libmodbus and mbpoll on both, two hosts at once, a capture that
// distinguishes the lines, and the control socket's replies.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon_thread.h"
#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::acceptance {
namespace ports_test {

namespace workbench = emulator::workbench;
using Json = nlohmann::json;

struct Port {
  const char* link;
  int baud;
  char parity;
};
constexpr Port kPc{"/P", 115200, 'E'};
constexpr Port kHmi{"/P.HMI", 19200, 'N'};

/// Like `serve --model workbench --link P`.
class ServedOnTwoPorts : public testing::Test {
 protected:
  ServedOnTwoPorts() {
    folder_ = "/tmp/understudy-test-XXXXXX";
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
    emulator::DeviceSettings settings;
    settings.name = "mill";
    emulator::world::Bench bench =
        emulator::world::bench_of_one(workbench::model(), settings, folder_ + "/P");
    for (auto& line : bench.lines) line.timing = pty::Timing::instant;
    emulator::serve::DaemonOptions options;
    options.watch_signals = false;
    options.capture_path = capture();
    daemon_ = std::make_unique<emulator::serve::DaemonThread>(bench, options, [](const std::string&) {});
    daemon_->start();
  }
  ~ServedOnTwoPorts() override {
    daemon_.reset();
    std::filesystem::remove_all(folder_);
  }
  std::string capture() const { return folder_ + "/lines.pcapng"; }
  std::string path_of(const Port& port) const { return folder_ + port.link; }
  void stop() { daemon_->stop(); }
  Json status() {
    Json answer;
    emulator::serve::handle_message(daemon_->daemon(), R"({"do":"status"})",
                                    [&](const std::string& line) { answer = Json::parse(line); });
    return answer.at("status");
  }

  struct Master {
    Master(const std::string& path, const Port& port)
        : context(modbus_new_rtu(path.c_str(), port.baud, port.parity, 8, 1)) {
      modbus_set_slave(context, 1);
      modbus_set_response_timeout(context, 5, 0);
      modbus_set_byte_timeout(context, 2, 0);
      is_connected = modbus_connect(context) == 0;
    }
    ~Master() {
      modbus_close(context);
      modbus_free(context);
    }
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;
    modbus_t* context;
    bool is_connected = false;
  };

  /// Returns the output for the address; a write prints nothing.
  std::string mbpoll(const Port& port, const std::string& type, int address, const Words& written) const {
    Words words{"mbpoll",
                "-m",
                "rtu",
                "-b",
                std::to_string(port.baud),
                "-P",
                port.parity == 'E' ? "even" : "none",
                "-0",
                "-q",
                "-t",
                type,
                "-r",
                std::to_string(address)};
    if (written.empty()) words.push_back("-1");
    words.push_back(path_of(port));
    if (!written.empty()) words.push_back("--");
    words.insert(words.end(), written.begin(), written.end());
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    std::smatch found;
    const bool printed = std::regex_search(finished.output, found, std::regex("\\]:\\s*(\\S+)"));
    return printed ? found[1].str() : std::string();
  }

 private:
  std::string folder_;
  std::unique_ptr<emulator::serve::DaemonThread> daemon_;
};

TEST_F(ServedOnTwoPorts, AnswersLibmodbusOnBoth) {
  const Master pc(path_of(kPc), kPc);
  const Master hmi(path_of(kHmi), kHmi);
  ASSERT_TRUE(pc.is_connected && hmi.is_connected);
  const Master* const both[] = {&pc, &hmi};
  for (std::size_t i = 0; i < 2; ++i) {
    modbus_t* const one = both[i]->context;
    modbus_t* const other = both[1 - i]->context;
    std::uint16_t word = 0;
    std::uint8_t bit = 0;
    EXPECT_EQ(modbus_write_register(one, 0x64, static_cast<std::uint16_t>(700 + i)), 1);
    EXPECT_EQ(modbus_read_registers(other, 0x64, 1, &word), 1);
    EXPECT_EQ(word, 700 + i);
    EXPECT_EQ(modbus_write_bit(other, static_cast<int>(3 + i), 1), 1);
    EXPECT_EQ(modbus_read_bits(one, static_cast<int>(3 + i), 1, &bit), 1);
    EXPECT_EQ(bit, 1);
    EXPECT_EQ(modbus_read_input_bits(one, 17, 1, &bit), 1);
    EXPECT_EQ(bit, 1);
    EXPECT_EQ(modbus_read_input_registers(other, 20, 1, &word), 1);
    EXPECT_EQ(word, 0x44);
  }
}

TEST_F(ServedOnTwoPorts, AnswersMbpollInEachOfItsTypesOnBoth) {
  if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
  for (const auto& [port, other] : {std::pair(kPc, kHmi), std::pair(kHmi, kPc)}) {
    const int address = port.baud == kPc.baud ? 7 : 8;
    mbpoll(port, "0", address, {"1"});
    EXPECT_EQ(mbpoll(other, "0", address, {}), "1");
    EXPECT_EQ(mbpoll(port, "1", 17, {}), "1");
    EXPECT_EQ(mbpoll(port, "3", 20, {}), "68");
    mbpoll(port, "4", 1, {std::to_string(1000 + address)});
    EXPECT_EQ(mbpoll(other, "4", 1, {}), std::to_string(1000 + address));
  }
}

TEST_F(ServedOnTwoPorts, ServesTwoHostsAtOnce) {
  constexpr int kExchanges = 1000;
  constexpr int kWords = 16;
  std::atomic<int> torn{0};
  std::atomic<int> failed{0};
  // Each writes its own block as a whole and reads the other's, which has a different length.
  const auto talk = [&](const Port& port, int own, int others) {
    const Master master(path_of(port), port);
    if (!master.is_connected) ++failed;
    for (int i = 1; i <= kExchanges / 2; ++i) {
      const std::vector<std::uint16_t> block(static_cast<std::size_t>(kWords + own),
                                             static_cast<std::uint16_t>(i));
      std::vector<std::uint16_t> read(static_cast<std::size_t>(kWords + others));
      const int size = static_cast<int>(block.size());
      if (modbus_write_registers(master.context, 0x64 + 30 * own, size, block.data()) != size) ++failed;
      const int wanted = static_cast<int>(read.size());
      if (modbus_read_registers(master.context, 0x64 + 30 * others, wanted, read.data()) != wanted) ++failed;
      if (std::any_of(read.begin(), read.end(), [&](std::uint16_t word) { return word != read[0]; })) ++torn;
    }
  };
  std::thread other([&] { talk(kHmi, 1, 0); });
  talk(kPc, 0, 1);
  other.join();
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(torn, 0);
  stop();
  const Json lines = status().at("lines");
  for (const auto& [number, name] : {std::pair(0, "PC"), std::pair(1, "HMI")}) {
    const Json& station = lines[static_cast<std::size_t>(number)].at("stations")[0];
    EXPECT_EQ(station.at("device"), "mill");
    EXPECT_EQ(station.at("port"), name);
    EXPECT_EQ(station.at("address"), 1);
    EXPECT_EQ(station.at("requests"), kExchanges);
    EXPECT_EQ(station.at("replies"), kExchanges);
    EXPECT_EQ(station.at("exceptions"), 0);
  }
}

TEST_F(ServedOnTwoPorts, IsCapturedByLine) {
  if (run({"tshark", "--version"}).exit_code != 0) GTEST_SKIP() << "tshark is not installed";
  std::uint16_t word = 0;
  {
    const Master pc(path_of(kPc), kPc);
    const Master hmi(path_of(kHmi), kHmi);
    ASSERT_EQ(modbus_write_register(pc.context, 0x64, 5), 1);
    ASSERT_EQ(modbus_read_registers(hmi.context, 0x64, 1, &word), 1);
  }
  stop();
  const Finished decoded = run({"tshark", "-r", capture(), "-o", "mbrtu.tcp.port:19200", "-T", "fields", "-E",
                                "separator=|", "-e", "frame.interface_name", "-e", "_ws.col.Info"});
  EXPECT_EQ(decoded.output,
            "PC (mill PC)|   Query: Unit:   1, Func:   6: Write Single Register\n"
            "PC (mill PC)|Response: Unit:   1, Func:   6: Write Single Register\n"
            "HMI (mill HMI)|   Query: Unit:   1, Func:   3: Read Holding Registers\n"
            "HMI (mill HMI)|Response: Unit:   1, Func:   3: Read Holding Registers\n")
      << decoded.errors;
}

}  // namespace ports_test
}  // namespace understudy::acceptance
