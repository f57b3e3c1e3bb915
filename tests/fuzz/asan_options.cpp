// The settings of the address sanitizer for a search: a fraction of the memory that it holds back by default
// (256 MB, parts of which each run would touch outside any cache), and short stacks of allocations.
// ASAN_OPTIONS in the environment override them, to investigate findings.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): its name
  return "quarantine_size_mb=16:thread_local_quarantine_size_kb=64:malloc_context_size=8";
}
