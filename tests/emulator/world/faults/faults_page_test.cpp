// docs/faults.md names every kind and field, and its examples are read.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger_text.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace faults_page_test {

std::string page() {
  std::ifstream file(PROJECT_FOLDER "/docs/faults.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(FaultsPage, NamesEveryKindAndField) {
  const std::string text = page();
  const auto is_named = [&](std::string_view name) {
    const std::string word(name);
    return text.find("`" + word + "`") != std::string::npos ||
           text.find("`" + word + ": ") != std::string::npos;
  };
  for (const FaultKindRow& kind : fault_kinds()) {
    EXPECT_TRUE(is_named(kind.name)) << kind.name;
    for (const FaultFieldRow& field : kind.fields)
      EXPECT_TRUE(is_named(field.name)) << kind.name << " " << field.name;
  }
  for (const std::string& field : trigger_fields()) {
    EXPECT_TRUE(is_named(field) || field == "seed") << field;
  }
}

TEST(FaultsPage, ExamplesAreRead) {
  const std::string text = page();
  int examples = 0;
  for (std::size_t at = 0; (at = text.find("{ ", at)) != std::string::npos; ++at) {
    std::string example = text.substr(at, text.find(" }", at) + 2 - at);
    // A scenario's name for it is not a field of a fault.
    if (const std::size_t name = example.find(", name: "); name != std::string::npos) {
      example = example.substr(0, name) + " }";
    }
    ++examples;
    EXPECT_NO_THROW(
        FaultyLine("plant: { feeder.A: { encoder: { per_revolution: 4000 } } }\n"
                   "faults: [ " +
                   example + " ]\n"))
        << example;
  }
  EXPECT_EQ(examples, 11);
}

}  // namespace faults_page_test
}  // namespace understudy::emulator::world
