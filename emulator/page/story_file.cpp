#include "emulator/page/story_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/page/story_data.h"
#include "emulator/page/web_files.h"

namespace understudy::emulator::page {

namespace {

// Browsers do not load modules from other files on disk, so the page contains them. An import map names each
// module.
constexpr std::string_view kHere = "from './";
constexpr std::string_view kMapped = "from 'page/";
constexpr std::string_view kLater = "import('./";
constexpr std::string_view kLaterMapped = "import('page/";

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string escaped(const std::string& text) {
  return replaced(replaced(replaced(text, "&", "&amp;"), "<", "&lt;"), "\"", "&quot;");
}

std::string import_map() {
  Json imports = Json::object();
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.name.ends_with(".js") || file.name == "uplot.js") continue;
    const std::string text =
        replaced(replaced(std::string(file.bytes), kHere, kMapped), kLater, kLaterMapped);
    imports["page/" + std::string(file.name)] = "data:text/javascript;base64," + base64(text);
  }
  return Json{{"imports", std::move(imports)}}.dump();
}

/// Returns the text for readers without JavaScript.
std::string words_of(const Json& timeline) {
  if (!timeline.contains("story")) return "<p>This page needs JavaScript.</p>\n";
  const Json& story = timeline.at("story");
  std::string text = "<p><strong>" + escaped(story.at("text").get<std::string>()) + "</strong></p>\n<ol>\n";
  for (const Json& moment : story.at("moments"))
    text += "<li>" + std::to_string(moment.at("time_ns").get<double>() / 1e9) + " s " +
            escaped(moment.at("text").get<std::string>()) + "</li>\n";
  return text + "</ol>\n";
}

}  // namespace

std::string story_file(const Asker& ask, const std::string& name, const std::string& version) {
  const Json data = story_data(ask, name, version);
  const auto replace_bad = Json::error_handler_t::replace;
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline' "
      "data:; style-src 'unsafe-inline'; img-src data: blob:; form-action 'none'; base-uri 'none'\">\n";
  text += "<meta name=\"generator\" content=\"understudy " + escaped(version) + "\">\n";
  text += "<title>" + escaped(name) + " - Understudy</title>\n<style>\n";
  text += embedded_text("uplot.css");
  text += embedded_text("page.css");
  text += "</style>\n</head>\n<body>\n<main id=\"page\">\n" + words_of(data.at("timeline")) + "</main>\n";
  text += "<script type=\"application/json\" id=\"told\">";
  text += replaced(data.dump(-1, ' ', false, replace_bad), "<", "\\u003c");
  text += "</script>\n<script>\n";
  text += embedded_text("uplot.js");
  text += "</script>\n<script type=\"importmap\">" + import_map() + "</script>\n";
  return text + "<script type=\"module\">import 'page/page.js';</script>\n</body>\n</html>\n";
}

}  // namespace understudy::emulator::page
