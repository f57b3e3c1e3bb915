// Keeps memory in large pages. Many devices need some megabytes, and each tick reads a little from everywhere
// in them. With 4 KiB pages the processor spends much of its time translating addresses.
#pragma once

#include <cstddef>

namespace understudy {

/// Asks the kernel to back the addresses from `first` to `last` with large pages. The kernel may refuse;
/// only speed depends on it.
void ask_for_large_pages(const void* first, const void* last);

}  // namespace understudy
