// Delivers the bytes that leave a line's wire to its host, through an adapter that may hold them back.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "base/queue.h"
#include "pty/line.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"

namespace understudy::pty {

void Line::set_adapter(const Adapter& adapter) {
  if (adapter == state_.adapter) return;
  due_changed();
  state_.adapter = adapter;
  if (adapter.is_unplugged) {
    discard_unsent();
    state_.leaving.clear();
    state_.lump.clear();
    state_.lump_at.reset();
  } else if (adapter.latency == SimTime{0}) {
    give_lump();
  }
}

/// An adapter with a latency delivers its bytes at multiples of that latency, or as soon as its buffer is
/// full.
void Line::leave_wire(std::span<const std::uint8_t> bytes) {
  const SimTime latency = state_.adapter.latency;
  if (is_unplugged()) return;
  if (latency == SimTime{0}) return give_host(bytes);
  for (const std::uint8_t byte : bytes) {
    state_.lump.push_back(byte);
    if (state_.lump.size() == kLump) give_lump();
  }
  if (!state_.lump.empty() && !state_.lump_at) state_.lump_at = (state_.edge.clock / latency + 1) * latency;
}

void Line::give_lump() {
  state_.lump_at.reset();
  const Queue<std::uint8_t> lump = std::exchange(state_.lump, {});
  give_host(lump.values());
}

void Line::give_host(std::span<const std::uint8_t> bytes) {
  auto& [output, counters, clock] = state_.edge;
  if (bytes.size() > kOutputCapacity - output.size()) {
    for (LineObserver* observer : observers_) observer->on_output_full();
  }
  const std::size_t lost = bytes.size() - std::min(bytes.size(), kOutputCapacity - output.size());
  counters.bytes_discarded += lost;
  bytes = bytes.first(bytes.size() - lost);
  output.append(bytes);
  counters.bytes_out += bytes.size();
}

}  // namespace understudy::pty
