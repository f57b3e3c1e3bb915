// Implements `certificate`: creates signable statements about measurements on a real controller, and verifies
// such statements.
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/sha256.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/certificate.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/box/stage/rig.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json";
// Exit codes of the shell script below.
constexpr int kUnknownKey = 10;
constexpr int kNoProgram = 127;
/// The arguments are the file of signers, the signature and the signed file. A signature does not contain its
/// signer's name, so the signer is found by the key.
constexpr const char* kVerify =
    "verify() { command -v ssh-keygen >/dev/null || exit 127; "
    R"(who=$(ssh-keygen -Y find-principals -s "$2" -f "$1" 2>&1) || { echo "$who"; exit 10; }; )"
    R"(who=$(printf '%s\n' "$who" | head -n 1); )"
    R"(ssh-keygen -Y verify -f "$1" -I "$who" -n understudy -s "$2" <"$3" 2>&1 || exit 11; }; verify)";

std::vector<box::EvidenceFile> read_evidence_files(const std::vector<std::string>& paths) {
  std::vector<box::EvidenceFile> files;
  for (const std::string& path : paths) {
    const FileText text = read_text_file(path);
    if (!text)
      throw FileError(path + ": evidence: " + text.why + "; expected a file of `understudy calibrate -o`");
    files.push_back(box::parse_evidence(*text, path));
  }
  return files;
}

int make_certificate(ModelList models, const CertificateArguments& arguments) {
  if (!arguments.output.ends_with(kEnding) || arguments.output.size() == kEnding.size())
    throw UsageError("certificate: " + quoted(arguments.output) +
                     " does not end in .json; expected -o FILE.json");
  const std::string page_path =
      arguments.output.substr(0, arguments.output.size() - kEnding.size()) + ".html";
  FileClaims claims;
  for (const std::string& path : arguments.evidence) claims.add({path, "the evidence itself"});
  const std::string output_path = require_output(claims, "--output", arguments.output);
  const box::Certificate certificate =
      box::certify(models, read_evidence_files(arguments.evidence), arguments.box);
  ResultFile output("--output", output_path, ContentKind::certificate);
  ResultFile page_output("--output", require_output(claims, "--output", page_path), ContentKind::page);
  const std::string name = fs::path(arguments.output).filename().string();
  const std::string page = box::certificate_page(certificate, name, arguments.version);
  page_output.replace(page);
  output.replace(
      box::certificate_text(certificate, fs::path(page_path).filename().string(), page, arguments.version));
  std::printf("%s and %s: %s\n", arguments.output.c_str(), page_path.c_str(), certificate.summary().c_str());
  std::printf("sign:    ssh-keygen -Y sign -f KEY -n %s %s\n", std::string(box::kSignatureNamespace).c_str(),
              arguments.output.c_str());
  std::printf("verify:  understudy certificate --verify %s --signers SIGNERS\n", arguments.output.c_str());
  return kExitWell;
}

/// Returns the path of the file: next to the certificate, or its path when the evidence was created.
std::string find_certified(const std::string& certificate, const std::string& file) {
  const fs::path folder = fs::path(certificate).parent_path();
  std::error_code error;
  for (const fs::path& path : {folder / fs::path(file).filename(), folder / file})
    if (fs::exists(path, error)) return path.string();
  return file;
}

/// Compares the files with their digests in the certificate, and prints the results. Returns false if a file
/// has changed.
bool verify_files(const std::vector<box::CertifiedFile>& files, const std::string& certificate) {
  bool is_good = true;
  for (const box::CertifiedFile& file : files) {
    const auto digest = sha256_of_file(find_certified(certificate, file.file));
    const bool is_same = digest && *digest == file.sha256;
    is_good = is_good && (is_same || !digest);
    std::printf("  %s: %s\n", one_line(file.file).c_str(),
                is_same  ? "is the file that was certified"
                : digest ? "IS NOT the file that was certified"
                         : "was not found");
  }
  return is_good;
}

int verify_certificate(const CertificateArguments& arguments) {
  if (arguments.evidence.size() != 1)
    throw UsageError("certificate: --verify needs exactly one certificate; expected --verify FILE.json");
  if (arguments.signers.empty())
    throw UsageError(
        "certificate: --verify needs the keys that you trust; expected --signers FILE with lines such as "
        "`NAME ssh-ed25519 AAAA...`");
  const std::string& path = arguments.evidence.front();
  const FileText text = read_text_file(path);
  if (!text) throw FileError(path + ": certificate: " + text.why + "; expected a certificate");
  const std::vector<box::CertifiedFile> files = box::certified_files(*text, path);
  const std::string signature = path + ".sig";
  for (const auto& [file, what] : {std::pair{signature, "signature: "}, {arguments.signers, "signers: "}})
    if (const std::string why = why_not_readable(file); !why.empty())
      throw FileError(
          file + ": " + what + why + "; expected " +
          (file == signature ? "one made by `ssh-keygen -Y sign`" : "a file of keys that you trust"));
  const box::CommandAnswer answer = box::run_command(kVerify, {arguments.signers, signature, path});
  if (answer.exit_code == kNoProgram)
    throw FileError("ssh-keygen: is not installed; expected the program from OpenSSH");
  const std::string message = one_line(answer.output);
  if (answer.exit_code == kUnknownKey) {
    std::printf("%s: NOT VERIFIED: no key in %s has signed it (%s)\n", path.c_str(),
                arguments.signers.c_str(), message.c_str());
    return kExitFailed;
  }
  if (answer.exit_code != 0) {
    std::printf("%s: NOT VERIFIED: the signature does not match (%s)\n", path.c_str(), message.c_str());
    return kExitFailed;
  }
  const bool is_good = verify_files(files, path);
  std::printf("%s: %s: %s\n", path.c_str(), is_good ? "verified" : "NOT VERIFIED", message.c_str());
  return is_good ? kExitWell : kExitFailed;
}

}  // namespace

int certify_evidence(ModelList models, const CertificateArguments& arguments) {
  return arguments.verify ? verify_certificate(arguments) : make_certificate(models, arguments);
}

}  // namespace understudy::emulator::command_line
