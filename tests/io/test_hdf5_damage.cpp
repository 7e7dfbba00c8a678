// What is here: damaged HDF5 files, those with a checksum and those without, and files that point into others: refused,
// never a crash. What is not: whole files (test_hdf5.cpp).
#include <gmock/gmock.h>
#include <hdf5.h>
#include <sys/stat.h>

#include <random>

#include "io/checksum_trailer.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::HasSubstr;

constexpr std::size_t trailer_size = 24;

class Hdf5Damage : public testing::Test {
 protected:
  void SetUp() override {
    Hdf5Writer file(path);
    file.attribute("/", "format", std::string("perfora.pack/1"));
    file.dataset("/packing/x", numbers, 0, "m");
    file.dataset("/small", std::vector<std::int32_t>{1, 2, 3});
    file.text("/config", "a = 1");
    file.commit();
    whole = read_file(path);
    bare = whole.substr(0, whole.size() - trailer_size);
  }

  /// Reads everything; what was wrong, or "".
  std::string problem() const {
    try {
      const Hdf5Reader file(path);
      EXPECT_EQ(file.attribute_text("/", "format"), "perfora.pack/1");
      EXPECT_EQ(file.doubles("/packing/x"), numbers);
      EXPECT_EQ(file.int32s("/small"), (std::vector<std::int32_t>{1, 2, 3}));
      EXPECT_EQ(file.text("/config"), "a = 1");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder / "P.h5";
  std::vector<double> numbers = std::vector<double>(5000, 0.25);
  std::string whole, bare;
};

// The check value of CRC-32 for "123456789" is 0xCBF43926; the rest by hand from docs/user/formats.md, the last four
// bytes with Python's zlib.crc32 over the twenty before.
TEST_F(Hdf5Damage, TrailerIsWhatTheDocumentSays) {
  const std::string trailer = checksum_trailer("123456789");
  EXPECT_EQ(trailer.substr(0, 20), std::string("\x89PFCRC1\n\x09\0\0\0\0\0\0\0\x26\x39\xf4\xcb", 20));
  EXPECT_EQ(trailer.substr(20), std::string("\xe8"
                                            "\x07"
                                            "\x2a"
                                            "\xaf"
                                            "",
                                            4));
  EXPECT_TRUE(whole.ends_with(checksum_trailer(bare)));
  EXPECT_EQ(problem(), "");
  EXPECT_TRUE(Hdf5Reader(path).checked());
  EXPECT_TRUE(Hdf5Reader(path, Checksum::required).checked());
}

TEST_F(Hdf5Damage, EveryFlippedBitIsSeen) {
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    std::string damaged = whole;
    damaged[random() % bare.size()] ^= static_cast<char>(1U << random() % 8);
    folder.file("P.h5", damaged);
    EXPECT_THAT(problem(), HasSubstr("is damaged (its checksum does not fit)"));
  }
  for (std::size_t at = bare.size(); at < whole.size(); ++at) {  // in the trailer itself
    std::string damaged = whole;
    damaged[at] ^= 0x10;
    folder.file("P.h5", damaged);
    EXPECT_THAT(problem(), HasSubstr("damaged"));
  }
}

TEST_F(Hdf5Damage, FilesWithoutAChecksumAreReadUnlessItIsRequired) {
  folder.file("P.h5", bare);
  EXPECT_EQ(problem(), "");
  EXPECT_FALSE(Hdf5Reader(path).checked());
  EXPECT_THAT(input_error([this] { Hdf5Reader file(path, Checksum::required); }), HasSubstr("has no checksum"));
}

TEST_F(Hdf5Damage, WhatStandsBehindTheEndIsNotIgnored) {
  folder.file("P.h5", bare + "rest of something");
  EXPECT_THAT(problem(), HasSubstr("is cut off or damaged"));
}

// HDF5 itself crashes on some of these; here the trial in another process does.
TEST_F(Hdf5Damage, NoDamagedHeadOfAFileWithoutChecksumCrashesTheReader) {
  std::mt19937 random(2);
  int refused = 0;
  for (int k = 0; k < 60; ++k) {
    std::string damaged = bare;
    for (int flips = 0; flips < 4; ++flips) damaged[random() % 3000] ^= static_cast<char>(1U << random() % 8);
    folder.file("P.h5", damaged);
    try {
      const Hdf5Reader file(path);
      for (const std::string& name : file.children("/")) (void)file.has(name);
      (void)file.doubles("/packing/x");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 5);
}

/// Closes what HDF5's functions give.
struct Closing {
  hid_t file;
  ~Closing() { H5Fclose(file); }
};

TEST_F(Hdf5Damage, LinksAndStorageElsewhereAreNotFollowed) {
  const auto other = folder / "other.h5";
  {
    const Closing made{H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)};
    ASSERT_GE(H5Lcreate_external(path.c_str(), "/packing", made.file, "packing", H5P_DEFAULT, H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcreate_soft("/packing", made.file, "soft", H5P_DEFAULT, H5P_DEFAULT), 0);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, path.c_str(), 0, 80);
    const hsize_t size = 10;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t data = H5Dcreate2(made.file, "raw", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    ASSERT_GE(data, 0);
    H5Dclose(data);
    H5Sclose(space);
    H5Pclose(creation);
  }
  const Hdf5Reader file(other);
  EXPECT_THAT(input_error([&] { (void)file.doubles("/packing/x"); }),
              HasSubstr("/packing is a link that leads elsewhere, which is not followed"));
  EXPECT_THAT(input_error([&] { (void)file.has("/soft/x"); }), HasSubstr("/soft is a link"));
  EXPECT_THAT(input_error([&] { (void)file.doubles("/raw"); }), HasSubstr("/raw lies in other files"));
}

// 8 TB of zeros in a file of some kB: chunks that were never written take no room.
TEST_F(Hdf5Damage, MoreThanTheFileCanHoldIsRefusedBeforeMemoryIsTaken) {
  const auto other = folder / "other.h5";
  {
    const Closing made{H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)};
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 1000, size = hsize_t{1} << 40;
    H5Pset_chunk(creation, 1, &chunk);
    H5Pset_deflate(creation, 4);
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t data = H5Dcreate2(made.file, "x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    ASSERT_GE(data, 0);
    H5Dclose(data);
    H5Sclose(space);
    H5Pclose(creation);
  }
  EXPECT_THAT(input_error([&] { (void)Hdf5Reader(other).doubles("/x"); }),
              HasSubstr("/x claims more than the file can hold"));
}

TEST_F(Hdf5Damage, FifosAreNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder / "fifo.h5").c_str(), 0600), 0);
  EXPECT_THAT(input_error([&] { Hdf5Reader file(folder / "fifo.h5"); }), HasSubstr("is a FIFO"));
}

}  // namespace
}  // namespace perfora::io
