#include "engine/disk_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "engine/files.h"

namespace seascape {
namespace {

using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

class DiskCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("disk_cache_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const Bytes& bytes, const std::string& name) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  }
  fs::path folder_;
};

TEST_F(DiskCacheTest, KeepsFilesByName) {
  const DiskCache cache(folder_);
  EXPECT_FALSE(cache.read("a"));
  cache.write("a", Bytes{1, 2, 3});
  cache.write("b", Bytes{});
  EXPECT_EQ(cache.read("a"), (Bytes{1, 2, 3}));
  EXPECT_EQ(cache.read("b"), Bytes{});
  cache.write("a", Bytes{4});
  EXPECT_EQ(DiskCache(folder_).read("a"), Bytes{4});
}

// Each byte changed, each shorter length, more behind it, and another file under the name. Controls seen: the sum not
// compared; the name left out of it.
TEST_F(DiskCacheTest, WhatIsDamagedIsAbsentAndIsReplaced) {
  const DiskCache cache(folder_);
  cache.write("a", Bytes{10, 20, 30, 40});
  const Bytes whole = read_bytes(folder_ / "a");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    Bytes changed = whole;
    changed[i] ^= 0x10;
    put(changed, "a");
    EXPECT_FALSE(cache.read("a")) << "byte " << i;
    put(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(i)), "a");
    EXPECT_FALSE(cache.read("a")) << "cut to " << i;
  }
  Bytes longer = whole;
  longer.push_back(0);
  put(longer, "a");
  EXPECT_FALSE(cache.read("a"));
  put(whole, "another");
  EXPECT_FALSE(cache.read("another"));
  cache.write("a", Bytes{10, 20, 30, 40});
  EXPECT_EQ(cache.read("a"), (Bytes{10, 20, 30, 40}));
}

TEST_F(DiskCacheTest, WhatCannotBeWrittenIsNotKept) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  const DiskCache cache(folder_);
  cache.write("a", Bytes{1});
  EXPECT_FALSE(cache.read("a"));
  DiskCache().write("a", Bytes{1});
  EXPECT_FALSE(DiskCache().read("a"));
  fs::remove(folder_);
  fs::create_directories(folder_ / "a");  // a folder where the file should be
  cache.write("a", Bytes{1});
  EXPECT_FALSE(cache.read("a"));
}

// Control seen: the newest removed first.
TEST_F(DiskCacheTest, TheOldestFilesGo) {
  const DiskCache cache(folder_, 1000);
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 9; ++i) {
    const std::string name(1, char('a' + i));
    cache.write(name, Bytes(200, std::uint8_t(i)));
    fs::last_write_time(folder_ / name, now - std::chrono::seconds(100 - i));
  }
  EXPECT_FALSE(cache.read("a"));
  EXPECT_TRUE(cache.read("i"));
  std::uintmax_t all = 0;
  for (const auto& file : fs::directory_iterator(folder_)) all += file.file_size();
  EXPECT_LE(all, 1000u);
}

TEST_F(DiskCacheTest, TheUsersFolderIsThatOfTheirDesktop) {
  const auto with = [](const char* off, const char* cache, const char* home) {
    const auto set = [](const char* name, const char* value) {
      const char* before = std::getenv(name);
      const std::optional<std::string> was = before ? std::optional<std::string>(before) : std::nullopt;
      value ? setenv(name, value, 1) : unsetenv(name);
      return was;
    };
    const auto a = set("SEASCAPE_CACHE", off), b = set("XDG_CACHE_HOME", cache), c = set("HOME", home);
    const fs::path folder = DiskCache::of_user().folder();
    set("SEASCAPE_CACHE", a ? a->c_str() : nullptr);
    set("XDG_CACHE_HOME", b ? b->c_str() : nullptr);
    set("HOME", c ? c->c_str() : nullptr);
    return folder.string();
  };
  EXPECT_EQ(with(nullptr, "/cache", "/home/a"), "/cache/seascape/made");
  EXPECT_EQ(with(nullptr, "relative", "/home/a"), "/home/a/.cache/seascape/made");
  EXPECT_EQ(with(nullptr, nullptr, "/home/a"), "/home/a/.cache/seascape/made");
  EXPECT_EQ(with(nullptr, nullptr, nullptr), "");
  EXPECT_EQ(with("off", "/cache", "/home/a"), "");
}

}  // namespace
}  // namespace seascape
