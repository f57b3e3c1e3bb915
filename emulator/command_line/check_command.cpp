#include <cstdio>

#include "emulator/bench/bench_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/edge/nv_keeper.h"

namespace understudy::emulator {

int check_files(const std::vector<std::string>& files) {
  int code = kExitWell;
  for (const std::string& file : files) {
    try {
      Bench bench = load_bench(file);
      read_memories(bench, "");
      std::printf("%s: a bench with %zu line%s and %zu device%s\n", file.c_str(), bench.lines.size(),
                  bench.lines.size() == 1 ? "" : "s", bench.devices.size(),
                  bench.devices.size() == 1 ? "" : "s");
    } catch (const BenchError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      code = kExitBadInput;
    } catch (const NvError& error) {
      std::fprintf(stderr, "%s\n", one_line(error.what()).c_str());
      code = kExitBadInput;
    }
  }
  return code;
}

}  // namespace understudy::emulator
