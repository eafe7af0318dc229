#pragma once

#include <stdexcept>

namespace thermotwin::output {

/// A file could not be written: the sentence names the file, the system's reason, and what became of the old file.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace thermotwin::output
