// What is here: reading whole datasets and attributes of an HDF5 file, with an InputError for whatever is wrong with
// it. What is not: writing (hdf5_writer.cpp).
#include <algorithm>
#include <ctime>
#include <new>
#include <stdexcept>

#include "io/checksum_trailer.h"
#include "io/descriptor.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/hdf5_common.h"

namespace perfora::io {
namespace {

constexpr const char* wanted_file = "a file written by perfora is wanted";
constexpr const char* damaged_remedy = "write it again or take a copy";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& problem, const std::string& remedy) {
  throw InputError({path.string(), 0, ""}, problem, wanted_file, remedy);
}

/// "give one of its files, such as out/best.h5": a folder of results given in place of one of them.
[[noreturn]] void refuse_folder(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    if (entry.path().extension() == ".h5" && entry.path().stem().extension() != ".xdmf")
      names.push_back(entry.path().string());
  refuse(folder, "is a folder",
         names.empty() ? "check the path"
                       : "give one of its files, such as " + *std::min_element(names.begin(), names.end()));
}

[[noreturn]] void refuse_damaged(const std::filesystem::path& path, const std::string& name) {
  refuse(path, name + " cannot be read: the file is damaged", damaged_remedy);
}

/// Whether `name` is there. Steps of the way that lead elsewhere are refused: another file is not looked into.
bool exists(hid_t file, const std::filesystem::path& path, const std::string& name) {
  if (name.empty() || name == "/") return !name.empty();
  for (std::size_t slash = 0; slash != std::string::npos;) {  // H5Lexists wants every step of the way to exist
    slash = name.find('/', slash + 1);
    const std::string way = name.substr(0, slash);
    if (H5Lexists(file, way.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t link{};
    if (H5Lget_info(file, way.c_str(), &link, H5P_DEFAULT) < 0) refuse_damaged(path, way);
    if (link.type != H5L_TYPE_HARD) refuse(path, way + " is a link that leads elsewhere, which is not followed", "");
  }
  return H5Oexists_by_name(file, name.c_str(), H5P_DEFAULT) > 0;
}

void require(hid_t file, const std::filesystem::path& path, const std::string& name) {
  if (!exists(file, path, name)) refuse(path, "has no " + name, "check that it is the right kind of file");
}

Hdf5Handle open_dataset(hid_t file, const std::filesystem::path& path, const std::string& name) {
  require(file, path, name);
  Hdf5Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.valid()) refuse_damaged(path, name);
  if (H5Iget_type(object.get()) != H5I_DATASET)
    refuse(path, name + " is not a dataset", "check that it is the right kind of file");
  hsize_t size = 0;
  if (H5Fget_filesize(file, &size) < 0) refuse_damaged(path, name);
  const std::string problem = refused_dataset(object.get(), size);
  if (!problem.empty()) refuse(path, name + " " + problem, damaged_remedy);
  return object;
}

void require_class(hid_t type, bool text, const std::filesystem::path& path, const std::string& name) {
  const H5T_class_t found = H5Tget_class(type);
  const bool number = found == H5T_INTEGER || found == H5T_FLOAT || found == H5T_ENUM;
  if (text ? found != H5T_STRING : !number)
    refuse(path, name + (text ? " is not a text" : " does not hold numbers"),
           "check that it is the right kind of file");
}

template <class T>
std::vector<T> read_numbers(hid_t file, const std::filesystem::path& path, const std::string& name) {
  const Hdf5Handle dataset = open_dataset(file, path, name);
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  if (!type.valid() || !space.valid()) refuse_damaged(path, name);
  require_class(type.get(), false, path, name);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0) refuse_damaged(path, name);
  std::vector<T> data;
  try {
    data.resize(static_cast<std::size_t>(count));
  } catch (const std::exception&) {  // bad_alloc, length_error: a damaged header claims a size nothing could hold
    refuse_damaged(path, name);
  }
  if (count > 0 && H5Dread(dataset.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    refuse_damaged(path, name);
  return data;
}

/// `read(memory_type, buffer)` is H5Dread or H5Aread of a scalar string, of fixed or variable length.
template <class Read>
std::string read_text(hid_t type, const std::filesystem::path& path, const std::string& name, const Read& read) {
  require_class(type, true, path, name);
  if (H5Tis_variable_str(type) > 0) {
    char* pointer = nullptr;
    if (read(type, &pointer) < 0) refuse_damaged(path, name);
    std::string text = pointer == nullptr ? "" : pointer;
    H5free_memory(pointer);
    return text;
  }
  std::string text(H5Tget_size(type), '\0');  // no longer than what is stored: see refused_dataset()
  if (read(type, text.data()) < 0) refuse_damaged(path, name);
  return text.substr(0, text.find('\0'));
}

void require_scalar(hid_t space, const std::filesystem::path& path, const std::string& name) {
  if (H5Sget_simple_extent_npoints(space) != 1)
    refuse(path, name + " does not hold one value", "check that it is the right kind of file");
}

struct OpenAttribute {
  Hdf5Handle attribute;
  Hdf5Handle type;
  std::string name;
};

OpenAttribute open_attribute(hid_t file, const std::filesystem::path& path, const std::string& object,
                             const std::string& name) {
  const std::string full = "attribute " + name + " of " + object;
  require(file, path, object);
  if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0)
    refuse(path, "has no " + full, "check that it is the right kind of file");
  Hdf5Handle attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) refuse_damaged(path, full);
  Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type.valid() || !space.valid()) refuse_damaged(path, full);
  require_scalar(space.get(), path, full);
  return {std::move(attribute), std::move(type), full};
}

