// Measures request and reply over a pty: Understudy with `--timing instant` and a moving axis, compared with
// a bare echo responder and a libmodbus slave. The requests are a read of a Simple2-R3, and a command through
// the window of an RS-M8194H. All three servers run on one processor, the host on another. The servers take
// turns, in blocks; during a block the others are stopped, so that none slows down another.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/host.h"
#include "benchmarks/responders.h"
#include "benchmarks/understudy_server.h"
#include "pty/rtu_crc.h"

namespace understudy::benchmarks {

namespace {

constexpr std::uint8_t kStation = 1;
constexpr int kWarmUp = 20;  // exchanges at the beginning of a block, which do not count
constexpr int kExchanges = 300;
constexpr int kDefaultRounds = 60;

enum Side : std::size_t { echo, libmodbus, understudy, kSides };
constexpr std::array<const char*, kSides> kNames = {"echo", "libmodbus", "understudy"};

using Frame = std::vector<std::uint8_t>;

Frame completed(Frame frame) {
  pty::append_rtu_crc(frame);
  return frame;
}

/// The request that is sent repeatedly.
struct Question {
  const char* name;
  const char* model;
  Frame request;
  Frame reply;  // as a bare responder sends it
  Responder::Range registers;
  void (UnderstudyServer::*start_moving)() const;
};

/// Reads the low word of Cord_A of a Simple2-R3, which changes with every tick of a move.
Question read_of_a_register() {
  constexpr std::uint8_t kHigh = 0x0E;
  constexpr std::uint8_t kLow = 0x04;
  return {.name = "a register",
          .model = "simple2-r3",
          .request = completed({kStation, 0x03, kHigh, kLow, 0x00, 0x01}),
          .reply = completed({kStation, 0x03, 0x02, 0x00, 0x00}),
          .registers = {.first = kHigh << 8U | kLow, .count = 1},
          .start_moving = &UnderstudyServer::start_long_move};
}

/// Sends RSM_CHANGE_VEL_ON_FLY Y 1000 to an RS-M8194H. It is executed on receipt, however many arrive in a
/// tick; commands that go through the FIFO would soon be refused as busy.
Question command_through_the_window() {
  constexpr unsigned kWindow = 8000;
  return {.name = "a command",
          .model = "rs-m8194h",
          .request = completed(
              {kStation, 0x10, 0x1F, 0x40, 0x00, 0x04, 0x08, 0x0A, 0x43, 0x00, 0x02, 0x00, 0x00, 0x03, 0xE8}),
          .reply = completed({kStation, 0x10, 0x1F, 0x40, 0x00, 0x04}),
          .registers = {.first = kWindow, .count = 4},
          .start_moving = &UnderstudyServer::start_endless_move};
}

class Contestant {
 public:
  Contestant(const Process& process, const std::string& port, const Question& question)
      : process_(process), host_(port), request_(question.request), reply_(question.reply.size()) {
    alarm(5);
    host_.exchange(request_, reply_);
    alarm(0);
    const bool is_right = std::equal(reply_.begin(), reply_.begin() + 3, question.reply.begin());
    if (!is_right || !pty::rtu_crc_ok(reply_)) throw CannotRun("wrong reply from " + port);
    process_.stop();
  }
  ~Contestant() { process_.carry_on(); }
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  void run_block() {
    process_.carry_on();
    std::vector<double> times;
    alarm(10);
    for (int i = 0; i < kWarmUp; ++i) host_.exchange(request_, reply_);
    const Nanoseconds before = process_.processor_time();
    for (int i = 0; i < kExchanges; ++i) {
      times.push_back(static_cast<double>(host_.exchange(request_, reply_).count()) / 1000);
    }
    const Nanoseconds used = process_.processor_time() - before;
    alarm(0);
    process_.stop();
    p50.push_back(percentile(times, 0.50));
    p99.push_back(percentile(times, 0.99));
    processor.push_back(static_cast<double>(used.count()) / 1000 / kExchanges);
    all.insert(all.end(), times.begin(), times.end());
  }

  // Microseconds: one figure per block, and every exchange.
  std::vector<double> p50;
  std::vector<double> p99;
  std::vector<double> processor;
  std::vector<double> all;

 private:
  const Process& process_;
  Host host_;
  Frame request_;
  Frame reply_;
};

/// Returns the median of the ratios between blocks of the same round: levels drift, but their ratio does not.
double ratio(const std::vector<double>& ours, const std::vector<double>& theirs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(ours[i] / theirs[i]);
  return median(ratios);
}

/// Lets alarm() end the wait for a reply that never arrives: a caught signal interrupts the read.
void let_alarms_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(SIGALRM, &action, nullptr);
}

void run(const Question& question, const Processors& processors, const std::string& executable, int rounds) {
  const Responder bare = Responder::echo(question.request.size(), question.reply, processors.server);
  const Responder peer = Responder::libmodbus_tables(kStation, {}, question.registers, processors.server);
  const UnderstudyServer ours(executable, "instant", processors.server, question.model);
  (ours.*question.start_moving)();

  std::array<std::unique_ptr<Contestant>, kSides> sides;
  sides[echo] = std::make_unique<Contestant>(bare.process(), bare.port(), question);
  sides[libmodbus] = std::make_unique<Contestant>(peer.process(), peer.port(), question);
  sides[understudy] = std::make_unique<Contestant>(ours.process(), ours.port(), question);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < kSides; ++i)
      sides[(i + static_cast<std::size_t>(round)) % kSides]->run_block();
  }

  std::array<double, 1> load{};
  getloadavg(load.data(), 1);
  const Contestant& floor = *sides[echo];
  std::printf("%s of %s: %d rounds of %d exchanges each; load average %.1f\n", question.name, question.model,
              rounds, kExchanges, load[0]);
  std::printf("microseconds; in parentheses, the ratio to echo (median over the rounds)\n");
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
  const auto judge = [&](const std::string& what, double found, double bar) {
    print_verdict((question.name + (": " + what)).c_str(), found, bar);
  };
  judge("p50 relative to echo", ratio(own.p50, floor.p50), 1.10);
  judge("p99 relative to echo", ratio(own.p99, floor.p99), 1.25);
  judge("processor time per request, relative to libmodbus",
        ratio(own.processor, sides[libmodbus]->processor), 1.00);
}

void run(const std::string& executable, int rounds) {
  const Processors processors = two_processors();
  let_alarms_interrupt();
  pin_to(processors.client);
  prctl(PR_SET_TIMERSLACK, 1UL);
  for (const Question& question : {read_of_a_register(), command_through_the_window()}) {
    run(question, processors, executable, rounds);
  }
}

}  // namespace

}  // namespace understudy::benchmarks

/// Usage: exchange [ROUNDS [EXECUTABLE]]
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
