// The files of `serve --capture`, as an independent reader and tshark see them.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/pty/pcapng_reader.h"

namespace understudy::acceptance {
namespace capture_test {

using pty::contents_of;
using pty::PcapngFile;
using pty::read_pcapng;

const Bytes kWrongChecksum = pty::hex("01 06 10 02 00 C8 2D 5D");
const Bytes kNoise = pty::hex("FF 00 01 03 42");
const Bytes kRefused = pty::hex("01 05 00 00 FF 00 8C 3A");
const Bytes kRefusal = pty::hex("01 85 01 83 50");
const Bytes kSetFive = pty::hex("01 10 10 00 00 05 0A 7D 00 00 00 00 C8 00 05 00 05 B3 F7");
const Bytes kSetFiveReply = pty::hex("01 10 10 00 00 05 04 CA");

constexpr std::uint32_t kInbound = 1;
constexpr std::uint32_t kOutbound = 2;

/// A daemon that captures, with one host.
class Capturing {
 public:
  explicit Capturing(const std::string& name, const Words& flags = {})
      : path_(folder_ / name), daemon_(with_capture(flags)), host_(daemon_.port()) {
    EXPECT_TRUE(host_.set_even_parity(B19200));
  }
  void exchange(const Bytes& request, const Bytes& reply) {
    EXPECT_EQ(acceptance::exchange(host_, request, reply.size()), reply);
  }
  void send_in_vain(const Bytes& bytes) {
    host_.write(bytes);
    EXPECT_TRUE(is_silent(host_));
  }
  /// Returns the contents of the file after SIGTERM.
  std::string stop() {
    EXPECT_EQ(daemon_.stop(SIGTERM), 0) << daemon_.errors();
    return pty::contents_of(path_);
  }
  const std::string& path() const { return path_; }
  RunningUnderstudy& daemon() { return daemon_; }

 private:
  Words with_capture(const Words& flags) const {
    Words all{"--capture", path_};
    all.insert(all.end(), flags.begin(), flags.end());
    return all;
  }

