#include "emulator/device/describe/fidelity_page.h"
#include <algorithm>
#include <cstddef>
#include <string>

#include "emulator/device/describe/describe.h"
#include "emulator/device/describe/sheet.h"
#include "emulator/device/model.h"

namespace understudy::emulator {

std::string fidelity_page(const Model& model) {
  const std::string name(model.name);
  std::string page = "# How faithful `" + name + "` is\n\n" + std::string(model.title) +
                     ". This page is made from the model's own tables:\n"
                     "`understudy describe " +
                     name + " choices --format markdown > docs/fidelity/" + name + ".md`\n\n";
  page +=
      "## Choices\n\nThe maker's manual leaves these questions open. The tables show what we chose. If there "
      "are alternatives, a\nbench can select one: `choices: { ID: ALTERNATIVE }`. The last columns say how "
      "sure we are: *follows* (from\nother statements of the manual), *likely* (the cited standard or "
      "similar devices do so), *proposal* (the\nmanual is silent). The scenario shows the difference: "
      "`understudy run FILE --filter 'ID: *'` runs it with each option.\n\n";
  page += format_sheet(*describe(model, "choices", SheetFormat::markdown), SheetFormat::markdown);

  Sheet missing{.columns = {"address", "register", "what is not modelled"}, .rows = {}};
  const Sheet registers = *describe(model, "registers", SheetFormat::table);
  const auto column = std::find(registers.columns.begin(), registers.columns.end(), "not modelled");
  for (const auto& row : registers.rows) {
    const std::string& what = row[static_cast<std::size_t>(column - registers.columns.begin())];
    if (!what.empty()) missing.rows.push_back({row[1], row[2], what});
  }
  page += "\n## Not modelled yet\n\n";
  for (const std::string_view gap : model.known_limitations) page += "- " + std::string(gap) + "\n";
  if (model.registers == nullptr) return page;
  if (!model.known_limitations.empty()) page += "\n";
  if (missing.rows.empty()) {
    page += model.known_limitations.empty() ? "Nothing: every register does what the manual says.\n"
                                            : "Every register does what the manual says.\n";
    return page;
  }
  page +=
      "These registers exist, with the manual's access and range. The daemon logs the first use of "
      "each.\n\n" +
      format_sheet(missing, SheetFormat::markdown);
  return page;
}

}  // namespace understudy::emulator
