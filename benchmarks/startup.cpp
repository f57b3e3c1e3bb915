// From exec to the `ready` line, beside the start and end of /bin/true.
#include <cstdio>
#include <cstdlib>

#include "benchmarks/figures.h"
#include "benchmarks/understudy_server.h"

namespace understudy::benchmarks {

namespace {

constexpr double kBar = 50;  // starts and ends of /bin/true
constexpr double kReadyBar_ms = 50;
constexpr int kDefaultStarts = 40;

double milliseconds(Nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

double start_of_true() {
  const Nanoseconds start = now();
  if (Process::of_command({"/bin/true"}).wait() != 0) throw CannotRun("/bin/true failed");
  return milliseconds(now() - start);
}

double start_of_understudy(const std::string& executable, const std::string& model) {
  const Nanoseconds start = now();
  const UnderstudyServer server(executable, "wire", Process::kAnyProcessor, model);
  return milliseconds(now() - start);
}

void run(const std::string& executable, int starts) {
  std::printf("%d starts; milliseconds %10s %10s\n", starts, "median", "p90");
  for (const std::string model : {"simple2-r3", "super-40nc"}) {
    std::vector<double> others;
    std::vector<double> ours;
    std::vector<double> ratios;
    for (int i = 0; i < starts; ++i) {
      others.push_back(start_of_true());
      ours.push_back(start_of_understudy(executable, model));
      ratios.push_back(ours.back() / others.back());
    }
    std::printf("%-28s %10.2f %10.2f\n", "/bin/true", median(others), percentile(others, 0.9));
    std::printf("%-28s %10.2f %10.2f\n", ("serve --model " + model).c_str(), median(ours),
                percentile(ours, 0.9));
    print_verdict(("from exec to ready, " + model + ", against /bin/true, median of the pairs").c_str(),
                  median(ratios), kBar);
    print_verdict(("from exec to ready, " + model + ", against 50 ms, median").c_str(),
                  median(ours) / kReadyBar_ms, 1.00);
  }
}

}  // namespace

}  // namespace understudy::benchmarks

/// startup [STARTS [EXECUTABLE]]
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
