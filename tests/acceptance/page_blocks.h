// Returns the code blocks in one language on a page of docs/, which readers paste.
#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace understudy::acceptance {

inline std::vector<std::string> page_blocks(const std::string& page, const std::string& language) {
  std::ifstream file(std::string(PROJECT_FOLDER) + "/docs/" + page);
  std::vector<std::string> found;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      is_inside = !is_inside && line == "```" + language;
      if (is_inside) found.emplace_back();
    } else if (is_inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

}  // namespace understudy::acceptance
