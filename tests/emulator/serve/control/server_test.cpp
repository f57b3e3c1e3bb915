// The control socket: who can open it, what it replaces, and how it treats clients of every kind.
#include "emulator/serve/control/server.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/sanitized.h"

namespace understudy::emulator::serve {
namespace server_test {

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  return address;
}

/// A client that never waits.
struct Client {
  explicit Client(const std::string& path) : descriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    const sockaddr_un address = address_of(path);
    is_connected = connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }
  ~Client() { close(descriptor); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  std::size_t say(const std::string& bytes) const {
    const ssize_t count = send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  }
  /// Returns what has arrived so far; sets `is_over` if the server has hung up.
  std::string hear() {
    std::string received;
    char bytes[4096];
    while (true) {
      const ssize_t count = recv(descriptor, bytes, sizeof(bytes), 0);
      if (count == 0 || (count < 0 && errno == ECONNRESET)) is_over = true;
      if (count <= 0) return received;
      received.append(bytes, static_cast<std::size_t>(count));
    }
  }

  int descriptor;
  bool is_connected = false;
  bool is_over = false;
};

/// A server that answers "you said: ...".
struct ServerRig {
  ServerRig() = default;
  void serve(const std::string& at) {
    server = std::make_unique<ControlServer>(loop, at,
                                             [this](const std::string& line, ControlServer::Reply reply) {
                                               received.push_back(line);
                                               if (answers) reply("you said: " + line);
                                               replies.push_back(std::move(reply));
                                             });
  }
  /// Lets the server do all its pending work. One call does less if the machine is busy, because its time is
  /// limited.
  void settle() {
    for (int look = 0; look < 1000; ++look) loop.wait(wall_now());
  }

  TestFolder folder;
  std::string path = folder.path + "/control";
  EventLoop loop;
  std::vector<std::string> received;
  std::vector<ControlServer::Reply> replies;
  bool answers = true;
  std::unique_ptr<ControlServer> server;
};

std::string refusal(ServerRig& rig, const std::string& path) {
  try {
    rig.serve(path);
  } catch (const ControlError& error) {
    return error.what();
  }
  return "";
}

TEST(ControlServer, OnlyItsOwnerMayOpenTheSocketWhateverTheUmask) {
  for (const mode_t mask : {0000, 0022, 0077}) {
    ServerRig rig;
    const mode_t before = umask(mask);
    rig.serve(rig.path);
    const mode_t after = umask(before);
    EXPECT_EQ(after, mask) << "the umask is unchanged";
    struct stat status {};
    ASSERT_EQ(lstat(rig.path.c_str(), &status), 0);
    EXPECT_TRUE(S_ISSOCK(status.st_mode));
    EXPECT_EQ(status.st_mode & 0777, 0600u);
  }
}

TEST(ControlServer, TakesItsSocketAwayWhenItGoes) {
  ServerRig rig;
  rig.serve(rig.path);
  EXPECT_TRUE(std::filesystem::exists(rig.path));
  rig.server.reset();
  EXPECT_FALSE(std::filesystem::exists(rig.path));
}

TEST(ControlServer, ReplacesADeadSocket) {
  ServerRig rig;
  const int dead = socket(AF_UNIX, SOCK_STREAM, 0);
  const sockaddr_un address = address_of(rig.path);
  ASSERT_EQ(bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  close(dead);
  ASSERT_TRUE(std::filesystem::exists(rig.path));
  EXPECT_EQ(refusal(rig, rig.path), "");
  Client client(rig.path);
  EXPECT_TRUE(client.is_connected);
  client.say("hello\n");
  rig.settle();
  EXPECT_EQ(client.hear(), "you said: hello\n");
}

TEST(ControlServer, LeavesALiveSocketAlone) {
  ServerRig first;
  first.serve(first.path);
  ServerRig second;
  EXPECT_EQ(refusal(second, first.path), first.path + ": another understudy uses it; expected a free path");
  Client client(first.path);
  client.say("still there?\n");
  first.settle();
  EXPECT_EQ(client.hear(), "you said: still there?\n");
}

TEST(ControlServer, LeavesWhatIsNoSocketAlone) {
  ServerRig rig;
  std::ofstream(rig.path) << "precious";
  EXPECT_EQ(refusal(rig, rig.path), rig.path + ": is not a socket; expected a free path");
  std::string content;
  std::ifstream(rig.path) >> content;
  EXPECT_EQ(content, "precious");
  EXPECT_EQ(refusal(rig, rig.folder.path), rig.folder.path + ": is not a socket; expected a free path");
  const std::string link = rig.folder.path + "/link";
  ASSERT_EQ(symlink("/nowhere/at/all", link.c_str()), 0);
  EXPECT_EQ(refusal(rig, link), link + ": is not a socket; expected a free path");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(ControlServer, APathThatCannotBeASocketIsRefused) {
  ServerRig rig;
  for (const std::string& path : {std::string(), std::string(108, 'x'), "/tmp/" + std::string(5000, 'x'),
                                  rig.folder.path + "/no/such/folder", std::string("/proc/control")}) {
    EXPECT_NE(refusal(rig, path), "") << path.substr(0, 40);
    EXPECT_FALSE(rig.server);
  }
  EXPECT_EQ(refusal(rig, rig.path), "");
}

TEST(ControlServer, AHundredClientsAreServedEach) {
  ServerRig rig;
  rig.serve(rig.path);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 100; ++i) {
    clients.push_back(std::make_unique<Client>(rig.path));
    ASSERT_TRUE(clients.back()->is_connected) << i;
    rig.loop.wait(wall_now());
  }
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < clients.size(); ++i) clients[i]->say(std::to_string(i) + "\n");
    rig.settle();
    for (std::size_t i = 0; i < clients.size(); ++i) {
      EXPECT_EQ(clients[i]->hear(), "you said: " + std::to_string(i) + "\n");
    }
  }
}

