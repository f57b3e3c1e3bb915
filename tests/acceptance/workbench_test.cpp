// Four tables on a pty: libmodbus with each function that it has for them, and mbpoll with its types.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "emulator/device/register_map/access.h"
#include "emulator/serve/daemon/daemon_thread.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::acceptance {
namespace workbench_test {

using emulator::ListedModel;
namespace workbench = emulator::workbench;

const ListedModel kModels[] = {&workbench::model()};

/// The controller behind a link, in its own folder.
class ServedWorkbench : public testing::Test {
 protected:
  ServedWorkbench() {
    folder_ = "/tmp/understudy-test-XXXXXX";
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
    const emulator::world::Bench bench = emulator::world::parse_bench(
        kModels,
        "understudy: 1\nlines:\n  rs485:\n    link: ./port\n    timing: instant\n    stations:\n"
        "      - { name: it, model: workbench }\n",
        "bench.yaml", folder_);
    emulator::serve::DaemonOptions options;
    options.watch_signals = false;
    options.capture_path = folder_ + "/capture.pcapng";
    daemon_ = std::make_unique<emulator::serve::DaemonThread>(bench, options, [](const std::string&) {});
    daemon_->start();
  }
  ~ServedWorkbench() override {
    daemon_.reset();
    std::filesystem::remove_all(folder_);
  }
  std::string port() const { return folder_ + "/port"; }
  /// Returns what was captured so far; nothing more is served.
  std::string capture() {
    daemon_.reset();
    return folder_ + "/capture.pcapng";
  }

