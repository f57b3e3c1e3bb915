// Measures the largest reads over a pty: all coils with function 01 (at most 2,000) and 125 registers with
// function 03, from the tests' controller with four tables and from a SUPER-40NC (--timing instant), compared
// with a libmodbus slave. Both servers run on one processor, the host on another. While one server is
// measured, the other is stopped.
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/host.h"
#include "benchmarks/responders.h"
#include "emulator/models/models.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::benchmarks {

namespace {

namespace workbench = emulator::workbench;

constexpr int kStation = 1;

struct Controller {
  const char* name;
  const emulator::Model& model;
  Responder::Range coils;
  Responder::Range registers;
};
constexpr int kWarmUp = 20;
constexpr int kExchanges = 300;
constexpr int kDefaultRounds = 40;

using Frame = std::vector<std::uint8_t>;

struct Read {
  std::string what;
  Frame request;
  std::size_t bytes;  // the size of its data
};

Read read_of(const std::string& what, std::uint8_t function, const Responder::Range& range,
             std::size_t bytes) {
  const auto high = [](unsigned number) { return static_cast<std::uint8_t>(number >> 8); };
  const auto low = [](unsigned number) { return static_cast<std::uint8_t>(number & 0xFF); };
  Frame request{kStation, function, high(range.first), low(range.first), high(range.count), low(range.count)};
  pty::append_rtu_crc(request);
  return {what, request, bytes};
}

/// Serves the controller until the process is killed.
void serve(const Controller& controller, const std::string& folder) {
  const emulator::ListedModel models[] = {&controller.model};
  const emulator::world::Bench bench = emulator::world::parse_bench(
      models,
      std::string("understudy: 1\nlines:\n  rs485:\n    link: ./port\n    timing: instant\n    stations:\n") +
          "      - { name: it, model: " + std::string(controller.model.name) + ", address: 1 }\n",
      "bench.yaml", folder);
  emulator::serve::DaemonOptions options;
  options.enforce_settings = false;  // the host is at 19200
  emulator::serve::Daemon daemon(bench, options, [](const std::string&) {});
  daemon.run();
}

/// Waits for the link, and returns its path.
std::string port_in(const std::string& folder) {
  const std::string link = folder + "/port";
  for (int tries = 0; tries < 5000; ++tries) {
    if (std::filesystem::exists(link)) return link;
    usleep(1000);
  }
  throw CannotRun(link + " does not appear");
}

struct Folder {
  Folder() {
    if (mkdtemp(path.data()) == nullptr) throw CannotRun("a temporary folder cannot be created");
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path = "/tmp/understudy-tables-XXXXXX";
};

/// Returns the processor time per request in microseconds.
double block(const Process& process, const Host& host, const Read& read) {
  process.carry_on();
  Frame reply(3 + read.bytes + 2);
  alarm(10);
  for (int i = 0; i < kWarmUp; ++i) host.exchange(read.request, reply);
  const Nanoseconds before = process.processor_time();
  for (int i = 0; i < kExchanges; ++i) host.exchange(read.request, reply);
  const Nanoseconds used = process.processor_time() - before;
  alarm(0);
  process.stop();
  if (reply[1] != read.request[1] || reply[2] != read.bytes || !pty::rtu_crc_ok(reply))
    throw CannotRun(std::string("wrong reply to ") + read.what);
  return static_cast<double>(used.count()) / 1000 / kExchanges;
}

/// Lets alarm() end the wait for a reply that never arrives.
void let_alarms_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(SIGALRM, &action, nullptr);
}

void run(const Controller& controller, const Processors& processors, int rounds) {
  const Folder folder;
  const Responder peer =
      Responder::libmodbus_tables(kStation, controller.coils, controller.registers, processors.server);
  const Process ours = Process::of_function([&] { serve(controller, folder.path); }, processors.server);
  const Host our_host(port_in(folder.path));
  const Host peer_host(peer.port());
  const unsigned coils = controller.coils.count;
  const Read reads[] = {read_of(std::to_string(coils) + " coils", 0x01, controller.coils, (coils + 7) / 8),
                        read_of(std::to_string(controller.registers.count) + " registers", 0x03,
                                controller.registers, 2 * controller.registers.count)};
  for (const Read& read : reads) {
    std::vector<double> own;
    std::vector<double> theirs;
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
      own.push_back(block(ours, our_host, read));
      theirs.push_back(block(peer.process(), peer_host, read));
      ratios.push_back(own.back() / theirs.back());
    }
    std::printf("%s, %-14s understudy %6.2f, libmodbus %6.2f\n", controller.name, read.what.c_str(),
                median(own), median(theirs));
    print_verdict((std::string(controller.name) + ": " + read.what + ", relative to libmodbus").c_str(),
                  median(ratios), 1.00);
  }
  ours.carry_on();
  peer.process().carry_on();
}

void run(int rounds) {
  const Processors processors = two_processors();
  let_alarms_interrupt();
  pin_to(processors.client);
  const emulator::Model* const mill = emulator::find_model(emulator::models::all_models(), "super-40nc");
  if (mill == nullptr) throw CannotRun("there is no super-40nc");
  std::printf("%d rounds of %d exchanges each; microseconds of processor time per request\n", rounds,
              kExchanges);
  run({"the tests' controller", workbench::model(), {0x1000, 2000}, {0x0064, 125}}, processors, rounds);
  run({"SUPER-40NC", *mill, {2000, 700}, {7200, 125}}, processors, rounds);  // M8000 on, D8100 on
}

}  // namespace

}  // namespace understudy::benchmarks

/// Usage: tables [ROUNDS]
int main(int count, char** arguments) {
  using namespace understudy::benchmarks;
  try {
    const int rounds = count > 1 ? std::atoi(arguments[1]) : kDefaultRounds;
    if (rounds < 1) throw CannotRun("ROUNDS: expected a positive number");
    run(rounds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tables: %s\n", error.what());
    return 2;
  }
}