TEST(ControlServer, AMessageMayComeInPiecesAndSeveralAtOnce) {
  ServerRig rig;
  rig.serve(rig.path);
  Client client(rig.path);
  for (const char c : std::string("in pieces\n")) {
    EXPECT_EQ(client.hear(), "");
    client.say(std::string(1, c));
    rig.settle();
  }
  EXPECT_EQ(client.hear(), "you said: in pieces\n");
  client.say("one\ntwo\n\nfo");
  rig.settle();
  EXPECT_EQ(client.hear(), "you said: one\nyou said: two\nyou said: \n");
  client.say("ur\n");
  rig.settle();
  EXPECT_EQ(client.hear(), "you said: four\n");
}

TEST(ControlServer, AClientThatLeavesInTheMiddleIsForgotten) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  {
    Client half(rig.path);
    half.say("half a mess");
    Client asked(rig.path);
    asked.say("tell me later\n");
    rig.settle();
  }
  rig.settle();
  EXPECT_EQ(rig.received, std::vector<std::string>{"tell me later"});
  rig.replies.at(0)("too late");  // to nobody
  rig.server.reset();
  rig.replies.at(0)("even later");
}

TEST(ControlServer, AReplyMayComeLater) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  Client client(rig.path);
  client.say("advance\n");
  rig.settle();
  EXPECT_EQ(client.hear(), "");
  rig.replies.at(0)("there");
  EXPECT_EQ(client.hear(), "there\n");
}

TEST(ControlServer, MessagesOfOneClientAreAnsweredInTheirOrder) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  Client client(rig.path);
  client.say("advance\nget\n");
  rig.settle();
  EXPECT_EQ(rig.received, std::vector<std::string>{"advance"}) << "the next client waits";
  rig.answers = true;
  rig.replies.at(0)("there");
  rig.settle();
  EXPECT_EQ(client.hear(), "there\nyou said: get\n");
}

TEST(ControlServer, ManyMessagesMayWaitBehindOneAndEachIsAnswered) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  Client client(rig.path);
  client.say("advance\n");
  rig.settle();
  std::string waiting;  // more than the maximum length of a message
  for (int i = 0; i < 10'000; ++i) waiting += "get number " + std::to_string(i) + "\n";
  std::size_t printed = 0;
  std::string received;
  rig.answers = true;
  for (int round = 0; round < 1000 && received.find("number 9999\n") == std::string::npos; ++round) {
    printed += client.say(waiting.substr(printed));
    rig.settle();
    if (round == 10) rig.replies.at(0)("there");
    received += client.hear();
  }
  EXPECT_TRUE(received.starts_with("there\nyou said: get number 0\n")) << received.substr(0, 100);
  EXPECT_NE(received.find("number 9999\n"), std::string::npos);
  EXPECT_EQ(rig.received.size(), 10'001U);
}

TEST(ControlServer, AClientThatHasSaidAllStillGetsItsReply) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  Client client(rig.path);
  client.say("advance\nget\n");
  shutdown(client.descriptor, SHUT_WR);
  rig.settle();
  rig.answers = true;
  rig.replies.at(0)("there");
  rig.settle();
  EXPECT_EQ(client.hear(), "there\nyou said: get\n");
  EXPECT_TRUE(client.is_over);
}

TEST(ControlServer, ALineThatNeverEndsIsRefusedAndTheClientDropped) {
  ServerRig rig;
  rig.serve(rig.path);
  Client endless(rig.path);
  Client other(rig.path);
  constexpr int kMaxPieces = 1024;
  const std::string piece(4096, 'x');
  for (int i = 0; i < kMaxPieces + 40 && !endless.is_over; ++i) {
    endless.say(piece);
    rig.settle();
    const std::string received = endless.hear();
    if (received.empty()) continue;
    EXPECT_EQ(
        received,
        "{\"ok\":false,\"error\":\"the message is too long; expected a line of at most 4194304 bytes\"}\n");
    EXPECT_GE(i, kMaxPieces);
  }
  EXPECT_TRUE(endless.is_over);
  EXPECT_TRUE(rig.received.empty());
  other.say("and I?\n");
  rig.settle();
  EXPECT_EQ(other.hear(), "you said: and I?\n");
}

