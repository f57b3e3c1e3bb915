// A certificate lists what was measured on a controller, with the capture or proof of each row. It is a JSON
// file, which its owner signs with `ssh-keygen -Y sign`, and a page for people. The JSON has the digests of
// the page, of the evidence and of the captures, so its signature covers them all.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/device/model.h"

namespace understudy::emulator::box {

/// The namespace of signatures.
inline constexpr std::string_view kSignatureNamespace = "understudy";

struct CertifiedChoice {
  std::string model;
  std::string firmware;
  std::string choice;
  std::string option;
  std::string standard{};  // the model's default
  std::string section{};   // of the manual
  std::string question{};
  std::string source;  // "line.txt:12", or the proof
};

struct Certificate {
  std::string box;
  std::vector<EvidenceFile> evidence;
  std::vector<CertifiedChoice> choices;

  /// Returns "2 measured choices of simple2-r3 1.52".
  std::string summary() const;
};

/// `box` names the controller if the evidence does not. Throws EvidenceError if the evidence does not explain
/// its captures, measures nothing, or is of several controllers.
Certificate certify(ModelList models, std::vector<EvidenceFile> evidence, const std::string& box);

/// `name` is that of the JSON file.
std::string certificate_page(const Certificate& certificate, const std::string& name,
                             std::string_view version);
std::string certificate_text(const Certificate& certificate, const std::string& page_name,
                             std::string_view page, std::string_view version);

struct CertifiedFile {
  std::string file;
  std::string sha256;
};
/// Returns the files whose digests a certificate has, the page first. Throws EvidenceError.
std::vector<CertifiedFile> certified_files(std::string_view certificate, const std::string& path);

}  // namespace understudy::emulator::box
