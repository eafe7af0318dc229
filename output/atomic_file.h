#pragma once

#include <filesystem>
#include <string_view>

namespace thermotwin::output {

/// After this, `path` holds all of `contents`; whatever happens on the way (kill, power cut, disk full), it holds what
/// it held before. The bytes go to a new file `<path>.<process>-<number>.tmp` in the same directory, are synchronised
/// to the disk, and renamed; no file that is there already is touched, and two processes may write one `path`.
///
/// A symbolic link is followed, also to a file that is not there yet; a file that is keeps its permissions. A device, a
/// pipe, and a file that this process has open (`/dev/stdout`, wherever that was redirected to) are written straight
/// through. Throws OutputError and leaves no `.tmp` behind when the directory is missing or not writable, the disk is
/// full or a size limit is met.
void write_atomically(std::filesystem::path const& path, std::string_view contents);

/// Removes the `.tmp` of processes that were killed while they wrote `path`. Nobody may be writing it.
void remove_leftovers(std::filesystem::path const& path);

/// Makes the directory and its parents; OutputError when that cannot be.
void make_directory(std::filesystem::path const& directory);

/// OutputError when the directory holds something already: what a command fills must be new, or empty.
void require_empty(std::filesystem::path const& directory);

}  // namespace thermotwin::output
