#include "mesh/io/write_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <iostream>
#include <sstream>
#include <thread>

#include "penumbra/mesh/error.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

void write_hello(std::ostream& out) {
  out << "hello\n";
}

TEST(WriteFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "something longer that was there");
  write_file(folder / "a.txt", write_hello);
  write_file(folder / "b.txt", write_hello);
  EXPECT_EQ(read_text(folder / "a.txt"), "hello\n");
  EXPECT_EQ(read_text(folder / "b.txt"), "hello\n");
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(WriteFile, LeavesTheOldFileAndNothingElseWhenTheCallbackThrows) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  const auto failing = [](std::ostream& out) {
    out << "half";
    throw Cancelled();
  };
  EXPECT_THROW(write_file(folder / "a.txt", failing), Cancelled);
  EXPECT_THROW(write_file(folder / "new.txt", failing), Cancelled);
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WriteFile, AFailedStreamIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file(folder / "a", [](std::ostream& out) { out.setstate(std::ios::failbit); }),
               SystemError);
  EXPECT_THROW(write_file(folder / "a",
                          [](std::ostream& out) {
                            out.exceptions(std::ios::badbit);
                            out.setstate(std::ios::badbit);
                          }),
               SystemError);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(WriteFile, FollowsLinksToWhatIsNotThere) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("sub/target.txt", folder / "b");
  std::filesystem::create_symlink("b", folder / "a");
  for (int time = 0; time < 2; ++time) {
    write_file(folder / "a", write_hello);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "b"));
    EXPECT_EQ(read_text(folder / "sub/target.txt"), "hello\n");
  }
  std::filesystem::create_symlink("round", folder / "round");
  EXPECT_THROW(write_file(folder / "round", write_hello), SystemError);
}

TEST(WriteFile, TakesTheLongestName) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file(folder / name, write_hello);
  EXPECT_EQ(read_text(folder / name), "hello\n");
  EXPECT_THROW(write_file(folder / (name + "n"), write_hello), SystemError);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WriteFile, UnfinishedFilesCanBeRemoved) {
  const TemporaryFolder folder;
  std::size_t before = 0, after = 9;
  EXPECT_THROW(write_file(folder / "a",
                          [&](std::ostream& out) {
                            write_file(folder / "b", write_hello);
                            out << "half";
                            before = folder.file_count();
                            remove_unfinished_files();
                            after = folder.file_count();
                          }),
               SystemError);
  EXPECT_EQ(before, 2u);
  EXPECT_EQ(after, 1u);
  EXPECT_EQ(read_text(folder / "b"), "hello\n");
}

TEST(WriteFile, SaysWhatCannotBeWritten) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder.path(), folder / "none" / "a.txt",
                                            std::filesystem::path("/proc/none"), std::filesystem::path("")}) {
    try {
      write_file(path, write_hello);
      ADD_FAILURE() << path;
    } catch (const SystemError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

TEST(WriteFile, WritesSpecialFilesDirectly) {
  write_file("/dev/null", write_hello);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  if (std::filesystem::is_character_file("/dev/full")) {
    EXPECT_THROW(write_file("/dev/full", write_hello), SystemError);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  }
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_text(pipe); });
  write_file(pipe, write_hello);
  reader.join();
  EXPECT_EQ(received, "hello\n");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(WriteFile, KeepsPermissionsAndLinks) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  using std::filesystem::perms;
  std::filesystem::permissions(folder / "a.txt", perms::owner_read | perms::owner_write);
  std::filesystem::create_symlink("a.txt", folder / "link");
  write_file(folder / "link", write_hello);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_text(folder / "a.txt"), "hello\n");
  EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(), perms::owner_read | perms::owner_write);
}

TEST(WriteFile, DashIsStandardOutput) {
  std::ostringstream captured;
  std::streambuf* const old = std::cout.rdbuf(captured.rdbuf());
  write_file("-", write_hello);
  std::cout.rdbuf(old);
  EXPECT_EQ(captured.str(), "hello\n");
  EXPECT_FALSE(std::filesystem::exists("-"));
}

}  // namespace
}  // namespace penumbra
