# cmake -D OUTPUT=web_files.cpp -D FILES="name=path|name=path" -P embed.cmake
# Writes a source that contains the files. Lines of our modules that are only a comment are left out, because the page
# has to stay small.
string(REPLACE "|" ";" pairs "${FILES}")
set(arrays "")
set(rows "")
set(number 0)
foreach(pair IN LISTS pairs)
  string(REGEX MATCH "^([^=]+)=(.+)$" matched "${pair}")
  set(name "${CMAKE_MATCH_1}")
  set(path "${CMAKE_MATCH_2}")
  if(path MATCHES "/web/.+\\.js$")
    file(READ "${path}" text)
    string(REGEX REPLACE "\n *//[^\n]*" "" text "${text}")
    set(path "${OUTPUT}.js")
    file(WRITE "${path}" "${text}")
  endif()
  file(READ "${path}" hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "constexpr unsigned char kFile${number}[] = {\n${bytes}0};\n")
  string(APPEND rows "    EmbeddedFile{\"${name}\", text_of(kFile${number}, ${size})},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}" "// Made by embed.cmake.
#include \"emulator/page/web_files.h\"

#include <cstddef>
#include <span>
#include <string_view>

namespace understudy::emulator::page {
namespace {
${arrays}
std::string_view text_of(const unsigned char* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}
}  // namespace

std::span<const EmbeddedFile> embedded_files() {
  static const EmbeddedFile files[] = {
${rows}  };
  return files;
}

}  // namespace understudy::emulator::page
")
