# Rules that hold for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)

# -O3 gains nothing here, but takes longer to compile.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
                    -Wcast-align -Wvla -Wimplicit-fallthrough -Werror)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 sees overlapping copies in std::string's operator+ where there are none (GCC bug 105651).
  add_compile_options(-Wno-restrict)
endif()

# Simulated results are the same bits everywhere: no contraction into fused multiply-add, no
# reordering of floating point, and no -march beyond the baseline.
add_compile_options(-ffp-contract=off -fno-fast-math)

# In release builds, too, a missing key of a JSON object aborts the program; otherwise it would read arbitrary memory.
add_compile_options("-DJSON_ASSERT(x)=((x)?void(0):__builtin_trap())")

if(UNDERSTUDY_SANITIZERS)
  add_compile_options(-fsanitize=${UNDERSTUDY_SANITIZERS} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${UNDERSTUDY_SANITIZERS})
  add_compile_definitions(_GLIBCXX_ASSERTIONS)  # reports an index beyond the end, whatever is there
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With sanitizers, g++ thinks that variants in the standard library are uninitialized (GCC bug 105562).
    add_compile_options(-Wno-maybe-uninitialized)
  else()
    add_compile_options(-fno-sanitize=function)  # with it clang 14 cannot compile coroutines
  endif()
endif()

find_program(UNDERSTUDY_CCACHE ccache)
if(UNDERSTUDY_CCACHE)
  # Without this sloppiness, ccache does not store results that use precompiled headers. CCACHE_DEPEND uses the
  # compiler's own list of headers, so ccache does not read all headers once more for a new file.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${UNDERSTUDY_CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()
