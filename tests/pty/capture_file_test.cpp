// The capture file: who can own it, and its contents when the disk does not keep up.
#include "pty/capture_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/pty/pcapng_reader.h"
#include "tests/pty/pty_host.h"

namespace understudy::pty {
namespace capture_file_test {

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const std::string kHead = "# simulated seconds, in (from the host) or out, line, bytes, # remark\n";

class CaptureFileTest : public testing::Test {
 protected:
  std::unique_ptr<CaptureFile> make(const std::string& path) {
    auto file =
        std::make_unique<CaptureFile>(path, [this](const std::string& text) { logged_.push_back(text); });
    file->begin({{"L", 19200}});
    return file;
  }
  CapturedPacket packet(int number) const {
    return {.line = 0, .direction = Direction::from_host, .time = SimTime{number}, .bytes = kRequest};
  }
  std::string refusal(const std::string& path) {
    try {
      make(path);
    } catch (const CaptureError& error) {
      return error.what();
    }
    return "not refused";
  }

  ScratchDirectory folder_;
  std::vector<std::string> logged_;
};

TEST_F(CaptureFileTest, ItsEndingSaysWhatIsInIt) {
  make(folder_ / "a.pcapng")->add(packet(7));
  const PcapngFile read = read_pcapng(contents_of(folder_ / "a.pcapng"));
  ASSERT_EQ(read.packets.size(), 1U);
  EXPECT_EQ(read.packets[0].time, 7U);
  make(folder_ / "a.log")->add(packet(7));
  EXPECT_EQ(contents_of(folder_ / "a.log"), kHead + "0.000000007 in  L 01 03 00 01 00 01 D5 CA\n");
  EXPECT_TRUE(logged_.empty());
}

TEST_F(CaptureFileTest, IsThereFromTheBeginningAndGrows) {
  const auto file = make(folder_ / "a.txt");
  EXPECT_EQ(contents_of(folder_ / "a.txt"), kHead);
  file->add(packet(1));
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (contents_of(folder_ / "a.txt") == kHead && std::chrono::steady_clock::now() < until)
    std::this_thread::yield();
  EXPECT_EQ(contents_of(folder_ / "a.txt"), kHead + "0.000000001 in  L 01 03 00 01 00 01 D5 CA\n");
}

TEST_F(CaptureFileTest, ReplacesARegularFile) {
  std::ofstream(folder_ / "a.txt") << kHead + std::string(10'000, 'x');
  make(folder_ / "a.txt");
  EXPECT_EQ(contents_of(folder_ / "a.txt"), kHead);
}

TEST_F(CaptureFileTest, RefusesWhatIsNoRegularFile) {
  const auto expected = [](const std::string& kind) {
    return ": the capture cannot be written: it is a " + kind + "; expected a regular file, or a free path";
  };
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), pipe + expected("pipe")) << "nobody reads it";
  const Descriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK));
  EXPECT_EQ(refusal(pipe), pipe + expected("pipe"));
  EXPECT_EQ(refusal("/dev/null"), "/dev/null" + expected("device"));
  EXPECT_EQ(refusal(folder_ / ""), (folder_ / "") + expected("directory"));
}

TEST_F(CaptureFileTest, SaysWhyAFileIsNotAvailable) {
  EXPECT_EQ(refusal(folder_ / "none/a.txt"),
            (folder_ / "none/a.txt") + ": the capture cannot be written: No such file or directory");
}

TEST_F(CaptureFileTest, TwoCapturesNeverShareAFile) {
  const auto first = make(folder_ / "a.txt");
  first->add(packet(1));
  EXPECT_NE(refusal(folder_ / "a.txt").find("another program is writing it"), std::string::npos);
  first->finish();
  EXPECT_EQ(contents_of(folder_ / "a.txt"), kHead + "0.000000001 in  L 01 03 00 01 00 01 D5 CA\n");
}

/// A full disk, simulated by a limit on the size of files.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
  sighandler_t handler_;
};

TEST_F(CaptureFileTest, AFullDiskEndsTheCaptureWithWholePacketsAndOneLine) {
  const auto file = make(folder_ / "a.pcapng");
  {
    const SizeLimit limit(5000);
    for (int i = 0; i < 100; ++i) file->add(packet(i));
    file->finish();
  }
  const PcapngFile read = read_pcapng(contents_of(folder_ / "a.pcapng"));
  EXPECT_GT(read.packets.size(), 20U);
  EXPECT_LT(read.packets.size(), 60U);
  EXPECT_EQ(file->lost(), 100 - read.packets.size());
  ASSERT_EQ(logged_.size(), 2U);
  EXPECT_EQ(logged_[0], (folder_ / "a.pcapng") + ": the capture ended early: File too large");
  EXPECT_EQ(logged_[1], (folder_ / "a.pcapng") + ": " + std::to_string(file->lost()) +
                            " packets are missing from the capture");
}

TEST_F(CaptureFileTest, ADiskThatCannotBeStartedOnIsRefused) {
  const SizeLimit limit(10);
  EXPECT_NE(refusal(folder_ / "a.txt").find("File too large"), std::string::npos);
}

}  // namespace capture_file_test
}  // namespace understudy::pty
