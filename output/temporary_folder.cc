#include "output/temporary_folder.h"

#include <stdlib.h>
#include <system_error>

#include "output/atomic_file.h"
#include "output/error.h"

namespace thermotwin::output {

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "thermotwin.XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw OutputError("cannot make a folder like " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::put(std::string const& name, std::string_view text) const {
  write_atomically(path_ / name, text);
  return path_ / name;
}

}  // namespace thermotwin::output
