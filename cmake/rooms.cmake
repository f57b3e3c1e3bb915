# understudy_room(FOLDER KNOWS ... SEES ... USES ... SHOWS ... SOURCES ...) makes one static library per room, named
# after its folder: emulator/world makes understudy_emulator_world.
#   KNOWS  rooms, by their folders, whose headers it may include
#   SEES   single headers of other rooms that it may include as well
#   USES   outside libraries; SHOWS those that its headers include too
# A room cannot link anything that is not listed. All rooms share one include root, so a forbidden include would
# compile. The check below refuses it when the build is configured, and names the file.
function(understudy_room folder)
  cmake_parse_arguments(ROOM "" "" "KNOWS;SEES;USES;SHOWS;SOURCES" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  if(ROOM_SOURCES)
    add_library(understudy_${name} STATIC ${ROOM_SOURCES})
    compile_together(understudy_${name})
    set(outward PUBLIC)
  else()
    add_library(understudy_${name} INTERFACE)
    set(outward INTERFACE)
  endif()
  target_include_directories(understudy_${name} ${outward} ${PROJECT_SOURCE_DIR})
  foreach(known IN LISTS ROOM_KNOWS)
    string(REPLACE "/" "_" known ${known})
    target_link_libraries(understudy_${name} ${outward} understudy_${known})
  endforeach()
  target_link_libraries(understudy_${name} ${outward} ${ROOM_SHOWS})
  if(ROOM_USES)
    target_link_libraries(understudy_${name} PRIVATE ${ROOM_USES})
  endif()
  refuse_stray_includes(${folder} "${ROOM_KNOWS}" "${ROOM_SEES}")
endfunction()

# The compiler gets several sources of a target as one, so it reads the headers once for all of them: a build from
# scratch takes half the time or less. Therefore, no two files of a room may use one name in their anonymous namespaces
# for different things. The preset `tidy` compiles each file alone: it checks that each includes what it needs.
set(UNDERSTUDY_TOGETHER 32)  # sources
function(compile_together target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD "${UNDERSTUDY_UNITY}" UNITY_BUILD_BATCH_SIZE ${UNDERSTUDY_TOGETHER})
endfunction()

# For rooms without hot code: optimizing them would take longer than it would ever save.
function(compile_quickly target)
  compile_cold(${target} -O1)
endfunction()

# The same, for much code of which little runs: the portable archive has at most 5 MB.
function(compile_small target)
  compile_cold(${target} -Os)
endfunction()

function(compile_cold target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
  if(UNDERSTUDY_SANITIZERS AND NOT UNDERSTUDY_FUZZERS)
    target_compile_options(${target} PRIVATE -O0)  # takes clang a third to a half of the time of -O1
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # At these levels, g++ 12 thinks that std::string's operator+ exceeds bounds (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
  endif()
endfunction()

# Refuses each include of a project file that is not in one of the `known` folders, in its own folder, or among the
# `seen` files. A room inside this folder is another room.
function(refuse_stray_includes folder known seen)
  list(JOIN known "|" folders)
  list(JOIN seen "|" files)
  string(REGEX REPLACE "([.+])" "\\\\\\1" files "${files}")
  set(allowed "^#include \"((${folder}|${folders})/|(${files})\")")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  get_property(inner GLOBAL PROPERTY understudy_rooms)  # rooms inside this one have their own rules
  set_property(GLOBAL APPEND PROPERTY understudy_rooms ${folder})
  list(FILTER inner INCLUDE REGEX "^${folder}/")
  set(unknown ${inner})
  list(REMOVE_ITEM unknown ${known})
  list(JOIN unknown "|" unknown)
  list(TRANSFORM inner PREPEND "${PROJECT_SOURCE_DIR}/")
  foreach(room IN LISTS inner)
    list(FILTER sources EXCLUDE REGEX "^${room}/")
  endforeach()
  foreach(source IN LISTS sources)
    file(STRINGS ${source} includes REGEX "^#include \"(base|motion|interpreter|pty|emulator|tests|benchmarks)/")
    foreach(include IN LISTS includes)
      if(NOT include MATCHES "${allowed}" OR (unknown AND include MATCHES "^#include \"(${unknown})/"))
        message(FATAL_ERROR "${source}: the room '${folder}' may not include this: ${include}\n"
                            "It may include: ${folder} ${known} ${seen} (${folder}/CMakeLists.txt)")
      endif()
    endforeach()
  endforeach()
endfunction()
