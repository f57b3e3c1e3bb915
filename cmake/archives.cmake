# Outside libraries are linked statically if an archive is installed. Each shared library adds a fifth of the run time of
# /bin/true to every start, and scripts often start a program to ask for one value.
#   understudy_archive(NAME TARGET ARCHIVE): the interface NAME is ARCHIVE if it is installed, else TARGET
function(understudy_archive name target archive)
  find_library(archive_of_${name} ${archive})
  add_library(${name} INTERFACE)
  if(archive_of_${name})
    target_include_directories(${name} SYSTEM INTERFACE $<TARGET_PROPERTY:${target},INTERFACE_INCLUDE_DIRECTORIES>)
    target_link_libraries(${name} INTERFACE ${archive_of_${name}})
  else()
    target_link_libraries(${name} INTERFACE ${target})
  endif()
endfunction()

find_package(PkgConfig REQUIRED)
find_package(yaml-cpp REQUIRED)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
set(yaml_target yaml-cpp)
if(TARGET yaml-cpp::yaml-cpp)  # its name from version 0.8 on
  set(yaml_target yaml-cpp::yaml-cpp)
endif()
understudy_archive(outside_yaml ${yaml_target} libyaml-cpp.a)
understudy_archive(outside_sqlite PkgConfig::SQLITE libsqlite3.a)
if(archive_of_outside_sqlite)
  target_link_libraries(outside_sqlite INTERFACE m ${CMAKE_DL_LIBS})
endif()

# Makes a program start as fast as possible. It has a fixed address: otherwise the loader would have to relocate half a
# megabyte of tables, which takes as long as /bin/true runs. Sanitizers choose their own address.
function(start_fast target)
  if(UNDERSTUDY_SANITIZERS)
    return()
  endif()
  target_link_options(${target} PRIVATE -no-pie -static-libgcc -static-libstdc++)
endfunction()
