// What is here: a checkpoint written and read (docs/user/formats.md): a group a struct, its numbers as attributes, its
// arrays as datasets, all by the names of their members. What is not: the state it holds (simulation.h).
#include "solver/checkpoint.h"

#include <type_traits>

#include "io/error.h"
#include "io/hdf5.h"
#include "results/file_parts.h"
#include "results/formats.h"
#include "solver/checkpoint_checks.h"
#include "solver/checkpoint_members.h"

namespace perfora::solver {
namespace {

template <class Value>
constexpr bool is_number = std::is_same_v<Value, double> || std::is_same_v<Value, std::int64_t>;
template <class Value>
constexpr bool is_array = false;
template <class Element>
constexpr bool is_array<std::vector<Element>> = true;
template <class Value>
constexpr bool is_events = std::is_same_v<Value, std::vector<results::BreakEvent>>;

std::string object(const std::string& group) {
  return group.empty() ? "/" : group;
}

class Writing {
 public:
  Writing(io::Hdf5Writer& file, std::string group) : file_(file), group_(std::move(group)) {}

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    const std::string path = group_ + "/" + std::string(name);
    if constexpr (is_number<Value>) {
      file_.attribute(object(group_), std::string(name), value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      file_.text(path, value);
    } else if constexpr (is_events<Value>) {
      results::write_events(file_, path, value);
    } else if constexpr (is_array<Value>) {
      file_.dataset(path, value);
    } else {
      file_.group(path);
      Writing inner(file_, path);
      visit_members(inner, value);
    }
  }

 private:
  io::Hdf5Writer& file_;
  std::string group_;
};

class Reading {
 public:
  Reading(const io::Hdf5Reader& file, std::string group, std::int32_t discs)
      : file_(file), group_(std::move(group)), discs_(discs) {}

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    const std::string path = group_ + "/" + std::string(name);
    if constexpr (is_events<Value>) {
      value = results::read_events(file_, path, discs_);
    } else if constexpr (is_number<Value> || is_array<Value> || std::is_same_v<Value, std::string>) {
      read(path, std::string(name), value);
    } else {
      Reading inner(file_, path, discs_);
      visit_members(inner, value);
    }
  }

 private:
  void read(const std::string&, const std::string& name, double& value) const {
    value = file_.attribute_double(object(group_), name);
  }
  void read(const std::string&, const std::string& name, std::int64_t& value) const {
    value = file_.attribute_int(object(group_), name);
  }
  void read(const std::string& path, const std::string&, std::string& value) const { value = file_.text(path); }
  void read(const std::string& path, const std::string&, std::vector<double>& value) const {
    value = file_.doubles(path);
  }
  void read(const std::string& path, const std::string&, std::vector<std::int32_t>& value) const {
    value = file_.int32s(path);
  }
  void read(const std::string& path, const std::string&, std::vector<std::int64_t>& value) const {
    value = file_.int64s(path);
  }
  void read(const std::string& path, const std::string&, std::vector<std::uint64_t>& value) const {
    value = file_.uint64s(path);
  }
  void read(const std::string& path, const std::string&, std::vector<std::uint8_t>& value) const {
    value = file_.uint8s(path);
  }

  const io::Hdf5Reader& file_;
  std::string group_;
  std::int32_t discs_;
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint) {
  io::Hdf5Writer file(path);
  file.attribute("/", "format", std::string(results::checkpoint_format));
  // For people (perfora show).
  const LoadingState& loading = checkpoint.simulation.progress.loading;
  file.attribute("/", "strain", path_strain(loading));
  file.attribute("/", "steps", checkpoint.simulation.progress.steps);
  Writing writing(file, "");
  visit_members(writing, checkpoint);
  file.commit();
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const Simulation& simulation) {
  const io::Hdf5Reader file(path);
  if (!file.has_attribute("/", "format") || file.attribute_text("/", "format") != results::checkpoint_format)
    throw io::InputError({path.string(), 0, "format"}, "this is not a checkpoint that this version of perfora can read",
                         std::string("allowed is ") + results::checkpoint_format);
  if (!file.checked())
    throw io::InputError({path.string(), 0, ""}, "has no checksum, so that damage would not be seen");
  Checkpoint checkpoint;
  Reading reading(file, "", simulation.discs().size());
  visit_members(reading, checkpoint);
  require_sound(path, checkpoint, simulation);
  return checkpoint;
}

}  // namespace perfora::solver
