// Memory in large pages. A crowd of devices is some megabytes, of which each tick reads a little everywhere:
// in pages of 4 KiB the processor spends much of its time on looking up where they are.
#pragma once

#include <cstddef>

namespace understudy {

/// Asks the kernel to keep all that is between two addresses in large pages. Nothing but time depends on it,
/// and it may say no.
void ask_for_large_pages(const void* first, const void* last);

}  // namespace understudy
