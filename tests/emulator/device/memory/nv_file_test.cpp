// NV images on disk are replaced as a whole, whenever the writer dies and whatever the disk reports.
#include "emulator/device/memory/nv_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "tests/ordinary_user.h"

namespace understudy::emulator {
namespace nv_file_test {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class NvFile : public testing::Test {
 protected:
  NvFile() { EXPECT_NE(mkdtemp(folder_.data()), nullptr); }
  ~NvFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name = "feeder.json") const { return folder_ + "/" + name; }
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

 private:
  std::string folder_ = "/tmp/understudy-nv-XXXXXX";
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// An image in which all registers hold `value`; a few disk blocks long.
NvImage image_of(std::int64_t value, int registers = 400) {
  NvImage image{.model = "simple2-r3", .firmware = "1.52", .registers = {}};
  for (int i = 0; i < registers; ++i) image.registers.emplace_back("R" + std::to_string(i), value);
  return image;
}

std::string numbered(int i) { return to_json(image_of(i, 1)); }

/// Returns the value of a complete image; -1 if it is a mixture.
std::int64_t value_of_whole(const NvImage& image, std::size_t registers = 400) {
  if (image.registers.size() != registers) return -1;
  for (const auto& [name, value] : image.registers) {
    if (value != image.registers.front().second) return -1;
  }
  return image.registers.front().second;
}

std::string diagnostic(const std::string& path) {
  try {
    read_nv_file(path);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST_F(NvFile, ThatIsNotThereIsNoError) {
  EXPECT_EQ(read_nv_file(path()), std::nullopt);
  EXPECT_EQ(read_nv_file(path("no/such/folder/feeder.json")), std::nullopt);
}

TEST_F(NvFile, HoldsWhatWasWritten) {
  const NvImage image = image_of(7);
  {
    NvWriter writer;
    EXPECT_TRUE(writer.is_idle());
    writer.write(path(), to_json(image));
    EXPECT_FALSE(writer.is_idle());
    writer.flush();
    EXPECT_TRUE(writer.is_idle());
    EXPECT_EQ(text_of(path()), to_json(image));
    EXPECT_TRUE(writer.take_news().empty());
  }
  EXPECT_EQ(read_nv_file(path()), image);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(NvFile, RefusedIsKeptAsItIs) {
  const std::string torn = to_json(image_of(1)).substr(0, 1000);
  for (const std::string& text : {torn, std::string("hello\n"), std::string()}) {
    put(path(), text);
    const std::string found = diagnostic(path());
    EXPECT_EQ(found.rfind(path() + ":", 0), 0u) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
    EXPECT_EQ(text_of(path()), text);
  }
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(NvFile, ThatCannotBeReadIsRefused) {
  fs::create_directory(path());
  EXPECT_EQ(diagnostic(path()), path() + ": file: is not a regular file; expected an NV image");
}

TEST_F(NvFile, ALeftOverOfAWriterThatDiedIsNotReadAndNotTouched) {
  put(path(), to_json(image_of(1)));
  const std::string torn = to_json(image_of(2)).substr(0, 777);
  put(path() + ".new", torn);
  EXPECT_EQ(value_of_whole(*read_nv_file(path())), 1);
  NvWriter writer;
  writer.write(path(), to_json(image_of(3)));
  writer.flush();
  EXPECT_EQ(value_of_whole(*read_nv_file(path())), 3);
  EXPECT_EQ(text_of(path() + ".new"), torn) << "it may belong to somebody";
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(NvFile, AShorterImageLeavesNothingOfALongerOne) {
  NvWriter writer;
  for (const int registers : {400, 3, 0}) {
    writer.write(path(), to_json(image_of(5, registers)));
    writer.flush();
    EXPECT_EQ(read_nv_file(path()), image_of(5, registers));
  }
}

// The caller does not wait for it, and does not write it itself.
TEST_F(NvFile, ALateImageIsMadeByTheWritersThread) {
  std::thread::id maker;
  {
    NvWriter writer;
    writer.write(path(), [&] {
      maker = std::this_thread::get_id();
      return image_of(7);
    });
    writer.flush();
  }
  EXPECT_EQ(read_nv_file(path()), image_of(7));
  EXPECT_NE(maker, std::this_thread::get_id());
  EXPECT_NE(maker, std::thread::id());
}

// --- one of many images ---------------------------------------------------------------------------------

TEST_F(NvFile, ImagesInQuickSuccessionAreWrittenOnceTheLastOfThem) {
  NvWriter writer;
  writer.write(path(), numbered(-1));
  writer.flush();
  const auto first = fs::last_write_time(path());
  const auto begin = Clock::now();
  for (int i = 0; i < 1000; ++i) writer.write(path(), numbered(i));
  const auto taken = Clock::now() - begin;
  // Nothing of it reaches the disk before the coalescing time ends.
  if (taken < NvWriter::kCoalesce / 2) {
    EXPECT_EQ(text_of(path()), numbered(-1));
    EXPECT_EQ(fs::last_write_time(path()), first);
  }
  while (!writer.is_idle() && Clock::now() - begin < 10s) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(text_of(path()), numbered(999)) << "by itself, without a flush";
  EXPECT_GE(Clock::now() - begin, NvWriter::kCoalesce);
}

TEST_F(NvFile, FilesDoNotTouchEachOther) {
  NvWriter writer;
  for (int i = 0; i < 20; ++i) writer.write(path(std::to_string(i)), "file " + std::to_string(i));
  writer.flush();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(text_of(path(std::to_string(i))), "file " + std::to_string(i));
}

TEST_F(NvFile, FlushWaitsForAllAndNotForTheCoalescing) {
  NvWriter writer;
  const auto begin = Clock::now();
  for (int i = 0; i < 40; ++i) {
    writer.write(path(), numbered(i));
    writer.flush();
    ASSERT_EQ(text_of(path()), numbered(i));
  }
  EXPECT_LT(Clock::now() - begin, 40 * NvWriter::kCoalesce);
  writer.flush();  // with nothing to do
}

TEST_F(NvFile, TheLastImageIsWrittenWhenTheWriterGoes) {
  for (int i = 0; i < 10; ++i) {
    const auto begin = Clock::now();
    {
      NvWriter writer;
      writer.write(path(), numbered(i));
    }
    ASSERT_EQ(text_of(path()), numbered(i));
    EXPECT_LT(Clock::now() - begin, 5s);
  }
}

// --- never torn -----------------------------------------------------------------------------------------

TEST_F(NvFile, AReaderFindsTheOldImageOrTheNewOneNeverAMixture) {
  put(path(), to_json(image_of(0)));
  std::atomic<bool> done = false;
  std::atomic<int> reads = 0;
  std::atomic<std::int64_t> distinct = 0;
  std::thread reader([&] {
    std::int64_t last = 0;
    while (!done) {
      const std::int64_t value = value_of_whole(*read_nv_file(path()));
      if (value < last) ADD_FAILURE() << value << " after " << last;
      distinct += value != last;
      last = value;
      ++reads;
    }
  });
  {
    NvWriter writer;
    const auto until = Clock::now() + 700ms;
    for (std::int64_t i = 1; Clock::now() < until || distinct < 5 || reads <= 10; ++i) {
      writer.write(path(), to_json(image_of(i)));
      writer.flush();
      if (Clock::now() > until + 10s) break;
    }
  }
  done = true;
  reader.join();
  EXPECT_GT(reads, 10);
  EXPECT_GE(distinct, 5);
}

TEST_F(NvFile, AWriterKilledAtAnyMomentLeavesAWholeImage) {
  put(path(), to_json(image_of(0)));
  constexpr std::uint64_t kSeed = 81'003;
  std::mt19937_64 random(kSeed);
  std::int64_t last = 0;
  for (int kill_number = 0; kill_number < 100; ++kill_number) {
    int first_is_there[2];
    ASSERT_EQ(pipe(first_is_there), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      NvWriter writer;
      for (std::int64_t i = last + 1;; ++i) {
        writer.write(path(), to_json(image_of(i)));
        writer.flush();
        if (i == last + 1 && ::write(first_is_there[1], "!", 1) != 1) _exit(1);
      }
    }
    // Every second one dies at its start or with its first image, the rest among many.
    close(first_is_there[1]);
    char sign = 0;
    if (kill_number % 2 == 0) {
      EXPECT_EQ(::read(first_is_there[0], &sign, 1), 1);
    }
    usleep(static_cast<useconds_t>(std::uniform_int_distribution<int>(0, 8000)(random)));
    ::kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(first_is_there[0]);
    const std::int64_t value = value_of_whole(*read_nv_file(path()));
    ASSERT_GE(value, last) << kSeed << " " << kill_number;
    last = value;
  }
  const std::size_t left_overs = file_count() - 1;  // each has a different name
  EXPECT_GE(last, 50) << "it was able to write";
  EXPECT_GT(left_overs, 3u) << "it died while writing";
}

// --- errors of the disk ------------------------------------------------------------------------------------

TEST_F(NvFile, ThatCannotBeReplacedIsReportedOnceAndStays) {
  fs::create_directories(path() + "/in the way");
  NvWriter writer;
  for (int i = 0; i < 3; ++i) {
    writer.write(path(), numbered(1));
    writer.flush();
  }
  const auto news = writer.take_news();
  ASSERT_EQ(news.size(), 1u);
  EXPECT_EQ(news[0], path() +
                         ": cannot be written (it is a directory; expected a regular file, or a free path); "
                         "the file keeps its previous contents");
  EXPECT_TRUE(fs::exists(path() + "/in the way"));
  EXPECT_EQ(file_count(), 1u) << "nothing is left next to it";
  EXPECT_TRUE(writer.take_news().empty());

  fs::remove_all(path());
  for (int i = 0; i < 2; ++i) {
    writer.write(path(), numbered(1));
    writer.flush();
  }
  EXPECT_EQ(writer.take_news(), std::vector<std::string>{path() + ": can be written again"});
  EXPECT_EQ(text_of(path()), numbered(1));
}

TEST_F(NvFile, InAFolderThatIsNotThereIsReported) {
  NvWriter writer;
  writer.write(path("gone/feeder.json"), numbered(1));
  writer.write(path(), "another's");
  writer.flush();
  EXPECT_EQ(writer.take_news(),
            std::vector<std::string>{
                path("gone/feeder.json") +
                ": cannot be written (No such file or directory); the file keeps its previous contents"});
  EXPECT_EQ(text_of(path()), "another's") << "one file's error does not affect another";
}

/// Like a full disk: no file grows beyond this many bytes.
struct FullDisk {
  explicit FullDisk(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_DFL);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  rlimit before{};
};

TEST_F(NvFile, OnAFullDiskTheOldImageIsKeptAndNoPartialOneIsLeft) {
  const std::string old = to_json(image_of(1));
  const std::string wanted = to_json(image_of(2));
  NvWriter writer;
  writer.write(path(), old);
  writer.flush();
  {
    const FullDisk full(wanted.size() / 2);
    writer.write(path(), wanted);
    writer.flush();
    const auto news = writer.take_news();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0], path() + ": cannot be written (File too large); the file keeps its previous contents");
    EXPECT_EQ(text_of(path()), old);
    EXPECT_EQ(file_count(), 1u);
  }
  writer.write(path(), wanted);
  writer.flush();
  EXPECT_EQ(text_of(path()), wanted);
  EXPECT_EQ(writer.take_news().size(), 1u);
}

TEST_F(NvFile, WritesThroughNoLinkThatStandsBesideIt) {
  put(path("precious"), "precious");
  fs::create_symlink(path("precious"), path() + ".new");
  NvWriter writer;
  writer.write(path(), numbered(1));
  writer.flush();
  EXPECT_EQ(text_of(path()), numbered(1));
  EXPECT_EQ(text_of(path("precious")), "precious");
  EXPECT_TRUE(fs::is_symlink(path() + ".new"));
}

TEST_F(NvFile, InAFolderThatMayNotBeWrittenIsReported) {
  put(path(), numbered(1));
  fs::permissions(path("."), fs::perms::owner_read | fs::perms::owner_exec);
  {
    const OrdinaryUser nobody(path("."));
    NvWriter writer;
    writer.write(path(), numbered(2));
    writer.flush();
    EXPECT_EQ(writer.take_news(),
              std::vector<std::string>{
                  path() + ": cannot be written (Permission denied); the file keeps its previous contents"});
  }
  EXPECT_EQ(text_of(path()), numbered(1));
  fs::permissions(path("."), fs::perms::owner_all);
}

}  // namespace nv_file_test
}  // namespace understudy::emulator
