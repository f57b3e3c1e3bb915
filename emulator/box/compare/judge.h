// Compares replies of a real controller with those of a bench.
//
// A controller's values at the beginning of a capture are unknown, unless the capture begins at power-up. So
// a register whose first value differs from the bench's is not different but undecidable. Its value is
// learned: as long as the bench's stays, so must the controller's, and a counter may keep its distance. A
// write of the host ends that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::box {

enum class Verdict : std::uint8_t {
  same,
  within,  // a value that the bench has within the tolerance
  early,   // the same reply, at another time than usual
  late,
  different,
  undecidable,  // it depends on something that the capture does not show
};
inline constexpr std::array kVerdictNames = {
    std::pair{Verdict::same, std::string_view("same")},
    std::pair{Verdict::within, std::string_view("same_within_time")},
    std::pair{Verdict::early, std::string_view("early")},
    std::pair{Verdict::late, std::string_view("late")},
    std::pair{Verdict::different, std::string_view("different")},
    std::pair{Verdict::undecidable, std::string_view("undecidable")}};
std::string_view name_of(Verdict verdict);

class Judge {
 public:
  explicit Judge(bool knows_beginning) : knows_beginning_(knows_beginning) {}

  /// `bank` has the registers of the station that the request is for, or is null. `is_last`: the capture may
  /// end before the reply.
  Verdict judge(const Exchange& exchange, const BenchReply& bench_reply, const RegisterBank* bank,
                bool is_last);

 private:
  struct Cell {
    std::uint32_t key = 0;
    Type type = Type::u16;
    bool is_moving = false;
    Value box = 0;
    Value bench = 0;
    Value before = 0;
    Value after = 0;
  };
  struct Seen {
    double bench = 0;
    double box = 0;
    bool is_written = false;  // by the host, so its value is known
  };
  Verdict judge_whole(const Exchange& exchange, const BenchReply& bench_reply, const RegisterBank* bank,
                      bool is_last);
  Verdict judge_words(const Addressed& asked, const Exchange& exchange, const BenchReply& bench_reply,
                      const RegisterBank& bank);
  Verdict judge_cell(const Cell& cell);
  Verdict judge_number(const std::string& query, double box, double bench, const BenchReply& bench_reply);
  template <typename Key>
  Verdict judge_unseen(std::map<Key, Seen>& seen, const Key& key, double box, double bench, bool counts);
  void note_write(const Addressed& asked);

  bool knows_beginning_;
  std::map<std::uint32_t, Seen> registers_;
  std::map<std::string, Seen> queries_;
  std::set<std::uint32_t> unsettled_;  // counters that have not agreed since the beginning
};

}  // namespace understudy::emulator::box
