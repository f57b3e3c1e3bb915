// Waiting for descriptors and moments.
#include "emulator/serve/loop/event_loop.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

namespace understudy::emulator::serve {
namespace event_loop_test {

using namespace std::chrono_literals;

/// Two connected sockets: data written to one is read from the other.
struct Pair {
  Pair() { EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0); }
  ~Pair() {
    for (const int end : ends) close(end);
  }
  void poke() const { EXPECT_EQ(write(ends[1], "x", 1), 1); }
  void drain() const {
    char byte = 0;
    EXPECT_EQ(::read(ends[0], &byte, 1), 1);
  }
  int near() const { return ends[0]; }
  std::array<int, 2> ends{-1, -1};
};

TEST(EventLoop, CallsWhatIsReadableAndNothingElse) {
  EventLoop loop;
  const Pair talking;
  const Pair silent;
  int calls = 0;
  loop.watch(talking.near(), EventLoop::readable, [&](std::uint32_t ready) {
    EXPECT_EQ(ready, EventLoop::readable);
    talking.drain();
    ++calls;
  });
  loop.watch(silent.near(), EventLoop::readable, [](std::uint32_t) { ADD_FAILURE() << "nothing was sent"; });
  loop.wait(wall_now());
  EXPECT_EQ(calls, 0);
  talking.poke();
  loop.wait(std::nullopt);
  EXPECT_EQ(calls, 1);
  loop.wait(wall_now());
  EXPECT_EQ(calls, 1);
}

// The kernel reports both descriptors at once. The first call closes the other descriptor, and opens one that
// gets its number.
TEST(EventLoop, DropsTheEventsOfADescriptorThatWasClosed) {
  EventLoop loop;
  std::array<Pair, 2> pairs;
  const Pair silent;
  int calls = 0;
  for (const std::size_t own : {0U, 1U}) {
    const int other = pairs.at(1 - own).near();
    loop.watch(pairs.at(own).near(), EventLoop::readable, [&, own, other](std::uint32_t) {
      pairs.at(own).drain();
      if (calls++ > 0) return;
      loop.unwatch(other);
      ASSERT_EQ(dup2(silent.near(), other), other);
      loop.watch(other, EventLoop::readable, [](std::uint32_t) { ADD_FAILURE() << "nothing was sent"; });
    });
  }
  for (const Pair& pair : pairs) pair.poke();
  loop.wait(std::nullopt);
  loop.wait(wall_now());
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, WaitsNoShorterThanUntilTheMoment) {
  EventLoop loop;
  const WallTime until = wall_now() + 20ms;
  loop.wait(until);
  EXPECT_GE(wall_now(), until);
}

TEST(EventLoop, AMomentInThePastOnlyLooks) {
  EventLoop loop;
  const WallTime before = wall_now();
  loop.wait(before - 1h);
  loop.wait(WallTime{0});
  loop.wait(WallTime{-1});
  EXPECT_LT(wall_now() - before, 5s);
}

TEST(EventLoop, InterestMayChange) {
  EventLoop loop;
  const Pair pair;
  std::uint32_t seen = 0;
  loop.watch(pair.near(), EventLoop::readable, [&](std::uint32_t ready) { seen = ready; });
  loop.wait(wall_now());
  EXPECT_EQ(seen, 0u);
  loop.change_interest(pair.near(), EventLoop::readable | EventLoop::writable);
  loop.wait(wall_now());
  EXPECT_EQ(seen, EventLoop::writable);
  seen = 0;
  loop.change_interest(pair.near(), 0);
  pair.poke();
  loop.wait(wall_now());
  EXPECT_EQ(seen, 0u);
  loop.change_interest(pair.near(), EventLoop::readable);
  loop.wait(wall_now());
  EXPECT_EQ(seen, EventLoop::readable);
  loop.change_interest(12345, EventLoop::readable);  // not watched: nothing happens
}

TEST(EventLoop, AHangUpIsReadable) {
  EventLoop loop;
  Pair pair;
  std::uint32_t seen = 0;
  loop.watch(pair.near(), EventLoop::readable, [&](std::uint32_t ready) { seen = ready; });
  close(pair.ends[1]);
  pair.ends[1] = -1;
  loop.wait(wall_now());
  EXPECT_NE(seen & EventLoop::readable, 0u);
}

TEST(EventLoop, ACallMayUnwatchItselfAndContinue) {
  EventLoop loop;
  const Pair pair;
  std::string kept_by_the_call = "still here";
  int calls = 0;
  loop.watch(pair.near(), EventLoop::readable, [&loop, &pair, &calls, kept_by_the_call](std::uint32_t) {
    loop.unwatch(pair.near());
    EXPECT_EQ(kept_by_the_call, "still here");  // the function outlives its watch
    ++calls;
  });
  pair.poke();
  loop.wait(wall_now());
  loop.wait(wall_now());
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, ACallMayUnwatchWhatIsReadyAtTheSameMoment) {
  EventLoop loop;
  const Pair first;
  const Pair second;
  int calls = 0;
  const auto only_one = [&](const Pair& other) {
    return [&loop, &calls, &other](std::uint32_t) {
      ++calls;
      loop.unwatch(other.near());
    };
  };
  loop.watch(first.near(), EventLoop::readable, only_one(second));
  loop.watch(second.near(), EventLoop::readable, only_one(first));
  first.poke();
  second.poke();
  loop.wait(wall_now());
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, ACallMayWatchSomethingNew) {
  EventLoop loop;
  const Pair first;
  const Pair second;
  int calls = 0;
  second.poke();
  loop.watch(first.near(), EventLoop::readable, [&](std::uint32_t) {
    first.drain();
    loop.watch(second.near(), EventLoop::readable, [&](std::uint32_t) { ++calls; });
  });
  first.poke();
  loop.wait(wall_now());
  loop.wait(wall_now());
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, ServesMoreDescriptorsThanOneLookBringsIn) {
  EventLoop loop;
  std::vector<Pair> pairs(100);
  std::vector<int> calls(pairs.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    loop.watch(pairs[i].near(), EventLoop::readable, [&, i](std::uint32_t) {
      pairs[i].drain();
      ++calls[i];
    });
    pairs[i].poke();
  }
  for (int look = 0; look < 10; ++look) loop.wait(wall_now());
  EXPECT_EQ(calls, std::vector<int>(pairs.size(), 1));
}

TEST(EventLoop, RefusesWhatCannotBeWatchedAndForgetsIt) {
  EventLoop loop;
  EXPECT_THROW(loop.watch(-1, EventLoop::readable, [](std::uint32_t) {}), std::system_error);
  loop.unwatch(-1);
  loop.wait(wall_now());
}

TEST(EventLoop, WhatMayWaitComesLastHoweverManyThereAre) {
  EventLoop loop;
  const Pair port;
  std::array<Pair, 40> clients;
  std::string order;
  for (const Pair& client : clients) {
    loop.watch(
        client.near(), EventLoop::readable,
        [&](std::uint32_t) {
          order += 'c';
          client.drain();
        },
        EventLoop::Rank::later);
    client.poke();
  }
  loop.watch(port.near(), EventLoop::readable, [&](std::uint32_t) {
    order += 'p';
    port.drain();
  });
  port.poke();
  loop.wait(wall_now());
  EXPECT_TRUE(order.starts_with("pc")) << order;
}

TEST(EventLoop, WhatMayWaitGetsASliceAndEachItsTurn) {
  EventLoop loop;
  const Pair port;
  std::array<Pair, 10> clients;
  std::array<int, 10> calls{};
  int turns_of_port = 0;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    loop.watch(
        clients[i].near(), EventLoop::readable,
        [&calls, i](std::uint32_t) {
          ++calls[i];  // and is ready again at once
          const WallTime until = wall_now() + EventLoop::kLaterSlice / 2;
          while (wall_now() < until) {
          }
        },
        EventLoop::Rank::later);
    clients[i].poke();
  }
  loop.watch(port.near(), EventLoop::readable, [&](std::uint32_t) { ++turns_of_port; });
  port.poke();
  int max_of_one_turn = 0;
  const auto all = [&] {
    int sum = 0;
    for (const int count : calls) sum += count;
    return sum;
  };
  while (all() < 100) {
    const int before = all();
    loop.wait(wall_now());
    max_of_one_turn = std::max(max_of_one_turn, all() - before);
  }
  EXPECT_GE(turns_of_port, 25) << "it is checked before each slice";
  EXPECT_LE(max_of_one_turn, 3);
  EXPECT_LE(*std::max_element(calls.begin(), calls.end()) - *std::min_element(calls.begin(), calls.end()), 1)
      << "they take turns";
}

