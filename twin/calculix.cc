#include "twin/calculix.h"

#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "output/temporary_folder.h"
#include "thermal/error.h"
#include "twin/file/text_file.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
constexpr int not_installed = 127;

/// The child's side: nothing but system calls between fork and exec.
[[noreturn]] void become_ccx(char const* directory, char const* log) {
  int const file = ::open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::chdir(directory) != 0) ::_exit(1);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::execlp("ccx", "ccx", "-i", "block", static_cast<char*>(nullptr));
  ::_exit(not_installed);
}

int run_ccx(fs::path const& directory, fs::path const& log) {
  pid_t const child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start a process for ccx");
  if (child == 0) become_ccx(directory.c_str(), log.c_str());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// What a log says went wrong, or else its end.
std::string last_words(std::string const& log) {
  auto const error = log.find("*ERROR");
  return error != std::string::npos ? log.substr(error, 300)
                                    : log.substr(log.size() - std::min<std::size_t>(300, log.size()));
}

}  // namespace

std::string calculix_model(ElasticMesh const& mesh, double youngs_modulus, double poisson_ratio, double expansion) {
  std::string text = "*NODE,NSET=ALL\n";
  for (auto const& [id, x] : mesh.nodes()) text += fmt::format("{},{:.12e},{:.12e},{:.12e}\n", id, x[0], x[1], x[2]);
  text += "*ELEMENT,TYPE=C3D20R,ELSET=ALL\n";
  int element = 0;
  for (auto const& nodes : mesh.elements())
    text += fmt::format("{},{},\n{}\n", ++element, fmt::join(nodes.begin(), nodes.begin() + 10, ","),
                        fmt::join(nodes.begin() + 10, nodes.end(), ","));
  auto const [first, second, third] = mesh.corners();
  return text + fmt::format(
                    "*MATERIAL,NAME=SOLID\n*ELASTIC\n{:.9g},{:.9g}\n*EXPANSION,ZERO=0.\n{:.9g}\n"
                    "*SOLID SECTION,ELSET=ALL,MATERIAL=SOLID\n*BOUNDARY\n{},1,3\n{},2,3\n{},3,3\n",
                    youngs_modulus, poisson_ratio, expansion, first, second, third);
}

std::string calculix_loads(std::map<int, Eigen::Vector3d> const& forces) {
  std::string text = "*CLOAD\n";
  for (auto const& [node, force] : forces)
    for (int d = 0; d < 3; ++d)
      if (force[d] != 0.0) text += fmt::format("{},{},{:.12e}\n", node, d + 1, force[d]);
  return text;
}

std::string run_calculix(std::string const& deck) {
  output::TemporaryFolder const directory;
  directory.put("block.inp", deck);
  int const status = run_ccx(directory.path(), directory / "log");
  if (status == not_installed)
    throw thermal::InputError(
        "influence weights need CalculiX: there is no program 'ccx'; on Debian, install the package calculix-ccx");
  auto const written = [&](char const* name) {
    return fs::exists(directory / name) ? text_of_file(directory / name) : std::string();
  };
  auto printed = written("block.dat");
  if (status != 0 || printed.empty())
    throw std::runtime_error(fmt::format("ccx failed (exit code {}): {}", status, last_words(written("log"))));
  return printed;
}

}  // namespace thermotwin::twin
