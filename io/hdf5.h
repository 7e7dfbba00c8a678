// What is here: a thin RAII over the HDF5 C API: whole datasets and attributes, written once, read whole.
// What is not: any knowledge of what the datasets mean; in-place updates (files are written whole and renamed).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace perfora::io {

/// A file being written. It grows in memory: HDF5 does not bear a disk that fails. commit() writes it whole, with the
/// checksum of io/checksum_trailer.h behind it; without commit() nothing is written. Groups on the way to a dataset are
/// made as needed. All datasets over 1 kB are shuffled and deflated. Throws SurroundingsError when memory or disk fail.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::filesystem::path path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void group(const std::string& name);
  /// `columns` = 0: one-dimensional; otherwise shape (size/columns, columns). `units` becomes the attribute "units"
  /// when not empty.
  void dataset(const std::string& name, std::span<const double> data, int columns = 0, const std::string& units = {});
  void dataset(const std::string& name, std::span<const float> data, int columns = 0, const std::string& units = {});
  void dataset(const std::string& name, std::span<const std::int32_t> data, int columns = 0,
               const std::string& units = {});
  void dataset(const std::string& name, std::span<const std::int64_t> data, int columns = 0,
               const std::string& units = {});
  void dataset(const std::string& name, std::span<const std::uint64_t> data, int columns = 0,
               const std::string& units = {});
  void dataset(const std::string& name, std::span<const std::uint8_t> data, int columns = 0,
               const std::string& units = {});
  /// A scalar UTF-8 string dataset (the resolved configuration).
  void text(const std::string& name, const std::string& value);
  /// Attributes of an existing object ("/" for the file).
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  /// Copies group or dataset `name` of another file to `target` here (attributes included).
  void copy_from(const std::filesystem::path& other, const std::string& name, const std::string& target);
  /// Writes the file as write_file() does; takes as much memory again as the file is long.
  void commit();

 private:
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

/// What a reader asks of a file. Older ones, and those changed by another program, have no checksum.
enum class Checksum { if_there, required };

/// A file being read. Throws InputError naming the file (and the dataset) when it is missing, no regular file, not
/// HDF5, damaged, or lacks what is asked. A checksum is tried before HDF5 sees the file; a file without one is tried in
/// a process of its own first, as HDF5 may crash on damaged ones. Links to other files and storage in other files are
/// not followed.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::filesystem::path path, Checksum checksum = Checksum::if_there);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Whether the file carries a checksum (that fits).
  bool checked() const { return checked_; }
  bool has(const std::string& name) const;
  std::vector<std::string> children(const std::string& group) const;  ///< names in alphabetical order
  std::vector<std::int64_t> shape(const std::string& name) const;
  /// Whole dataset, row by row; converts between numeric types as HDF5 does.
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::int32_t> int32s(const std::string& name) const;
  std::vector<std::int64_t> int64s(const std::string& name) const;
  std::vector<std::uint64_t> uint64s(const std::string& name) const;
  std::vector<std::uint8_t> uint8s(const std::string& name) const;
  std::string text(const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string attribute_text(const std::string& object, const std::string& name) const;
  double attribute_double(const std::string& object, const std::string& name) const;
  std::int64_t attribute_int(const std::string& object, const std::string& name) const;

 private:
  friend class Hdf5Writer;  // copies from it

  std::filesystem::path path_;
  std::int64_t file_ = -1;
  bool checked_ = false;
};

/// For main(), before any file: HDF5 does nothing when the program ends. All files are closed by then, and after a
/// failure its own clearing up would crash.
void end_without_hdf5();

}  // namespace perfora::io
