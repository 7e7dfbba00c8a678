// What is here: what is written comes back; files that are missing, foreign, cut off or damaged are named.
// What is not: the layout of result files.
#include "io/hdf5.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <thread>

#include "io/files.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Hdf5 : public testing::Test {
 protected:
  std::string error_of(const std::function<void()>& code) const {
    std::string said;
    testing::internal::CaptureStderr();
    said = input_error(code);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "HDF5 prints its own errors";
    EXPECT_THAT(said, HasSubstr(path.string()));
    return said;
  }
  /// A file with a large and a small dataset, some text and attributes.
  void write_example() const {
    Hdf5Writer file(path);
    file.dataset("/packing/x", std::span<const double>(numbers), 0, "m");
    file.dataset("/packing/pairs", std::span<const std::int32_t>(std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}), 2);
    file.text("/config", "[layout]\nrows = 6\n");
    file.attribute("/", "format", "perfora.pack/1");
    file.attribute("/packing", "seed", std::int64_t{9007199254740993});
    file.attribute("/packing", "width", 0.15);
    file.commit();
  }

  Hdf5() {
    std::mt19937_64 random(3);
    for (int k = 0; k < 5000; ++k)
      numbers.push_back(std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 200) - 100));
  }

  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "P.h5";
  std::vector<double> numbers;
};

