// One watch for several terminals, and terminals that the kernel does not watch.
#include "pty/presence_watch.h"

#include <sys/inotify.h>

#include <fstream>

#include "tests/ordinary_user.h"
#include "tests/pty/pty_host.h"

namespace understudy::pty {
namespace presence_watch_test {

struct TwoTerminals : testing::Test {
  std::shared_ptr<PresenceWatch> watch = std::make_shared<PresenceWatch>();
  PseudoTerminal one{"", watch};
  std::unique_ptr<PseudoTerminal> other = std::make_unique<PseudoTerminal>("", watch);
};

TEST_F(TwoTerminals, HaveTheirOwnHosts) {
  const Host host(other->path());
  ASSERT_TRUE(is_readable(watch->descriptor(), kTimeoutMs));
  watch->collect();
  EXPECT_FALSE(one.has_presence_news());
  EXPECT_TRUE(other->has_presence_news());
  EXPECT_TRUE(other->poll_presence().opened);
  EXPECT_FALSE(one.poll_presence().opened);
  EXPECT_TRUE(other->host_present());
}

TEST_F(TwoTerminals, KeepWhatTheOtherCollected) {
  const Host host(other->path());
  EXPECT_FALSE(one.poll_presence().opened);  // empties the kernel's queue
  EXPECT_FALSE(is_readable(watch->descriptor(), 0));
  EXPECT_TRUE(other->has_presence_news());
  EXPECT_TRUE(other->poll_presence().opened);
}

TEST_F(TwoTerminals, MayGoOneByOne) {
  const std::string path = other->path();
  Host(path).close();
  other.reset();
  const Host host(one.path());
  EXPECT_TRUE(one.poll_presence().opened);
  EXPECT_FALSE(is_readable(watch->descriptor(), 0));
}

// A line that is not served for a long time stores little, and then checks itself.
TEST_F(TwoTerminals, ForgetNoHostAmongThousands) {
  for (int i = 0; i < 2000; ++i) {
    Host(other->path()).close();
    watch->collect();
  }
  const Host last(other->path());
  const auto presence = other->poll_presence();
  EXPECT_TRUE(presence.opened);
  EXPECT_TRUE(other->host_present());
}

/// All inotify instances of an ordinary user.
class AllInstances {
 public:
  AllInstances() {
    for (int i = 0; i < kLimit; ++i) {
      Descriptor instance(::inotify_init1(IN_CLOEXEC));
      if (!instance) return;
      instances_.push_back(std::move(instance));
    }
  }
  bool are_taken() const { return instances_.size() < kLimit; }

 private:
  static constexpr int kLimit = 900;  // below the usual limit of descriptors
  std::vector<Descriptor> instances_;
};

TEST(UnwatchedTerminal, LooksWhoIsThereWheneverItIsAsked) {
  const ScratchDirectory folder;
  const OrdinaryUser user(folder / ".");
  const AllInstances all;
  if (!all.are_taken()) GTEST_SKIP() << "this machine has no such limit";
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  EXPECT_LT(terminal.watch->descriptor(), 0);
  EXPECT_FALSE(port.is_watched());
  for (int i = 0; i < 3; ++i) {
    Host host(port.path());
    EXPECT_TRUE(host.set_even_parity(B19200)) << i;
    EXPECT_TRUE(port.poll_presence().opened) << i;
    EXPECT_FALSE(port.poll_presence().opened) << i;
    EXPECT_FALSE(port.is_in_doubt()) << i;
    host.write(hex("01 02 03"));
    EXPECT_EQ(read_some(port), hex("01 02 03")) << i;
    port.write(hex("04 05"));
    EXPECT_EQ(host.read(2), hex("04 05")) << i;
    host.close();
    EXPECT_TRUE(port.poll_presence().closed) << i;
    EXPECT_FALSE(port.host_present()) << i;
  }
  // Bytes also show that a host is present.
  Host host(port.path());
  host.write(hex("01"));
  EXPECT_EQ(read_some(port), hex("01"));
  EXPECT_TRUE(port.host_present());
  EXPECT_TRUE(port.poll_presence().opened);
}

}  // namespace presence_watch_test
}  // namespace understudy::pty
