// Measures short runs of the program, and the time from exec to the `ready` line, compared with a run of
// /bin/true.
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/understudy_server.h"

namespace understudy::benchmarks {

namespace {

constexpr int kDefaultStarts = 40;

double milliseconds(Nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

Nanoseconds run_to_its_end(const std::vector<std::string>& command) {
  const Nanoseconds start = now();
  if (Process::of_command(command).wait() != 0) throw CannotRun(command.front() + " failed");
  return now() - start;
}

Nanoseconds run_until_ready(const std::string& executable, const std::string& model) {
  const Nanoseconds start = now();
  const UnderstudyServer server(executable, "wire", Process::kAnyProcessor, model);
  return now() - start;
}

struct Start {
  std::string name;
  std::function<Nanoseconds()> time;
  double bar;  // runs of /bin/true
};

void measure(const Start& start, int starts) {
  std::vector<double> others;
  std::vector<double> ours;
  std::vector<double> ratios;
  for (int i = 0; i < starts; ++i) {
    others.push_back(milliseconds(run_to_its_end({"/bin/true"})));
    ours.push_back(milliseconds(start.time()));
    ratios.push_back(ours.back() / others.back());
  }
  std::printf("%-24s %8.2f %8.2f   /bin/true %8.2f %8.2f\n", start.name.c_str(), median(ours),
              percentile(ours, 0.9), median(others), percentile(others, 0.9));
  print_verdict((start.name + ", relative to /bin/true, median over the pairs").c_str(), median(ratios),
                start.bar);
}

void run(const std::string& executable, int starts) {
  const UnderstudyServer running(executable, "wire");
  const std::vector<std::string> look{executable, "ctl", "--control", running.control_socket(),
                                      "get",      "time"};
  std::printf("%d starts; milliseconds: median, p90\n", starts);
  for (const Start& start : {
           Start{"--version",
                 [&] {
                   return run_to_its_end({executable, "--version"});
                 },
                 2},
           Start{"ctl get time", [&] { return run_to_its_end(look); }, 2},
           Start{"exec to ready, simple2-r3", [&] { return run_until_ready(executable, "simple2-r3"); }, 4},
           Start{"exec to ready, super-40nc", [&] { return run_until_ready(executable, "super-40nc"); }, 7},
       }) {
    measure(start, starts);
  }
}

}  // namespace

}  // namespace understudy::benchmarks

/// Usage: startup [STARTS [EXECUTABLE]]
int main(int count, char** arguments) {
  using namespace understudy::benchmarks;
  try {
    const int starts = count > 1 ? std::atoi(arguments[1]) : kDefaultStarts;
    if (starts < 1) throw CannotRun("STARTS: expected a positive number");
    run(count > 2 ? arguments[2] : UNDERSTUDY_EXECUTABLE, starts);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "startup: %s\n", error.what());
    return 2;
  }
}
