#include "emulator/box/calibrate/certificate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/choices.h"
#include "base/files/sha256.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/device/model.h"
#include "emulator/play/report/page_parts.h"
#include "emulator/play/results/junit.h"

namespace understudy::emulator::box {

namespace {

using WrittenJson = nlohmann::ordered_json;

/// Takes the name of the controller from the evidence. Throws EvidenceError if there are several or none.
std::string name_of_box(const std::vector<EvidenceFile>& evidence, std::string box) {
  for (const EvidenceFile& file : evidence) {
    if (file.box.empty()) continue;
    if (!box.empty() && box != file.box)
      throw EvidenceError(file.path + ": evidence: is of the controller " + quoted(file.box) + ", not of " +
                          quoted(box) + "; expected evidence of one controller");
    box = file.box;
  }
  if (box.empty())
    throw EvidenceError(evidence.front().path +
                        ": evidence: names no controller; expected --box NAME, such as its serial number");
  return box;
}

void require_explained(const EvidenceFile& file) {
  if (!file.is_explained)
    throw EvidenceError(file.path +
                        ": evidence: no options explain its captures; expected evidence that does");
}

CertifiedChoice certified(ModelList models, const EvidenceFile& file, const EvidenceRow& row) {
  CertifiedChoice choice{
      .model = row.model,
      .firmware = row.firmware,
      .choice = row.choice,
      .option = row.options.front(),
      .source = row.capture.empty() ? row.proof : row.capture + ":" + std::to_string(row.place)};
  if (choice.source.empty()) choice.source = file.path;
  const Model* const model = find_model(models, row.model);
  if (model == nullptr) return choice;
  const auto known = std::ranges::find(model->choices, row.choice, &ChoiceRow::id);
  if (known == model->choices.end()) return choice;
  choice.standard = std::string(options_of(*known).front());
  choice.section = std::string(known->section);
  choice.question = std::string(known->question);
  return choice;
}

}  // namespace

std::string Certificate::summary() const {
  std::set<std::string> of;
  for (const CertifiedChoice& one : choices) of.insert(one.model + " " + one.firmware);
  std::string text = std::to_string(choices.size()) + " measured choice" + (choices.size() == 1 ? "" : "s");
  const char* between = " of ";
  for (const std::string& one : of) text += std::exchange(between, ", ") + one;
  return text;
}

Certificate certify(ModelList models, std::vector<EvidenceFile> evidence, const std::string& box) {
  Certificate certificate{.box = name_of_box(evidence, box), .evidence = {}, .choices = {}};
  for (const EvidenceFile& file : evidence) {
    require_explained(file);
    for (const EvidenceRow& row : file.rows) {
      if (row.state != kEvidenceStates.front() || row.options.empty()) continue;
      const CertifiedChoice choice = certified(models, file, row);
      const auto known = std::ranges::find_if(certificate.choices, [&](const CertifiedChoice& one) {
        return one.model == choice.model && one.choice == choice.choice;
      });
      if (known == certificate.choices.end()) {
        certificate.choices.push_back(choice);
      } else if (known->option != choice.option) {
        throw EvidenceError(file.path + ": evidence: " + row.label() + " is measured as " + choice.option +
                            ", but as " + known->option + " by " + known->source +
                            "; expected evidence of one controller, with the same settings");
      } else {
        known->source += ", " + choice.source;
      }
    }
  }
  if (certificate.choices.empty())
    throw EvidenceError(evidence.front().path +
                        ": evidence: no choice is measured; expected evidence with at least one");
  certificate.evidence = std::move(evidence);
  return certificate;
}

std::string certificate_page(const Certificate& certificate, const std::string& name,
                             std::string_view version) {
  std::vector<std::vector<std::string>> choices;
  for (const CertifiedChoice& one : certificate.choices)
    choices.push_back({one.model + " " + one.firmware, one.choice, one.option,
                       one.standard == one.option ? "" : one.standard, one.section, one.question,
                       one.source});
  std::vector<std::vector<std::string>> sources;
  for (const EvidenceFile& file : certificate.evidence) {
    const auto open = std::ranges::count_if(
        file.rows, [](const EvidenceRow& row) { return row.state != kEvidenceStates.front(); });
    sources.push_back({file.path, std::to_string(open) + " choices are not measured", file.sha256});
    for (const EvidenceCapture& capture : file.captures)
      sources.push_back({capture.file, std::to_string(capture.exchanges) + " exchanges", capture.sha256});
  }
  constexpr std::array<std::string_view, 7> kChoiceColumns{
      "model", "choice", "measured", "default, if another", "manual", "question", "measured by"};
  constexpr std::array<std::string_view, 3> kSourceColumns{"file", "", "SHA-256"};
  const std::string sign = "ssh-keygen -Y sign -f KEY -n " + std::string(kSignatureNamespace) + " " + name;
  const std::string verify = "understudy certificate --verify " + name + " --signers SIGNERS";
  const std::string how =
      " contains the digest of this page. The owner of the key signs that file with the first command, and "
      "you verify it with the second:";
  return play::plain_page("Certificate of " + certificate.box, certificate.summary(),
                          play::table_section("Measured", kChoiceColumns, choices) +
                              play::table_section("Evidence", kSourceColumns, sources) +
                              "<section>\n<h2>Signature</h2>\n<p>" + play::xml_escaped(name) + how +
                              "</p>\n<pre>" + play::xml_escaped(sign) + "\n" + play::xml_escaped(verify) +
                              "</pre>\n</section>\n",
                          version);
}

std::string certificate_text(const Certificate& certificate, const std::string& page_name,
                             std::string_view page, std::string_view version) {
  WrittenJson file{{"understudy", 1},
                   {"kind", "certificate"},
                   {"box", certificate.box},
                   {"made_by", "understudy " + std::string(version)},
                   {"page", {{"file", page_name}, {"sha256", sha256_of(page)}}},
                   {"evidence", WrittenJson::array()},
                   {"choices", WrittenJson::array()}};
  for (const EvidenceFile& one : certificate.evidence) {
    WrittenJson captures = WrittenJson::array();
    for (const EvidenceCapture& capture : one.captures)
      captures.push_back(
          {{"file", capture.file}, {"exchanges", capture.exchanges}, {"sha256", capture.sha256}});
    file["evidence"].push_back(
        {{"file", one.path},
         {"sha256", one.sha256},
         {one.port.empty() ? "bench" : "port", one.port.empty() ? one.bench : one.port},
         {"captures", std::move(captures)}});
  }
  for (const CertifiedChoice& one : certificate.choices)
    file["choices"].push_back({{"model", one.model},
                               {"firmware", one.firmware},
                               {"choice", one.choice},
                               {"option", one.option},
                               {"default", one.standard},
                               {"section", one.section},
                               {"measured_by", one.source}});
  return file.dump(1, ' ', false, WrittenJson::error_handler_t::replace) + "\n";
}

std::vector<CertifiedFile> certified_files(std::string_view certificate, const std::string& path) {
  try {
    const auto file = nlohmann::json::parse(certificate);
    if (file.at("kind") != "certificate") throw EvidenceError("");
    std::vector<CertifiedFile> files;
    const auto add = [&](const nlohmann::json& one) {
      files.push_back({one.at("file").get<std::string>(), one.at("sha256").get<std::string>()});
    };
    add(file.at("page"));
    for (const auto& evidence : file.at("evidence")) {
      add(evidence);
      for (const auto& capture : evidence.at("captures")) add(capture);
    }
    return files;
  } catch (const std::exception&) {
    throw EvidenceError(path + ": certificate: is not one; expected a file of `understudy certificate -o`");
  }
}

}  // namespace understudy::emulator::box
