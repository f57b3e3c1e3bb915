# understudy_room(NAME SOURCES ... KNOWS ... USES ... SHOWS ...)
# One static library a room. KNOWS lists the rooms it may include, USES the outside libraries, SHOWS those
# that its headers include as well.
# What is not listed cannot be linked, and the check below keeps stray includes out as well.
function(understudy_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;KNOWS;USES;SHOWS" ${ARGN})
  add_library(understudy_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(understudy_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  foreach(known IN LISTS ROOM_KNOWS)
    target_link_libraries(understudy_${name} PUBLIC understudy_${known})
  endforeach()
  target_link_libraries(understudy_${name} PRIVATE ${ROOM_USES} PUBLIC ${ROOM_SHOWS})

  # All rooms share one include root, so a forbidden include would compile: refuse it here.
  set(rooms motion interpreter pty emulator)
  list(REMOVE_ITEM rooms ${name} ${ROOM_KNOWS})
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(file IN LISTS files)
    foreach(stranger IN LISTS rooms)
      file(STRINGS ${file} stray REGEX "^#include \"${stranger}/")
      if(stray)
        message(FATAL_ERROR "${file}: the room '${name}' may not include '${stranger}/': ${stray}")
      endif()
    endforeach()
  endforeach()
endfunction()
