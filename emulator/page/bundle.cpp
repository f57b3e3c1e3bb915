#include "emulator/page/bundle.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/page/web_files.h"

namespace understudy::emulator::page {

namespace {

constexpr std::string_view kLibrary = "preact.js";
constexpr std::string_view kRoot = "page.js";
// Modules find each other in this object, because both parts must share them.
constexpr std::string_view kCommon =
    "const later = async (name) => { await import('./rest.js'); return modules[name]; };\n";

/// Calls `act` with each line of the text.
template <typename Act>
void for_each_line(std::string_view text, Act act) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    act(line);
  }
}

/// Returns the names that follow `before`: "small.js" for "from './small.js'".
std::vector<std::string_view> names_behind(std::string_view text, std::string_view before) {
  std::vector<std::string_view> names;
  for (std::size_t at = text.find(before); at != std::string_view::npos; at = text.find(before, at + 1)) {
    const std::string_view rest = text.substr(at + before.size());
    names.push_back(rest.substr(0, rest.find('\'')));
  }
  return names;
}

/// Returns the name that "function draw() {", "async function ask(", "const kMax = " or "class Wire {"
/// declares.
std::string_view declared_name(std::string_view declaration) {
  for (const std::string_view word : {"async ", "function ", "const ", "class "})
    if (declaration.starts_with(word)) declaration.remove_prefix(word.size());
  const auto is_of_name = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '$';
  };
  const auto* const end = std::find_if_not(declaration.begin(), declaration.end(), is_of_name);
  return declaration.substr(0, static_cast<std::size_t>(end - declaration.begin()));
}

/// Returns the module as a function that returns its exports.
std::string module_function(std::string_view name, std::string_view text) {
  constexpr std::string_view kImport = "import {";
  constexpr std::string_view kFrom = "} from ";
  constexpr std::string_view kExport = "export ";
  std::string body;
  std::string exports;
  for_each_line(text, [&](std::string_view line) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string_view::npos || line.substr(first).starts_with("//")) return;
    if (const std::size_t from = line.find(kFrom);
        line.starts_with(kImport) && from != std::string_view::npos) {
      const std::string names =
          replaced(std::string(line.substr(kImport.size(), from - kImport.size())), " as ", ": ");
      std::string_view module = line.substr(from + kFrom.size());
      if (module.ends_with(';')) module.remove_suffix(1);
      body += "const {" + names + "} = modules[" + std::string(module) + "];\n";
      return;
    }
    if (line.starts_with(kExport)) {
      line.remove_prefix(kExport.size());
      exports += (exports.empty() ? "" : ", ") + std::string(declared_name(line));
    }
    body += std::string(line) + "\n";
  });
  body = replaced(std::move(body), "import('./", "later('./");
  return "modules['./" + std::string(name) + "'] = (() => {\n" + body + "return { " + exports +
         " };\n})();\n";
}

/// Adds the modules that `name` imports, and then itself.
class Order {
 public:
  explicit Order(const std::function<std::string_view(std::string_view)>& text_of) : text_of_(text_of) {}

  void add(std::string_view name) {
    if (name == kLibrary || has(name)) return;
    known_.push_back(name);
    const std::string_view text = text_of_(name);
    for (const std::string_view other : names_behind(text, "from './")) add(other);
    for (const std::string_view other : names_behind(text, "import('./")) later.push_back(other);
    modules.push_back(name);
  }

  std::vector<std::string_view> modules;
  std::vector<std::string_view> later;

 private:
  bool has(std::string_view name) const {
    return std::find(known_.begin(), known_.end(), name) != known_.end();
  }

  const std::function<std::string_view(std::string_view)>& text_of_;
  std::vector<std::string_view> known_;
};

}  // namespace

Bundle bundled(const std::function<std::string_view(std::string_view name)>& text_of) {
  Order order(text_of);
  order.add(kRoot);
  const std::size_t of_first = order.modules.size();
  for (std::size_t i = 0; i < order.later.size(); ++i) order.add(order.later[i]);
  Bundle bundle;
  bundle.first = "import * as library from './" + std::string(kLibrary) +
                 "';\nconst modules = globalThis.understudy = { './" + std::string(kLibrary) +
                 "': library };\n" + std::string(kCommon);
  bundle.rest = "const modules = globalThis.understudy;\n" + std::string(kCommon);
  for (std::size_t i = 0; i < order.modules.size(); ++i) {
    const std::string_view name = order.modules[i];
    (i < of_first ? bundle.first : bundle.rest) += module_function(name, text_of(name));
  }
  return bundle;
}

std::string with_scripts(std::string_view html, std::string_view early, std::string_view first,
                         std::string_view nonce) {
  const std::string with_nonce = " nonce=\"" + std::string(nonce) + "\"";
  const auto inside = [&](const std::string& attributes, std::string_view text) {
    return "<script" + attributes + with_nonce + ">\n" + std::string(text) + "</script>";
  };
  std::string page = replaced(std::string(html), "<script src=\"early.js\"></script>",
                              inside("", early) + "\n<link rel=\"modulepreload\" href=\"preact.js\">");
  return replaced(std::move(page), "<script type=\"module\" src=\"page.js\"></script>",
                  inside(" type=\"module\"", first));
}

}  // namespace understudy::emulator::page
