// How the address sanitizer works in a search: with a fraction of the memory that it holds back by default
// (256 MB, of which each run would touch some that is in no cache), and with short stacks of who made what.
// ASAN_OPTIONS in the environment are stronger, to look into what was found.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): its name
  return "quarantine_size_mb=16:thread_local_quarantine_size_kb=64:malloc_context_size=8";
}