  PrivateFolder folder_;
  std::string path_;
  RunningUnderstudy daemon_;
  Host host_;
};

TEST(Capture, HoldsEachFrameWithItsDirectionAndItsSimulatedTime) {
  Capturing capturing("a.pcapng");
  capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
  capturing.exchange(kSetSpeed200, kSetSpeed200);
  const std::string file = capturing.stop();
  const PcapngFile capture = pty::read_pcapng(file);
  ASSERT_EQ(capture.interfaces.size(), 1U);
  EXPECT_EQ(capture.interfaces[0].name, "line");
  EXPECT_EQ(capture.interfaces[0].speed, 19200U);
  ASSERT_EQ(capture.packets.size(), 4U);
  EXPECT_EQ(capture.packets[0].bytes, kReadHardwareCode);
  EXPECT_EQ(capture.packets[1].bytes, kHardwareCodeReply);
  EXPECT_EQ(capture.packets[2].bytes, kSetSpeed200);
  EXPECT_EQ(capture.packets[3].bytes, kSetSpeed200);
  for (const std::size_t request : {0U, 2U}) {
    EXPECT_EQ(capture.packets[request].flags, kInbound);
    EXPECT_EQ(capture.packets[request + 1].flags, kOutbound);
    // 8 characters of 11 bits at 19200 baud, and the END time of 0.75 ms.
    EXPECT_EQ(capture.packets[request + 1].time - capture.packets[request].time, 4'583'333U + 750'000U);
  }
  EXPECT_GT(capture.packets[2].time, capture.packets[1].time + 4'010'416) << "7 characters";
  EXPECT_LT(capture.packets[3].time, 60'000'000'000U) << "simulated time, not the wall clock's";
}

TEST(Capture, HoldsWhatWasDroppedAndWhatWasNotReceived) {
  Capturing capturing("a.pcapng");
  capturing.send_in_vain(kWrongChecksum);
  capturing.send_in_vain(kNoise);
  capturing.send_in_vain(pty::hex("01 03 00"));
  const std::string file = capturing.stop();
  const PcapngFile capture = pty::read_pcapng(file);
  ASSERT_EQ(capture.packets.size(), 3U);
  EXPECT_EQ(capture.packets[0].bytes, kWrongChecksum);
  EXPECT_EQ(capture.packets[0].comment, "dropped: bad CRC");
  EXPECT_EQ(capture.packets[1].bytes, kNoise);
  EXPECT_EQ(capture.packets[1].comment, "dropped: not a frame");
  EXPECT_EQ(capture.packets[2].comment, "dropped: incomplete");
  for (const auto& packet : capture.packets) EXPECT_EQ(packet.flags & 3U, kInbound);
}

TEST(Capture, IsTextUnderAnyOtherName) {
  Capturing capturing("a.txt", {"--speed", "manual", "--timing", "instant"});
  capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
  EXPECT_EQ(capturing.daemon().ctl({"advance", "1500ms"}).exit_code, 0);
  capturing.send_in_vain(kNoise);
  EXPECT_EQ(capturing.stop(),
            "# simulated seconds, in (from the host) or out, line, bytes, # remark\n"
            "0.000000000 in  line 01 03 00 01 00 01 D5 CA\n"
            "0.000000000 out line 01 03 02 C0 01 29 84\n"
            "1.500000000 in  line FF 00 01 03 42  # dropped: not a frame\n");
}

TEST(Capture, OfTheSameExchangeInManualTimeIsTheSameFile) {
  std::vector<std::string> files;
  for (int run = 0; run < 2; ++run) {
    Capturing capturing("a.pcapng", {"--speed", "manual", "--timing", "instant"});
    capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
    EXPECT_EQ(capturing.daemon().ctl({"advance", "250ms"}).exit_code, 0);
    capturing.send_in_vain(kWrongChecksum);
    capturing.exchange(kSetSpeed200, kSetSpeed200);
    files.push_back(capturing.stop());
  }
  EXPECT_EQ(pty::read_pcapng(files[0]).packets.size(), 5U);
  EXPECT_EQ(files[0], files[1]);
}

const char* const kTwoLines = R"(understudy: 1
lines:
  north: { link: north.port, timing: instant, stations: [ { name: one, model: simple2-r3, address: 1 } ] }
  south: { link: south.port, timing: instant, stations: [ { name: two, model: simple2-r3, address: 1 } ] }
)";

TEST(Capture, TellsLinesApart) {
  const PrivateFolder folder;
  const auto daemon = RunningUnderstudy::of_bench(kTwoLines, {"--capture", folder / "a.pcapng"});
  Host north(daemon->ports().at(0).link);
  Host south(daemon->ports().at(1).link);
  EXPECT_EQ(exchange(south, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
  EXPECT_EQ(exchange(north, kSetSpeed200, kSetSpeed200.size()), kSetSpeed200);
  EXPECT_EQ(daemon->stop(SIGTERM), 0);
  const std::string file = pty::contents_of(folder / "a.pcapng");
  const PcapngFile capture = pty::read_pcapng(file);
  ASSERT_EQ(capture.interfaces.size(), 2U);
  EXPECT_EQ(capture.interfaces[0].name, "north");
  EXPECT_EQ(capture.interfaces[1].name, "south");
  ASSERT_EQ(capture.packets.size(), 4U);
  EXPECT_EQ(capture.packets[0].interface, 1U);
  EXPECT_EQ(capture.packets[1].interface, 1U);
  EXPECT_EQ(capture.packets[2].interface, 0U);
}

TEST(Capture, ConsistsOfWholeBlocksWhenTheDaemonIsKilled) {
  Capturing capturing("a.pcapng", {"--timing", "instant"});
  for (int i = 0; i < 200; ++i) capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
  EXPECT_TRUE(eventually([&] { return pty::contents_of(capturing.path()).size() > 1000; }));
  EXPECT_EQ(capturing.daemon().stop(SIGKILL), 128 + SIGKILL);
  const std::string file = pty::contents_of(capturing.path());
  EXPECT_GT(pty::read_pcapng(file).packets.size(), 0U);
}

TEST(Capture, EndsWhenTheDiskIsFullAndTheDevicesContinue) {
  Capturing capturing("a.pcapng", {"--timing", "instant"});
  const rlimit limit{.rlim_cur = 4000, .rlim_max = 4000};
  ASSERT_EQ(::prlimit(capturing.daemon().process().pid(), RLIMIT_FSIZE, &limit, nullptr), 0);
  for (int i = 0; i < 100; ++i) capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
  EXPECT_TRUE(eventually([&] {
    capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
    return !capturing.daemon().errors().empty();
  }));
  EXPECT_NE(capturing.daemon().errors().find("a.pcapng: the capture ended early: File too large\n"),
            std::string::npos)
      << capturing.daemon().errors();
  const std::string file = capturing.stop();
  EXPECT_GT(pty::read_pcapng(file).packets.size(), 20U);
  EXPECT_EQ(lines_of(capturing.daemon().errors()).size(), 2U) << "that it ends, and how much is missing";
}

TEST(CaptureRefusals, AreOneLineAndLeaveWhatIsThereAlone) {
  struct Case {
    std::string path;
    int exit_code;
    std::string says;
  };
  const PrivateFolder folder;
  const std::string bench = folder.write("bench.yaml", kTwoLines);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const Case& expected :
       {Case{folder.path(), 3, "is a directory"}, Case{folder / "pipe", 3, "is a pipe"},
        Case{"/dev/null", 3, "is a device"}, Case{folder / "none/a.txt", 3, "No such file or directory"},
        Case{folder / "a.pcap", 2, "expected .pcapng"}, Case{bench, 2, "is the bench itself"},
        Case{"", 2, "is empty"}}) {
    const Finished finished = understudy({"serve", bench, "--capture", expected.path});
    EXPECT_EQ(finished.exit_code, expected.exit_code) << expected.path;
    EXPECT_EQ(finished.output, "") << expected.path;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_NE(finished.errors.find(expected.says), std::string::npos) << finished.errors;
  }
  EXPECT_EQ(pty::contents_of(bench), kTwoLines);
}

TEST(CaptureRefusals, ARunThatCannotStartLeavesTheCaptureOfTheOneBefore) {
  const PrivateFolder folder;
  const std::string capture = folder.write("a.txt", "precious\n");
  const RunningUnderstudy first;
  const Finished second =
      understudy({"serve", "--model", "simple2-r3", "--link", first.port(), "--capture", capture});
  EXPECT_EQ(second.exit_code, 3) << second.errors;
  EXPECT_EQ(pty::contents_of(capture), "precious\n");
}

TEST(CaptureRefusals, TwoRunsNeverWriteOneFile) {
  Capturing first("a.txt");
  const Finished second = understudy({"serve", "--model", "simple2-r3", "--capture", first.path()});
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_NE(second.errors.find("another program is writing it"), std::string::npos) << second.errors;
}

/// Returns tshark's output for these fields of each packet, with the one flag from docs/wire.md.
std::vector<std::string> tshark(const std::string& path, const Words& fields) {
  Words command{"tshark", "-r", path, "-o", "mbrtu.tcp.port:19200", "-T", "fields", "-E", "separator=|"};
  for (const std::string& field : fields) command.insert(command.end(), {"-e", field});
  const Finished finished = run(command);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  return lines_of(finished.output);
}

TEST(Tshark, DecodesTheCaptureAsModbusRtu) {
  if (run({"tshark", "--version"}).exit_code != 0) GTEST_SKIP() << "tshark is not installed";
  Capturing capturing("a.pcapng");
  capturing.exchange(kReadHardwareCode, kHardwareCodeReply);
  capturing.exchange(kSetSpeed200, kSetSpeed200);
  capturing.exchange(kSetFive, kSetFiveReply);
  capturing.exchange(kRefused, kRefusal);
  capturing.send_in_vain(kWrongChecksum);
  capturing.send_in_vain(kNoise);
  capturing.stop();
  const auto decoded = tshark(
      capturing.path(), {"frame.interface_name", "frame.packet_flags_direction", "_ws.col.Info",
                         "modbus.request_frame", "modbus.regnum16", "modbus.regval_uint16", "frame.comment"});
  const std::string in = "line|0x00000001|   Query: Unit:   1, Func: ";
  const std::string out = "line|0x00000002|Response: Unit:   1, Func: ";
  const std::vector<std::string> expected = {
      in + "  3: Read Holding Registers||||", out + "  3: Read Holding Registers|1|1|49153|",
      in + "  6: Write Single Register|",     out + "  6: Write Single Register|3|",
      in + " 16: Write Multiple Registers|",  out + " 16: Write Multiple Registers|5|",
      in + "  5: Write Single Coil|",         out + "  5: Write Single Coil. Exception returned |",
      in + "  6: Write Single Register|",     "line|0x00000001|||||dropped: not a frame"};
  ASSERT_EQ(decoded.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(decoded[i].starts_with(expected[i])) << decoded[i] << "\nexpected " << expected[i];
  EXPECT_TRUE(decoded[8].ends_with("|dropped: bad CRC")) << decoded[8];
}

TEST(Capture, ReportsWhatFaultsDid) {
  for (const std::string name : {"a.txt", "a.pcapng"}) {
    Capturing capturing(name);
    for (const Words& fault :
         {Words{"inject", "drop", "device", "nth=1"}, Words{"inject", "corrupt_checksum", "device", "nth=1"},
          Words{"inject", "drop", "device", "of=request", "function=6"}}) {
      EXPECT_EQ(capturing.daemon().ctl(fault).exit_code, 0);
    }
    capturing.send_in_vain(kReadHardwareCode);
    capturing.exchange(kReadHardwareCode, pty::hex("01 03 02 C0 01 29 7B"));
    capturing.send_in_vain(kSetSpeed200);
    const std::string status = capturing.daemon().ctl({"status"}).output;
    EXPECT_NE(status.find("\nfault 1 drop device nth=1: seen 2, matched 2, hit 1\n"), std::string::npos)
        << status;
    const std::string file = capturing.stop();
    for (const char* comment : {"fault 1 drop: not sent", "fault 2 corrupt_checksum: last byte inverted",
                                "fault 3 drop: not received"}) {
      EXPECT_NE(file.find(comment), std::string::npos) << name << ": " << comment;
    }
    if (name == "a.txt") continue;
    const PcapngFile capture = pty::read_pcapng(file);
    ASSERT_EQ(capture.packets.size(), 6U);
    EXPECT_EQ(capture.packets[1].bytes, Bytes{});
    EXPECT_EQ(capture.packets[1].flags, kOutbound);
    EXPECT_EQ(capture.packets[5].bytes, Bytes{});
    EXPECT_EQ(capture.packets[5].flags, kInbound);
  }
}

}  // namespace capture_test
}  // namespace understudy::acceptance
