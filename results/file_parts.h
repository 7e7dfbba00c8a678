// What is here: the groups and attributes that several result files share, written and read in one place, with the
// checks of what is read. What is not: whole files (run_file.h, pack_file.h, material_file.h, elastic_file.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/packing.h"
#include "io/hdf5.h"
#include "results/break_event.h"
#include "results/frame.h"
#include "results/history.h"
#include "results/provenance.h"

namespace perfora::results {

/// Throws io::InputError that names the file, the dataset `key`, what is wrong and what is allowed.
[[noreturn]] void refuse(const io::Hdf5Reader& file, const std::string& key, const std::string& problem,
                         const std::string& allowed = {});
/// Throws io::InputError unless the attribute `format` is `wanted`; `what` is "a run", `remedy` what to give instead.
void require_format(const io::Hdf5Reader& file, const std::string& wanted, const std::string& what,
                    const std::string& remedy);
template <class Values>
void require_size(const io::Hdf5Reader& file, const std::string& name, const Values& values, std::size_t wanted) {
  if (values.size() != wanted)
    refuse(file, name, "has " + std::to_string(values.size()) + " numbers where " + std::to_string(wanted) + " belong");
}
/// Indices of discs, each in 0 .. discs - 1.
void require_discs(const io::Hdf5Reader& file, const std::string& name, const std::vector<std::int32_t>& indices,
                   std::int32_t discs);
/// Equally long, finite, positive radii.
/// 0 or 1, as BreakMode.
void require_modes(const io::Hdf5Reader& file, const std::string& name, const std::vector<std::int32_t>& modes);
void require_packing(const io::Hdf5Reader& file, const std::string& group, const geometry::Packing& packing);
std::vector<double> finite_doubles(const io::Hdf5Reader& file, const std::string& name);
std::string optional_text(const io::Hdf5Reader& file, const std::string& name);
/// An attribute of the file; "" where there is none.
std::string optional_attribute(const io::Hdf5Reader& file, const std::string& name);

/// Format, provenance, /config and /summary: how every result file begins and ends.
void write_head(io::Hdf5Writer& file, const char* format, const Provenance& provenance, const nlohmann::json& summary);
Provenance read_provenance(const io::Hdf5Reader& file);
/// {} when the file has none.
nlohmann::json read_summary(const io::Hdf5Reader& file);

void write_history(io::Hdf5Writer& file, const std::string& group, const History& history);
/// Columns that the file lacks are empty.
History read_history(const io::Hdf5Reader& file, const std::string& group);

void write_events(io::Hdf5Writer& file, const std::string& group, const std::vector<BreakEvent>& events);
/// None where the file has no such group.
std::vector<BreakEvent> read_events(const io::Hdf5Reader& file, const std::string& group, std::int32_t discs);

void write_frame_group(io::Hdf5Writer& file, const std::string& group, const Frame& frame);
/// `name`: of the frame in its file.
FrameInfo read_frame_info(const io::Hdf5Reader& file, const std::string& group, const std::string& name);
Frame read_frame_group(const io::Hdf5Reader& file, const std::string& group, const FrameInfo& info, std::int32_t discs);

}  // namespace perfora::results