 private:
  std::string folder_;
  std::unique_ptr<emulator::serve::DaemonThread> daemon_;
};

struct Master {
  explicit Master(const std::string& port) : context(modbus_new_rtu(port.c_str(), 115200, 'N', 8, 1)) {
    modbus_set_slave(context, 1);
    modbus_set_response_timeout(context, 2, 0);
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

TEST_F(ServedWorkbench, AnswersLibmodbusInEveryFunction) {
  const Master master(port());
  ASSERT_TRUE(master.is_connected);
  modbus_t* const it = master.context;
  std::array<std::uint8_t, MODBUS_MAX_READ_BITS> bits{};
  std::array<std::uint8_t, MODBUS_MAX_WRITE_BITS> written{};
  for (std::size_t i = 0; i < written.size(); ++i) written[i] = i % 3 == 0 || i % 7 == 0 ? 1 : 0;
  ASSERT_EQ(modbus_write_bits(it, 0x1000, MODBUS_MAX_WRITE_BITS, written.data()), MODBUS_MAX_WRITE_BITS);
  ASSERT_EQ(modbus_read_bits(it, 0x1000, MODBUS_MAX_READ_BITS, bits.data()), MODBUS_MAX_READ_BITS);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    EXPECT_EQ(bits[i], i < written.size() ? written[i] : 0) << i;
  }
  EXPECT_EQ(modbus_write_bit(it, 5, 1), 1);
  EXPECT_EQ(modbus_read_bits(it, 4, 3, bits.data()), 3);
  EXPECT_EQ((Registers{bits[0], bits[1], bits[2]}), (Registers{0, 1, 0}));
  EXPECT_EQ(modbus_read_input_bits(it, 16, 2, bits.data()), 2);
  EXPECT_EQ((Registers{bits[0], bits[1]}), (Registers{0, 1}));

  std::array<std::uint16_t, MODBUS_MAX_READ_REGISTERS> words{};
  Registers sent(MODBUS_MAX_WRITE_REGISTERS);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint16_t>(i * 521);
  ASSERT_EQ(modbus_write_registers(it, 0x64, MODBUS_MAX_WRITE_REGISTERS, sent.data()),
            MODBUS_MAX_WRITE_REGISTERS);
  ASSERT_EQ(modbus_read_registers(it, 0x64, MODBUS_MAX_READ_REGISTERS, words.data()),
            MODBUS_MAX_READ_REGISTERS);
  EXPECT_TRUE(std::equal(sent.begin(), sent.end(), words.begin()));
  EXPECT_EQ(modbus_write_register(it, 0x0002, 3999), 1);
  EXPECT_EQ(modbus_read_registers(it, 0x0002, 1, words.data()), 1);
  EXPECT_EQ(words[0], 3999);
  EXPECT_EQ(modbus_read_input_registers(it, 8, 2, words.data()), 2);
  EXPECT_EQ(modbus_get_float_abcd(words.data()), 21.5F);

  EXPECT_EQ(modbus_write_bit(it, 100, 1), -1);
  EXPECT_EQ(errno, EMBXILADD);
  EXPECT_EQ(modbus_write_register(it, 0x0000, 0), -1);
  EXPECT_EQ(errno, EMBXILVAL);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(modbus_write_register(it, 0x1F40, workbench::kStop), 1);
  EXPECT_EQ(modbus_write_register(it, 0x1F40, workbench::kStop), -1);
  EXPECT_EQ(errno, EMBXSBUSY);
  EXPECT_EQ(modbus_write_bit(it, 111, 1), 1);
  EXPECT_EQ(modbus_write_register(it, 0x1F40, workbench::kStop), -1);
  EXPECT_EQ(errno, EMBXSFAIL);
  EXPECT_EQ(modbus_read_input_registers(it, 16, 1, words.data()), 1);
  EXPECT_EQ(words[0], static_cast<int>(emulator::Cause::failure));
}

TEST_F(ServedWorkbench, IsCapturedAsTsharkReadsIt) {
  if (run({"tshark", "--version"}).exit_code != 0) GTEST_SKIP() << "tshark is not installed";
  {
    const Master master(port());
    ASSERT_TRUE(master.is_connected);
    modbus_t* const it = master.context;
    std::array<std::uint8_t, 16> bits{1, 0, 1, 1};
    std::array<std::uint16_t, 4> words{7, 8, 9, 10};
    EXPECT_EQ(modbus_write_bit(it, 5, 1), 1);
    EXPECT_EQ(modbus_write_bits(it, 8, 4, bits.data()), 4);
    EXPECT_EQ(modbus_read_bits(it, 5, 8, bits.data()), 8);
    EXPECT_EQ(modbus_read_input_bits(it, 16, 2, bits.data()), 2);
    EXPECT_EQ(modbus_write_register(it, 2, 3999), 1);
    EXPECT_EQ(modbus_write_registers(it, 100, 4, words.data()), 4);
    EXPECT_EQ(modbus_read_registers(it, 100, 4, words.data()), 4);
    EXPECT_EQ(modbus_read_input_registers(it, 20, 1, words.data()), 1);
    EXPECT_EQ(modbus_write_bit(it, 100, 1), -1);
  }
  const Finished finished =
      run({"tshark",        "-r", capture(),       "-o", "mbrtu.tcp.port:19200", "-T", "fields",         "-E",
           "separator=|",   "-e", "_ws.col.Info",  "-e", "modbus.reference_num", "-e", "modbus.bit_cnt", "-e",
           "modbus.bitnum", "-e", "modbus.bitval", "-e", "_ws.malformed"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  std::vector<std::string> lines;
  std::istringstream output(finished.output);
  for (std::string line; std::getline(output, line);) lines.push_back(line);
  // A query and a response for each; for bits that are read, their numbers and values.
  const char* const wanted[] = {
      "   Query: Unit:   1, Func:   5: Write Single Coil|5|",
      "Response: Unit:   1, Func:   5: Write Single Coil|5|",
      "   Query: Unit:   1, Func:  15: Write Multiple Coils|8|4|",
      "Response: Unit:   1, Func:  15: Write Multiple Coils|8|4|",
      "   Query: Unit:   1, Func:   1: Read Coils|5|8|",
      "Response: Unit:   1, Func:   1: Read Coils|||5,6,7,8,9,10,11,12|1,0,0,1,0,1,1,0|",
      "   Query: Unit:   1, Func:   2: Read Discrete Inputs|16|2|",
      "Response: Unit:   1, Func:   2: Read Discrete Inputs|||16,17|0,1|",
      "   Query: Unit:   1, Func:   6: Write Single Register|2|",
      "Response: Unit:   1, Func:   6: Write Single Register|2|",
      "   Query: Unit:   1, Func:  16: Write Multiple Registers|100|",
      "Response: Unit:   1, Func:  16: Write Multiple Registers|100|",
      "   Query: Unit:   1, Func:   3: Read Holding Registers|100|",
      "Response: Unit:   1, Func:   3: Read Holding Registers|",
      "   Query: Unit:   1, Func:   4: Read Input Registers|20|",
      "Response: Unit:   1, Func:   4: Read Input Registers|",
      "   Query: Unit:   1, Func:   5: Write Single Coil|100|",
      "Response: Unit:   1, Func:   5: Write Single Coil. Exception returned |",
  };
  ASSERT_EQ(lines.size(), std::size(wanted)) << finished.output;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_TRUE(lines[i].starts_with(wanted[i])) << lines[i] << "\nexpected " << wanted[i];
    EXPECT_TRUE(lines[i].ends_with("|")) << lines[i] << " is malformed";
  }
}

TEST_F(ServedWorkbench, AnswersMbpollInEachOfItsTypes) {
  if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
  const auto poll = [&](const std::string& type, int address, const Words& rest) {
    Words words{"mbpoll",
                "-m",
                "rtu",
                "-b",
                "115200",
                "-P",
                "none",
                "-0",
                "-q",
                "-t",
                type,
                "-r",
                std::to_string(address)};
    const bool is_write = !rest.empty();
    if (!is_write) words.push_back("-1");
    words.push_back(port());
    if (is_write) words.push_back("--");
    words.insert(words.end(), rest.begin(), rest.end());
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    std::smatch found;
    const bool printed = std::regex_search(finished.output, found, std::regex("\\]:\\s*(\\S+)"));
    return printed ? found[1].str() : std::string();
  };
  poll("0", 7, {"1"});
  EXPECT_EQ(poll("0", 7, {}), "1");
  EXPECT_EQ(poll("0", 8, {}), "0");
  EXPECT_EQ(poll("1", 17, {}), "1");
  EXPECT_EQ(poll("1", 16, {}), "0");
  EXPECT_EQ(poll("3", 20, {}), "68");
  poll("4", 1, {"1234"});
  EXPECT_EQ(poll("4", 1, {}), "1234");
}

TEST_F(ServedWorkbench, AnswersPollByTableAndType) {
  const auto poll = [&](const Words& rest) {
    Words words{UNDERSTUDY_BINARY, "poll", port(), "--baud", "115200", "--parity", "none"};
    words.insert(words.end(), rest.begin(), rest.end());
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    return finished.output;
  };
  EXPECT_EQ(poll({"--function", "1", "0x0009=1", "0x0008:3"}), "0x0008 0\n0x0009 1\n0x000A 0\n");
  EXPECT_EQ(poll({"--function", "2", "17"}), "17 1\n");
  EXPECT_EQ(poll({"--function", "4", "20"}), "20 68\n");
  // It expects the low word first, so this controller is set to do the same.
  EXPECT_EQ(poll({"0x0031=1"}), "");
  EXPECT_EQ(poll({"--type", "f32", "0x0020=2.25", "0x0020:2"}), "0x0020 2.25\n0x0022 1.5\n");
  const Finished refused =
      run({UNDERSTUDY_BINARY, "poll", port(), "--function", "2", "17=1", "--parity", "none"});
  EXPECT_NE(refused.errors.find("17 can only be read; expected a coil or a holding register"),
            std::string::npos)
      << refused.errors;
}

TEST_F(ServedWorkbench, TakesCommandsByNameFromPoll) {
  const auto poll = [&](const Words& rest) {
    Words words{WORKBENCH_BINARY, "poll", port(), "--baud", "115200", "--parity", "none"};
    words.insert(words.end(), rest.begin(), rest.end());
    return run(words);
  };
  const Finished moved =
      poll({"--model", "workbench", "--command", "MOVE Y -1000", "--command", "STOP", "STATE"});
  EXPECT_EQ(moved.exit_code, 0) << moved.errors;
  EXPECT_EQ(moved.output, "STATE 32\n") << "two wait";
  const std::pair<Words, const char*> wrong[] = {
      {{"--model", "workbench", "--command", "MOVE W 5"}, "poll: 'MOVE W 5': column 6: 'W' is not an axis"},
      {{"--model", "simple2-r3", "--command", "STOP"}, "simple2-r3 has no named commands"},
      {{"--command", "STOP"}, "expected --model MODEL"},
      {{}, "nothing to read"},
  };
  for (const auto& [words, why] : wrong) {
    const Finished refused = poll(words);
    EXPECT_EQ(refused.exit_code, 2) << why;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
  }
  EXPECT_EQ(poll({"--model", "workbench", "--command", "STOP"}).exit_code, 0);
  const Finished full = poll({"--model", "workbench", "--command", "STOP"});
  EXPECT_EQ(full.exit_code, 1) << "the FIFO holds three";
  EXPECT_NE(full.errors.find("poll: STOP: "), std::string::npos) << full.errors;
  EXPECT_EQ(run({WORKBENCH_BINARY, "describe", "workbench", "commands"}).output,
            "workbench has no commands in text form; its window accepts the commands that `instructions` "
            "lists, such as MOVE "
            "X 1000\n");
}

TEST_F(ServedWorkbench, IsAskedByPollForItsOrderOfWords) {
  const auto polled = [&](const Words& rest) {
    Words words{WORKBENCH_BINARY, "poll", port(),    "--baud",   "115200",
                "--parity",       "none", "--model", "workbench"};
    words.insert(words.end(), rest.begin(), rest.end());
    const Finished finished = run(words);
    return finished.exit_code == 0 ? finished.output : finished.errors;
  };
  EXPECT_EQ(polled({"holding.Position_X=70000", "holding.Position_X"}), "holding.Position_X 70000\n");
  EXPECT_EQ(polled({"Word_Order=1"}), "");
  EXPECT_EQ(polled({"holding.Position_X", "holding.Position_Y=-5", "holding.Position_Y"}),
            "holding.Position_X 70000\nholding.Position_Y -5\n");
  EXPECT_EQ(polled({"--type", "s32", "0x10"}), "0x10 70000\n");
  EXPECT_EQ(polled({"--command", "MOVE Z 65538", "Run=1"}), "");
  EXPECT_TRUE(eventually([&] { return polled({"holding.Position_Z"}) == "holding.Position_Z 65538\n"; }));
  // From then on, it uses the value that it writes itself.
  EXPECT_EQ(polled({"Word_Order=0", "holding.Position_Y=7", "holding.Position_Y", "Word_Order=1",
                    "holding.Position_Y"}),
            "holding.Position_Y 7\nholding.Position_Y 7\n");
  EXPECT_EQ(polled({"holding.Position_Y"}), "holding.Position_Y 7\n");
  // Or the order is given, and then the device is not asked.
  EXPECT_EQ(polled({"--word-order", "high", "holding.Position_Z"}), "holding.Position_Z 131073\n");
  EXPECT_EQ(polled({"--word-order", "low", "holding.Position_Z"}), "holding.Position_Z 65538\n");
  EXPECT_NE(polled({"--word-order", "middle", "holding.Position_Z"}).find("expected low or high"),
            std::string::npos);
  const std::string silent = polled({"--station", "9", "--timeout", "50ms", "holding.Position_Z"});
  EXPECT_NE(silent.find("Word_Order, word order: "), std::string::npos) << silent;
  EXPECT_EQ(polled({"Word_Order"}), "Word_Order 1\n");
}

}  // namespace workbench_test
}  // namespace understudy::acceptance
