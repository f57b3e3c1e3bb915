# Links tests that another build has compiled with this build's rooms. This is for sanitizers, which check the product:
# compiling and running the tests' own code under them as well would take longer than everything else.

# The rooms that a room links, and the room itself.
function(rooms_of out)
  set(found ${ARGN})
  set(left ${ARGN})
  while(left)
    list(POP_FRONT left room)
    get_target_property(known ${room} INTERFACE_LINK_LIBRARIES)
    foreach(other IN LISTS known)
      string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" other "${other}")
      if(other MATCHES "^understudy_" AND NOT other IN_LIST found)
        list(APPEND found ${other})
        list(APPEND left ${other})
      endif()
    endforeach()
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# UNDERSTUDY_TESTS_OF is the folder of the other build. It is configured first if necessary.
function(configure_other_build)
  if(NOT EXISTS ${UNDERSTUDY_TESTS_OF}/compile_commands.json)
    cmake_path(GET UNDERSTUDY_TESTS_OF FILENAME preset)
    execute_process(COMMAND ${CMAKE_COMMAND} --preset ${preset} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${UNDERSTUDY_TESTS_OF}/compile_commands.json)
endfunction()

# link_tests_of_another_build(TARGET ROOMS...): the executable TARGET of the other build, with this build's rooms.
function(link_tests_of_another_build target)
  set(compiled " -o (tests/CMakeFiles/${target}\\.dir/[^ ]+\\.o) ")
  file(STRINGS ${UNDERSTUDY_TESTS_OF}/compile_commands.json commands REGEX "${compiled}")
  set(objects)
  foreach(command IN LISTS commands)
    string(REGEX MATCH "${compiled}" matched "${command}")
    list(APPEND objects ${UNDERSTUDY_TESTS_OF}/${CMAKE_MATCH_1})
  endforeach()
  add_custom_target(${target}_compiled
    COMMAND ${CMAKE_COMMAND} --build ${UNDERSTUDY_TESTS_OF} --target ${target}
    BYPRODUCTS ${objects}
    COMMENT "Building ${target} in ${UNDERSTUDY_TESTS_OF}")
  set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  add_executable(${target} ${objects})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  add_dependencies(${target} ${target}_compiled)
  # All rooms come before the tests, so code that both have compiled (templates, inline functions) comes from the rooms.
  rooms_of(rooms ${ARGN})
  set(files)
  foreach(room IN LISTS rooms)
    get_target_property(type ${room} TYPE)
    if(NOT type STREQUAL "INTERFACE_LIBRARY")  # a room that only has headers has no file
      list(APPEND files $<TARGET_FILE:${room}>)
    endif()
  endforeach()
  target_link_options(${target} PRIVATE -Wl,--whole-archive ${files} -Wl,--no-whole-archive)
endfunction()
