// Keeps memory in large pages. The state of many devices takes several megabytes, and each tick reads small
// parts of all of it. With 4 KiB pages, the processor would spend much of its time translating addresses.
#pragma once

#include <cstddef>

namespace understudy {

/// Asks the kernel to use large pages for the addresses from `first` to `last`. The kernel may refuse; this
/// affects only speed.
void ask_for_large_pages(const void* first, const void* last);

}  // namespace understudy
