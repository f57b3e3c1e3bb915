// Memory in large pages. Many devices take some megabytes, of which each tick reads a little everywhere: with
// pages of 4 KiB the processor spends much of its time looking up addresses.
#pragma once

#include <cstddef>

namespace understudy {

/// Asks the kernel to keep everything between two addresses in large pages. Only speed depends on it, and the
/// kernel may refuse.
void ask_for_large_pages(const void* first, const void* last);

}  // namespace understudy
