# Runs during the installation: writes and installs the files that contain the prefix or come from the program.
# cmake/packaging.cmake sets the variables.
string(RANDOM LENGTH 12 own)  # several installations may run at the same time
set(STAGING "${STAGING}/${own}")
file(MAKE_DIRECTORY "${STAGING}")

# zip(FILE FOLDER): installs a file compressed, without its time and name, so that equal input gives equal bytes.
function(zip file folder)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL "${file}.gz" DESTINATION "${folder}")
endfunction()

execute_process(COMMAND sh "${PACKAGING}/manual.sh" "${PROGRAM}" "${PACKAGING}/understudy.1.in"
                OUTPUT_FILE "${STAGING}/understudy.1.in" COMMAND_ERROR_IS_FATAL ANY)
configure_file("${STAGING}/understudy.1.in" "${STAGING}/understudy.1" @ONLY)
zip("${STAGING}/understudy.1" "${MANUALS}")
execute_process(COMMAND sh "${PACKAGING}/manual.sh" "${PROGRAM}" --list
                OUTPUT_VARIABLE commands OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" commands "${commands}")
foreach(command IN LISTS commands)
  set(page "${STAGING}/understudy-${command}.1")
  execute_process(COMMAND sh "${PACKAGING}/manual.sh" "${PROGRAM}" --of ${command}
                  OUTPUT_FILE "${page}.in" COMMAND_ERROR_IS_FATAL ANY)
  configure_file("${page}.in" "${page}" @ONLY)
  zip("${page}" "${MANUALS}")
endforeach()

configure_file("${PACKAGING}/changelog.in" "${STAGING}/changelog.Debian" @ONLY)
zip("${STAGING}/changelog.Debian" "${DOCUMENTATION}")

# The installed CHANGELOG.md also has the unreleased changes, as `packaging/changelog.py show` prints them.
set(unreleased "")
foreach(kind Added Changed Deprecated Removed Fixed Security)
  string(TOLOWER ${kind} ending)
  file(GLOB fragments "${PACKAGING}/../changes/*.${ending}.md")
  list(SORT fragments)
  if(fragments)
    string(APPEND unreleased "### ${kind}\n\n")
  endif()
  foreach(fragment IN LISTS fragments)
    file(READ "${fragment}" text)
    string(STRIP "${text}" text)
    string(REPLACE "\n" "\n  " text "${text}")
    string(APPEND unreleased "- ${text}\n")
  endforeach()
  if(fragments)
    string(APPEND unreleased "\n")
  endif()
endforeach()
file(READ "${PACKAGING}/../CHANGELOG.md" changelog)
if(unreleased)
  string(FIND "${changelog}" "\n## " released)
  string(SUBSTRING "${changelog}" 0 ${released} before)
  string(SUBSTRING "${changelog}" ${released} -1 after)
  set(changelog "${before}\n## Unreleased\n\n${unreleased}")
  string(REGEX REPLACE "\n$" "" changelog "${changelog}")
  string(APPEND changelog "${after}")
endif()
file(WRITE "${STAGING}/CHANGELOG.md" "${changelog}")
file(INSTALL "${STAGING}/CHANGELOG.md" DESTINATION "${DOCUMENTATION}")

configure_file("${PACKAGING}/understudy@.service.in" "${STAGING}/understudy@.service" @ONLY)
file(INSTALL "${STAGING}/understudy@.service" DESTINATION "${UNITS}")

function(completion shell folder file)
  execute_process(COMMAND "${PROGRAM}" completion ${shell}
                  OUTPUT_FILE "${STAGING}/${file}" COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL "${STAGING}/${file}" DESTINATION "${COMPLETIONS}/${folder}")
endfunction()
completion(bash bash-completion/completions understudy)
completion(zsh zsh/vendor-completions _understudy)
completion(fish fish/vendor_completions.d understudy.fish)

function(schema what)
  execute_process(COMMAND "${PROGRAM}" schema ${what}
                  OUTPUT_FILE "${STAGING}/${what}.schema.json" COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL "${STAGING}/${what}.schema.json" DESTINATION "${SCHEMAS}")
endfunction()
schema(bench)
schema(scenario)
schema(model)

find_program(PYTHON3 python3)
if(PYTHON3)
  execute_process(COMMAND "${PYTHON3}" "${PACKAGING}/vscode/vsix.py" "${STAGING}" "${PROGRAM}"
                  OUTPUT_VARIABLE extension OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL "${extension}" DESTINATION "${EXTENSION}")
else()
  message(STATUS "Without the extension for VS Code: python3 is not installed")
endif()

file(REMOVE_RECURSE "${STAGING}")
