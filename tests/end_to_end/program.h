#pragma once

#include <array>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

namespace thermotwin::tests {

/// What a command printed, and its exit code; −1: it was killed.
struct Answer {
  int code = 0;
  std::string text;
};

inline Answer run_command(std::string const& command) {
  FILE* pipe = popen(command.c_str(), "r");
  Answer answer;
  std::array<char, 4096> buffer{};
  while (std::size_t const n = fread(buffer.data(), 1, buffer.size(), pipe)) answer.text.append(buffer.data(), n);
  int const status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

/// Both streams of the program, given these words.
inline Answer run_program(std::string const& arguments) {
  return run_command(std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1");
}

/// Both streams of a command that is expected to end so.
inline std::string answer(std::string const& command, int expected_code = 0) {
  auto const [code, text] = run_command(command + " 2>&1");
  EXPECT_EQ(code, expected_code) << command << "\n" << text;
  return text;
}

}  // namespace thermotwin::tests
