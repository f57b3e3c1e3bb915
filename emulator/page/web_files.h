// The page's own files, which the build embeds in the program (embed.cmake).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace understudy::emulator::page {

struct EmbeddedFile {
  std::string_view name;  // "index.html"
  std::string_view bytes;
};
std::span<const EmbeddedFile> embedded_files();
/// Returns the bytes of the file, or an empty text if there is no such file.
std::string_view embedded_text(std::string_view name);
/// Returns the text with every `what` replaced by `with`.
std::string replaced(std::string text, std::string_view what, std::string_view with);

/// Returns the type for the ending of a name: "text/javascript; charset=utf-8".
std::string_view type_of(std::string_view name);

}  // namespace understudy::emulator::page
