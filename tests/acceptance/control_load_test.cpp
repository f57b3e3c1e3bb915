// Clients of the control socket never make a host wait: hosts come first.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace control_load_test {

using Clock = std::chrono::steady_clock;

/// A client of the control socket that never waits.
class Client {
 public:
  explicit Client(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof(address.sun_path) - 1);
    is_connected_ = connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    fcntl(socket_.get(), F_SETFL, O_NONBLOCK);
  }
  bool is_connected() const { return is_connected_; }
  void say(const std::string& text) const { send(socket_.get(), text.data(), text.size(), MSG_NOSIGNAL); }
  /// The number of bytes received.
  std::size_t hear() const {
    std::array<char, 65536> bytes;
    const ssize_t count = recv(socket_.get(), bytes.data(), bytes.size(), 0);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  }

 private:
  Descriptor socket_;
  bool is_connected_ = false;
};

/// This many clients request the status repeatedly during its lifetime, as often as their sockets accept.
class Askers {
 public:
  Askers(const std::string& path, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) clients_.push_back(std::make_unique<Client>(path));
    thread_ = std::thread([this] {
      std::string lump;
      for (int i = 0; i < 100; ++i) lump += "{\"do\":\"status\"}\n";
      while (!is_over_) {
        for (const auto& client : clients_) {
          client->say(lump);
          heard_ += client->hear();
        }
      }
    });
  }
  ~Askers() {
    is_over_ = true;
    thread_.join();
  }
  Askers(const Askers&) = delete;
  Askers& operator=(const Askers&) = delete;
  std::size_t received() const { return heard_; }

 private:
  std::vector<std::unique_ptr<Client>> clients_;
  std::atomic<bool> is_over_ = false;
  std::atomic<std::size_t> heard_ = 0;
  std::thread thread_;
};

std::unique_ptr<RunningUnderstudy> feeder(const Words& flags = {}) {
  return RunningUnderstudy::of_bench(
      "understudy: 1\nlines: { rs485: { link: ./port, baud: 115200, stations: "
      "[ { name: feeder, model: simple2-r3 } ] } }\n",
      flags);
}

/// Returns how many requests a host loses that waits a second for each reply.
int lost(ModbusHost& host, int requests) {
  int count = 0;
  for (int i = 0; i < requests; ++i) {
    if (host.read(kHardwareCode) != Registers{0xC001}) ++count;
  }
  return count;
}

TEST(ControlLoad, TwoHundredClientsCostNoHostAReply) {
  const auto daemon = feeder();
  ModbusHost host(daemon->port(), {.baud = 115200});
  ASSERT_EQ(lost(host, 20), 0) << "without load";
  const Askers askers(daemon->control(), 200);
  ASSERT_TRUE(eventually([&] { return askers.received() > 1'000'000; }));
  EXPECT_EQ(lost(host, 200), 0);
  EXPECT_GT(askers.received(), 2'000'000U) << "they were served as well";
}

TEST(ControlLoad, ASignalIsObeyedAtOnce) {
  const auto time_to_stop = [](bool is_loaded) {
    const auto daemon = feeder();
    std::optional<Askers> askers;
    if (is_loaded) askers.emplace(daemon->control(), 200);
    EXPECT_TRUE(eventually([&] { return !is_loaded || askers->received() > 1'000'000; }));
    const auto begin = Clock::now();
    EXPECT_EQ(daemon->stop(SIGTERM), 0);
    return Clock::now() - begin;
  };
  const auto unloaded = time_to_stop(false);
  EXPECT_LT(time_to_stop(true), unloaded * 3 + std::chrono::seconds(1));
}

TEST(ControlLoad, ABadSnapshotCostsNoHostAReply) {
  const auto daemon = feeder();
  ModbusHost host(daemon->port(), {.baud = 115200});
  struct Case {
    const char* name;
    std::string text;
    const char* error;
  };
  for (const Case& bad : {Case{"nested", std::string(std::size_t{20} << 20, '['), "nested too deeply"},
                          Case{"long", "{\"understudy\":\"" + std::string(std::size_t{60} << 20, 'x') + "\"}",
                               "understudy: has a different format"}}) {
    const std::string file = daemon->folder().write(bad.name, bad.text);
    std::atomic<bool> is_over = false;
    Finished finished;
    std::thread restoring([&] {
      finished = daemon->ctl({"restore", file});
      is_over = true;
    });
    int count = 0;
    do {
      count += lost(host, 20);
    } while (!is_over);
    restoring.join();
    EXPECT_EQ(count, 0) << bad.name;
    EXPECT_EQ(finished.exit_code, 2) << bad.name;
    EXPECT_NE(finished.errors.find(bad.error), std::string::npos) << finished.errors;
  }
}

/// Returns the processor time of the process so far.
std::chrono::milliseconds processor_time(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  long user = 0;
  long system = 0;
  fields >> user >> system;
  return std::chrono::milliseconds((user + system) * 1000 / sysconf(_SC_CLK_TCK));
}

TEST(ControlLoad, WithoutDescriptorsTheDaemonRestsAndServesItsHosts) {
  const auto daemon = feeder();
  ModbusHost host(daemon->port(), {.baud = 115200});
  ASSERT_EQ(lost(host, 5), 0);
  const rlimit few{30, 30};
  ASSERT_EQ(prlimit(daemon->process().pid(), RLIMIT_NOFILE, &few, nullptr), 0);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 40; ++i) clients.push_back(std::make_unique<Client>(daemon->control()));
  for (const auto& client : clients) client->say("{\"do\":\"list\"}\n");
  ASSERT_TRUE(eventually([&] { return clients.front()->hear() > 0; }));
  const auto before = processor_time(daemon->process().pid());
  std::this_thread::sleep_for(Wait(2'000));
  // A client that sends repeatedly receives all replies, which is more than this even on a very busy machine.
  EXPECT_LT(processor_time(daemon->process().pid()) - before, Wait(50));
  EXPECT_EQ(lost(host, 20), 0);
  // Waiting clients are served when the others have gone.
  const auto last = std::move(clients.back());
  EXPECT_EQ(last->hear(), 0U);
  clients.clear();
  EXPECT_TRUE(eventually([&] { return last->hear() > 0; }));
}

}  // namespace control_load_test
}  // namespace understudy::acceptance