TEST(EventLoop, WorkInPiecesIsDoneInTurnWithClients) {
  EventLoop loop;
  std::string order;
  const Pair client;
  loop.watch(
      client.near(), EventLoop::readable, [&](std::uint32_t) { order += 'c'; }, EventLoop::Rank::later);
  client.poke();  // and is ready again at once
  const auto work = [&](char name) {
    loop.do_in_pieces([&order, name, left = 3]() mutable {
      order += name;
      return --left > 0;
    });
  };
  work('a');
  work('b');
  while (order.size() < 14) loop.wait(std::nullopt);
  const std::string work_done = [&] {
    std::string pieces = order;
    std::erase(pieces, 'c');
    return pieces;
  }();
  EXPECT_EQ(work_done, "ababab") << "each gets its turn, and no more than it has";
  EXPECT_LE(order.find_last_of('b'), 12U) << order;
  for (std::size_t i = 1; i < 12; ++i) EXPECT_NE(order[i] == 'c', order[i - 1] == 'c') << order;
}

TEST(EventLoop, APieceKnowsWhenItsTimeIsOver) {
  EventLoop loop;
  EXPECT_FALSE(loop.slice_is_over()) << "no other client waits";
  bool was_over_at_once = true;
  bool was_over_later = false;
  loop.do_in_pieces([&] {
    was_over_at_once = loop.slice_is_over();
    const WallTime until = wall_now() + EventLoop::kLaterSlice;
    while (wall_now() < until) {
    }
    was_over_later = loop.slice_is_over();
    return false;
  });
  loop.wait(std::nullopt);  // does not wait for anything else
  EXPECT_FALSE(was_over_at_once && !was_over_later);
  EXPECT_TRUE(was_over_later);
  EXPECT_FALSE(loop.slice_is_over());
}

