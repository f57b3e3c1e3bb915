# clang-tidy with the checks of .clang-tidy, for the preset `tidy`. Version 19 has misc-include-cleaner as we use it. If
# it is not installed, a newer one is used, which may find more.
if(NOT UNDERSTUDY_TIDY)
  return()
endif()

set(oldest_tidy 19)
find_program(UNDERSTUDY_CLANG_TIDY NAMES clang-tidy-19 clang-tidy-20 clang-tidy-21 clang-tidy-22 clang-tidy)
set(version 0)
if(UNDERSTUDY_CLANG_TIDY)
  execute_process(COMMAND ${UNDERSTUDY_CLANG_TIDY} --version OUTPUT_VARIABLE said)
  if(said MATCHES "version ([0-9]+)")
    set(version ${CMAKE_MATCH_1})
  endif()
endif()
if(version LESS oldest_tidy)
  message(FATAL_ERROR "UNDERSTUDY_TIDY: clang-tidy ${oldest_tidy} or newer is needed; found ${UNDERSTUDY_CLANG_TIDY} "
                      "(version ${version}). Debian 12 has it: apt-get install clang clang-tidy-${oldest_tidy}")
endif()
set(CMAKE_CXX_CLANG_TIDY ${UNDERSTUDY_CLANG_TIDY};--quiet)
