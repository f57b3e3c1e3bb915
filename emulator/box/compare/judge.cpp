#include "emulator/box/compare/judge.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/parse_real.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"

namespace understudy::emulator::box {

namespace {

constexpr std::uint8_t kException = 0x80;

/// Returns the worse of two verdicts about one reply.
Verdict worse(Verdict a, Verdict b) {
  constexpr std::array kOrder{Verdict::same, Verdict::within, Verdict::undecidable, Verdict::different};
  const auto place = [&](Verdict verdict) { return std::ranges::find(kOrder, verdict) - kOrder.begin(); };
  return place(a) < place(b) ? b : a;
}

bool is_between(double value, double a, double b, double c) {
  return std::min({a, b, c}) <= value && value <= std::max({a, b, c});
}

std::string text_in(std::span<const std::uint8_t> bytes) {
  std::string text(bytes.begin(), bytes.end());
  const std::size_t end = text.find_last_not_of("\r\n ");
  return text.substr(0, end == std::string::npos ? 0 : end + 1);
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  for (const auto& [known, name] : kVerdictNames)
    if (known == verdict) return name;
  return "";
}

template <typename Key>
Verdict Judge::judge_unseen(std::map<Key, Seen>& seen, const Key& key, double box, double bench,
                            bool counts) {
  if (knows_beginning_) return Verdict::different;
  const auto [found, is_new] = seen.try_emplace(key, Seen{.bench = bench, .box = box});
  if (is_new) return Verdict::undecidable;
  const Seen before = found->second;
  // What the host did before the capture may show in any register that it has not written since, only later.
  if (before.bench == before.box)
    return counts || before.is_written ? Verdict::different : Verdict::undecidable;
  const bool stays = before.bench == bench && before.box == box;
  if (stays || (counts && before.box - before.bench == box - bench)) return Verdict::same;
  // It goes on with what began before the capture, as a motion does.
  found->second = {.bench = bench, .box = box};
  return Verdict::undecidable;
}

Verdict Judge::judge_cell(const Cell& cell) {
  const auto number = [](Value value) { return static_cast<double>(value); };
  if (cell.box == cell.bench) {
    unsettled_.erase(cell.key);
    registers_.try_emplace(cell.key, Seen{.bench = number(cell.bench), .box = number(cell.box)});
    return Verdict::same;
  }
  const auto differing = static_cast<std::uint64_t>(cell.box ^ cell.bench);
  const auto changing = static_cast<std::uint64_t>((cell.before ^ cell.bench) | (cell.after ^ cell.bench));
  const bool is_number = cell.is_moving || is_32_bit(cell.type);
  if (is_number ? is_between(number(cell.box), number(cell.before), number(cell.bench), number(cell.after))
                : (differing & ~changing) == 0)
    return Verdict::within;
  const Verdict verdict = judge_unseen(registers_, cell.key, number(cell.box), number(cell.bench), is_number);
  if (verdict == Verdict::undecidable && is_number) unsettled_.insert(cell.key);
  return verdict;
}

Verdict Judge::judge_words(const Addressed& asked, const Exchange& exchange, const BenchReply& bench_reply,
                           const RegisterBank& bank) {
  const auto box = words_in(asked, exchange.request, exchange.reply);
  const auto bench = words_in(asked, exchange.request, bench_reply.bytes);
  if (box.empty() || bench.empty())  // one of them refuses, or both are damaged
    return std::ranges::equal(exchange.reply, bench_reply.bytes) ? Verdict::same : Verdict::different;
  const auto& before = bench_reply.before.size() == box.size() ? bench_reply.before : bench;
  const auto& after = bench_reply.after.size() == box.size() ? bench_reply.after : bench;
  Verdict verdict = Verdict::same;
  for (std::size_t i = 0; i < box.size(); ++i) {
    const auto address = static_cast<std::uint16_t>(asked.first + i);
    const Place place = bank.at(asked.table, address);
    const std::size_t at = i;
    const bool is_pair =
        place && place.part != Place::Part::whole && i + 1 < box.size() &&
        bank.at(asked.table, static_cast<std::uint16_t>(address + 1)).is_same_register(place);
    const Type type = !place                                   ? Type::u16
                      : is_pair || !is_32_bit(place.row->type) ? place.row->type
                                                               : Type::u16;
    const auto value = [&](const std::vector<std::uint16_t>& words) {
      if (!is_pair) return value_of(words[at], type);
      return value_of(bits_of_wire(*place.row, words[at], words[at + 1], bank.low_word_first()), type);
    };
    // A level that was taken from this reply cannot be judged by it.
    if (std::ranges::find(bench_reply.taken, i) != bench_reply.taken.end()) {
      verdict = worse(verdict, Verdict::undecidable);
      continue;
    }
    verdict = worse(verdict, judge_cell({.key = static_cast<std::uint32_t>(asked.table) << 16 | address,
                                         .type = type,
                                         .is_moving = place && place.row->moves(),
                                         .box = value(box),
                                         .bench = value(bench),
                                         .before = value(before),
                                         .after = value(after)}));
    if (is_pair) ++i;
  }
  return verdict;
}

void Judge::note_write(const Addressed& asked) {
  for (int i = 0; i < asked.count; ++i)
    registers_[static_cast<std::uint32_t>(asked.table) << 16 | static_cast<std::uint32_t>(asked.first + i)] =
        {.is_written = true};
}

Verdict Judge::judge_number(const std::string& query, double box, double bench,
                            const BenchReply& bench_reply) {
  if (bench_reply.number_before && bench_reply.number_after &&
      is_between(box, *bench_reply.number_before, bench, *bench_reply.number_after))
    return Verdict::within;
  return judge_unseen(queries_, query, box, bench, true);
}

/// What depends on a request that is lost, or on a reply that is, is neither agreement nor difference. Nor is
/// a refusal while a motion goes on that began before the capture.
Verdict Judge::judge(const Exchange& exchange, const BenchReply& bench_reply, const RegisterBank* bank,
                     bool is_last) {
  const Verdict verdict = judge_whole(exchange, bench_reply, bank, is_last);
  const bool is_clear = verdict == Verdict::same || verdict == Verdict::within;
  const auto asked = addressed_by(exchange.request);
  const bool is_read = asked && !asked->is_write;
  const bool is_told = !exchange.follows_loss && !(exchange.has_broken_reply && exchange.reply.empty()) &&
                       (is_read || unsettled_.empty());
  return is_clear || is_told ? verdict : Verdict::undecidable;
}

Verdict Judge::judge_whole(const Exchange& exchange, const BenchReply& bench_reply, const RegisterBank* bank,
                           bool is_last) {
  if (exchange.reply.empty() && is_last)
    return bench_reply.bytes.empty() ? Verdict::same : Verdict::undecidable;
  const auto asked = addressed_by(exchange.request);
  if (asked && !asked->is_write && bank != nullptr && !exchange.reply.empty() && !bench_reply.bytes.empty() &&
      exchange.reply[1] < kException)
    return judge_words(*asked, exchange, bench_reply, *bank);
  const bool is_same = std::ranges::equal(exchange.reply, bench_reply.bytes);
  if (asked) {
    if (asked->is_write && is_same) note_write(*asked);
    return is_same ? Verdict::same : Verdict::different;
  }
  const std::string query = text_in(exchange.request);
  const auto box = parse_real(text_in(exchange.reply));
  const auto own = parse_real(text_in(bench_reply.bytes));
  if (is_same || !query.starts_with('?') || !box || !own) {
    if (is_same && query.starts_with('?') && own)
      queries_.try_emplace(query, Seen{.bench = *own, .box = *own});
    return is_same ? Verdict::same : Verdict::different;
  }
  return judge_number(query, *box, *own, bench_reply);
}

}  // namespace understudy::emulator::box