TEST(EventLoop, WhatMayWaitDoesSoWhileSomethingIsDueSoon) {
  EventLoop loop;
  const Pair client;
  WallTime due{0};
  std::vector<WallTime> begins;
  loop.watch(
      client.near(), EventLoop::readable, [&](std::uint32_t) { begins.push_back(wall_now()); },
      EventLoop::Rank::later);
  client.poke();
  int pieces = 0;
  loop.do_in_pieces([&] {
    begins.push_back(wall_now());
    return ++pieces < 50;
  });
  // Due again and again, before there is time: waiting functions are called after each, and not before it.
  int too_soon = 0;
  for (int turn = 0; turn < 50; ++turn) {
    due = wall_now() + EventLoop::kRoom / 2;
    begins.clear();
    int waits = 0;  // one that postpones them, and one until the moment comes
    for (; wall_now() < due; ++waits) loop.wait(due);
    for (const WallTime begin : begins) too_soon += begin < due ? 1 : 0;
    if (waits == 1) loop.wait(due);  // the machine has delayed us: what is due still comes first
    loop.wait(due);                  // it is past: the others have their turn
    EXPECT_FALSE(begins.empty()) << turn;
  }
  EXPECT_EQ(too_soon, 0);
}

TEST(EventLoop, WhatMayWaitKeepsWaitingThoughAHostSends) {
  EventLoop loop;
  const Pair port;
  const Pair client;
  WallTime called{0};
  int of_port = 0;
  loop.watch(
      client.near(), EventLoop::readable, [&](std::uint32_t) { called = wall_now(); },
      EventLoop::Rank::later);
  loop.watch(port.near(), EventLoop::readable, [&](std::uint32_t) { ++of_port; });
  client.poke();
  port.poke();  // and is ready again at once
  for (int round = 0; round < 50; ++round) {
    called = WallTime{0};
    const WallTime due = wall_now() + EventLoop::kRoom * 9 / 10;
    int turns = 0;
    for (; wall_now() < due; ++turns) loop.wait(due);
    if (turns > 1) {
      EXPECT_EQ(called, WallTime{0}) << round;
    }
    for (int look = 0; look < 3 && called == WallTime{0}; ++look) loop.wait(wall_now() + 1h);
    EXPECT_GE(called, due) << round;
  }
  EXPECT_GT(of_port, 100);
}

TEST(EventLoop, WhereNothingCanBeLateASliceIsLong) {
  EventLoop loop;
  int pieces = 0;
  loop.do_in_pieces([&] {
    ++pieces;
    const WallTime until = wall_now() + EventLoop::kLaterSlice;
    while (wall_now() < until) {
    }
    return true;
  });
  int max = 0;
  for (int turn = 0; turn < 20; ++turn) {
    const int before = pieces;
    loop.wait(wall_now(), EventLoop::kLongSlice);
    max = std::max(max, pieces - before);
  }
  EXPECT_GT(max, 5);
}

TEST(EventLoop, WorkInPiecesIsBegunOnlyWhileThereIsLittleOfIt) {
  EventLoop loop;
  const Pair client;
  int begun = 0;
  int under_way = 0;
  int max = 0;
  loop.watch(
      client.near(), EventLoop::readable,
      [&](std::uint32_t) {
        ++begun;
        max = std::max(max, ++under_way);
        loop.do_in_pieces([&under_way, left = 20]() mutable {
          if (--left > 0) return true;
          --under_way;
          return false;
        });
      },
      EventLoop::Rank::later);
  client.poke();  // and is ready again at once
  while (begun < 1'000) loop.wait(std::nullopt);
  EXPECT_LE(max, 64);
}

TEST(EventLoop, WhatMayWaitIsPutOffOnceAndNoMore) {
  EventLoop loop;
  const Pair client;
  int calls = 0;
  loop.watch(
      client.near(), EventLoop::readable, [&](std::uint32_t) { ++calls; }, EventLoop::Rank::later);
  client.poke();
  // Something is due soon at every check, as in a world whose time passes quickly.
  int looks = 0;
  for (; looks < 300 && calls < 100; ++looks) loop.wait(wall_now() + EventLoop::kRoom / 2);
  EXPECT_GE(calls, 100);
}

}  // namespace event_loop_test
}  // namespace understudy::emulator::serve