template <class T>
T read_number(const OpenAttribute& open, const std::filesystem::path& path) {
  require_class(open.type.get(), false, path, open.name);
  T value{};
  if (H5Aread(open.attribute.get(), native_type<T>(), &value) < 0) refuse_damaged(path, open.name);
  return value;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// A file that was looked at, as the system knows it.
struct Seen {
  dev_t device;
  ino_t number;
  off_t size;
  timespec changed, written;
  bool proved;
};

bool same(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

/// Files whose content was proved or tried by this process; frames of one file are read one by one. The caller holds
/// hdf5_lock().
std::vector<Seen>& seen_files() {
  static std::vector<Seen> files;
  return files;
}

/// Keeps what was found, but not of a file that was written just now: its time of writing may not tell it from the
/// next content.
void remember(const struct stat& status, bool proved) {
  constexpr std::size_t most = 256;
  constexpr time_t settled = 2;  // seconds
  std::vector<Seen>& files = seen_files();
  if (std::max(status.st_mtim.tv_sec, status.st_ctim.tv_sec) + settled > ::time(nullptr)) return;
  if (files.size() == most) files.clear();
  files.push_back({status.st_dev, status.st_ino, status.st_size, status.st_ctim, status.st_mtim, proved});
}

/// Whether the file has a checksum that fits. One without is tried; what is damaged is refused.
bool is_proved(const OpenFile& file, const std::filesystem::path& path) {
  const struct stat& status = file.status;
  for (const Seen& seen : seen_files())
    if (seen.device == status.st_dev && seen.number == status.st_ino && seen.size == status.st_size &&
        same(seen.changed, status.st_ctim) && same(seen.written, status.st_mtim))
      return seen.proved;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const Trailer trailer = check_trailer(file.descriptor.get(), size, path);
  if (trailer == Trailer::damaged) refuse(path, "is damaged (its checksum does not fit)", damaged_remedy);
  if (trailer == Trailer::absent) {
    if (H5Fis_hdf5(path.c_str()) <= 0)
      refuse(path, "is not an HDF5 file, or may not be read",
             path.extension() == ".toml" ? "a design is evaluated first: perfora evaluate DESIGN.toml -o RESULT.h5"
                                         : "check the path and its permissions");
    if (!survives_reading(path, size)) refuse(path, "is cut off or damaged", damaged_remedy);
  }
  remember(status, trailer == Trailer::fits);
  return trailer == Trailer::fits;
}

}  // namespace

Hdf5Reader::Hdf5Reader(std::filesystem::path path, Checksum checksum) : path_(std::move(path)) {
  if (std::error_code none; std::filesystem::is_directory(path_, none)) refuse_folder(path_);
  const auto lock = hdf5_lock();
  const OpenFile file = open_regular(path_, wanted_file);
  if (file.status.st_size == 0) refuse(path_, "is empty", damaged_remedy);
  checked_ = is_proved(file, path_);
  if (checksum == Checksum::required && !checked_)
    refuse(path_, "has no checksum, so that damage would not be seen", damaged_remedy);
  file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, file_access().get());
  if (file_ < 0) refuse(path_, "is cut off or damaged", damaged_remedy);
}

Hdf5Reader::~Hdf5Reader() {
  const auto lock = hdf5_lock();
  H5Fclose(file_);
}

bool Hdf5Reader::has(const std::string& name) const {
  const auto lock = hdf5_lock();
  return exists(file_, path_, name);
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
  const auto lock = hdf5_lock();
  require(file_, path_, group);
  const Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.valid()) refuse(path_, group + " is not a group", "check that it is the right kind of file");
  std::vector<std::string> names;
  if (H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0)
    refuse_damaged(path_, group);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::int64_t> Hdf5Reader::shape(const std::string& name) const {
  const auto lock = hdf5_lock();
  const Hdf5Handle dataset = open_dataset(file_, path_, name);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) refuse_damaged(path_, name);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

std::vector<double> Hdf5Reader::doubles(const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_numbers<double>(file_, path_, name);
}

std::vector<std::int32_t> Hdf5Reader::int32s(const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_numbers<std::int32_t>(file_, path_, name);
}

std::vector<std::int64_t> Hdf5Reader::int64s(const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_numbers<std::int64_t>(file_, path_, name);
}

std::vector<std::uint64_t> Hdf5Reader::uint64s(const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_numbers<std::uint64_t>(file_, path_, name);
}

std::vector<std::uint8_t> Hdf5Reader::uint8s(const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_numbers<std::uint8_t>(file_, path_, name);
}

std::string Hdf5Reader::text(const std::string& name) const {
  const auto lock = hdf5_lock();
  const Hdf5Handle dataset = open_dataset(file_, path_, name);
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  if (!type.valid() || !space.valid()) refuse_damaged(path_, name);
  require_scalar(space.get(), path_, name);
  return read_text(type.get(), path_, name, [&dataset](hid_t memory, void* buffer) {
    return H5Dread(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  });
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  const auto lock = hdf5_lock();
  return exists(file_, path_, object) && H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::attribute_text(const std::string& object, const std::string& name) const {
  const auto lock = hdf5_lock();
  const OpenAttribute open = open_attribute(file_, path_, object, name);
  return read_text(open.type.get(), path_, open.name,
                   [&open](hid_t memory, void* buffer) { return H5Aread(open.attribute.get(), memory, buffer); });
}

double Hdf5Reader::attribute_double(const std::string& object, const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_number<double>(open_attribute(file_, path_, object, name), path_);
}

std::int64_t Hdf5Reader::attribute_int(const std::string& object, const std::string& name) const {
  const auto lock = hdf5_lock();
  return read_number<std::int64_t>(open_attribute(file_, path_, object, name), path_);
}

}  // namespace perfora::io
