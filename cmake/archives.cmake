# Outside libraries of which there is an archive become part of the program: each that the loader has to find and to
# bind adds a fifth of what /bin/true takes to every start, and a program that scripts ask for one value starts often.
#   understudy_archive(NAME TARGET ARCHIVE): the interface NAME, which is ARCHIVE where it is installed, else TARGET
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
understudy_archive(outside_yaml yaml-cpp libyaml-cpp.a)
understudy_archive(outside_sqlite PkgConfig::SQLITE libsqlite3.a)
if(archive_of_outside_sqlite)
  target_link_libraries(outside_sqlite INTERFACE m ${CMAKE_DL_LIBS})
endif()

# A program that starts as fast as it can. It stands at an address of its own: with one that the loader chooses, half a
# megabyte of tables would have to be told where it is, which takes as long as /bin/true does. Sanitizers choose their
# own way.
function(start_fast target)
  if(UNDERSTUDY_SANITIZERS)
    return()
  endif()
  target_link_options(${target} PRIVATE -no-pie -static-libgcc -static-libstdc++)
endfunction()
