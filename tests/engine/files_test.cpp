#include "engine/files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

// Files may not grow past `bytes` while this lives: what a full disk looks like to a writer.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : old_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit small = old_;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_signal_);
  }

 private:
  rlimit old_{};
  void (*old_signal_)(int);
};

// Root may write anywhere; the checks of permission run as nobody.
class AsNobody {
 public:
  AsNobody() : root_(geteuid() == 0) {
    if (root_ && seteuid(65534) != 0) root_ = false;
  }
  ~AsNobody() {
    if (root_ && seteuid(0) != 0) ADD_FAILURE() << "still nobody";
  }

 private:
  bool root_;
};

// Control: with the rename left out of write_atomically the text read back is missing.
TEST(Files, WritesAndReadsBack) {
  const TemporaryFolder folder;
  const std::string text("zero \0 byte and \xff", 17);
  write_atomically(folder / "a.bin", text);
  EXPECT_EQ(read_text(folder / "a.bin"), text);
  write_atomically(folder / "a.bin", std::string_view());
  EXPECT_EQ(read_text(folder / "a.bin"), "");
  EXPECT_THAT(folder.names(), ElementsAre("a.bin"));
}

// Control: without fs::remove after a failed write, a.txt.tmp-PID-N stays behind.
TEST(Files, FullDiskLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", std::string_view("old"));
  {
    const SmallDisk disk(4096);
    const std::string message = error_of([&] { write_atomically(folder / "a.txt", std::string(100000, 'x')); });
    EXPECT_THAT(message, HasSubstr((folder / "a.txt").string()));
    EXPECT_THAT(message, HasSubstr("larger than this system allows"));
  }
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

// Control: a writer that ignores what fflush and fclose answer is silent on /dev/full.
TEST(Files, DevicesAreWrittenToAndStay) {
  EXPECT_THAT(error_of([] { write_atomically("/dev/full", std::string_view("x")); }), HasSubstr("the disk is full"));
  write_atomically("/dev/null", std::string_view("x"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

// Control: renaming over the link itself turns link.txt into a plain file.
TEST(Files, LinksStayLinks) {
  const TemporaryFolder folder;
  write_atomically(folder / "real.txt", std::string_view("old"));
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_atomically(folder / "link.txt", std::string_view("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(read_text(folder / "real.txt"), "new");
  EXPECT_THAT(folder.names(), ElementsAre("link.txt", "real.txt"));
}

// A link to a file that is yet to be makes that file; one whose folder is missing, or that leads round, is refused.
// Controls seen: fs::canonical(), which takes no such link; the count of links left out (it ran until it was stopped).
TEST(Files, ALinkToNoFileMakesIt) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("second", folder / "first");
  std::filesystem::create_symlink("real.txt", folder / "second");
  write_atomically(folder / "first", std::string_view("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "second"));
  EXPECT_EQ(read_text(folder / "real.txt"), "new");
  std::filesystem::create_symlink("none/real.txt", folder / "away");
  EXPECT_THAT(error_of([&] { write_atomically(folder / "away", std::string_view("x")); }),
              HasSubstr("/away: its folder does not exist"));
  std::filesystem::create_symlink("round", folder / "round");
  EXPECT_THAT(error_of([&] { write_atomically(folder / "round", std::string_view("x")); }),
              HasSubstr("/round: its symbolic links go round in a circle"));
  EXPECT_THAT(folder.names(), ElementsAre("away", "first", "real.txt", "round", "second"));
}

// What a name holds does not break the line of a message, nor command a terminal. Control seen: names as they are.
TEST(Files, AMessageIsOneLineWhateverTheName) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { read_text(folder / "a\nb\x1b[31m"); }),
              HasSubstr("/a\\x0ab\\x1b[31m: there is no such file"));
}

// A name may be as long as names may be, and no longer, of files and of folders. Controls seen: the temporary name not
// cut; fs::is_directory() that throws what is no Error.
TEST(Files, NamesMayBeLong) {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  write_atomically(folder / longest, std::string_view("x"));
  EXPECT_THAT(folder.names(), ElementsAre(longest));
  EXPECT_THAT(error_of([&] { write_atomically(folder / (longest + "n"), std::string_view("x")); }),
              HasSubstr("its name is too long; choose a shorter name"));
  EXPECT_THAT(error_of([&] { make_output_directory(folder / (longest + "n")); }),
              HasSubstr("its name is too long; choose a shorter name"));
  EXPECT_THAT(folder.names(), ElementsAre(longest));
}

// Control: without fs::permissions the new file has the mode of any new file.
TEST(Files, KeepsTheModeOfTheFileItReplaces) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.sh", std::string_view("old"));
  chmod((folder / "a.sh").c_str(), 0751);
  write_atomically(folder / "a.sh", std::string_view("new"));
  struct stat status {};
  stat((folder / "a.sh").c_str(), &status);
  EXPECT_EQ(status.st_mode & 07777, 0751u);
}

// Control: each case of advice_for taken out in turn changes the words asked for here.
TEST(Files, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  write_atomically(folder / "plain", std::string_view("x"));
  EXPECT_THAT(error_of([&] { read_text(folder / "none"); }), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of([&] { read_text(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { read_text(folder / "plain/below"); }), HasSubstr("is a file, not a folder"));
  EXPECT_THAT(error_of([&] { read_text(folder / "plain", 0); }), HasSubstr("is larger than"));
  EXPECT_THAT(error_of([&] { write_atomically(folder / "none/a", std::string_view("x")); }),
              HasSubstr("folder does not exist"));
  EXPECT_THAT(error_of([&] { write_atomically(folder.path(), std::string_view("x")); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { make_output_directory(folder / "plain"); }), HasSubstr("is a file"));
  EXPECT_THAT(error_of([&] { make_output_directory(folder / "plain/below"); }), HasSubstr("is a file"));
  EXPECT_THAT(error_of([&] { read_text("/dev/zero", 1 << 20); }), HasSubstr("is larger than 1 MiB"));
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const auto to = [](int end) { write_atomically("/dev/fd/" + std::to_string(end), std::string_view("x")); };
  EXPECT_THAT(error_of([&] { to(ends[0]); }), HasSubstr("is not open for writing"));
  const auto handler = std::signal(SIGPIPE, SIG_IGN);  // as main has it
  close(ends[0]);
  EXPECT_THAT(error_of([&] { to(ends[1]); }), HasSubstr("its reader went before the end"));
  std::signal(SIGPIPE, handler);
  close(ends[1]);
  EXPECT_THAT(folder.names(), ElementsAre("plain"));
}

// Control: without access() in write_atomically the protected file is replaced.
TEST(Files, RespectsPermissions) {
  const TemporaryFolder folder;
  write_atomically(folder / "secret", std::string_view("x"));
  write_atomically(folder / "fixed", std::string_view("x"));
  std::filesystem::create_directory(folder / "closed");
  chmod((folder / "secret").c_str(), 0);
  chmod((folder / "fixed").c_str(), 0444);
  chmod((folder / "closed").c_str(), 0555);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(folder.path().c_str(), 65534, 65534), 0);
  }
  {
    const AsNobody nobody;
    EXPECT_THAT(error_of([&] { read_text(folder / "secret"); }), HasSubstr("no permission to read"));
    EXPECT_THAT(error_of([&] { write_atomically(folder / "fixed", std::string_view("y")); }),
                HasSubstr("no permission to write"));
    EXPECT_THAT(error_of([&] { write_atomically(folder / "closed/a", std::string_view("y")); }),
                HasSubstr("no permission to write"));
    EXPECT_THAT(error_of([&] { make_output_directory(folder / "closed"); }), HasSubstr("no permission to write"));
    EXPECT_THAT(error_of([&] { make_output_directory(folder / "closed/below"); }), HasSubstr("no permission to write"));
  }
  EXPECT_EQ(read_text(folder / "fixed"), "x");
}

// Control: with one temporary name for all threads, some writers fail and mixed contents appear.
TEST(Files, ThreadsMayWriteTheSameFile) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (char letter = 'a'; letter < 'e'; ++letter)
    threads.emplace_back([&, letter] {
      for (int i = 0; i < 50; ++i) write_atomically(folder / "shared", std::string(50000, letter));
    });
  for (std::thread& thread : threads) thread.join();
  const std::string text = read_text(folder / "shared");
  EXPECT_EQ(text, std::string(50000, text.at(0)));
  EXPECT_THAT(folder.names(), ElementsAre("shared"));
}

// Control: a probe that is not removed is found in the folder.
TEST(Files, MakesOutputDirectories) {
  const TemporaryFolder folder;
  make_output_directory(folder / "a b/c");
  make_output_directory(folder / "a b/c");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a b/c"));
  const SmallDisk disk(0);
  error_of([&] { make_output_directory(folder / "a b/c"); });
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a b/c"));
}

// Control seen: without leads_to_descriptor() in write_atomically the first write replaces the file, and the next finds
// it gone.
TEST(Files, ADescriptorIsWrittenToAndTheFileBehindItStays) {
  const TemporaryFolder folder;
  const int log = open((folder / "log").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
  ASSERT_EQ(write(log, "before\n", 7), 7);
  const std::string name = "/dev/fd/" + std::to_string(log);
  std::filesystem::create_symlink(name, folder / "link");
  write_atomically(name, std::string_view("now\n"));
  write_atomically("/proc/self/fd/" + std::to_string(log), std::string_view("again\n"));
  write_atomically(folder / "link", std::string_view("by a link\n"));
  ASSERT_EQ(write(log, "after\n", 6), 6);
  close(log);
  EXPECT_EQ(read_text(folder / "log"), "before\nnow\nagain\nby a link\nafter\n");
  EXPECT_THAT(error_of([&] { write_atomically(name, std::string_view("x")); }),
              HasSubstr("no such descriptor is open"));
  EXPECT_THAT(folder.names(), ElementsAre("link", "log"));
}

// Controls seen: a reader that does not ask poll() first finds the end before the writer comes; one that does not try
// again at EAGAIN throws; a writer that is opened but once says that there is no such device.
TEST(Files, PipesAreReadAndWrittenWhenTheOtherSideComes) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe", text(300000, 'x');
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto later = [](const std::function<void()>& work) {
    return std::thread([work] {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      work();
    });
  };
  const auto in_parts = [&] {
    std::ofstream writer(pipe);
    for (int i = 0; i < 3; ++i) {
      writer << text << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  };
  std::thread writer = later(in_parts);
  EXPECT_EQ(read_text(pipe), text + text + text);
  writer.join();
  std::string got;
  const auto take = [&] { got = read_text(pipe); };
  std::thread reader = later(take);
  write_atomically(pipe, text);
  reader.join();
  EXPECT_EQ(got, text);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

// Control seen: names alone compared.
TEST(Files, KnowsTwoNamesOfOneFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) write_atomically(folder / name, std::string_view("x"));
  std::filesystem::create_symlink("a", folder / "soft");
  std::filesystem::create_hard_link(folder / "a", folder / "hard");
  for (const std::filesystem::path& other :
       {folder / "a", folder / "soft", folder / "hard", folder.path() / ".." / folder.path().filename() / "a"}) {
    EXPECT_TRUE(same_file(folder / "a", other)) << other;
    EXPECT_FALSE(same_file(folder / "b", other)) << other;
  }
  EXPECT_FALSE(same_file("/dev/null", "/dev/null")) << "nothing of a device is lost";
  EXPECT_FALSE(same_file(folder / "none", folder / "none"));
}

// Control seen: names that are looked for and not made are given to several threads.
TEST(Files, ANumberedNameIsGivenOnce) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int n = 0; n < 5; ++n) make_numbered_file(folder / "out", "shot", ".png");
    });
  for (std::thread& thread : threads) thread.join();
  const auto files = std::filesystem::directory_iterator(folder / "out");
  EXPECT_EQ(std::distance(begin(files), end(files)), 20);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/shot_020.png"));
}

// Control: without the check of the magic number, text of the right size passes.
TEST(Files, ReadsSpirv) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> words{0x07230203, 0x00010300, 0, 1, 0};
  std::string bytes(reinterpret_cast<const char*>(words.data()), 20);
  write_atomically(folder / "a.spv", bytes);
  EXPECT_EQ(read_spirv(folder / "a.spv"), words);
  for (const std::string& wrong : {bytes.substr(0, 16), bytes + "x", std::string(20, 'x'), std::string()}) {
    write_atomically(folder / "b.spv", wrong);
    EXPECT_THAT(error_of([&] { read_spirv(folder / "b.spv"); }), HasSubstr("not a SPIR-V module"));
  }
}

// Control: the current folder given instead (the test runs elsewhere) lacks the program.
TEST(Files, KnowsWhereTheProgramLies) { EXPECT_TRUE(std::filesystem::exists(executable_directory() / "tests_unit")); }

}  // namespace
}  // namespace seascape
