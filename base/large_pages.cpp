#include "base/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace understudy {

void ask_for_large_pages(const void* first, const void* last) {
  constexpr std::uintptr_t kLargePage = std::uintptr_t{2} << 20;
  constexpr int kCollapse =
      25;  // MADV_COLLAPSE of Linux 6.1: collapses immediately, rather than when the kernel has time
  const auto begin = (reinterpret_cast<std::uintptr_t>(first) + kLargePage - 1) / kLargePage * kLargePage;
  const auto end = reinterpret_cast<std::uintptr_t>(last) / kLargePage * kLargePage;
  if (begin >= end) return;
  auto* const pages = reinterpret_cast<void*>(begin);  // NOLINT(performance-no-int-to-ptr): rounded
  if (::madvise(pages, end - begin, MADV_HUGEPAGE) == 0) ::madvise(pages, end - begin, kCollapse);
}

}  // namespace understudy
