// Which paths can become a port's link, and what remains of it.
#include "pty/port_link.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <set>

#include "pty/pseudo_terminal.h"
#include "tests/pty/pty_host.h"

namespace understudy::pty {
namespace port_link_test {

namespace fs = std::filesystem;

std::string error_of(const std::string& link_path) {
  try {
    const PseudoTerminal port(link_path);
  } catch (const PortError& error) {
    return error.what();
  }
  return {};
}

TEST(PortLink, IsAWorkingPathAndGoesWithThePort) {
  const ScratchDirectory directory;
  const std::string link = directory / "feeder.port";
  {
    PseudoTerminal port(link);
    EXPECT_EQ(port.link_path(), link);
    EXPECT_EQ(fs::read_symlink(link), port.path());
    Host host(link);
    EXPECT_TRUE(host.set_even_parity(B19200));
    EXPECT_TRUE(port.poll_presence().opened);
  }
  EXPECT_FALSE(fs::is_symlink(link));
}

TEST(PortLink, ReplacesStaleLinks) {
  const ScratchDirectory directory;
  const std::string link = directory / "feeder.port";
  // A dangling link, one of a run that was killed, and one whose number belongs to another program by now.
  const int other = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(other, 0);
  ASSERT_EQ(::unlockpt(other), 0);
  const std::string others = ::ptsname(other);
  for (const std::string& target : {directory / "nothing", std::string("/dev/pts/99999"), others}) {
    fs::create_symlink(target, link);
    const PseudoTerminal port(link);
    EXPECT_EQ(fs::read_symlink(link), port.path()) << target;
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory / "")) names.insert(entry.path().filename());
    EXPECT_EQ(names, (std::set<std::string>{".feeder.port.lock", "feeder.port"}));
  }
  ::close(other);
}

TEST(PortLink, LeavesWhatIsNotOursAlone) {
  const ScratchDirectory directory;
  const std::string expected = ", not a link that understudy made; expected a free path or a stale link";

  const std::string file = directory / "file";
  std::ofstream(file) << "precious";
  EXPECT_EQ(error_of(file), file + ": is a regular file" + expected);
  EXPECT_EQ(fs::file_size(file), 8u);

  const std::string folder = directory / "folder";
  fs::create_directory(folder);
  EXPECT_EQ(error_of(folder), folder + ": is a directory" + expected);
  EXPECT_TRUE(fs::is_directory(folder));

  const std::string link = directory / "link";
  fs::create_symlink(file, link);
  EXPECT_EQ(error_of(link), link + ": is a link to " + file + expected);
  EXPECT_EQ(fs::read_symlink(link), file);

  const std::string socket = directory / "socket";
  const Descriptor listener(::socket(AF_UNIX, SOCK_STREAM, 0));
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  socket.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(error_of(socket), socket + ": is a socket" + expected);
  EXPECT_EQ(error_of("/dev/null"), "/dev/null: is a device" + expected);
}

TEST(PortLink, NamesTheDirectoryThatIsMissing) {
  const ScratchDirectory directory;
  EXPECT_EQ(error_of(directory / "no/port"), directory / "no/port" + ": " + directory / "no" +
                                                 " does not exist; expected an existing directory");
  std::ofstream(directory / "file") << "x";
  EXPECT_EQ(error_of(directory / "file/port"), directory / "file/port" + ": " + directory / "file" +
                                                   " is not a directory; expected an existing directory");
}

TEST(PortLink, IsNotRemovedWhenItHasBecomeAnothers) {
  const ScratchDirectory directory;
  const std::string link = directory / "feeder.port";
  auto port = std::make_unique<PseudoTerminal>(link);
  fs::remove(link);
  fs::create_symlink("/dev/null", link);
  port.reset();
  EXPECT_EQ(fs::read_symlink(link), "/dev/null");
}

TEST(PortLink, IsRemovedAlsoFromAnotherWorkingDirectory) {
  const ScratchDirectory directory;
  const fs::path before = fs::current_path();
  fs::current_path(directory / "");
  {
    const PseudoTerminal port("feeder.port");
    EXPECT_EQ(port.link_path(), "feeder.port");
    fs::current_path(before);
    EXPECT_TRUE(fs::is_symlink(directory / "feeder.port"));
  }
  EXPECT_FALSE(fs::is_symlink(directory / "feeder.port"));
}

TEST(PortLink, OfAnUnderstudyThatRunsIsNotTaken) {
  const ScratchDirectory directory;
  const std::string link = directory / "feeder.port";
  {
    const PseudoTerminal first(link);
    EXPECT_EQ(error_of(link),
              link + ": is the link of another running understudy; expected a free path or a stale link");
    EXPECT_EQ(fs::read_symlink(link), first.path());
  }
  EXPECT_EQ(error_of(link), "");
  EXPECT_TRUE(fs::is_empty(directory / ""));
}

TEST(PortLink, CannotBeBlockedByWhoMayNotMakeIt) {
  const ScratchDirectory directory;
  const std::string link = directory / "feeder.port";
  // The sign of another run for 0.1.0: an abstract socket, which anybody can bind.
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const char c : fs::canonical(directory / "").string() + "/feeder.port") {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  }
  const Descriptor squatter(::socket(AF_UNIX, SOCK_DGRAM, 0));
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  const std::string name = std::string(1, '\0') + "understudy link " + std::to_string(hash);
  name.copy(address.sun_path, sizeof address.sun_path);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  ASSERT_EQ(::bind(squatter.get(), reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(error_of(link), "");
}

TEST(PortLink, TakesOverTheLockThatAKilledRunHasLeft) {
  const ScratchDirectory directory;
  const std::string lock = directory / ".feeder.port.lock";
  std::ofstream(lock).close();
  {
    const PseudoTerminal port(directory / "feeder.port");
    EXPECT_TRUE(fs::exists(lock));
  }
  EXPECT_FALSE(fs::exists(lock));
  // A file with contents belongs to somebody.
  std::ofstream(lock) << "precious";
  EXPECT_NE(error_of(directory / "feeder.port").find(lock + ": File exists"), std::string::npos);
  EXPECT_EQ(fs::file_size(lock), 8U);
}

TEST(PortLink, CanPointToAnother) {
  const ScratchDirectory folder;
  const std::string path = folder / "port";
  {
    PortLink link(path, "/dev/pts/1");
    link.point_to("/dev/pts/2");
    EXPECT_EQ(std::filesystem::read_symlink(path), "/dev/pts/2");
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/pts/3", path);
    link.point_to("/dev/pts/4");
    EXPECT_EQ(std::filesystem::read_symlink(path), "/dev/pts/3") << "it belongs to another by now";
  }
  EXPECT_TRUE(std::filesystem::is_symlink(path));
}

}  // namespace port_link_test
}  // namespace understudy::pty
