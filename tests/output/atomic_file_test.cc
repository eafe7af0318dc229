#include "output/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "output/descriptor.h"
#include "output/error.h"
#include "tests/output/small_disk.h"
#include "tests/output/temporary_directory.h"

namespace thermotwin::output {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::contents;
using tests::put;
using tests::SmallDisk;
using tests::TemporaryDirectory;

/// Permissions do not hold for root, so be somebody else for a while.
class WithoutPrivileges {
 public:
  WithoutPrivileges() : was_root_(geteuid() == 0) {
    if (was_root_ && seteuid(65534) != 0) throw std::runtime_error("seteuid");
  }
  ~WithoutPrivileges() {
    if (was_root_ && seteuid(0) != 0) std::abort();
  }
  WithoutPrivileges(WithoutPrivileges const&) = delete;
  WithoutPrivileges& operator=(WithoutPrivileges const&) = delete;

 private:
  bool was_root_;
};

TEST(AtomicFile, WritesAndReplaces) {
  TemporaryDirectory const directory;
  write_atomically(directory / "a.csv", "first");
  write_atomically(directory / "a.csv", std::string("sec\0nd", 6));
  EXPECT_EQ(contents(directory / "a.csv"), std::string("sec\0nd", 6));
  EXPECT_THAT(directory.files(), ElementsAre("a.csv"));
}

TEST(AtomicFile, LeavesFilesThatLookTemporaryAlone) {
  TemporaryDirectory const directory;
  std::string const process = std::to_string(getpid());
  put(directory / "a.csv.tmp", "mine");
  for (int i = 0; i < 1000; ++i) put(directory / ("a.csv." + process + "-" + std::to_string(i) + ".tmp"), "mine");
  write_atomically(directory / "a.csv", "new");
  EXPECT_EQ(contents(directory / "a.csv"), "new");
  auto const files = directory.files();
  EXPECT_EQ(files.size(), 1002U);
  for (auto const& name : files) EXPECT_EQ(contents(directory / name), name == "a.csv" ? "new" : "mine") << name;
}

TEST(AtomicFile, TwoProcessesMayWriteOneFile) {
  TemporaryDirectory const directory;
  std::string const ours(100'000, 'a'), theirs(100'000, 'b');
  auto const write_often = [&](std::string const& text) {
    for (int i = 0; i < 50; ++i) write_atomically(directory / "a.csv", text);
  };
  pid_t const child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      write_often(theirs);
    } catch (OutputError const&) {
      _exit(1);
    }
    _exit(0);
  }
  EXPECT_NO_THROW(write_often(ours));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  auto const written = contents(directory / "a.csv");
  EXPECT_TRUE(written == ours || written == theirs);
  EXPECT_THAT(directory.files(), ElementsAre("a.csv"));
}

TEST(AtomicFile, LeftoversAreThoseOfThatFileAlone) {
  TemporaryDirectory const directory;
  for (auto const* name : {"a.h5", "a.h5.12-0.tmp", "a.h5.13-1.tmp", "a.h5.journal", "b.h5.12-0.tmp", "aa.h5.1-0.tmp"})
    put(directory / name, "x");
  remove_leftovers(directory / "a.h5");
  std::vector<std::string> left;
  for (auto const& entry : std::filesystem::directory_iterator(directory / ""))
    left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, testing::UnorderedElementsAre("a.h5", "a.h5.journal", "b.h5.12-0.tmp", "aa.h5.1-0.tmp"));
}

TEST(AtomicFile, FollowsALink) {
  TemporaryDirectory const directory;
  put(directory / "run_7.csv", "old");
  std::filesystem::create_symlink("run_7.csv", directory / "latest.csv");
  write_atomically(directory / "latest.csv", "new");
  EXPECT_EQ(contents(directory / "run_7.csv"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "latest.csv"));
}

