#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/command_window.h"
#include "emulator/device/describe/describe.h"
#include "emulator/device/describe/fidelity_page.h"
#include "emulator/device/describe/sheet.h"
#include "emulator/device/describe/thing_model.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::command_line {

const Model& described_model(ModelList models, const std::string& path, std::vector<FileClaim>& files) {
  if (models.files == nullptr)
    throw FileError(path + ": model: cannot be read here; expected a model's name");
  return models.files->load(path, files);
}

const Model& require_model(ModelList models, const std::string& name) {
  std::vector<FileClaim> files;
  return require_model(models, name, files);
}

const Model& require_model(ModelList models, const std::string& name, std::vector<FileClaim>& files) {
  if (const Model* model = find_model(models, name)) return *model;
  if (names_model_file(name)) return described_model(models, name, files);
  std::vector<std::string> names;
  for (const ListedModel& model : models) names.emplace_back(model.name());
  throw UsageError(quoted(name) + " is not a model" + suggestion(name, names) +
                   " (`understudy models` lists them; a model file ends in .yaml)");
}

int list_models(ModelList models) {
  for (const Model* model : models) {
    std::printf("%s  %s (firmware %s to %s)\n", std::string(model->name).c_str(),
                std::string(model->title).c_str(), version_text(model->firmwares.front()).c_str(),
                version_text(model->firmwares.back()).c_str());
  }
  return kExitWell;
}

namespace {

/// Returns the source of a row, such as "bench 3 (1.52), line.txt:12".
std::string source_of(const box::EvidenceFile& file, const box::EvidenceRow& row) {
  std::string text = (file.box.empty() ? file.path : file.box) + " (" + row.firmware + ")";
  if (!row.capture.empty()) text += ", " + row.capture + ":" + std::to_string(row.place);
  if (!row.proof.empty()) text += ", " + row.proof;
  return text;
}

/// Adds measurements to a sheet of choices: the option, and the controller on which it was measured. If
/// controllers differ, lists all of them.
void add_evidence(Sheet& sheet, const Model& model, const std::vector<box::EvidenceFile>& files) {
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(sheet.columns, name) - sheet.columns.begin());
  };
  const std::size_t id = column("id");
  const std::size_t confidence = column("confidence");
  sheet.columns.insert(sheet.columns.end(), {"measured", "evidence"});
  for (std::vector<std::string>& cells : sheet.rows) {
    std::string options;
    std::string sources;
    for (const box::EvidenceFile& file : files) {
      for (const box::EvidenceRow& row : file.rows) {
        const bool is_meant = row.model == model.name && row.choice == cells[id];
        if (!is_meant || row.state != "measured" || row.options.empty()) continue;
        if (options != row.options.front()) options += (options.empty() ? "" : " or ") + row.options.front();
        sources += (sources.empty() ? "" : "; ") + source_of(file, row);
      }
    }
    if (!options.empty()) cells[confidence] = "measured";
    cells.insert(cells.end(), {options, sources});
  }
}

std::vector<box::EvidenceFile> read_evidence(const Model& model, const DescribeArguments& arguments) {
  if (!arguments.evidence.empty() && arguments.what != "choices")
    throw UsageError("--evidence: " + quoted(arguments.what) + " are not measured; expected choices");
  std::vector<box::EvidenceFile> files;
  for (const std::string& path : arguments.evidence) {
    const auto text = read_text_argument(path);
    if (!text)
      throw FileError(path + ": evidence: " + text.why + "; expected a file of `understudy calibrate -o`");
    files.push_back(box::parse_evidence(*text, path));
    const auto is_of_model = [&](const auto& device) { return device.model == model.name; };
    if (std::ranges::none_of(files.back().devices, is_of_model)) {
      std::fprintf(stderr, "understudy: describe: %s: has no evidence about %s\n", one_line(path).c_str(),
                   arguments.model.c_str());
    }
  }
  return files;
}

/// A Thing Model is one JSON object, whatever format is chosen for tables.
int print_thing(const Model& model, const DescribeArguments& arguments) {
  if (model.registers == nullptr)
    throw UsageError(quoted(arguments.model) +
                     " has no registers, so it has no Thing Model; expected a model that speaks Modbus");
  std::fputs(thing_model(model).c_str(), stdout);
  return kExitWell;
}

}  // namespace

int describe_model(ModelList models, const DescribeArguments& arguments) {
  const Model& model = require_model(models, arguments.model);
  const auto format = parse_sheet_format(arguments.format);
  if (!format)
    throw UsageError("--format: " + quoted(arguments.format) +
                     " is unknown; expected table, csv, json or markdown");
  if (arguments.what == "thing") return print_thing(model, arguments);
  const std::vector<box::EvidenceFile> evidence = read_evidence(model, arguments);
  auto sheet = describe(model, arguments.what, *format);
  if (!sheet) {
    throw UsageError(quoted(arguments.what) +
                     " cannot be described; expected registers, parameters, instructions, commands, choices, "
                     "ports, blocks or thing");
  }
  if (sheet->rows.empty() && *format == SheetFormat::table) {
    const bool has_window = arguments.what == "commands" && model.window != nullptr;
    const std::string more =
        has_window ? " in text form; its window accepts the commands that `instructions` lists, such as " +
                         std::string(model.window->example())
                   : "";
    std::printf("%s has no %s%s\n", arguments.model.c_str(), arguments.what.c_str(), more.c_str());
    return kExitWell;
  }
  if (!evidence.empty()) add_evidence(*sheet, model, evidence);
  // As Markdown, the choices are a complete page of the documentation.
  const bool page = arguments.what == "choices" && *format == SheetFormat::markdown && evidence.empty();
  std::fputs(page ? fidelity_page(model).c_str() : format_sheet(*sheet, *format).c_str(), stdout);
  return kExitWell;
}

Firmware require_firmware(const Model& model, const std::string& text) {
  if (text.empty()) return 0;
  const Firmware firmware = parse_firmware(text);
  for (const Firmware known : model.firmwares)
    if (known == firmware) return firmware;
  std::string versions;
  for (const Firmware known : model.firmwares)
    versions += (versions.empty() ? "" : ", ") + version_text(known);
  throw UsageError("--firmware: " + quoted(text) + " is not a firmware version of " +
                   std::string(model.name) + "; expected one of " + versions);
}

}  // namespace understudy::emulator::command_line
