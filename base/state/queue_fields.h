// Saves a queue as part of a state. Only the current elements are saved, in the same form as a vector.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/queue.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"

namespace understudy {

template <class T>
struct StateOf<Queue<T>> {
  static void write(const Queue<T>& queue, StateWriter& writer) {
    writer.write(static_cast<std::uint32_t>(queue.size()));
    for (const T& value : queue) writer.write(value);
  }
  static void read(Queue<T>& queue, StateReader& reader) {
    std::uint32_t count = 0;
    reader.read(count);
    // Each element takes at least one byte, so a wrong count is refused before memory is allocated for it.
    require_state(count <= reader.rest().size(), "the bytes end too early");
    queue.clear();
    queue.resize(count);
    for (T& value : queue) reader.read(value);
  }
};

}  // namespace understudy
