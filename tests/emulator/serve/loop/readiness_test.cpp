#include "emulator/serve/loop/readiness.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "base/files/descriptor.h"

namespace understudy::emulator::serve {
namespace readiness_test {

/// The service manager's end of the protocol. `name` is as in NOTIFY_SOCKET.
class ListeningManager {
 public:
  explicit ListeningManager(const std::string& name)
      : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof(address.sun_path) - 1);
    if (name[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size), 0) << name;
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ~ListeningManager() { unsetenv("NOTIFY_SOCKET"); }

  std::string received() const {
    std::array<char, 256> text{};
    const ssize_t size = recv(socket_.get(), text.data(), text.size(), 0);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
  }

 private:
  Descriptor socket_;
};

std::string name_of_our_own() { return "understudy-readiness-" + std::to_string(getpid()); }

TEST(Readiness, ReachesASocketThatIsAPath) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name_of_our_own();
  const ListeningManager manager(path.string());
  notify_service_manager("READY=1");
  EXPECT_EQ(manager.received(), "READY=1");
  notify_service_manager("STOPPING=1");
  EXPECT_EQ(manager.received(), "STOPPING=1");
  EXPECT_EQ(manager.received(), "");
  std::filesystem::remove(path);
}

TEST(Readiness, ReachesAnAbstractSocket) {
  const ListeningManager manager("@" + name_of_our_own());
  notify_service_manager("READY=1");
  EXPECT_EQ(manager.received(), "READY=1");
}

TEST(Readiness, ReachesAnAbstractSocketWithTheLongestAllowedName) {
  const ListeningManager manager("@" + name_of_our_own() + std::string(106 - name_of_our_own().size(), 'x'));
  notify_service_manager("READY=1");
  EXPECT_EQ(manager.received(), "READY=1");
}

TEST(Readiness, IsKeptToItselfWhereNobodyListens) {
  for (const std::string& name : {std::string(), std::string("relative"), std::string("/missing/socket"),
                                  "@" + name_of_our_own() + "-nobody", "/" + std::string(500, 'x')}) {
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    notify_service_manager("READY=1");
  }
  unsetenv("NOTIFY_SOCKET");
  notify_service_manager("READY=1");
}

}  // namespace readiness_test
}  // namespace understudy::emulator::serve
