#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace thermotwin::twin {

/// InputError when `output` is the machine's file or another one that is read, by whatever path or link, is a folder,
/// or is to lie in one that is not there nor on the way to `made`, a folder that the command makes: before any work,
/// not after it. Every command that writes a file asks this first. An empty path is no file.
void refuse_to_overwrite(std::filesystem::path const& output, std::filesystem::path const& machine,
                         std::vector<std::filesystem::path> const& others, std::filesystem::path const& made = {});

/// InputError where `what` ("table of predictions") would take the place of a file that is none; an empty one may go.
void refuse_to_replace_other(std::filesystem::path const& output, std::string_view what,
                             std::function<bool(std::filesystem::path const&)> const& is_one);

/// The same of tables, which their header tells apart.
void refuse_to_replace_other_table(std::filesystem::path const& output, std::string_view what,
                                   std::function<bool(std::string const&)> const& is_header);

/// InputError when a file's suffix says another format than `what` ("a data set") is written in; none says nothing.
void check_suffix(std::filesystem::path const& output, std::string_view what, std::vector<std::string> const& suffixes);

/// The same of a picture (.png), and OutputError where no display is there to draw it: before any work, too.
void check_picture(std::filesystem::path const& picture);

/// The same of a machine, which must have its suffix: without one it would be taken for a shipped machine's name.
void check_machine_suffix(std::filesystem::path const& output);

}  // namespace thermotwin::twin
