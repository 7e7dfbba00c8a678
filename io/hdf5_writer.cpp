// What is here: an HDF5 file made in memory and written whole by commit().
// What is not: reading (hdf5_reader.cpp).
#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "io/checksum_trailer.h"
#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/hdf5_common.h"

namespace perfora::io {
namespace {

constexpr std::size_t compress_above = 1000;                  // bytes; smaller datasets would only grow
constexpr std::size_t chunk_bytes = std::size_t{512} * 1024;  // fits HDF5's default chunk cache of 1 MB
constexpr unsigned deflate_level = 4;                         // higher levels cost time and gain a few per cent

/// HDF5 works in memory here: what fails is the memory (or this program, which used a name twice).
void check(hid_t result, const std::filesystem::path& path, const std::string& name) {
  if (result < 0)
    throw SurroundingsError(path.string() + " cannot be written: there was no memory to put " + name +
                            " together; free some and run the command again (with --resume where it has that)");
}

Hdf5Handle make_groups_on_the_way() {
  Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  H5Pset_char_encoding(properties.get(), H5T_CSET_UTF8);
  return properties;
}

Hdf5Handle creation_properties(const std::vector<hsize_t>& shape, std::size_t element_size) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);  // equal data give equal bytes
  std::size_t row = element_size;
  for (std::size_t k = 1; k < shape.size(); ++k) row *= shape[k];
  if (shape.empty() || shape[0] * row <= compress_above) return properties;
  std::vector<hsize_t> chunk = shape;
  chunk[0] = std::min<hsize_t>(shape[0], std::max<std::size_t>(1, chunk_bytes / row));
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), deflate_level);
  return properties;
}

Hdf5Handle create_dataset(hid_t file, const std::string& name, hid_t type, const Hdf5Handle& space,
                          const Hdf5Handle& creation) {
  const Hdf5Handle link = make_groups_on_the_way();
  return {H5Dcreate2(file, name.c_str(), type, space.get(), link.get(), creation.get(), H5P_DEFAULT), H5Dclose};
}

template <class T>
void write_numbers(hid_t file, const std::filesystem::path& path, const std::string& name, std::span<const T> data,
                   int columns) {
  assert(columns >= 0 && (columns == 0 || data.size() % static_cast<std::size_t>(columns) == 0));
  std::vector<hsize_t> shape{data.size()};
  if (columns > 0) shape = {data.size() / static_cast<std::size_t>(columns), static_cast<hsize_t>(columns)};
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Hdf5Handle creation = creation_properties(shape, sizeof(T));
  const Hdf5Handle dataset = create_dataset(file, name, native_type<T>(), space, creation);
  check(dataset.get(), path, name);
  if (!data.empty())
    check(H5Dwrite(dataset.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()), path, name);
}

void write_attribute(hid_t file, const std::filesystem::path& path, const std::string& object, const std::string& name,
                     hid_t type, const void* value) {
  const std::string full = "attribute " + name + " of " + object;
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check(attribute.get(), path, full);
  check(H5Awrite(attribute.get(), type, value), path, full);
}

}  // namespace

Hdf5Writer::Hdf5Writer(std::filesystem::path path) : path_(std::move(path)) {
  const auto lock = hdf5_lock();
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, memory_access().get());
  check(file_, path_, "the file");
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ < 0) return;
  const auto lock = hdf5_lock();
  H5Fclose(file_);
}

void Hdf5Writer::group(const std::string& name) {
  const auto lock = hdf5_lock();
  const Hdf5Handle link = make_groups_on_the_way();
  const Hdf5Handle made(H5Gcreate2(file_, name.c_str(), link.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(made.get(), path_, name);
}

#define PERFORA_DATASET(type)                                                                \
  void Hdf5Writer::dataset(const std::string& name, std::span<const type> data, int columns, \
                           const std::string& units) {                                       \
    const auto lock = hdf5_lock();                                                           \
    write_numbers(file_, path_, name, data, columns);                                        \
    if (!units.empty()) attribute(name, "units", units);                                     \
  }
PERFORA_DATASET(double)
PERFORA_DATASET(float)
PERFORA_DATASET(std::int32_t)
PERFORA_DATASET(std::int64_t)
PERFORA_DATASET(std::uint64_t)
PERFORA_DATASET(std::uint8_t)
#undef PERFORA_DATASET

void Hdf5Writer::text(const std::string& name, const std::string& value) {
  const auto lock = hdf5_lock();
  const Hdf5Handle type = string_type();
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle creation = creation_properties({}, 1);
  const Hdf5Handle dataset = create_dataset(file_, name, type.get(), space, creation);
  check(dataset.get(), path_, name);
  const char* pointer = value.c_str();
  check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer), path_, name);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::string& value) {
  const auto lock = hdf5_lock();
  const char* pointer = value.c_str();
  write_attribute(file_, path_, object, name, string_type().get(), &pointer);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  const auto lock = hdf5_lock();
  write_attribute(file_, path_, object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const auto lock = hdf5_lock();
  write_attribute(file_, path_, object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5Writer::copy_from(const std::filesystem::path& other, const std::string& name, const std::string& target) {
  const auto lock = hdf5_lock();
  const Hdf5Reader source(other);  // says what is wrong with the other file
  if (!source.has(name)) throw InputError({other.string(), 0, ""}, "has no " + name, "", "write the file again");
  const Hdf5Handle link = make_groups_on_the_way();
  check(H5Ocopy(source.file_, name.c_str(), file_, target.c_str(), H5P_DEFAULT, link.get()), path_, target);
}

void Hdf5Writer::commit() {
  const auto lock = hdf5_lock();
  if (file_ < 0) throw std::logic_error(path_.string() + ": committed twice");
  check(H5Fflush(file_, H5F_SCOPE_LOCAL), path_, "the file");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  check(size, path_, "the file");
  std::string image(static_cast<std::size_t>(size), '\0');
  check(H5Fget_file_image(file_, image.data(), image.size()), path_, "the file");
  check(H5Fclose(std::exchange(file_, -1)), path_, "the file");
  image += checksum_trailer(image);
  write_file(path_, image);
}

}  // namespace perfora::io
