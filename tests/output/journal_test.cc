#include "output/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/error.h"
#include "tests/output/small_disk.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::contents;
using tests::put;
using Records = std::vector<std::string>;

constexpr std::size_t head = 24;  ///< bytes before each record

Records const records = {"first", std::string("\0\n\xff", 3), "", std::string(10'000, 'x')};

std::filesystem::path written(tests::TemporaryDirectory const& directory) {
  Journal journal(directory / "journal");
  for (auto const& record : records) journal.append(record);
  return directory / "journal";
}

TEST(Journal, GivesBackWhatWasAppended) {
  tests::TemporaryDirectory const directory;
  Journal again(written(directory));
  EXPECT_EQ(again.take_records(), records);
  again.append("fifth");
  EXPECT_EQ(contents(directory / "journal").size(), 5 * head + 5 + 3 + 10'000 + 5u);
}

/// Whatever length is left of the file, whole records are read, and what is appended then is read, too.
TEST(Journal, CutAnywhereKeepsTheWholeRecordsBeforeTheCut) {
  tests::TemporaryDirectory const directory;
  auto const whole = contents(written(directory));
  for (std::size_t size : {0, 1, 8, 23, 24, 28, 29, 30, 55, 56, 79, 80, 81, 104, 105, 5000, 10'103}) {
    put(directory / "cut", whole.substr(0, size));
    auto const counted = Journal::count(directory / "cut");
    std::size_t fit = 0, end = 0;
    while (fit < records.size() && end + head + records[fit].size() <= size) end += head + records[fit++].size();
    EXPECT_EQ(counted, fit) << size;
    Records expected(records.begin(), records.begin() + std::ptrdiff_t(fit));
    {
      Journal cut(directory / "cut");
      EXPECT_EQ(cut.take_records(), expected) << size;
      cut.append("new");
    }
    expected.emplace_back("new");
    EXPECT_EQ(Journal(directory / "cut").take_records(), expected) << size;
  }
}

std::string refusal(std::filesystem::path const& path) {
  try {
    Journal const journal(path);
    return "opened";
  } catch (thermal::InputError const& error) {
    return error.what();
  }
}

/// The last record's only byte may be one that was on its way when the power went.
TEST(Journal, OnlyTheLastRecordMayBeDamaged) {
  tests::TemporaryDirectory const directory;
  auto const whole = contents(written(directory));
  for (std::size_t const at :
       {head + 5 + head, head + 5 + 8, head + 5, std::size_t(9)}) {  // record, length, mark, first
    auto bytes = whole;
    bytes[at] ^= 1;
    put(directory / "damaged", bytes);
    EXPECT_THAT(refusal(directory / "damaged"),
                AllOf(HasSubstr("damaged' is damaged at byte " + std::to_string(at < head ? 0 : head + 5)),
                      HasSubstr("it is left as it is")));
    EXPECT_TRUE(contents(directory / "damaged") == bytes);
  }
  auto bytes = whole;
  bytes.back() ^= 1;
  put(directory / "damaged", bytes);
  EXPECT_EQ(Journal(directory / "damaged").take_records(), Records(records.begin(), records.end() - 1));
}

TEST(Journal, AFileOfSomethingElseIsRefusedAndLeftAsItIs) {
  tests::TemporaryDirectory const directory;
  for (auto const& text : Records{"a", "notes of a day, longer than a head", std::string(50, '\0')}) {
    put(directory / "notes", text);
    EXPECT_THAT(refusal(directory / "notes"), HasSubstr("notes' does not begin as a journal"));
    EXPECT_THROW(static_cast<void>(Journal::read(directory / "notes")), thermal::InputError);
    EXPECT_EQ(contents(directory / "notes"), text);
  }
}

TEST(Journal, AReaderCutsNothing) {
  tests::TemporaryDirectory const directory;
  auto const whole = contents(written(directory)), cut = whole.substr(0, whole.size() - 1);
  put(directory / "cut", cut);
  EXPECT_EQ(Journal::read(directory / "cut"), Records(records.begin(), records.end() - 1));
  EXPECT_TRUE(contents(directory / "cut") == cut);
}

TEST(Journal, OnAFullDiskItSaysSoAndStaysWhole) {
  tests::TemporaryDirectory const directory;
  Journal journal(directory / "journal");
  journal.append("first");
  {
    tests::SmallDisk const full(100);
    EXPECT_THAT([&] { journal.append(std::string(1000, 'x')); },
                testing::ThrowsMessage<OutputError>(HasSubstr("journal': File too large")));
  }
  journal.append("second");
  EXPECT_EQ(Journal::read(directory / "journal"), (Records{"first", "second"}));
}

TEST(Journal, IsForOneAtATime) {
  tests::TemporaryDirectory const directory;
  Journal const first(directory / "journal");
  EXPECT_THROW(Journal second(directory / "journal"), OutputError);
  EXPECT_THROW(Journal nowhere(directory / "none" / "journal"), OutputError);
}

}  // namespace
}  // namespace thermotwin::output
