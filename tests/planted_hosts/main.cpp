// A host with a planted fault, or without it: planted_host NAME careless|careful NUMBER. The scenario
// NAME.yaml beside this file finds the fault (tests/acceptance/planted_faults_test.cpp).
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/planted_hosts/hosts.h"

using namespace understudy::planted;

int main(int count, char** words) {
  struct Host {
    std::string_view name;
    void (*run)(bool is_careful, int number);
  };
  constexpr std::array<Host, 10> kHosts{{{"double_move", double_move},
                                         {"stale_busy_bit", stale_busy_bit},
                                         {"torn_value", torn_value},
                                         {"timeout_race", timeout_race},
                                         {"missing_wait", missing_wait},
                                         {"counter_overflow", counter_overflow},
                                         {"lost_command", lost_command},
                                         {"starved_stop", starved_stop},
                                         {"word_order", word_order},
                                         {"early_alarm_clear", early_alarm_clear}}};
  for (const Host& host : kHosts) {
    if (count != 4 || host.name != words[1]) continue;
    host.run(std::string_view(words[2]) == "careful", std::atoi(words[3]));
    return 0;
  }
  std::fprintf(stderr, "expected NAME careless|careful NUMBER\n");
  return 2;
}
