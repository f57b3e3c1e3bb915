// The bundle holds every module of the page once, each after those that it imports.
#include "emulator/page/bundle.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>

#include "emulator/page/gzip.h"
#include "emulator/page/web_files.h"

namespace understudy::emulator::page {
namespace bundle_test {

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Bundle, HasEveryModuleOnce) {
  const Bundle bundle = bundled(embedded_text);
  for (const EmbeddedFile& file : embedded_files()) {
    // early.js connects before any module is there.
    const bool is_apart = file.name == "preact.js" || file.name == "uplot.js" || file.name == "early.js";
    if (!file.name.ends_with(".js") || is_apart) continue;
    const std::string begin = "modules['./" + std::string(file.name) + "'] = (() => {";
    EXPECT_EQ(count_of(bundle.first, begin) + count_of(bundle.rest, begin), 1U) << file.name;
  }
  for (const std::string& part : {bundle.first, bundle.rest}) {
    EXPECT_EQ(count_of(part, "\nexport "), 0U);
    EXPECT_EQ(count_of(part, "\nimport {"), 0U);
    EXPECT_EQ(count_of(part, "await import('./"), 1U);  // the one for the rest
  }
}

TEST(Bundle, DefinesAModuleBeforeItIsUsed) {
  const Bundle bundle = bundled(embedded_text);
  const std::string all = bundle.first + bundle.rest;
  for (std::size_t at = all.find("} = modules['"); at != std::string::npos;
       at = all.find("} = modules['", at + 1)) {
    const std::size_t begin = at + std::string("} = modules['").size();
    const std::string name = all.substr(begin, all.find('\'', begin) - begin);
    if (name == "./preact.js") continue;
    EXPECT_LT(all.find("modules['" + name + "'] ="), at) << name;
  }
}

TEST(Bundle, WrapsImportsAndExports) {
  const std::map<std::string_view, std::string_view> texts{
      {"page.js",
       "// A page.\nimport { html } from './preact.js';\nimport { two as deux, three } from './numbers.js';\n"
       "const other = () => import('./later.js');\nhtml(deux, three, other);\n"},
      {"numbers.js",
       "export const two = 2;\nexport async function three() {\n  return 3;\n}\nexport class Four {\n}\n"},
      {"later.js", "import { two } from './numbers.js';\nexport const four = 2 * two;\n"}};
  const Bundle bundle = bundled([&](std::string_view name) { return texts.at(name); });
  EXPECT_NE(bundle.first.find("modules['./numbers.js'] = (() => {\nconst two = 2;\nasync function three() {\n"
                              "  return 3;\n}\nclass Four {\n}\nreturn { two, three, Four };\n})();\n"),
            std::string::npos)
      << bundle.first;
  EXPECT_NE(bundle.first.find("const { html } = modules['./preact.js'];\n"
                              "const { two: deux, three } = modules['./numbers.js'];\n"
                              "const other = () => later('./later.js');\n"),
            std::string::npos)
      << bundle.first;
  EXPECT_EQ(bundle.first.find("A page."), std::string::npos);
  EXPECT_EQ(count_of(bundle.rest, "modules['./later.js'] = "), 1U) << bundle.rest;
}

/// At 20 kB a second, the first sight has little more than a second for its bytes.
TEST(Bundle, IsSmallForTheFirstSight) {
  const Bundle bundle = bundled(embedded_text);
  std::size_t bytes = gzipped(bundle.first).size();
  for (const char* name : {"index.html", "page.css", "preact.js"})
    bytes += gzipped(embedded_text(name)).size();
  EXPECT_LT(bytes, 40'000U);
}

}  // namespace bundle_test
}  // namespace understudy::emulator::page
