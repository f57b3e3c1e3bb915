# cpack reads this file: it sets the dependencies of the Debian package, and the time of its files. CPack itself would
# take half a minute, because it runs `file` on each of hundreds of scenarios and pages, although only two files are
# programs. Without dpkg-shlibdeps, it would only warn, and make a package without dependencies.
if(CPACK_GENERATOR STREQUAL "DEB")
  # Equal input gives an equal package: its files have the time of the changelog, or SOURCE_DATE_EPOCH.
  if("$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
    file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/changelog.in date REGEX "^ -- ")
    string(REGEX REPLACE "^ -- .*  " "" date "${date}")
    execute_process(COMMAND date -u -d "${date}" +%s OUTPUT_VARIABLE epoch OUTPUT_STRIP_TRAILING_WHITESPACE
                    COMMAND_ERROR_IS_FATAL ANY)
    set(ENV{SOURCE_DATE_EPOCH} ${epoch})
  endif()
  find_program(found_dpkg-shlibdeps dpkg-shlibdeps)
  if(NOT found_dpkg-shlibdeps)
    message(FATAL_ERROR "dpkg-shlibdeps is missing; expected the package dpkg-dev")
  endif()
  set(folder ${CPACK_PACKAGE_DIRECTORY}/_depends)
  file(WRITE ${folder}/debian/control "Source: understudy\n\nPackage: understudy\nArchitecture: any\n")
  execute_process(COMMAND ${found_dpkg-shlibdeps} -O ${CPACK_UNDERSTUDY_PROGRAMS}
                  WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE said ERROR_VARIABLE complained RESULT_VARIABLE result)
  string(REGEX MATCH "shlibs:Depends=([^\n]*)" found "${said}")
  if(NOT result EQUAL 0 OR NOT found)
    message(FATAL_ERROR "dpkg-shlibdeps: ${complained}")
  endif()
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
  file(REMOVE_RECURSE ${folder})
endif()