TEST(ControlServer, ALongMessageBelowTheLimitIsHeardWhole) {
  ServerRig rig;
  rig.serve(rig.path);
  Client client(rig.path);
  const std::string message(60000, 'm');
  std::size_t sent = 0;
  while (sent < message.size()) {
    sent += client.say(message.substr(sent, 4096));
    rig.settle();
  }
  client.say("\n");
  rig.settle();
  EXPECT_EQ(rig.received, std::vector<std::string>{message});
}

TEST(ControlServer, AClientThatNeverReadsIsDroppedBeforeMemoryFills) {
  ServerRig rig;
  rig.serve(rig.path);
  rig.answers = false;
  Client lazy(rig.path);
  lazy.say("a\n");
  rig.settle();
  const std::string megabyte(1 << 20, 'r');
  for (int i = 0; i < 16; ++i) rig.replies.at(0)(megabyte);
  std::size_t received = 0;
  for (int i = 0; i < 100; ++i) {
    received += lazy.hear().size();
    rig.settle();
  }
  EXPECT_TRUE(lazy.is_over);
  EXPECT_LT(received, std::size_t{12} << 20);
}

TEST(AskControl, ComplainsWhenNobodyAnswers) {
  const TestFolder folder;
  EXPECT_THROW(ask_control(folder.path + "/nobody", "{}"), ControlError);
  EXPECT_THROW(ask_control("", "{}"), ControlError);
  EXPECT_THROW(ask_control(std::string(200, 'x'), "{}"), ControlError);
}

TEST(AskControl, ComplainsWhenTheServerGoesBeforeItAnswers) {
  const TestFolder folder;
  const std::string path = folder.path + "/control";
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  const sockaddr_un address = address_of(path);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ASSERT_EQ(listen(listener, 1), 0);
  std::thread server([&] {
    const int client = accept(listener, nullptr, nullptr);
    char bytes[64];
    EXPECT_GT(recv(client, bytes, sizeof(bytes), 0), 0);
    EXPECT_EQ(send(client, "half", 4, 0), 4);
    close(client);
  });
  EXPECT_THROW(ask_control(path, "{}"), ControlError);
  server.join();
  close(listener);
}

TEST(ControlServer, ClientsTakeTurnsHoweverMuchOneHasToSay) {
  ServerRig rig;
  rig.serve(rig.path);
  Client busy(rig.path);
  Client other(rig.path);
  std::string much;
  for (int i = 0; i < 200; ++i) much += "much\n";
  busy.say(much);
  other.say("a word\n");
  rig.settle();
  const auto turn = std::find(rig.received.begin(), rig.received.end(), "a word") - rig.received.begin();
  EXPECT_LE(turn, 3) << "after one message of the other client, not after all";
  while (rig.received.size() < 201) rig.loop.wait(wall_now() + std::chrono::seconds(5));
}

/// While this object exists, no more descriptors are available than now.
struct NoMoreDescriptors {
  NoMoreDescriptors() {
    getrlimit(RLIMIT_NOFILE, &before);
    const int next = dup(0);
    close(next);
    rlimit limit = before;
    limit.rlim_cur = static_cast<rlim_t>(next);
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  ~NoMoreDescriptors() { setrlimit(RLIMIT_NOFILE, &before); }
  NoMoreDescriptors(const NoMoreDescriptors&) = delete;
  NoMoreDescriptors& operator=(const NoMoreDescriptors&) = delete;
  rlimit before{};
};

TEST(ControlServer, WithoutDescriptorsItRestsUntilAClientHasGone) {
  ServerRig rig;
  rig.serve(rig.path);
  auto served = std::make_unique<Client>(rig.path);
  served->say("first\n");
  rig.settle();
  Client waiting(rig.path);
  waiting.say("second\n");
  {
    const NoMoreDescriptors none;
    rig.settle();
    // Nobody is notified repeatedly that a client waits.
    const WallTime before = wall_now();
    rig.loop.wait(before + std::chrono::milliseconds(100));
    EXPECT_GE(wall_now() - before, std::chrono::milliseconds(100));
    served->say("third\n");
    rig.settle();
    EXPECT_EQ(rig.received, (std::vector<std::string>{"first", "third"}));
  }
  served.reset();
  rig.settle();
  EXPECT_EQ(rig.received.back(), "second");
  EXPECT_EQ(waiting.hear(), "you said: second\n");
}

TEST(ControlServer, WithoutDescriptorsItTriesAgainByItself) {
  // Its check of a virtual call opens a pipe to see whether memory can be read.
  if (is_address_sanitized()) GTEST_SKIP() << "the sanitizer needs descriptors of its own";
  ServerRig rig;
  rig.serve(rig.path);
  Client waiting(rig.path);
  waiting.say("is there room?\n");
  {
    const NoMoreDescriptors none;
    rig.settle();
  }
  EXPECT_TRUE(rig.received.empty());
  for (const WallTime end = wall_now() + std::chrono::seconds(10); rig.received.empty() && wall_now() < end;)
    rig.loop.wait(wall_now() + std::chrono::milliseconds(50));
  EXPECT_EQ(waiting.hear(), "you said: is there room?\n");
}

}  // namespace server_test
}  // namespace understudy::emulator::serve
