// Request and reply over a pty: Understudy with `--timing instant` and an axis that moves, beside a bare
// echo responder and a libmodbus slave. All three live on one processor, the host on the other; they are
// asked in turn, in blocks, and while one is asked the others are stopped, so that none pays for another.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "benchmarks/figures.h"
#include "benchmarks/host.h"
#include "benchmarks/responders.h"
#include "benchmarks/understudy_server.h"
#include "pty/rtu_crc.h"

namespace understudy::benchmarks {

namespace {

constexpr int kStation = 1;
constexpr int kRegister = 0x0E04;  // Cord_A, its low word: it changes with every tick of a move
constexpr std::size_t kReplySize = 7;
constexpr int kWarmUp = 20;  // exchanges at the beginning of a block that do not count
constexpr int kExchanges = 300;
constexpr int kDefaultRounds = 60;

enum Side : std::size_t { echo, libmodbus, understudy, kSides };
constexpr std::array<const char*, kSides> kNames = {"echo", "libmodbus", "understudy"};

using Frame = std::vector<std::uint8_t>;

Frame completed(Frame frame) {
  pty::append_rtu_crc(frame);
  return frame;
}

Frame request() { return completed({kStation, 0x03, kRegister >> 8, kRegister & 0xFF, 0x00, 0x01}); }

class Contestant {
 public:
  Contestant(const Process& process, const std::string& port, const Frame& request)
      : process_(process), host_(port), request_(request) {
    std::array<std::uint8_t, kReplySize> reply{};
    alarm(5);
    host_.exchange(request_, reply);
    alarm(0);
    if (reply[0] != kStation || reply[1] != 0x03 || reply[2] != 2 || !pty::rtu_crc_ok(reply)) {
      throw CannotRun("a wrong reply came from " + port);
    }
    process_.stop();
  }
  ~Contestant() { process_.carry_on(); }
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  void run_block() {
    process_.carry_on();
    std::array<std::uint8_t, kReplySize> reply{};
    std::vector<double> times;
    alarm(10);
    for (int i = 0; i < kWarmUp; ++i) host_.exchange(request_, reply);
    const Nanoseconds before = process_.processor_time();
    for (int i = 0; i < kExchanges; ++i) {
      times.push_back(static_cast<double>(host_.exchange(request_, reply).count()) / 1000);
    }
    const Nanoseconds used = process_.processor_time() - before;
    alarm(0);
    process_.stop();
    p50.push_back(percentile(times, 0.50));
    p99.push_back(percentile(times, 0.99));
    processor.push_back(static_cast<double>(used.count()) / 1000 / kExchanges);
    all.insert(all.end(), times.begin(), times.end());
  }

  // Microseconds: one figure a block, and every exchange.
  std::vector<double> p50;
  std::vector<double> p99;
  std::vector<double> processor;
  std::vector<double> all;

 private:
  const Process& process_;
  Host host_;
  Frame request_;
};

/// The median of the ratios of blocks of the same round: levels drift, their ratio does not.
double ratio(const std::vector<double>& ours, const std::vector<double>& theirs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(ours[i] / theirs[i]);
  return median(ratios);
}

/// Lets alarm() end the wait for a reply that never comes: a caught signal breaks it off.
void let_alarms_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(SIGALRM, &action, nullptr);
}

void run(const std::string& executable, int rounds) {
  const Processors processors = two_processors();
  const Frame reply = completed({kStation, 0x03, 0x02, 0x00, 0x00});
  const Responder bare = Responder::echo(request().size(), reply, processors.server);
  const Responder peer = Responder::libmodbus(kStation, kRegister, processors.server);
  const UnderstudyServer ours(executable, "instant", processors.server);
  ours.start_long_move();
  let_alarms_interrupt();
  pin_to(processors.client);
  prctl(PR_SET_TIMERSLACK, 1UL);

  std::array<std::unique_ptr<Contestant>, kSides> sides;
  sides[echo] = std::make_unique<Contestant>(bare.process(), bare.port(), request());
  sides[libmodbus] = std::make_unique<Contestant>(peer.process(), peer.port(), request());
  sides[understudy] = std::make_unique<Contestant>(ours.process(), ours.port(), request());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < kSides; ++i)
      sides[(i + static_cast<std::size_t>(round)) % kSides]->run_block();
  }

  std::array<double, 1> load{};
  getloadavg(load.data(), 1);
  const Contestant& floor = *sides[echo];
  std::printf("%d rounds of %d exchanges each; load average %.1f\n", rounds, kExchanges, load[0]);
  std::printf("microseconds, and in brackets the ratio to echo, the median over the rounds\n");
  std::printf("%-12s %18s %18s %18s %12s %12s\n", "", "p50 of a block", "p99 of a block", "processor/request",
              "p50 of all", "p99 of all");
  for (std::size_t i = 0; i < kSides; ++i) {
    const Contestant& side = *sides[i];
    std::printf("%-12s %9.1f  (%5.3f) %9.1f  (%5.3f) %9.2f  (%5.3f) %12.1f %12.1f\n", kNames[i],
                median(side.p50), ratio(side.p50, floor.p50), median(side.p99), ratio(side.p99, floor.p99),
                median(side.processor), ratio(side.processor, floor.processor), percentile(side.all, 0.50),
                percentile(side.all, 0.99));
  }
  const Contestant& own = *sides[understudy];
  print_verdict("p50 against echo", ratio(own.p50, floor.p50), 1.10);
  print_verdict("p99 against echo", ratio(own.p99, floor.p99), 1.25);
  print_verdict("processor time of a request against libmodbus",
                ratio(own.processor, sides[libmodbus]->processor), 1.00);
}

}  // namespace

}  // namespace understudy::benchmarks

/// exchange [ROUNDS [EXECUTABLE]]
int main(int count, char** arguments) {
  using namespace understudy::benchmarks;
  try {
    const int rounds = count > 1 ? std::atoi(arguments[1]) : kDefaultRounds;
    if (rounds < 1) throw CannotRun("ROUNDS: expected a positive number");
    run(count > 2 ? arguments[2] : UNDERSTUDY_EXECUTABLE, rounds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "exchange: %s\n", error.what());
    return 2;
  }
}