TEST(AtomicFile, FollowsLinksToAFileThatIsNotThereYet) {
  TemporaryDirectory const directory;
  std::filesystem::create_symlink("run_8.csv", directory / "newest.csv");
  std::filesystem::create_symlink(directory / "newest.csv", directory / "latest.csv");
  write_atomically(directory / "latest.csv", "new");
  EXPECT_EQ(contents(directory / "run_8.csv"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "latest.csv"));
  std::filesystem::create_symlink("ring.csv", directory / "ring.csv");
  EXPECT_THAT([&] { write_atomically(directory / "ring.csv", "x"); },
              ThrowsMessage<OutputError>(HasSubstr("ring.csv': Too many levels of symbolic links")));
}

/// As /dev/stdout is, wherever a shell has sent it.
TEST(AtomicFile, WritesThroughWhatIsOpenAlready) {
  TemporaryDirectory const directory;
  put(directory / "log", "earlier, ");
  Descriptor const log(directory / "log", O_WRONLY | O_APPEND);
  write_atomically("/dev/fd/" + std::to_string(log.number()), "now, ");
  ASSERT_TRUE(log.write("later"));
  EXPECT_EQ(contents(directory / "log"), "earlier, now, later");
}

TEST(AtomicFile, KeepsTheOldFilesPermissions) {
  TemporaryDirectory const directory;
  for (auto const mode : {0600, 0664}) {
    put(directory / "a.csv", "old");
    std::filesystem::permissions(directory / "a.csv", std::filesystem::perms(mode));
    write_atomically(directory / "a.csv", "new");
    EXPECT_EQ(std::filesystem::status(directory / "a.csv").permissions(), std::filesystem::perms(mode));
  }
}

TEST(AtomicFile, LeavesTheOldFileWhenTheDiskIsFull) {
  TemporaryDirectory const directory;
  put(directory / "a.csv", "old");
  std::string const large(100'000, 'x');
  auto const write_on_small_disk = [&] {
    SmallDisk const full(10'000);
    write_atomically(directory / "a.csv", large);
  };
  EXPECT_THAT(write_on_small_disk, ThrowsMessage<OutputError>(AllOf(HasSubstr("a.csv': File too large"),
                                                                    HasSubstr("the old file is as it was"))));
  EXPECT_EQ(contents(directory / "a.csv"), "old");
  EXPECT_THAT(directory.files(), ElementsAre("a.csv"));
}

TEST(AtomicFile, SaysThatTheDeviceIsFull) {
  EXPECT_THAT([] { write_atomically("/dev/full", "x"); },
              ThrowsMessage<OutputError>(HasSubstr("'/dev/full': No space left on device")));
}

TEST(AtomicFile, SaysThatTheDirectoryIsMissing) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { write_atomically(directory / "no/a.csv", "x"); },
              ThrowsMessage<OutputError>(HasSubstr("no/a.csv': No such file or directory")));
}

TEST(AtomicFile, SaysThatTheTargetIsADirectory) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { write_atomically(directory.path(), "x"); },
              ThrowsMessage<OutputError>(HasSubstr("it is a directory")));
}

TEST(AtomicFile, LeavesTheOldFileWhenTheDirectoryIsReadOnly) {
  TemporaryDirectory const directory;
  put(directory / "a.csv", "old");
  std::filesystem::permissions(directory.path(), std::filesystem::perms(0555));
  auto const write_without_privileges = [&] {
    WithoutPrivileges const nobody;
    write_atomically(directory / "a.csv", "new");
  };
  EXPECT_THAT(write_without_privileges,
              ThrowsMessage<OutputError>(HasSubstr("Permission denied (the old file is as it was)")));
  std::filesystem::permissions(directory.path(), std::filesystem::perms(0755));
  EXPECT_EQ(contents(directory / "a.csv"), "old");
}

TEST(MakeDirectory, SaysWhatIsInTheWay) {
  TemporaryDirectory const directory;
  put(directory / "a", "");
  EXPECT_THAT([&] { make_directory(directory / "a/b"); },
              ThrowsMessage<OutputError>(HasSubstr("a/b': Not a directory")));
  make_directory(directory / "c/d");
  EXPECT_TRUE(std::filesystem::is_directory(directory / "c/d"));
}

}  // namespace
}  // namespace thermotwin::output
