# Read by cpack. Without these tools it would make a package that depends on nothing, and only warn.
if(CPACK_GENERATOR STREQUAL "DEB")
  foreach(tool dpkg-shlibdeps file)
    find_program(found_${tool} ${tool})
    if(NOT found_${tool})
      message(FATAL_ERROR "${tool} is missing; expected the packages dpkg-dev and file")
    endif()
  endforeach()
endif()