TEST_F(Hdf5, WhatIsWrittenComesBack) {
  write_example();
  const Hdf5Reader file(path);
  EXPECT_EQ(file.doubles("/packing/x"), numbers);
  EXPECT_EQ(file.doubles("packing/x"), numbers);
  EXPECT_THAT(file.shape("/packing/x"), ElementsAre(5000));
  EXPECT_THAT(file.shape("/packing/pairs"), ElementsAre(3, 2));
  EXPECT_THAT(file.int32s("/packing/pairs"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(file.doubles("/packing/pairs"), ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
  EXPECT_EQ(file.text("/config"), "[layout]\nrows = 6\n");
  EXPECT_EQ(file.attribute_text("/", "format"), "perfora.pack/1");
  EXPECT_EQ(file.attribute_text("/packing/x", "units"), "m");
  EXPECT_EQ(file.attribute_int("/packing", "seed"), 9007199254740993);
  EXPECT_EQ(file.attribute_double("/packing", "width"), 0.15);
  EXPECT_THAT(file.children("/"), ElementsAre("config", "packing"));
  EXPECT_THAT(file.children("/packing"), ElementsAre("pairs", "x"));
  EXPECT_TRUE(file.has("/packing/x"));
  EXPECT_TRUE(file.has("/"));
  EXPECT_FALSE(file.has("/packing/z"));
  EXPECT_FALSE(file.has("/none/z"));
  EXPECT_FALSE(file.has("/packing/x/z"));
  EXPECT_TRUE(file.has_attribute("/", "format"));
  EXPECT_FALSE(file.has_attribute("/", "none"));
  EXPECT_FALSE(file.has_attribute("/none", "none"));
}

TEST_F(Hdf5, ExtremesOfEveryType) {
  const auto round_trip = [this]<class T>(std::vector<T> values,
                                          std::vector<T> (Hdf5Reader::*read)(const std::string&) const) {
    {
      Hdf5Writer file(path);
      file.dataset("a", std::span<const T>(values));
      file.commit();
    }
    EXPECT_EQ((Hdf5Reader(path).*read)("a"), values);
  };
  const auto ends = []<class T>(T) {
    return std::vector<T>{std::numeric_limits<T>::lowest(), 0, 1, std::numeric_limits<T>::max()};
  };
  round_trip(ends(double{}), &Hdf5Reader::doubles);
  round_trip(ends(std::int32_t{}), &Hdf5Reader::int32s);
  round_trip(ends(std::int64_t{}), &Hdf5Reader::int64s);
  round_trip(ends(std::uint64_t{}), &Hdf5Reader::uint64s);
  round_trip(ends(std::uint8_t{}), &Hdf5Reader::uint8s);
}

TEST_F(Hdf5, FloatsAndEmptyDatasets) {
  {
    Hdf5Writer file(path);
    file.dataset("single", std::span<const float>(std::vector<float>{0.5F, -2.25F}), 2);
    file.dataset("none", std::span<const std::int32_t>(), 2);
    file.text("empty", "");
    file.group("/a/b");
    file.commit();
  }
  const Hdf5Reader file(path);
  EXPECT_THAT(file.doubles("single"), ElementsAre(0.5, -2.25));
  EXPECT_THAT(file.shape("none"), ElementsAre(0, 2));
  EXPECT_THAT(file.int32s("none"), IsEmpty());
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_THAT(file.children("/a/b"), IsEmpty());
}

TEST_F(Hdf5, LargeDatasetsAreCompressed) {
  {
    Hdf5Writer file(path);
    file.dataset("a", std::span<const double>(std::vector<double>(300000, 1.5)), 3);
    file.commit();
  }
  EXPECT_LT(std::filesystem::file_size(path), 100000U);  // 2.4 MB of equal numbers
  EXPECT_EQ(Hdf5Reader(path).doubles("a"), std::vector<double>(300000, 1.5));
}

TEST_F(Hdf5, LongTextComesBack) {
  const std::string text(300000, 'a');
  {
    Hdf5Writer file(path);
    file.text("config", text);
    file.attribute("/", "command_line", text.substr(0, 100000));
    file.commit();
  }
  EXPECT_EQ(Hdf5Reader(path).text("config"), text);
  EXPECT_EQ(Hdf5Reader(path).attribute_text("/", "command_line").size(), 100000U);
}

TEST_F(Hdf5, EqualContentGivesEqualBytes) {
  write_example();
  const std::string first = read_file(path);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's time stamps count seconds
  write_example();
  EXPECT_EQ(read_file(path), first);
}

TEST_F(Hdf5, NothingAppearsWithoutCommit) {
  {
    Hdf5Writer file(path);
    file.text("config", "x");
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Hdf5, ReplacesAnExistingFileWhole) {
  folder.file("P.h5", "old");
  write_example();
  EXPECT_TRUE(Hdf5Reader(path).has("/config"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST_F(Hdf5, CopiesFromAnotherFile) {
  write_example();
  const auto copy = folder / "R.h5";
  {
    Hdf5Writer file(copy);
    file.copy_from(path, "/packing", "/made/packing");
    file.commit();
  }
  const Hdf5Reader file(copy);
  EXPECT_EQ(file.doubles("/made/packing/x"), numbers);
  EXPECT_EQ(file.attribute_text("/made/packing/x", "units"), "m");
  EXPECT_EQ(file.attribute_int("/made/packing", "seed"), 9007199254740993);
  Hdf5Writer again(copy);
  EXPECT_THAT(error_of([&] { again.copy_from(path, "/none", "/none"); }), HasSubstr("has no /none"));
}

TEST_F(Hdf5, MissingForeignAndEmptyFiles) {
  const auto open = [this] { Hdf5Reader file(path); };
  EXPECT_EQ(error_of(open), path.string() + ": does not exist; a file written by perfora is wanted; check the path");
  folder.file("P.h5", "x,y\n1,2\n");
  EXPECT_THAT(error_of(open), HasSubstr("is not an HDF5 file"));
  folder.file("P.h5", "");
  EXPECT_THAT(error_of(open), HasSubstr("is empty"));
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_THAT(error_of(open), HasSubstr("is a folder; a file written by perfora is wanted; check the path"));
  for (const char* name : {"best.xdmf.h5", "later.h5", "best.h5"}) std::ofstream(path / name) << "x";
  EXPECT_THAT(error_of(open), HasSubstr("give one of its files, such as " + (path / "best.h5").string()));
}

TEST_F(Hdf5, CutOffFilesAreNamedAtEveryLength) {
  write_example();
  const std::string whole = read_file(path);
  for (std::size_t size = 100; size < whole.size(); size += 997) {
    folder.file("P.h5", whole.substr(0, size));
    EXPECT_THAT(error_of([this] { Hdf5Reader file(path); }),
                HasSubstr("is cut off or damaged; a file written by perfora is wanted; write it again"));
  }
}

TEST_F(Hdf5, DamageInCompressedDataIsNoticed) {
  write_example();
  std::string damaged = read_file(path);
  std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / 2), 64, '\x5a');
  folder.file("P.h5", damaged);
  EXPECT_THAT(error_of([this] { (void)Hdf5Reader(path).doubles("/packing/x"); }),
              HasSubstr("is damaged (its checksum does not fit)"));
}

TEST_F(Hdf5, WhatIsNotThereIsNamed) {
  write_example();
  const Hdf5Reader file(path);
  EXPECT_THAT(error_of([&] { (void)file.doubles("/packing/radius"); }), HasSubstr("has no /packing/radius"));
  EXPECT_THAT(error_of([&] { (void)file.doubles("/packing"); }), HasSubstr("/packing is not a dataset"));
  EXPECT_THAT(error_of([&] { (void)file.doubles("/config"); }), HasSubstr("/config does not hold numbers"));
  EXPECT_THAT(error_of([&] { (void)file.text("/packing/x"); }), HasSubstr("/packing/x does not hold one value"));
  EXPECT_THAT(error_of([&] { (void)file.children("/packing/x"); }), HasSubstr("is not a group"));
  EXPECT_THAT(error_of([&] { (void)file.attribute_text("/", "status"); }), HasSubstr("has no attribute status of /"));
  EXPECT_THAT(error_of([&] { (void)file.attribute_double("/", "format"); }),
              HasSubstr("attribute format of / does not hold numbers"));
  EXPECT_THAT(error_of([&] { (void)file.attribute_text("/packing", "seed"); }), HasSubstr("is not a text"));
}

TEST_F(Hdf5, FolderThatIsMissing) {
  Hdf5Writer file(folder / "none/P.h5");
  EXPECT_THROW(file.commit(), SurroundingsError);
}

TEST_F(Hdf5, SameNameTwiceIsAnError) {
  Hdf5Writer file(path);
  file.text("a", "x");
  EXPECT_THROW(file.text("a", "y"), std::runtime_error);
  EXPECT_THROW(file.attribute("/none", "a", "y"), std::runtime_error);
}

TEST_F(Hdf5, SeveralThreadsMayReadAndWrite) {
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([this, k] {
      const auto mine = folder / ("T" + std::to_string(k) + ".h5");
      for (int round = 0; round < 5; ++round) {
        {
          Hdf5Writer file(mine);
          file.dataset("a", std::span<const double>(numbers));
          file.commit();
        }
        EXPECT_EQ(Hdf5Reader(mine).doubles("a"), numbers);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

// HDF5 keeps a setting for its own messages in every thread.
TEST_F(Hdf5, FailuresAreSilentInEveryThread) {
  write_file(path, "no HDF5");
  const auto open = [&] { static_cast<void>(Hdf5Reader(path)); };
  EXPECT_NE(error_of(open), "");
  std::string said;
  std::thread([&] { said = error_of(open); }).join();
  EXPECT_NE(said, "");
}

}  // namespace
}  // namespace perfora::io
