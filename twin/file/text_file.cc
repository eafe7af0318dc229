#include "twin/file/text_file.h"

#include <fstream>
#include <sstream>

#include "twin/file/value.h"

namespace thermotwin::twin {

std::string text_of_file(std::filesystem::path const& path) {
  Location const where{path.string(), 0, 0};
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw FileError(where, "there is no such file");
  if (std::filesystem::is_directory(path, ignored)) throw FileError(where, "is a folder; a file is due");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw FileError(where, "the file cannot be read");
  return text.str();
}

}  // namespace thermotwin::twin
