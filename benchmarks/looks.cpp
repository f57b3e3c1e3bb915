// Measures how long an observer makes the devices of a bench with fifteen stations wait at a time. Sends each
// message whose reply may be long, as the control socket receives it, and measures the longest piece of its
// work in processor time.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "emulator/models/models.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::benchmarks {

namespace {

using emulator::serve::Daemon;

constexpr int kStations = 15;
constexpr int kRounds = 200;
// The rest of a piece's time is its last step, which may begin just before the limit.
constexpr double kBar = 2.0;

struct Folder {
  Folder() {
    if (mkdtemp(path.data()) == nullptr) std::abort();
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path = "/tmp/understudy-looks-XXXXXX";
};

std::string bench_text(const std::string& folder) {
  std::string text = "understudy: 1\nlines:\n  rs485:\n    link: " + folder + "/a.port\n    stations:\n";
  for (int i = 1; i <= kStations; ++i) {
    text += "      - { name: d" + std::to_string(i) + ", model: simple2-r3, address: " + std::to_string(i) +
            " }\n";
  }
  const char* const others[] = {"rs-m8194h", "super-40nc", "slim"};
  for (const char* model : others) {
    text += "  " + std::string(model) + ": { link: " + folder + "/" + model +
            ".port, stations: [ { name: one_" +
            std::string(model == others[0]   ? "rsm"
                        : model == others[1] ? "super"
                                             : "slim") +
            ", model: " + model + " } ] }\n";
  }
  return text;
}

/// Returns the request that the live page sends thirty times per second.
std::string names_of_a_page() {
  std::string names;
  for (int i = 1; i <= kStations; ++i) {
    for (const char* name :
         {"A.position", "A.speed", "A.lost", "B.position", "STATUS", "DIN_1", "DIN_1@by", "DOUT_1"}) {
      names += std::string(names.empty() ? "\"" : ",\"") + "d" + std::to_string(i) + "." + name + "\"";
    }
  }
  return "[" + names + "]";
}

struct Cost {
  std::vector<double> longest_us;  // one for each round
  std::vector<double> all_us;
  std::size_t bytes = 0;
};

/// Runs the work as the daemon's loop does: one slice after another, with a check between them for what is
/// due.
Cost cost_of(Daemon& daemon, const std::string& message) {
  Cost cost;
  for (int round = 0; round < kRounds; ++round) {
    bool is_answered = false;
    double longest = 0;
    double all = 0;
    daemon.loop().do_in_pieces([&] {
      handle_message(daemon, message, [&](const std::string& reply) {
        is_answered = true;
        cost.bytes = reply.size();
      });
      return false;
    });
    while (!is_answered) {
      const auto begin = processor_time_here();
      daemon.loop().wait(emulator::serve::wall_now() + std::chrono::hours(1));
      const double took = static_cast<double>((processor_time_here() - begin).count()) / 1'000;
      longest = std::max(longest, took);
      all += took;
    }
    cost.longest_us.push_back(longest);
    cost.all_us.push_back(all);
  }
  return cost;
}

void run() {
  const Folder folder;
  const auto bench = emulator::world::parse_bench(emulator::models::all_models(), bench_text(folder.path),
                                                  "bench.yaml", folder.path);
  emulator::serve::DaemonOptions options;
  options.speed = {.kind = emulator::serve::Speed::Kind::manual};
  options.watch_signals = false;
  Daemon daemon(bench, options, [](const std::string&) {});
  const double slice_us =
      std::chrono::duration<double, std::micro>(emulator::serve::EventLoop::kLaterSlice).count();
  std::printf("%-46s %9s %9s %9s %9s %8s\n", "", "p50 us", "p99 us", "max us", "total us", "bytes");
  double longest = 0;
  const auto judge = [&](const std::string& what, const std::string& message) {
    const Cost cost = cost_of(daemon, message);
    longest = std::max(longest, median(cost.longest_us));
    std::printf("%-46s %9.1f %9.1f %9.1f %9.1f %8zu\n", what.c_str(), median(cost.longest_us),
                percentile(cost.longest_us, 0.99), percentile(cost.longest_us, 1.0), median(cost.all_us),
                cost.bytes);
  };
  judge("look, 120 names in full", R"({"do":"look","names":)" + names_of_a_page() + "}");
  judge("look, 120 names by their number", R"({"do":"look","look":1,"frames":0,"events":0})");
  judge("the same with status", R"({"do":"look","look":1,"status":true})");
  judge("status", R"({"do":"status"})");
  judge(
      "get, 120 names", R"({"do":"get","names":)" + [] {
        std::string names = names_of_a_page();
        for (std::size_t at; (at = names.find("@by")) != std::string::npos;) names.erase(at, 3);
        return names;
      }() + "}");
  judge("bench", R"({"do":"bench"})");
  judge("faults", R"({"do":"faults"})");
  for (const char* device : {"d1", "one_rsm", "one_super", "one_slim"}) {
    const std::string of = R"("device":")" + std::string(device) + "\"}";
    judge("bench " + std::string(device), R"({"do":"bench",)" + of);
    judge("registers " + std::string(device), R"({"do":"registers",)" + of);
    judge("registers " + std::string(device) + ", found", R"({"do":"registers","find":"speed",)" + of);
    judge("get, a page of " + std::string(device), R"({"do":"get",)" + of);
    judge("choices " + std::string(device), R"({"do":"choices",)" + of);
  }
  print_verdict("the longest piece, relative to the time limit of a piece", longest / slice_us, kBar);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  try {
    understudy::benchmarks::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "looks: %s\n", error.what());
    return 2;
  }
}
