// Joins the page's modules into a few files, so that a browser with a slow connection needs few round trips.
// The modules themselves stay as they are (web/), and `page --web` serves them one by one.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace understudy::emulator::page {

/// The page's scripts in two parts: the modules that the first view needs, and the panels that modules import
/// later.
struct Bundle {
  std::string first;
  std::string rest;
};

/// `text_of(name)` returns the text of a module, "page.js". Modules must have the forms that web/ uses:
/// imports of names on one line, and exports in front of declarations. Modules without them (libraries) are
/// imported as they are.
Bundle bundled(const std::function<std::string_view(std::string_view name)>& text_of);

/// Returns the page's HTML with its scripts inside: `early`, and the first part of the bundle in place of its
/// module. A browser with a slow connection then needs no further round trip for them. The content security
/// policy must admit scripts with this nonce.
std::string with_scripts(std::string_view html, std::string_view early, std::string_view first,
                         std::string_view nonce);

}  // namespace understudy::emulator::page
