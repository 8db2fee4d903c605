// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/keys/certificate_list.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace orca::keys {
namespace {

constexpr const char* kNoMachine = "-";
constexpr std::size_t kSubjectSize = 32;
constexpr std::size_t kMost = 100'000;  // certificates

bool is_subject(const std::string& text) {
  return text.size() == kSubjectSize &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isxdigit(c) != 0; });
}

// Reads "SUBJECT MACHINE PROCESS SECONDS valid|revoked".
bool read(const std::string& line, Certificate& certificate) {
  std::istringstream words(line);
  std::string state;
  std::string more;
  if (!(words >> certificate.subject >> certificate.machine >> certificate.process >> certificate.not_after >>
        state) ||
      words >> more || !is_subject(certificate.subject))
    return false;
  if (certificate.machine == kNoMachine) certificate.machine.clear();
  certificate.revoked = state == "revoked";
  return certificate.revoked || state == "valid";
}

}  // namespace

std::string print(const CertificateList& list) {
  std::ostringstream text;
  text << "orca certificates " << list.edition << "\n";
  for (const Certificate& each : list.certificates)
    text << each.subject << " " << (each.machine.empty() ? kNoMachine : each.machine) << " " << each.process
         << " " << each.not_after << " " << (each.revoked ? "revoked" : "valid") << "\n";
  return text.str();
}

Result<CertificateList> parse_certificates(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::string line;
  CertificateList list;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();  // signed text has these ends of lines
    std::istringstream head(line);
    std::string orca;
    std::string what;
    const bool is_good =
        number == 1 ? head >> orca >> what >> list.edition && orca == "orca" && what == "certificates"
                    : list.certificates.size() < kMost && read(line, list.certificates.emplace_back());
    if (!is_good)
      return fail(Code::data_loss,
                  "line " + std::to_string(number) + " of the list of certificates cannot be understood");
  }
  if (list.edition == 0) return fail(Code::data_loss, "the list of certificates is empty");
  return list;
}

}  // namespace orca::keys
